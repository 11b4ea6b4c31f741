import { element } from "./dom.js";
import { texts } from "./language.js";

const ROWS_ON_PAPER = 50;

/** The page on paper: the head, the moment, and a table of the robots, in light colours. */
export class Paper {
  constructor(plan, clock, theme, words, comparison, repaint) {
    Object.assign(this, { plan, clock, theme, words, comparison, repaint });
    window.addEventListener("beforeprint", () => this.lay(true));
    window.addEventListener("afterprint", () => this.lay(false));
  }

  /** Get ready for paper, or for the screen again. */
  lay(onPaper) {
    document.documentElement.classList.toggle("on-paper", onPaper);
    this.theme.refresh();
    this.repaint();
    if (!onPaper) return;
    document.getElementById("paper-moment").textContent = texts.mapAt(
      this.words.moment(this.clock.tick),
      this.words.time(this.clock.end),
    );
    document
      .getElementById("paper-robots")
      .replaceChildren(...(this.comparison ? this.#comparedTable() : this.#table()));
  }

  get #end() {
    return texts.doneAt(this.plan.endsAtHome);
  }

  #time(ticks) {
    return ticks ? this.words.time(ticks) : "";
  }

  #table() {
    const { words } = this;
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

  #comparedTable() {
    const { words, comparison } = this;
    const { compared, plans } = comparison;
    const head = [
      texts.robot,
      ...plans.map(({ title }) => texts.headOf(this.#end, title)),
      ...plans.slice(1).map(({ title }) => texts.inPlan(title)),
    ];
    const found = new Map(compared.robots.map((robot) => [robot.name, robot]));
    return this.#rows(
      head,
      ({ name }) => compared.largest(found.get(name)),
      texts.differLess,
      (robot) => [
        robot.name,
        words.time(robot.completion),
        ...found
          .get(robot.name)
          .completion.slice(1)
          .map((ticks) => (ticks === null ? "" : compared.time(ticks))),
        ...comparison.changesOf(robot).map(([, change]) => change),
      ],
    );
  }

  /** A row for each robot; of many, those with the largest values. */
  #rows(head, valueOf, less, cellsOf) {
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
      ...(left ? [row("td", [texts.andMoreThat(left, less)])] : []),
    ];
  }
}
