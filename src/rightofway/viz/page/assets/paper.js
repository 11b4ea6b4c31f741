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
    const { plan, words, comparison } = this;
    const [one, two] = [plan.title, plan.other.title];
    const head = [
      texts.robot,
      texts.headOf(this.#end, one),
      texts.headOf(this.#end, two),
      texts.inPlan(two),
      texts.headOf(texts.timeLost, one),
      texts.headOf(texts.timeLost, two),
    ];
    return this.#rows(
      head,
      (robot) => Math.abs(comparison.change(robot)),
      texts.differLess,
      (robot) => {
        const other = plan.other.planned[robot.index];
        return [
          robot.name,
          words.time(robot.completion),
          words.time(other.completion),
          comparison.changeInWords(robot),
          this.#time(robot.delay),
          this.#time(other.delay),
        ];
      },
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
