import { element, facts, goTo, link, swatch } from "./dom.js";
import { BROKEN, WAIT } from "./phases.js";
import { counted } from "./quantities.js";

const MOST_LINES = 200; // of stages or losses in a card

/** All about the robot or decision that is chosen. */
export class Card {
  constructor(plan, clock, choice, words, comparison, space) {
    Object.assign(this, { plan, clock, choice, words, comparison, space });
    this.box = document.getElementById("card");
    choice.on("choice", () => this.#show());
    choice.on("mode", () => this.#show());
  }

  #show() {
    const { robot, decision, fault } = this.choice;
    this.box.hidden = !robot;
    if (!robot) return;
    const content = fault
      ? this.#fault(fault)
      : decision
        ? this.#decision(decision)
        : this.#robot(robot);
    this.box.replaceChildren(...content);
    this.box.scrollTop = 0;
    this.#clearMap();
  }

  /** Where the card lies over the lower half of the screen, bring the map above it. */
  #clearMap() {
    const map = document.querySelector(".map");
    const { top, bottom } = map.getBoundingClientRect();
    const isOver =
      getComputedStyle(this.box).position === "fixed" &&
      bottom > this.box.getBoundingClientRect().top;
    if (isOver && top > 0 && top < innerHeight / 2) map.scrollIntoView();
  }

  #header(...title) {
    const said = { ariaLabel: "Choose nothing", title: "Choose nothing (Esc)" };
    const close = element("button", { type: "button", className: "quiet", ...said }, "✕");
    close.addEventListener("click", () => this.choice.chooseNothing());
    return element("header", {}, ...title, close);
  }

  #robot(robot) {
    const { words } = this;
    const rerouted = this.plan.reroutes.find((reroute) => reroute.robot === robot.index);
    return [
      this.#header(swatch(robot), element("h2", { className: "name" }, robot.name)),
      ...(robot.planned || this.plan.steady ? [] : this.#sum(robot)),
      facts([
        ...this.#times(robot),
        ...(this.comparison
          ? [[`In ${this.plan.other.title}`, this.comparison.changeInWords(robot)]]
          : []),
        ["Speed", this.plan.quantities.speed(robot.speed)],
        ["Radius", robot.radius ? this.plan.quantities.length(robot.radius) : ""],
        ["Home", words.vertex(robot.home)],
        ["Another way", rerouted?.because ?? ""],
      ]),
      element("h3", {}, "Trip"),
      this.#lines(robot.stages, (stage) => this.#stage(robot, stage)),
      ...this.#losses(robot),
      ...this.#encounters(robot),
    ];
  }

  /** How near other robots come, the one with least room to spare first. */
  #encounters(robot) {
    const encounters = this.space.encounters(robot);
    if (!encounters.length) return [];
    const lines = this.#lines(encounters, (encounter) => {
      const text = `${encounter.other.name}, ${this.words.apart(encounter)}`;
      return goTo(this.words.time(encounter.tick), text, () => {
        this.clock.pause();
        this.clock.seek(encounter.tick);
        this.choice.lookAtPair(encounter.other.index);
      });
    });
    return [element("h3", {}, "Closest approaches"), lines];
  }

  /** Where the completion time goes: alone + detours + making room + waiting. */
  #sum(robot) {
    const { detours, makingRoom, waiting } = robot.lost;
    const parts = [
      ["Detours", detours],
      ["Making room", makingRoom],
      ["Waiting", waiting],
    ].filter(([, ticks]) => ticks);
    const row = (sign, term, ticks, className = "") =>
      element(
        "tr",
        { className },
        element("td", {}, sign),
        element("th", { scope: "row" }, term),
        element("td", {}, this.words.time(ticks)),
      );
    const end = this.plan.endsAtHome ? "Home at" : "Done at";
    const table = element(
      "table",
      { className: "sum" },
      row("", "Alone", robot.alone),
      ...parts.map(([term, ticks]) => row(ticks < 0 ? "−" : "+", term, Math.abs(ticks))),
      row("=", end, robot.completion, "all"),
    );
    return parts.length
      ? [table]
      : [table, element("p", { className: "none-lost" }, "It loses no time.")];
  }

  #times(robot) {
    if (robot.planned) return this.#floorTimes(robot);
    return this.plan.steady ? this.#lapTimes(robot) : [];
  }

  #floorTimes(robot) {
    const { words } = this;
    const waited = robot.losses.reduce((sum, { ticks }) => sum + ticks, 0);
    const planned = [
      ["Planned", words.time(robot.planned.completion)],
      ["Held up", robot.held ? `${words.time(robot.held)} in all` : ""],
      ["Waits", waited ? `${words.time(waited)} in all` : "never"],
    ];
    if (robot.ending === BROKEN)
      return [["Breaks down", `at ${words.time(robot.broken)}`], ...planned];
    if (robot.ending === WAIT)
      return [["Done", words.stuck(robot.stuckBehind(this.plan.happened))], ...planned];
    return [
      ["Done at", `${words.time(robot.completion)} (${words.lateness(robot.delayInAll)})`],
      ...planned,
    ];
  }

  /** From when on it repeats itself, and how often. */
  #lapTimes(robot) {
    const group = this.plan.steady.groupOf[robot.index];
    if (!group?.whole) return [["Repeats", "not within what is shown"]];
    const every = `${counted(this.plan.steady.lapsInPeriod(robot.index), "lap")} every ${this.words.time(group.period)}`;
    return [["Repeats", `${every}, from ${this.words.time(group.start)} on`]];
  }

  #stage(robot, stage) {
    const dwell = [];
    if (stage.work) dwell.push(`works ${this.words.duration(stage.work)}`);
    if (stage.turn && stage.visit + 1 < robot.vertices.length)
      dwell.push(`turns ${this.words.duration(stage.turn)}`);
    const text = [this.words.vertex(stage.vertex), ...dwell].join(", ");
    if (stage.visit < 0) return goTo("never", text, () => {});
    return this.#moment(robot.enter[stage.visit], text);
  }

  #losses(robot) {
    if (!robot.losses.length) return [];
    const lines = this.#lines(robot.losses, (loss) =>
      this.#moment(loss.tick, this.words.loss(loss, robot)),
    );
    return [element("h3", {}, robot.planned ? "Waits" : "Loses time"), lines];
  }

  #lines(items, make) {
    const list = element("ol", {}, ...items.slice(0, MOST_LINES).map(make));
    if (items.length > MOST_LINES)
      list.append(element("li", {}, `and ${items.length - MOST_LINES} more`));
    return list;
  }

  #moment(tick, text) {
    return goTo(this.words.time(tick), text, () => {
      this.clock.pause();
      this.clock.seek(tick);
    });
  }

  #fault(fault) {
    const robots = fault.robots.map((index) => this.plan.robots[index]);
    const names = robots.map((robot) =>
      link(robot.name, () => this.choice.chooseRobot(robot.index)),
    );
    const title = element(
      "h2",
      {},
      ...names.flatMap((name, i) => (i ? [i < names.length - 1 ? ", " : " and ", name] : [name])),
    );
    return [
      this.#header(...robots.slice(0, 3).map(swatch), title),
      element("p", { className: "name wrong" }, `${this.words.fault(fault)}.`),
      element("p", {}, this.words.remedy(fault)),
      ...(fault.reason
        ? []
        : [element("ol", {}, this.#moment(fault.tick, `the fault (${fault.kind})`))]),
    ];
  }

  #decision(decision) {
    const pair = decision.robots.map((index) => this.plan.robots[index]);
    const names = pair.map((robot) => link(robot.name, () => this.choice.chooseRobot(robot.index)));
    const title = element("h2", {}, names[0], " and ", names[1]);
    return [
      this.#header(swatch(pair[0]), swatch(pair[1]), title),
      element("p", { className: "name" }, this.words.decisionAtLength(decision)),
      element("p", { className: "name" }, this.words.reason(decision)),
      ...this.#choices(decision, pair),
    ];
  }

  /** The two choices side by side, the one that was taken stronger; nothing where no figure decided. */
  #choices(decision, pair) {
    const cell = (tag, text, side) =>
      element(
        tag,
        { className: decision.waits === decision.robots[side] ? "taken" : "" },
        String(text),
      );
    const row = (tag, label, both) =>
      element(
        "tr",
        {},
        element("th", {}, label),
        ...both.map((text, side) => cell(tag, text, side)),
      );
    const head = row(
      "th",
      "If it waits",
      pair.map((robot) => robot.name),
    );
    const rows = this.words.figures(decision).map(([label, ...both]) => row("td", label, both));
    return rows.length ? [element("table", { className: "choices" }, head, ...rows)] : [];
  }
}
