import { Orders } from "./orders.js";
import { element, goTo } from "../common/dom.js";
import { listenToFeed } from "./feed.js";
import { Punctuality } from "./punctuality.js";
import { said, texts } from "../language/language.js";
import { TwoLineList, chooseAt } from "../lists/two_line_list.js";

/** @import { Choice } from "../player/choice.js" */
/** @import { Clock } from "../player/clock.js" */
/** @import { Driven, Told } from "./driven.js" */
/** @import { DrivenFrame } from "../payload.d.ts" */
/** @import { Plan } from "../plan/plan.js" */
/** @import { Root } from "../common/root.js" */
/** @import { Theme } from "../drawing/theme.js" */
/** @import { TwoLines } from "../lists/two_line_list.js" */
/** @import { Words } from "../language/words.js" */

const MOST_TOLD = 2000; // sentences in the log, the latest ones
const NOT_MOVING = "still"; // the kind of alarm of a robot that may drive and does not move
const MOST_HOLD_UPS = 5; // robots that hold up others, the worst ones
const MOST_HELD_UP = 4; // robots that one holds up, by name
const WALL_WIDTH = 1200; // pixels, of a screen on a wall whose type is not enlarged
const LEAST_ZOOM = 1.2; // of large type
const MAP_SHARE = 0.8; // of the enlargement, for names on the map
const MARGIN = 1.25; // by how much the axis of time is longer than what has happened

/** What a page has of a fleet that is driven beside its map and diagram: whether it is live, trouble, the log, orders. */
export class Live {
  #lit = "";
  #heldUp = "[]";
  #isConnected = true;
  #hasBegun = false;

  /**
   * @param {Root} root
   * @param {Plan} plan
   * @param {Driven} driven
   * @param {Clock} clock
   * @param {Choice} choice
   * @param {Words} words
   * @param {Theme} theme
   */
  constructor(root, plan, driven, clock, choice, words, theme) {
    this.root = root;
    this.plan = plan;
    this.driven = driven;
    this.clock = clock;
    this.choice = choice;
    this.words = words;
    this.feed = /** @type {NonNullable<Plan["feed"]>} */ (plan.feed);
    this.button = root.part("live");
    this.state = root.part("live-state");
    this.box = root.part("alarms");
    this.count = root.all("#" + root.part("tab-log").id + " b", HTMLElement)[0];
    this.log = new TwoLineList(root, "told", choice, [], {
      none: texts.driven.nothingTold,
      isLong: true,
    });
    this.punctuality = new Punctuality(root, driven, choice, words);
    this.orders = new Orders(root, driven, choice, this.feed.orders ?? "");
    choice.alarmed = () =>
      driven.raw.map((_, robot) => robot).filter((robot) => this.isInTrouble(robot));
    root.part("live-box").hidden = false;
    this.button.hidden = !this.feed.stream;
    this.button.addEventListener("click", () => clock.follow());
    const wall = root.part("wall");
    wall.hidden = !this.feed.stream;
    wall.addEventListener("click", () => setWall(wall, !isOnWall(), theme));
    root.listen(window, "resize", () => setWall(wall, isOnWall(), theme));
    setWall(wall, isOnWall() || new URLSearchParams(location.search).has("wall"), theme);
    clock.on("playing", () => this.refresh());
    choice.on("choice", () => this.refresh());
    this.#lengthen();
    if (this.feed.stream) clock.live = () => driven.now;
    root.atEnd(
      listenToFeed(this.feed, {
        take: (frame) => this.take(frame),
        connect: (isConnected) => {
          if (isConnected !== this.#isConnected) {
            this.#isConnected = isConnected;
            this.choice.tell("fleet"); // what robots do is not known any more, or again
          }
          this.refresh();
        },
      }),
    );
    this.#showStory();
  }

  /** @param {DrivenFrame} frame */
  take(frame) {
    const { driven, clock, plan } = this;
    const sentences = driven.story.length;
    if (frame.rows.some(([, robot]) => robot >= driven.raw.length)) {
      location.reload(); // a robot has joined that this page does not have
      return;
    }
    driven.take(frame);
    plan.robots = plan.happened = driven.robots;
    this.#lengthen();
    if (!this.#hasBegun) {
      this.#hasBegun = true;
      if (driven.runs) {
        clock.seek(driven.now);
        clock.follow();
      }
    }
    if (frame.begins || driven.story.length !== sentences) this.#showStory();
    if (frame.ends !== undefined) this.punctuality.show();
    this.choice.tell("fleet");
    this.refresh();
  }

  /** Have the axis of time as long as the plan and all that has happened. */
  #lengthen() {
    const { driven, plan, clock } = this;
    const least = Math.max(driven.now, 1);
    const planned = Math.max(...this.plan.planned.map(({ completion }) => completion), 1);
    const isLong = clock.end < least;
    if (driven.runs && !isLong && clock.end >= planned) return;
    plan.end = driven.runs ? Math.max(planned, least * MARGIN) : Math.max(least, 1);
    clock.lengthen(plan.end);
  }

  /** Write again the rows in sight of lists that have come into sight. */
  refreshLists() {
    this.log.refresh();
    this.punctuality.refresh();
  }

  /** Write again what depends on the moment that is shown. */
  refresh() {
    this.#showState();
    this.#showAlarms();
    this.#showHoldUps();
    this.orders.refresh(this.clock.tick, this.#isConnected);
  }

  #showState() {
    const { clock, driven } = this;
    const isLive = clock.following && driven.runs && this.#isConnected;
    this.button.setAttribute("aria-pressed", String(isLive));
    this.button.classList.toggle("on", isLive);
    this.root.part("live-box").classList.toggle("follows", isLive);
    const { driven: words } = texts;
    const state = !this.feed.stream
      ? words.recorded
      : !this.#isConnected
        ? words.disconnected
        : !driven.runs
          ? words.ended
          : isLive
            ? words.isLive
            : words.lookingBack;
    if (this.state.textContent !== state) this.state.textContent = state;
    this.root.part("lost").hidden = this.#isConnected || !this.feed.stream || !driven.runs;
  }

  #showAlarms() {
    const alarms = this.driven.alarmsAt(this.clock.tick);
    const key = JSON.stringify(
      alarms.map(({ from, robot, kind, person }) => [from, robot, kind, person]),
    );
    if (key === this.#lit) return;
    this.#lit = key;
    this.box.hidden = !alarms.length;
    const list = this.root.part("alarm-list");
    list.replaceChildren(
      ...alarms
        .slice(-20)
        .reverse()
        .map(({ from, robot, text, person }) => {
          const seen = person ? ` (${texts.driven.seenBy({ person })})` : "";
          const line = goTo(this.words.time(from), said(text) + seen, () =>
            chooseAt(this.clock, from, () => this.choice.chooseRobot(robot)),
          );
          return line;
        }),
    );
  }

  /** List the robots that hold up others: those that cause a jam, not those that are in it. */
  #showHoldUps() {
    const { clock, driven, words } = this;
    const tick = clock.tick;
    const found = driven.holdUpsAt(tick).slice(0, MOST_HOLD_UPS);
    const lines = found.map(({ robot, victims, since }) => {
      const named = victims.slice(0, MOST_HELD_UP).map((victim) => words.robot(victim));
      const names = named.join(", ") + (victims.length > MOST_HELD_UP ? ", …" : "");
      const values = { name: words.robot(robot), robots: victims.length, names };
      return {
        robot,
        since: words.time(since),
        text: texts.driven.holdsUp(values),
        doing: this.doing(robot),
      };
    });
    const key = JSON.stringify(lines);
    if (key === this.#heldUp) return;
    this.#heldUp = key;
    this.root.part("hold-ups").hidden = !lines.length;
    this.root
      .part("hold-up-list")
      .replaceChildren(
        ...lines.map(({ robot, since, text, doing }) =>
          goTo(since, doing ? `${text} (${doing})` : text, () => this.choice.chooseRobot(robot)),
        ),
      );
  }

  #showStory() {
    const { story } = this.driven;
    this.count.textContent = String(story.length);
    this.log.setItems(
      story
        .slice(-MOST_TOLD)
        .reverse()
        .map((told) => this.#item(told)),
    );
  }

  /**
   * @param {Told} told
   * @returns {TwoLines}
   */
  #item({ tick, robot, kind, text }) {
    return {
      head: said(text),
      detail: this.words.time(tick),
      isAlarm: kind === "alarm",
      isChosen: () => false,
      choose: () => chooseAt(this.clock, tick, () => robot >= 0 && this.choice.chooseRobot(robot)),
    };
  }

  /**
   * What a robot does, where that is more than what it does by itself: it is in trouble, waits for others, is held, is off,
   * works for a job, or charges.
   *
   * @param {number} robot
   */
  doing(robot) {
    const { driven, clock, words } = this;
    const tick = clock.tick;
    if (driven.isOff(robot, tick)) return texts.driven.off;
    if (!this.#isConnected && driven.runs && tick >= driven.now) return texts.driven.unknown;
    const alarms = this.#alarmsOf(robot);
    if (alarms.some(({ kind }) => kind === NOT_MOVING)) return texts.driven.still;
    if (alarms.length) return texts.driven.alarmed;
    const wait = driven.waitAt(robot, tick);
    const names = wait?.others.map((other) => words.robot(other)).join(", ");
    if (names) return texts.driven.waitsFor({ names });
    if (driven.isHeld(robot, tick)) return texts.driven.held;
    const { task, percent } = this.#work(robot);
    return task ? [task, percent].filter(Boolean).join(", ") : "";
  }

  /**
   * What a robot does for a job, and its state of charge, as words.
   *
   * @param {number} robot
   */
  #work(robot) {
    const { task, percent } = this.driven.workAt(robot, this.clock.tick);
    return {
      task: said(task),
      percent: percent === null ? "" : texts.driven.percent({ percent }),
    };
  }

  /**
   * Whether there is an alarm of a robot at the moment shown.
   *
   * @param {number} robot
   */
  isInTrouble(robot) {
    return this.#alarmsOf(robot).length > 0;
  }

  /** @param {number} robot */
  #alarmsOf(robot) {
    const { driven, clock } = this;
    if (driven.isOff(robot, clock.tick)) return [];
    return driven.alarmsAt(clock.tick).filter((alarm) => alarm.robot === robot);
  }

  /**
   * What is known of a robot at the moment shown, as terms.
   *
   * @param {number} robot
   * @returns {[string, string | Node][]}
   */
  facts(robot) {
    const { driven, clock, words } = this;
    const { base, horizon } = driven.way(robot, clock.tick);
    const { driven: own } = texts;
    const wait = driven.waitAt(robot, clock.tick);
    const { task, percent } = this.#work(robot);
    /** @param {number[]} vertices */
    const places = (vertices) => {
      const shown = vertices.slice(0, 6).map((vertex) => words.short(vertex));
      return shown.join(", ") + (vertices.length > 6 ? ", …" : "");
    };
    /** @type {[string, string | Node][]} */
    const terms = [
      [own.task, task],
      [own.battery, percent],
      [own.waiting, wait ? said(wait.text) : ""],
      [own.since, wait ? words.moment(wait.since) : ""],
      [own.releasedTerm, base.length > 1 ? places(base.slice(1)) : own.nothing],
      [own.horizon, horizon.length > 1 ? places(horizon.slice(1)) : own.nothing],
      [own.operator, driven.isHeld(robot, clock.tick) ? own.held : ""],
    ];
    for (const { text, robot: other } of driven.alarmsAt(clock.tick))
      if (other === robot)
        terms.push([own.alarm, element("span", { className: "wrong" }, said(text))]);
    return terms;
  }
}

/** Whether the page has large type, for a screen on a wall. */
function isOnWall() {
  return document.documentElement.classList.contains("wall");
}

/**
 * Large type grows with the screen, which people look at from farther away.
 *
 * @param {HTMLElement} button
 * @param {boolean} isOn
 * @param {Theme} theme
 */
function setWall(button, isOn, theme) {
  const { classList, style } = document.documentElement;
  classList.toggle("wall", isOn);
  const zoom = Math.max(innerWidth / WALL_WIDTH, LEAST_ZOOM);
  style.setProperty("--zoom", String(zoom));
  style.setProperty("--map-zoom", String(isOn ? zoom * MAP_SHARE : 1));
  button.setAttribute("aria-pressed", String(isOn));
  theme.refresh();
}
