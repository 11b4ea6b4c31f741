import { Bottleneck } from "./bottleneck.js";
import { Choice } from "./choice.js";
import { element, swatch } from "./dom.js";
import { connectFind, matches } from "./find.js";
import { texts } from "./language.js";
import { MapView } from "./map_view.js";
import { Motion } from "./motion.js";
import { VirtualList } from "./virtual_list.js";
import { Words } from "./words.js";

/**
 * Another plan of the scenario beside the first one: a map of its own, the same clock and choice, and
 * what each robot gains or loses.
 */
export class Comparison {
  constructor(plan, other, clock, choice, theme, mapView) {
    Object.assign(this, {
      plan,
      other,
      clock,
      choice,
      words: new Words(other),
      motion: new Motion(other),
    });
    this.otherChoice = new Choice(other);
    this.#linkChoices();
    const ghosts = new Motion({ robots: other.planned, roadmap: other.roadmap });
    const lit = new Bottleneck(other, clock, this.otherChoice, theme, this.words);
    const canvas = document.getElementById("other-map");
    canvas.parentElement.hidden = false;
    this.view = new MapView(canvas, other, theme, {
      motion: this.motion,
      ghosts,
      clock,
      choice: this.otherChoice,
      words: this.words,
      bottleneck: lit,
    });
    this.#linkViews(mapView);
    document.body.classList.add("compared");
    for (const [id, shown] of [
      ["map-title", plan],
      ["other-title", other],
    ])
      this.#title(document.getElementById(id), shown);
    this.find = document.getElementById("find-compared");
    this.list = new VirtualList(document.getElementById("compared-list"), {
      rowHeight: 50,
      className: "change",
      none: texts.noRobotNamed,
      fill: (row, robot) => this.#fill(row, robot),
      choose: (robot) => choice.chooseRobot(robot.index),
    });
    connectFind(this.find, this.list, () => this.#select());
    choice.on("choice", () => this.list.setChosen(this.plan.planned[choice.robotIndex] ?? null));
    theme.on("theme", () => (this.view.base.stale = true));
    this.#select();
  }

  /** Paint a frame. */
  paint() {
    this.motion.moveTo(this.clock.tick);
    this.view.paint();
  }

  refresh() {
    this.list.refresh();
  }

  /** How much later a robot is there in the other plan [ticks]; below 0 if it is earlier. */
  change(robot) {
    return this.other.planned[robot.index].completion - robot.completion;
  }

  /** The same in words: "6 s earlier". */
  changeInWords(robot) {
    const change = this.change(robot);
    if (!change) return texts.same;
    const time = this.words.time(Math.abs(change));
    return change < 0 ? texts.isEarlier(time) : texts.isLater(time);
  }

  #linkChoices() {
    const { choice, otherChoice } = this;
    choice.on("choice", () => otherChoice.chooseRobot(choice.robotIndex));
    otherChoice.on(
      "choice",
      () =>
        otherChoice.robotIndex !== choice.robotIndex && choice.chooseRobot(otherChoice.robotIndex),
    );
    choice.on("heat", () => otherChoice.toggleHeat());
    choice.on("space", () => {
      if (otherChoice.space !== choice.space) otherChoice.toggleSpace();
    });
    for (const event of ["choice", "heat", "space"])
      otherChoice.on(event, () => (this.view.base.stale = true));
  }

  /** Both maps show the same part. */
  #linkViews(mapView) {
    const follow = (view, other) =>
      view.viewport.on("view", () => {
        const { left, top, scale, fitted } = view.viewport;
        Object.assign(other.viewport, { left, top, scale, fitted });
        view.base.stale = other.base.stale = true;
        this.clock.tell("tick");
      });
    follow(mapView, this.view);
    follow(this.view, mapView);
  }

  #title(heading, { title, metrics, endsAtHome, faultCount }) {
    heading.hidden = false;
    const outcome = faultCount
      ? element("span", { className: "wrong" }, texts.faults(faultCount))
      : element("span", {}, texts.allArrived(endsAtHome, this.words.time(metrics.makespan)));
    heading.replaceChildren(element("b", { className: "name" }, title), outcome);
  }

  /** Those that gain most by the other plan first. */
  #select() {
    const found = this.plan.planned.filter((robot) => matches(robot.name, this.find.value));
    this.list.setItems(found.sort((one, another) => this.change(one) - this.change(another)));
  }

  #fill(row, robot) {
    if (row.filled === robot) return;
    row.filled = robot;
    const other = this.other.planned[robot.index];
    row.replaceChildren(
      swatch(robot),
      element("span", { className: "name" }, robot.name),
      element("span", { className: "late" }, this.changeInWords(robot)),
      element(
        "span",
        { className: "state" },
        `${this.words.time(robot.completion)} → ${this.words.time(other.completion)}`,
      ),
    );
  }
}
