import { element, facts, goTo, link, swatch } from "../common/dom.js";
import { FloorRobot } from "../plan/floor.js";
import { said, texts, withKey } from "../language/language.js";
import { BROKEN, WAIT } from "../plan/phases.js";
import { chooseAt } from "./two_line_list.js";
import { joined, upperFirst } from "../language/words.js";

/** @import { Root } from "../common/root.js" */
/** @import { Choice } from "../player/choice.js" */
/** @import { Clock } from "../player/clock.js" */
/** @import { Comparison } from "../figures/comparison.js" */
/** @import { DecisionData, FaultData, ForcedLossData } from "../payload.d.ts" */
/** @import { JobCards } from "../jobs/job_cards.js" */
/** @import { Live } from "../live/live.js" */
/** @import { Plan } from "../plan/plan.js" */
/** @import { Robot, Stage } from "../plan/robot.js" */
/** @import { Space } from "../plan/space.js" */
/** @import { Words } from "../language/words.js" */

const MOST_LINES = 200; // of stages or losses in a card

/** @typedef {[string, string | Node | null]} Term A term, and what it is. */

/** All about the robot, job, decision, fault or forced loss that is chosen. */
export class Card {
  /**
   * @param {Root} root
   * @param {Plan} plan
   * @param {Clock} clock
   * @param {Choice} choice
   * @param {Words} words
   * @param {Comparison | null} comparison
   * @param {Space} space
   * @param {Live | null} [live] of a fleet that is driven
   * @param {JobCards | null} [jobs] of a plan with jobs
   */
  constructor(root, plan, clock, choice, words, comparison, space, live = null, jobs = null) {
    this.live = live;
    this.jobs = jobs;
    this.root = root;
    this.plan = plan;
    this.clock = clock;
    this.choice = choice;
    this.words = words;
    this.comparison = comparison;
    this.space = space;
    this.box = root.part("card");
    choice.on("choice", () => this.#show());
    choice.on("mode", () => this.#show());
  }

  /** Write again what is known of a robot that is driven, where that has changed. */
  refresh() {
    const { robot } = this.choice;
    if (!robot?.isDriven || this.box.hidden) return;
    const { scrollTop } = this.box;
    const [known] = this.root.all(".card .facts.now", HTMLElement);
    const fresh = this.#now(robot);
    if (!known || known.textContent === fresh.textContent) return;
    known.replaceWith(fresh);
    this.box.scrollTop = scrollTop;
  }

  /** @param {Robot} robot */
  #now(robot) {
    const list = facts(this.live?.facts(robot.index) ?? []);
    list.classList.add("now");
    return list;
  }

  #show() {
    this.box.hidden = !this.choice.robot && !this.choice.job;
    if (this.box.hidden) return;
    this.box.replaceChildren(...this.#content());
    this.box.scrollTop = 0;
    this.#clearMap();
  }

  #content() {
    const { robot, job, fault, forcedLoss, decisionIndex } = this.choice;
    const decision = this.plan.decisions[decisionIndex];
    if (fault) return this.#fault(fault);
    if (forcedLoss) return this.#forcedLoss(forcedLoss);
    if (decision) return this.#decision(decision);
    if (job && this.jobs) return [this.#header(...this.jobs.title(job)), ...this.jobs.job(job)];
    return robot ? this.#robot(robot) : [];
  }

  /** Where the card lies over the lower half of the screen, bring the map above it. */
  #clearMap() {
    const [map] = this.root.all(".map", HTMLElement);
    const { top, bottom } = map.getBoundingClientRect();
    const isOver =
      getComputedStyle(this.box).position === "fixed" &&
      bottom > this.box.getBoundingClientRect().top;
    if (isOver && top > 0 && top < innerHeight / 2) map.scrollIntoView();
  }

  /** @param {...Node | string} title */
  #header(...title) {
    const label = { ariaLabel: texts.chooseNothing, title: withKey(texts.chooseNothing, "Esc") };
    const close = element("button", { type: "button", className: "quiet", ...label }, "✕");
    close.addEventListener("click", () => this.choice.chooseNothing());
    return element("header", {}, ...title, close);
  }

  /** @param {Robot} robot */
  #robot(robot) {
    const { words } = this;
    const rerouted = this.plan.reroutes.find((reroute) => reroute.robot === robot.index);
    /** @type {Term[]} */
    const changes = (this.comparison?.changesOf(robot) ?? []).map(([title, change]) => [
      texts.inPlan({ title }),
      change,
    ]);
    return [
      this.#header(swatch(robot), element("h2", { className: "name" }, robot.name)),
      ...(robot instanceof FloorRobot || this.plan.steady || this.plan.shift
        ? []
        : this.#sum(robot)),
      ...(robot.isDriven ? [this.#now(robot)] : []),
      facts([
        ...this.#times(robot),
        ...changes,
        [texts.speed, this.plan.quantities.speed(robot.speed)],
        [texts.radius, robot.radius ? this.plan.quantities.length(robot.radius) : ""],
        [texts.home, words.where(robot.home)],
        [texts.anotherWay, said(rerouted?.because ?? "")],
      ]),
      ...(this.jobs?.tour(robot) ?? this.#trip(robot)),
      ...this.#losses(robot),
      ...this.#forcedLosses(robot),
      ...this.#encounters(robot),
    ];
  }

  /** @param {Robot} robot */
  #trip(robot) {
    const lines = this.#lines(robot.stages, (stage) => this.#stage(robot, stage));
    return [element("h3", {}, texts.trip), lines];
  }

  /**
   * How near other robots come, the one with least room to spare first.
   *
   * @param {Robot} robot
   */
  #encounters(robot) {
    const encounters = this.plan.shift ? [] : this.space.encounters(robot);
    if (!encounters.length) return [];
    const lines = this.#lines(encounters, (encounter) => {
      const text = `${encounter.other.name}, ${this.words.apart(encounter)}`;
      return goTo(this.words.time(encounter.tick), text, () =>
        chooseAt(this.clock, encounter.tick, () => this.choice.lookAtPair(encounter.other.index)),
      );
    });
    return [element("h3", {}, texts.closest), lines];
  }

  /**
   * Where the completion time goes: alone + detours + making room + waiting.
   *
   * @param {Robot} robot
   */
  #sum(robot) {
    const { detours, makingRoom, waiting } = robot.lost;
    /** @type {[string, number][]} */
    const causes = [
      [texts.detours, detours],
      [texts.makingRoom, makingRoom],
      [texts.waiting, waiting],
    ];
    const parts = causes.filter(([, ticks]) => ticks);
    /**
     * @param {string} sign
     * @param {string} term
     * @param {number} ticks
     * @param {string} [className]
     */
    const row = (sign, term, ticks, className = "") =>
      element(
        "tr",
        { className },
        element("td", {}, sign),
        element("th", { scope: "row" }, term),
        element("td", {}, this.words.time(ticks)),
      );
    const end = texts.doneAt({ isHome: this.plan.endsAtHome });
    const table = element(
      "table",
      { className: "sum" },
      row("", texts.alone, robot.alone),
      ...parts.map(([term, ticks]) => row(ticks < 0 ? "−" : "+", term, Math.abs(ticks))),
      row("=", end, robot.completion, "all"),
    );
    return parts.length
      ? [table]
      : [table, element("p", { className: "none-lost" }, texts.losesNothing)];
  }

  /**
   * @param {Robot} robot
   * @returns {Term[]}
   */
  #times(robot) {
    if (robot instanceof FloorRobot && robot.isDriven)
      return [[texts.planned, this.words.time(robot.planned.completion)]];
    if (robot instanceof FloorRobot) return this.#floorTimes(robot);
    return this.plan.steady ? this.#lapTimes(robot) : [];
  }

  /**
   * @param {FloorRobot} robot
   * @returns {Term[]}
   */
  #floorTimes(robot) {
    const { words } = this;
    const waited = robot.losses.reduce((sum, { ticks }) => sum + ticks, 0);
    /** @type {Term[]} */
    const planned = [
      [texts.planned, words.time(robot.planned.completion)],
      [texts.heldUp, robot.held ? texts.inAll({ time: words.time(robot.held) }) : ""],
      [texts.waits, waited ? texts.inAll({ time: words.time(waited) }) : texts.never],
    ];
    if (robot.ending === BROKEN)
      return [[texts.breaksDown, texts.at({ moment: words.time(robot.broken) })], ...planned];
    if (robot.ending === WAIT)
      return [[texts.done, words.stuck(robot.stuckBehind(this.plan.happened ?? []))], ...planned];
    return [
      [
        texts.doneAt({ isHome: false }),
        `${words.time(robot.completion)} (${words.lateness(robot.delayInAll)})`,
      ],
      ...planned,
    ];
  }

  /**
   * From when on it repeats itself, and how often.
   *
   * @param {Robot} robot
   * @returns {Term[]}
   */
  #lapTimes(robot) {
    const { steady } = this.plan;
    const group = steady?.groupOf[robot.index];
    if (!steady || !group?.whole) return [[texts.repeats, texts.notShown]];
    const laps = steady.lapsInPeriod(robot.index);
    const [period, start] = [group.period, group.start].map((ticks) => this.words.time(ticks));
    return [[texts.repeats, texts.lapsEvery({ laps, period, start })]];
  }

  /**
   * @param {Robot} robot
   * @param {Stage} stage
   */
  #stage(robot, stage) {
    const dwell = [];
    if (stage.work) dwell.push(texts.works({ time: this.words.duration(stage.work) }));
    if (stage.turn && stage.visit + 1 < robot.vertices.length)
      dwell.push(texts.turns({ time: this.words.duration(stage.turn) }));
    const text = [this.words.where(stage.vertex), ...dwell].join(", ");
    if (stage.visit < 0) return goTo(this.live ? texts.driven.notYet : texts.never, text, () => {});
    return this.#moment(robot.enter[stage.visit], text);
  }

  /** @param {Robot} robot */
  #losses(robot) {
    if (!robot.losses.length) return [];
    const lines = this.#lines(robot.losses, (loss) =>
      this.#moment(loss.tick, this.plan.phrases.said(loss.text), loss.places),
    );
    return [element("h3", {}, robot instanceof FloorRobot ? texts.waits : texts.losesTime), lines];
  }

  /**
   * What the robot and others lose in every plan.
   *
   * @param {Robot} robot
   */
  #forcedLosses(robot) {
    const { forcedLosses, phrases } = this.plan;
    const own = forcedLosses.filter(({ robots }) => robots.includes(robot.index));
    if (!own.length) return [];
    const lines = this.#lines(own, (loss) =>
      goTo(this.words.time(loss.tick), phrases.said(loss.head), () =>
        chooseAt(this.clock, loss.tick, () =>
          this.choice.chooseForcedLoss(forcedLosses.indexOf(loss)),
        ),
      ),
    );
    return [element("h3", {}, texts.inEveryPlan), lines];
  }

  /** @param {ForcedLossData} loss */
  #forcedLoss(loss) {
    const { phrases } = this.plan;
    const robots = loss.robots.map((index) => this.choice.robots[index]);
    const names = robots.map((robot) =>
      link(robot.name, () => this.choice.chooseRobot(robot.index)),
    );
    return [
      this.#header(...robots.map(swatch), element("h2", {}, ...joined(names))),
      element("p", { className: "name" }, texts.whyNoneIsBetter),
      element("p", {}, phrases.said(loss.text)),
      element("ol", {}, this.#moment(loss.tick, texts.inThisPlan, loss.vertices)),
    ];
  }

  /**
   * @template I
   * @param {readonly I[]} items
   * @param {(item: I) => HTMLElement} make
   */
  #lines(items, make) {
    const list = element("ol", {}, ...items.slice(0, MOST_LINES).map(make));
    if (items.length > MOST_LINES)
      list.append(element("li", {}, texts.andMore({ count: items.length - MOST_LINES })));
    return list;
  }

  /**
   * @param {number} tick
   * @param {string} text
   * @param {number[]} [places]
   */
  #moment(tick, text, places = []) {
    return goTo(this.words.time(tick), text, () =>
      chooseAt(this.clock, tick, () => this.choice.light(places)),
    );
  }

  /** @param {FaultData} fault */
  #fault(fault) {
    const { phrases } = this.plan;
    const remedy = phrases.said(fault.remedy);
    const robots = fault.robots.map((index) => this.choice.robots[index]);
    const names = robots.map((robot) =>
      link(robot.name, () => this.choice.chooseRobot(robot.index)),
    );
    const title = element("h2", {}, ...joined(names));
    return [
      this.#header(...robots.slice(0, 3).map(swatch), title),
      element("p", { className: "name wrong" }, `${phrases.said(fault.reason)}.`),
      ...(remedy ? [element("p", {}, upperFirst(`${remedy}.`))] : []),
      ...(this.plan.noPlan
        ? []
        : [
            element(
              "ol",
              {},
              this.#moment(fault.tick, texts.theFault({ kind: phrases.said(fault.name) })),
            ),
          ]),
    ];
  }

  /** @param {DecisionData} decision */
  #decision(decision) {
    const { phrases } = this.plan;
    const pair = decision.robots.map((index) => this.choice.robots[index]);
    const names = pair.map((robot) => link(robot.name, () => this.choice.chooseRobot(robot.index)));
    const title = element("h2", {}, ...joined(names));
    return [
      this.#header(swatch(pair[0]), swatch(pair[1]), title),
      element("p", { className: "name" }, phrases.said(decision.story)),
      element("p", { className: "name" }, phrases.said(decision.reason)),
      ...this.#choices(decision, pair),
    ];
  }

  /**
   * The two choices side by side, the one that was taken stronger; nothing where no figure decided.
   *
   * @param {DecisionData} decision
   * @param {Robot[]} pair
   */
  #choices(decision, pair) {
    /**
     * @param {"th" | "td"} tag
     * @param {string} text
     * @param {number} side
     */
    const cell = (tag, text, side) =>
      element(tag, { className: decision.waits === decision.robots[side] ? "taken" : "" }, text);
    /**
     * @param {"th" | "td"} tag
     * @param {string} label
     * @param {string[]} both
     */
    const row = (tag, label, both) =>
      element(
        "tr",
        {},
        element("th", {}, label),
        ...both.map((text, side) => cell(tag, text, side)),
      );
    const head = row(
      "th",
      texts.ifItWaits,
      pair.map((robot) => robot.name),
    );
    const { phrases } = this.plan;
    const rows = decision.figures.map(([label, ...both]) =>
      row(
        "td",
        phrases.said(label),
        both.map((text) => phrases.said(text)),
      ),
    );
    return rows.length ? [element("table", { className: "choices" }, head, ...rows)] : [];
  }
}
