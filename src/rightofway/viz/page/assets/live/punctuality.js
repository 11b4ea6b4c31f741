import { element, swatch } from "../common/dom.js";
import { texts } from "../language/language.js";
import { matches, connectFind } from "../lists/find.js";
import { VirtualList } from "../lists/virtual_list.js";

/** @import { Choice } from "../player/choice.js" */
/** @import { Driven } from "./driven.js" */
/** @import { EndRow, EndsData, PunctualityRow } from "../payload.d.ts" */
/** @import { Root } from "../common/root.js" */
/** @import { Words } from "../language/words.js" */

/** @typedef {{ robot: number, name: string, late: string, detail: string, isLate: boolean }} Line */

/** Planned ends next to actual and expected ones, as the control has measured them last: of each job, and of each robot. */
export class Punctuality {
  #byRobot = false;

  /**
   * @param {Root} root
   * @param {Driven} driven
   * @param {Choice} choice
   * @param {Words} words
   */
  constructor(root, driven, choice, words) {
    this.root = root;
    this.driven = driven;
    this.words = words;
    this.sums = root.part("ends-sums");
    this.tab = root.part("tab-ends");
    this.count = root.all(`#${this.tab.id} b`, HTMLElement)[0];
    this.robots = root.part("ends-by-robot");
    this.find = root.part("find-end", HTMLInputElement);
    this.list = new VirtualList(root.part("end-list"), {
      rowHeight: 52,
      className: "end",
      none: texts.driven.noEnds,
      fill: (row, /** @type {Line} */ line) => this.#fill(row, line),
      choose: ({ robot }) => robot >= 0 && choice.chooseRobot(robot),
    });
    connectFind(this.find, this.list, () => this.show());
    this.robots.addEventListener("click", () => {
      this.#byRobot = !this.#byRobot;
      this.robots.setAttribute("aria-pressed", String(this.#byRobot));
      this.list.box.scrollTop = 0;
      this.show();
    });
    this.show();
  }

  /** The number of late jobs, for the tab; null where nothing is compared, as for laps. */
  get lateCount() {
    return this.driven.ends && this.driven.ends.all[2];
  }

  /** Write again what was measured. */
  show() {
    const { ends } = this.driven;
    this.tab.hidden = !ends; // a page may be older than the drive
    if (!ends) return;
    this.count.textContent = String(this.lateCount);
    this.robots.hidden = !ends.hasJobs;
    this.sums.textContent = this.#sum(ends.all);
    const lines = this.#byRobot
      ? this.#linesOfRobots(ends)
      : ends.rows.map((row) => this.#end(row));
    this.list.setItems(
      lines.filter(({ name, detail }) => matches(`${name} ${detail}`, this.find.value)),
    );
  }

  refresh() {
    this.list.refresh();
  }

  /** @param {PunctualityRow} row */
  #sum([done, open, late, delay]) {
    const { driven: own } = texts;
    const parts = [own.doneCount({ count: done }), own.openCount({ count: open })];
    if (late) parts.push(own.lateCount({ count: late }));
    if (delay !== null) parts.push(own.meanDelay({ delay: this.words.lateness(delay) }));
    return parts.join(" · ");
  }

  /**
   * The robots with the most late jobs first.
   *
   * @param {EndsData} ends
   * @returns {Line[]}
   */
  #linesOfRobots({ robots }) {
    return robots
      .map((row, robot) => ({
        robot,
        name: this.words.robot(robot),
        late: row[3] === null ? "" : this.words.lateness(row[3]),
        detail: this.#sum([row[0], row[1], row[2], null]),
        isLate: row[2] > 0 && (row[3] ?? 0) > 0,
        key: row,
      }))
      .sort(({ key: a }, { key: b }) => b[2] - a[2] || (b[3] ?? 0) - (a[3] ?? 0));
  }

  /**
   * @param {EndRow} row
   * @returns {Line}
   */
  #end([name, robot, planned, due, actual, expected, delay, isLate]) {
    const { driven: own } = texts;
    const { words } = this;
    /** @type {[((values: { time: string }) => string), number | null][]} */
    const times = [
      [own.plannedEnd, planned],
      [own.dueEnd, due],
      [own.actualEnd, actual],
      [own.expectedEnd, expected],
    ];
    const known = times.flatMap(([write, tick]) =>
      tick === null ? [] : [write({ time: words.moment(tick) })],
    );
    const who = robot >= 0 && words.robot(robot) !== name ? [words.robot(robot)] : [];
    return {
      robot,
      name,
      late: delay === null ? "" : words.lateness(delay),
      detail: [...who, ...(known.length ? known : [own.notPlanned])].join(" · "),
      isLate,
    };
  }

  /**
   * @param {import("../lists/virtual_list.js").ListRow<Line>} row
   * @param {Line} line
   */
  #fill(row, line) {
    if (row.filled === line) return;
    row.filled = line;
    row.title = `${line.name}\n${line.detail}`;
    const { robots } = this.driven;
    const late = element("span", { className: "late" }, line.late);
    late.classList.toggle("wrong", line.isLate);
    row.replaceChildren(
      ...(line.robot >= 0 ? [swatch(robots[line.robot])] : []),
      element("span", { className: "name" }, line.name),
      late,
      element("span", { className: "text state" }, line.detail),
    );
  }
}
