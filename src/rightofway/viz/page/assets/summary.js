"use strict";

/** The head of the page: what the plan achieves, in a sentence and in figures. */
function showSummary(plan, words) {
  const { flowtime, makespan, lowerBound } = plan.metrics;
  const count = plan.robots.length;
  document.getElementById("headline").textContent = `${counted(count, "robot")}, ${headline(plan, words)}`;
  const gap = lowerBound ? words.percent(flowtime / lowerBound - 1) : "";
  const figures = [
    ...steadyFigures(plan, words),
    ...floorFigures(plan, words),
    ["Flowtime", words.time(flowtime), "Sum of all completion times"],
    ["Makespan", words.time(makespan), "When the last robot is done"],
    ["Lower bound", words.time(lowerBound), "Sum of all completion times if every robot were alone"],
    ["Gap", gap, "How far the flowtime is above its lower bound"],
    ["Planner", [plan.planner.name, plan.planner.status].filter(Boolean).join(": "), "Who made the plan, and how"],
  ];
  const known = figures.filter(([, value]) => value);
  document.getElementById("figures").replaceChildren(...known.map(([term, value, title]) =>
    element("div", { title }, element("dt", {}, term), element("dd", { className: "name" }, value))));
}

/** What matters most of a plan, of one that repeats itself, and of what became of one. */
function headline(plan, words) {
  const { makespan } = plan.metrics;
  if (plan.happened) return `planned to be done at ${words.time(makespan)}, ${outcome(plan, words)}`;
  if (plan.steady?.groups.length === 1) return `the same every ${words.time(plan.steady.largest.period)}`;
  if (plan.steady) return `in ${plan.steady.groups.length} groups that repeat themselves`;
  return `done at ${words.time(makespan)}`;
}

function outcome({ happened }, words) {
  const failed = happened.filter(({ ending }) => ending !== DONE).length;
  if (failed) return `${counted(failed, "robot")} never`;
  return `were at ${words.time(Math.max(...happened.map(({ completion }) => completion)))}`;
}

function steadyFigures({ steady }, words) {
  if (!steady) return [];
  const { start, period } = steady.largest;
  return [
    ["Period", words.time(period), "After how long everything comes again"],
    ["Transient", words.time(start), "How long it takes until it does"],
  ];
}

function floorFigures({ happened }, words) {
  if (!happened) return [];
  const late = happened.filter(({ delayInAll }) => delayInAll > 0).length;
  const most = happened.filter(({ ending }) => ending === DONE).reduce((most, robot) => Math.max(most, robot.delayInAll), 0);
  return [
    ["Late", `${late} of ${happened.length}`, "Robots that were done later than planned, or never"],
    ["Latest by", words.time(most), "The longest that a robot was late when it was done"],
  ];
}
