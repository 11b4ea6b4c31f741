"use strict";

/** The head of the page: what the plan achieves, in a sentence and in figures. */
function showSummary(plan, words) {
  const headline = `${counted(plan.robots.length, "robot")}, ${outcome(plan, words)}`;
  document.getElementById("headline").textContent = headline;
  const about = plan.happened ? floorFigures : plan.steady ? steadyFigures : planFigures;
  const told = plan.happened ? [plan.planner.name] : [plan.planner.name, plan.planner.status];
  const figures = [...about(plan, words), ["Planner", told.filter(Boolean).join(": "), "Who made the plan, and how"]];
  const known = figures.filter(([, value]) => value);
  document.getElementById("figures").replaceChildren(...known.map(([term, value, title]) =>
    element("div", { title }, element("dt", {}, term), element("dd", { className: "name" }, value))));
}

/** What matters most of a plan, of one that repeats itself, and of what became of one. */
function outcome({ happened, steady, robots, metrics }, words) {
  const planned = words.time(metrics.makespan);
  if (happened) {
    const failed = happened.filter(({ ending }) => ending !== DONE).length;
    if (failed) return `${failed} of them never done`;
    const done = Math.max(...happened.map(({ completion }) => completion));
    return done === metrics.makespan ? `done at ${planned} as planned` : `done at ${words.time(done)} instead of ${planned}`;
  }
  const stuck = robots.filter(({ ending }) => ending === WAIT).length;
  if (stuck) return `${stuck} of them stuck for ever`;
  return steady ? repetition(steady, words) : `done at ${planned}`;
}

function repetition({ groups, groupOf, largest }, words) {
  const robots = groupOf.filter(Boolean).length;
  if (robots < groupOf.length) return `${robots} of them known to repeat themselves`;
  if (groups.length > 1) return `in ${groups.length} groups that repeat themselves`;
  return `the same every ${words.time(largest.period)}`;
}

function planFigures({ metrics: { flowtime, makespan, lowerBound } }, words) {
  const gap = lowerBound ? words.percent(flowtime / lowerBound - 1) : "";
  return [
    ["Flowtime", words.time(flowtime), "Sum of all completion times"],
    ["Makespan", words.time(makespan), "When the last robot is done"],
    ["Lower bound", words.time(lowerBound), "Sum of all completion times if every robot were alone"],
    ["Gap", gap, "How far the flowtime is above its lower bound"],
  ];
}

function steadyFigures({ steady }, words) {
  const { largest, groups } = steady;
  const laps = largest.robots.reduce((sum, index) => sum + steady.lapsInPeriod(index), 0);
  const whose = groups.length > 1 ? " of the largest group" : "";
  return [
    [`Period${whose}`, words.time(largest.period), "After how long everything comes again"],
    ["Transient", words.time(largest.start), "How long it takes until it does"],
    ["Laps", largest.whole ? `${laps} a period` : "", "Laps that all robots together make in a period"],
  ];
}

function floorFigures({ happened, metrics }, words) {
  const late = happened.filter(({ delayInAll }) => delayInAll > 0);
  const done = happened.filter(({ ending }) => ending === DONE);
  const most = done.reduce((most, { delayInAll }) => Math.max(most, delayInAll), 0);
  const flowtime = done.reduce((sum, { completion }) => sum + completion, 0);
  const all = done.length === happened.length;
  return [
    ["Late", `${late.length} of ${happened.length}`, "Robots that were done later than planned, or never"],
    ["Latest by", most ? words.time(most) : "", "How late the latest of those was that were done"],
    ["Flowtime", all ? `${words.time(flowtime)} instead of ${words.time(metrics.flowtime)}` : "", "Sum of all completion times"],
  ];
}
