"use strict";

/** All robots: what they do now, when they are done, how much the others cost them. */
class RobotList {
  constructor(plan, motion, choice, words) {
    Object.assign(this, { plan, motion, choice, words });
    this.find = document.getElementById("find-robot");
    this.sort = document.getElementById("sort");
    this.list = new VirtualList(document.getElementById("robot-list"), {
      rowHeight: 34,
      none: "No robot has that name.",
      fill: (row, robot) => this.#fill(row, robot),
      choose: (robot) => choice.chooseRobot(robot.index),
    });
    this.find.addEventListener("input", () => this.#select());
    this.sort.addEventListener("click", () => this.#toggleSort());
    choice.on("choice", () => this.list.setChosen(choice.robot));
    this.#select();
  }

  /** Write again what the robots in sight do. */
  refresh() {
    this.list.refresh();
  }

  #select() {
    const part = this.find.value.trim().toLowerCase();
    const found = this.plan.robots.filter((robot) => robot.name.toLowerCase().includes(part));
    if (this.sort.getAttribute("aria-pressed") === "true") found.sort((one, other) => other.delay - one.delay);
    this.list.setItems(found);
  }

  #toggleSort() {
    this.sort.setAttribute("aria-pressed", this.sort.getAttribute("aria-pressed") !== "true");
    this.#select();
    this.list.box.scrollTop = 0;
  }

  #fill(row, robot) {
    const state = ACTIVITY_WORDS[this.motion.activity[robot.index]];
    if (row.filled === robot) {
      if (row.state.textContent !== state) row.state.textContent = state;
      return;
    }
    row.filled = robot;
    row.state = element("span", { className: "state" }, state);
    const late = element("span", { className: "late" }, `${this.words.time(robot.completion)} `);
    if (robot.delay > 0) late.append(element("small", {}, `+${this.words.time(robot.delay)}`));
    late.title = `Done at ${this.words.time(robot.completion)}, alone ${this.words.time(robot.alone)}`;
    row.replaceChildren(swatch(robot), element("span", { className: "name" }, robot.name), row.state, late);
  }
}
