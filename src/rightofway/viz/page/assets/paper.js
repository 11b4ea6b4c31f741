"use strict";

const ROWS_ON_PAPER = 50;

/** The page on paper: the head, the moment, and a table of the robots, in light colours. */
class Paper {
  constructor(plan, clock, theme, words, repaint) {
    Object.assign(this, { plan, clock, theme, words, repaint });
    window.addEventListener("beforeprint", () => this.lay(true));
    window.addEventListener("afterprint", () => this.lay(false));
  }

  /** Get ready for paper, or for the screen again. */
  lay(onPaper) {
    document.documentElement.classList.toggle("on-paper", onPaper);
    this.theme.refresh();
    this.repaint();
    if (!onPaper) return;
    document.getElementById("paper-moment").textContent =
      `The map at ${this.words.moment(this.clock.tick)} of ${this.words.time(this.clock.end)}.`;
    document.getElementById("paper-robots").replaceChildren(...this.#table());
  }

  #table() {
    const { plan, words } = this;
    const row = (tag, cells) => element("tr", {}, ...cells.map((cell) => element(tag, {}, cell)));
    const end = plan.endsAtHome ? "Home at" : "Done at";
    const byLoss = plan.planned.toSorted((one, other) => other.delay - one.delay).slice(0, ROWS_ON_PAPER);
    const rows = byLoss.toSorted((one, other) => one.index - other.index).map((robot) => row("td", [
      robot.name, words.time(robot.completion), words.time(robot.alone),
      ...[robot.lost.detours, robot.lost.makingRoom, robot.lost.waiting].map((ticks) => (ticks ? words.time(ticks) : "")),
    ]));
    const left = plan.robots.length - rows.length;
    return [
      row("th", ["Robot", end, "Alone", "Detours", "Making room", "Waiting"]),
      ...rows,
      ...(left ? [row("td", [`and ${left} more, which lose less`])] : []),
    ];
  }
}
