"use strict";

/** The head of the page: what the plan achieves, in a sentence and in figures. */
function showSummary(plan, words) {
  const { flowtime, makespan, lowerBound } = plan.metrics;
  const count = plan.robots.length;
  document.getElementById("headline").textContent = `${counted(count, "robot")}, done at ${words.time(makespan)}`;
  const gap = lowerBound ? words.percent(flowtime / lowerBound - 1) : "";
  const figures = [
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
