import { element, swatch } from "../common/dom.js";
import { connectFind, matches } from "./find.js";
import { FloorRobot } from "../plan/floor.js";
import { texts } from "../language/language.js";
import { BROKEN, WAIT } from "../plan/phases.js";
import { VirtualList } from "./virtual_list.js";

/** @import { Root } from "../common/root.js" */
/** @import { Choice } from "../player/choice.js" */
/** @import { Clock } from "../player/clock.js" */
/** @import { Live } from "../live/live.js" */
/** @import { Motion } from "../plan/motion.js" */
/** @import { Plan } from "../plan/plan.js" */
/** @import { Robot } from "../plan/robot.js" */
/** @import { Words } from "../language/words.js" */
/** @import { ListRow } from "./virtual_list.js" */

/** @typedef {ListRow<Robot> & { state?: HTMLElement, late?: HTMLElement }} RobotRow */

/** All robots: what they do now, when they are done, how much the others cost them. */
export class RobotList {
  /**
   * @param {Root} root
   * @param {Plan} plan
   * @param {Motion} motion
   * @param {Clock} clock
   * @param {Choice} choice
   * @param {Words} words
   * @param {Live | null} live of a fleet that is driven
   */
  constructor(root, plan, motion, clock, choice, words, live) {
    this.live = live;
    this.root = root;
    this.plan = plan;
    this.motion = motion;
    this.clock = clock;
    this.choice = choice;
    this.words = words;
    this.find = root.part("find-robot", HTMLInputElement);
    this.sort = root.part("sort");
    this.list = new VirtualList(root.part("robot-list"), {
      rowHeight: 34,
      none: texts.noRobotNamed,
      fill: (row, robot) => this.#fill(row, robot),
      choose: (robot) => choice.chooseRobot(robot.index),
    });
    connectFind(this.find, this.list, () => this.#select());
    this.sort.addEventListener("click", () => this.#toggleSort());
    choice.on("choice", () => this.list.setChosen(choice.robot));
    for (const event of ["mode", "fleet"]) choice.on(event, () => this.#select());
    // robots make different numbers of laps, and nobody has planned a shift
    this.sort.hidden = Boolean((plan.steady && !plan.happened) || plan.shift);
    this.#select();
  }

  /** Write again what the robots in sight do. */
  refresh() {
    this.list.refresh();
  }

  #select() {
    const found = this.choice.robots.filter((robot) => matches(robot.name, this.find.value));
    if (this.sort.getAttribute("aria-pressed") === "true")
      found.sort((one, other) => lost(other) - lost(one));
    this.list.setItems(found);
  }

  #toggleSort() {
    this.sort.setAttribute(
      "aria-pressed",
      String(this.sort.getAttribute("aria-pressed") !== "true"),
    );
    this.#select();
    this.list.box.scrollTop = 0;
  }

  /**
   * @param {RobotRow} row
   * @param {Robot} robot
   */
  #fill(row, robot) {
    const state = this.#state(robot);
    if (row.filled !== robot) this.#make(row, robot);
    if (row.state && row.state.textContent !== state) row.state.textContent = state;
    row.state?.classList.toggle("wrong", this.live?.isInTrouble(robot.index) ?? false);
    const now = this.#now(robot);
    if (row.late && now !== null && row.late.textContent !== now) row.late.textContent = now;
  }

  /** @param {Robot} robot */
  #state(robot) {
    if (this.live && robot instanceof FloorRobot && robot.isDriven) {
      const doing = this.live.doing(robot.index);
      return doing || texts.activities[this.motion.activity[robot.index]];
    }
    return this.#isStuck(robot) ? texts.stuck : texts.activities[this.motion.activity[robot.index]];
  }

  /**
   * Whether it waits for ever, and already longer than planned.
   *
   * @param {Robot} robot
   */
  #isStuck(robot) {
    const phase = this.motion.phase[robot.index];
    if (robot.ending !== WAIT || phase < robot.phases.begin.length - 1) return false;
    return !(robot instanceof FloorRobot) || this.clock.tick >= robot.unplannedFrom(phase);
  }

  /**
   * @param {RobotRow} row
   * @param {Robot} robot
   */
  #make(row, robot) {
    row.filled = robot;
    row.state = element("span", { className: "state" });
    row.late = element("span", { className: "late" });
    if (this.#now(robot) === null) this.#times(row.late, robot);
    row.replaceChildren(
      swatch(robot),
      element("span", { className: "name" }, robot.name),
      row.state,
      row.late,
    );
  }

  /**
   * When it is done, and what of that it owes to the others.
   *
   * @param {HTMLElement} late
   * @param {Robot} robot
   */
  #times(late, robot) {
    if (this.plan.shift) {
      late.textContent = texts.shift.robotDid({
        count: this.plan.shift.raw.robots[robot.index][0],
      });
      return;
    }
    late.append(element("span", {}, this.words.time(robot.completion)), " ");
    if (robot.delay > 0) late.append(element("small", {}, `+${this.words.time(robot.delay)}`));
    const [done, alone] = [robot.completion, robot.alone].map((tick) => this.words.moment(tick));
    late.title = texts.doneAloneAt({ isHome: this.plan.endsAtHome, moment: done, alone });
  }

  /**
   * How late it is at this moment, or which lap it is on; null where there is no such thing.
   *
   * @param {Robot} robot
   */
  #now(robot) {
    const { index } = robot;
    if (robot instanceof FloorRobot && robot.isDriven) {
      const visit = robot.phases.visit[this.motion.phase[index]];
      const late = robot.lateness(this.clock.wholeTick, visit);
      return late === null ? "" : this.words.lateness(late);
    }
    if (robot instanceof FloorRobot) {
      if (this.motion.activity[index] === BROKEN || this.#isStuck(robot)) return "";
      return this.words.lateness(
        robot.lateness(this.clock.wholeTick, robot.phases.visit[this.motion.phase[index]]),
      );
    }
    const { steady } = this.plan;
    if (!steady) return null;
    const { loop, tick, running } = this.clock;
    const made = loop ? steady.lapsForEver(index, running) : steady.laps(index, tick);
    return texts.lap({ number: made + 1 });
  }
}

/**
 * What a robot loses: to the others in a plan, against the plan on the floor.
 *
 * @param {Robot} robot
 */
function lost(robot) {
  return robot instanceof FloorRobot ? robot.delayInAll : robot.delay;
}
