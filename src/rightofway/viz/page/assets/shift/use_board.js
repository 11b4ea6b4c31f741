import { element, goTo, swatch } from "../common/dom.js";
import { texts } from "../language/language.js";
import { chooseAt } from "../lists/two_line_list.js";
import { VirtualList } from "../lists/virtual_list.js";
import { upperFirst } from "../language/words.js";

/** @import { Root } from "../common/root.js" */
/** @import { Choice } from "../player/choice.js" */
/** @import { Clock } from "../player/clock.js" */
/** @import { Plan } from "../plan/plan.js" */
/** @import { Robot } from "../plan/robot.js" */
/** @import { ShiftData, UseRow } from "../payload.d.ts" */
/** @import { Words } from "../language/words.js" */

export const SHIFT_TAB = `<button type="button" role="tab" id="tab-shift" aria-controls="shift" aria-selected="false" tabindex="-1"><span data-text="shiftTab"></span></button>`;

export const SHIFT_PANEL = `<div class="panel" id="shift" role="tabpanel" aria-labelledby="tab-shift" hidden>
  <div id="shift-figures" class="shift-figures" tabindex="0" role="group" data-label="shiftTab"></div>
  <div id="use-list" class="list" role="listbox" tabindex="0" data-label="robots"></div>
</div>`;

const KINDS = ["drive", "wait", "work", "charge", "idle"];
const SHOWN_PLACES = 5;
const MOST_EVENTS = 50;

/** How robots used their time, where they waited longest, and what happened. */
export class UseBoard {
  /**
   * @param {Root} root
   * @param {Plan} plan
   * @param {ShiftData} shift
   * @param {Clock} clock
   * @param {Choice} choice
   * @param {Words} words
   */
  constructor(root, plan, shift, clock, choice, words) {
    this.plan = plan;
    this.shift = shift;
    this.words = words;
    root
      .part("shift-figures")
      .append(
        ...this.#fleet(),
        ...this.#left(clock, choice),
        ...this.#places(choice),
        ...this.#events(clock),
      );
    this.list = new VirtualList(root.part("use-list"), {
      rowHeight: 52,
      className: "use",
      none: texts.noRobotNamed,
      fill: (row, robot) => this.#fill(row, robot),
      choose: (robot) => choice.chooseRobot(robot.index),
    });
    choice.on("choice", () => this.list.setChosen(choice.robot));
    this.list.setItems([...plan.robots]);
  }

  refresh() {
    this.list.refresh();
  }

  /** All robots together, with what the colours mean. */
  #fleet() {
    const { robots, until } = this.shift;
    const sums = /** @type {UseRow} */ (
      [0, 1, 2, 3, 4, 5].map((part) => robots.reduce((sum, row) => sum + row[part], 0))
    );
    const whole = until * robots.length;
    const legend = texts.shift.activities.map((what, kind) =>
      element(
        "li",
        {},
        element("i", { className: KINDS[kind] }),
        texts.shift.share({ what, share: this.words.percent(sums[kind + 1] / whole) }),
      ),
    );
    return [
      element("h3", {}, texts.shift.use),
      shareBar(sums, whole),
      element("ul", { className: "use-legend" }, ...legend),
    ];
  }

  /**
   * Late jobs, and those that are not served by their reasons; pressing a line chooses one of them.
   *
   * @param {Clock} clock
   * @param {Choice} choice
   */
  #left(clock, choice) {
    const { late, unserved } = this.shift;
    const { jobs, phrases } = this.plan;
    const lines = unserved.map(([reason, count]) => {
      const text = phrases.said(reason);
      const job = jobs.findIndex(
        (each) =>
          each.robot === undefined &&
          (each.reason === undefined || phrases.said(each.reason) === text),
      );
      return goTo(String(count), upperFirst(text), () => choice.chooseJob(job));
    });
    if (late) {
      const lateness = jobs.map(({ times }) => times?.[3] ?? 0);
      const job = lateness.indexOf(lateness.reduce((most, ticks) => Math.max(most, ticks), 0));
      const text = texts.shift.mostLate({
        name: jobs[job].name,
        time: this.words.time(lateness[job]),
      });
      const end = jobs[job].times?.[1] ?? 0;
      const choose = () => chooseAt(clock, end, () => choice.chooseJob(job));
      lines.unshift(goTo(String(late), text, choose));
    }
    return lines.length
      ? [element("h3", {}, texts.shift.lateAndNotServed), element("ol", {}, ...lines)]
      : [];
  }

  /** @param {Choice} choice */
  #places(choice) {
    const { words } = this;
    const rows = this.shift.bottlenecks
      .slice(0, SHOWN_PLACES)
      .map(([vertex, ticks]) =>
        goTo(words.time(ticks), words.vertex(vertex), () => choice.light([vertex])),
      );
    const none = element("p", { className: "note" }, texts.shift.noWaits);
    return [
      element("h3", {}, texts.shift.bottlenecks),
      rows.length ? element("ol", {}, ...rows) : none,
    ];
  }

  /** @param {Clock} clock */
  #events(clock) {
    const { happened } = this.shift;
    if (!happened.length) return [];
    const lines = happened
      .slice(0, MOST_EVENTS)
      .map(([tick, text]) =>
        goTo(this.words.time(tick), upperFirst(this.plan.phrases.said(text)), () =>
          chooseAt(clock, tick, () => {}),
        ),
      );
    const left = happened.length - lines.length;
    if (left) lines.push(element("li", {}, texts.more({ count: left })));
    return [element("h3", {}, texts.shift.happened), element("ol", {}, ...lines)];
  }

  /**
   * @param {import("../lists/virtual_list.js").ListRow<Robot>} row
   * @param {Robot} robot
   */
  #fill(row, robot) {
    if (row.filled === robot) return;
    row.filled = robot;
    const { robots, waits, until } = this.shift;
    const use = robots[robot.index];
    const [longest] = waits[robot.index];
    row.title = useLine(use, until, this.words);
    const waitsMost = longest
      ? texts.shift.waitsMost({
          name: this.words.robot(longest[0]),
          time: this.words.time(longest[1]),
        })
      : "";
    const did = texts.shift.robotDid({ count: use[0] });
    row.replaceChildren(
      swatch(robot),
      element("span", { className: "name" }, robot.name),
      element("span", { className: "state" }, [did, waitsMost].filter(Boolean).join(", ")),
      shareBar(use, until),
    );
  }
}

/**
 * A bar of the shares of time that robots drive, wait, work, charge, and have nothing to do.
 *
 * @param {UseRow} row
 * @param {number} whole
 */
export function shareBar([, ...parts], whole) {
  const bar = element("div", { className: "use-bar", ariaHidden: "true" });
  parts.forEach((ticks, kind) => {
    const part = element("i", { className: KINDS[kind] });
    part.style.width = `${(100 * ticks) / whole}%`;
    bar.append(part);
  });
  return bar;
}

/**
 * The same in words.
 *
 * @param {UseRow} row
 * @param {number} whole
 * @param {Words} words
 */
export function useLine([, ...parts], whole, words) {
  return parts
    .map((ticks, kind) =>
      texts.shift.share({
        what: texts.shift.activities[kind],
        share: words.percent(ticks / whole),
      }),
    )
    .join(" · ");
}
