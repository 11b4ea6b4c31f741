"use strict";

const MOST_LINES = 200; // of stages or waits in a card

/** All about the robot or decision that is chosen. */
class Card {
  constructor(plan, clock, choice, words) {
    Object.assign(this, { plan, clock, choice, words });
    this.box = document.getElementById("card");
    choice.on("choice", () => this.#show());
    choice.on("mode", () => this.#show());
  }

  #show() {
    const { robot, decision } = this.choice;
    this.box.hidden = !robot;
    if (!robot) return;
    this.box.replaceChildren(...(decision ? this.#decision(decision) : this.#robot(robot)));
    this.box.scrollTop = 0;
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
    const waited = robot.waits.reduce((sum, wait) => sum + wait.ticks, 0);
    return [
      this.#header(swatch(robot), element("h2", { className: "name" }, robot.name)),
      facts([
        ...this.#times(robot),
        ["Held up", robot.held ? `${words.time(robot.held)} in all` : ""],
        ["Waits", waited ? `${words.time(waited)} in all` : "never"],
        ["Speed", this.plan.quantities.speed(robot.speed)],
        ["Home", words.vertex(robot.home)],
        ["Another way", rerouted?.because ?? ""],
      ]),
      element("h3", {}, "Trip"),
      this.#lines(robot.stages, (stage) => this.#stage(robot, stage)),
      ...this.#waits(robot),
    ];
  }

  #times(robot) {
    if (robot.planned) return this.#floorTimes(robot);
    return this.plan.steady ? this.#lapTimes(robot) : this.#planTimes(robot);
  }

  #planTimes(robot) {
    const { words } = this;
    const share = robot.alone ? `, ${words.percent(robot.delay / robot.alone)}` : "";
    const lost = robot.delay > 0 ? ` (+${words.time(robot.delay)}${share})` : "";
    return [["Done at", `${words.time(robot.completion)}${lost}`], ["Alone", words.time(robot.alone)]];
  }

  #floorTimes(robot) {
    const { words } = this;
    const planned = ["Planned", words.time(robot.planned.completion)];
    if (robot.ending === BROKEN) return [["Breaks down", `at ${words.time(robot.broken)}`], planned];
    if (robot.ending === WAIT) return [["Done", words.stuck(robot.stuckBehind(this.plan.happened))], planned];
    return [["Done at", `${words.time(robot.completion)} (${words.lateness(robot.delayInAll)})`], planned];
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
    if (stage.turn && stage.visit + 1 < robot.vertices.length) dwell.push(`turns ${this.words.duration(stage.turn)}`);
    const text = [this.words.vertex(stage.vertex), ...dwell].join(", ");
    if (stage.visit < 0) return goTo("never", text, () => {});
    return this.#moment(robot.enter[stage.visit], text);
  }

  #waits(robot) {
    if (!robot.waits.length) return [];
    const lines = this.#lines(robot.waits, (wait) => this.#moment(wait.tick, this.words.wait(wait, robot)));
    return [element("h3", {}, "Waits"), lines];
  }

  #lines(items, make) {
    const list = element("ol", {}, ...items.slice(0, MOST_LINES).map(make));
    if (items.length > MOST_LINES) list.append(element("li", {}, `and ${items.length - MOST_LINES} more`));
    return list;
  }

  #moment(tick, text) {
    return goTo(this.words.time(tick), text, () => {
      this.clock.pause();
      this.clock.seek(tick);
    });
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
      element(tag, { className: decision.waits === decision.robots[side] ? "taken" : "" }, String(text));
    const row = (tag, label, both) =>
      element("tr", {}, element("th", {}, label), ...both.map((text, side) => cell(tag, text, side)));
    const head = row("th", "If it waits", pair.map((robot) => robot.name));
    const rows = this.words.figures(decision).map(([label, ...both]) => row("td", label, both));
    return rows.length ? [element("table", { className: "choices" }, head, ...rows)] : [];
  }
}
