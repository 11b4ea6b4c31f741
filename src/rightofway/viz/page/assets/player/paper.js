import { element } from "../common/dom.js";
import { texts } from "../language/language.js";

/** @import { Root } from "../common/root.js" */
/** @import { Clock } from "./clock.js" */
/** @import { Comparison } from "../figures/comparison.js" */
/** @import { ShiftData } from "../payload.d.ts" */
/** @import { Plan } from "../plan/plan.js" */
/** @import { Robot } from "../plan/robot.js" */
/** @import { Theme } from "../drawing/theme.js" */
/** @import { Words } from "../language/words.js" */

const ROWS_ON_PAPER = 50;

/** The page on paper: the head, the moment, and a table of the robots, in light colours. */
export class Paper {
  /**
   * @param {Root} root
   * @param {Plan} plan
   * @param {Clock} clock
   * @param {Theme} theme
   * @param {Words} words
   * @param {Comparison | null} comparison
   * @param {() => void} repaint
   */
  constructor(root, plan, clock, theme, words, comparison, repaint) {
    this.root = root;
    this.plan = plan;
    this.clock = clock;
    this.theme = theme;
    this.words = words;
    this.comparison = comparison;
    this.repaint = repaint;
    root.listen(window, "beforeprint", () => this.lay(true));
    root.listen(window, "afterprint", () => this.lay(false));
  }

  /**
   * Get ready for paper, or for the screen again.
   *
   * @param {boolean} onPaper
   */
  lay(onPaper) {
    this.root.top.classList.toggle("on-paper", onPaper);
    this.theme.refresh();
    this.repaint();
    if (!onPaper) return;
    this.root.part("paper-moment").textContent = texts.mapAt({
      moment: this.words.moment(this.clock.tick),
      end: this.words.time(this.clock.end),
    });
    this.root
      .part("paper-robots")
      .replaceChildren(...(this.comparison ? this.#comparedTable(this.comparison) : this.#table()));
  }

  get #end() {
    return texts.doneAt({ isHome: this.plan.endsAtHome });
  }

  /** @param {number} ticks */
  #time(ticks) {
    return ticks ? this.words.time(ticks) : "";
  }

  #table() {
    const { words } = this;
    if (this.plan.shift) return this.#useTable(this.plan.shift.raw);
    const head = [
      texts.robot,
      this.#end,
      texts.alone,
      texts.detours,
      texts.makingRoom,
      texts.waiting,
    ];
    return this.#rows(
      head,
      ({ delay }) => delay,
      texts.loseLess,
      (robot) => [
        robot.name,
        words.time(robot.completion),
        words.time(robot.alone),
        ...[robot.lost.detours, robot.lost.makingRoom, robot.lost.waiting].map((ticks) =>
          this.#time(ticks),
        ),
      ],
    );
  }

  /**
   * How robots used their time in a shift; of many, those that waited longest.
   *
   * @param {ShiftData} shift
   */
  #useTable({ robots, until }) {
    const { words } = this;
    return this.#rows(
      [texts.robot, texts.jobs.done, ...texts.shift.activities],
      ({ index }) => robots[index][2],
      texts.shift.waitLess,
      ({ name, index }) => {
        const [done, ...parts] = robots[index];
        return [name, String(done), ...parts.map((ticks) => words.percent(ticks / until))];
      },
    );
  }

  /** @param {Comparison} comparison */
  #comparedTable(comparison) {
    const { words } = this;
    const { compared, plans } = comparison;
    const head = [
      texts.robot,
      ...plans.map(({ title }) => texts.headOf({ term: this.#end, title })),
      ...plans.slice(1).map(({ title }) => texts.inPlan({ title })),
    ];
    const found = new Map(compared.robots.map((robot) => [robot.name, robot]));
    return this.#rows(
      head,
      ({ name }) => {
        const robot = found.get(name);
        return robot ? compared.largest(robot) : 0;
      },
      texts.differLess,
      (robot) => [
        robot.name,
        words.time(robot.completion),
        ...(found.get(robot.name)?.completion ?? [])
          .slice(1)
          .map((ticks) => (ticks === null ? "" : compared.time(ticks))),
        ...comparison.changesOf(robot).map(([, change]) => change),
      ],
    );
  }

  /**
   * A row for each robot; of many, those with the largest values.
   *
   * @param {string[]} head
   * @param {(robot: Robot) => number} valueOf
   * @param {string} less
   * @param {(robot: Robot) => string[]} cellsOf
   */
  #rows(head, valueOf, less, cellsOf) {
    /**
     * @param {"th" | "td"} tag
     * @param {string[]} cells
     */
    const row = (tag, cells) => element("tr", {}, ...cells.map((cell) => element(tag, {}, cell)));
    const most = this.plan.planned
      .toSorted((one, other) => valueOf(other) - valueOf(one))
      .slice(0, ROWS_ON_PAPER);
    const rows = most
      .toSorted((one, other) => one.index - other.index)
      .map((robot) => row("td", cellsOf(robot)));
    const left = this.plan.robots.length - rows.length;
    return [
      row("th", head),
      ...rows,
      ...(left ? [row("td", [texts.andMoreThat({ count: left, what: less })])] : []),
    ];
  }
}
