import { texts } from "../language/language.js";
import { makeRoundList } from "./round_list.js";
import { ShiftChart } from "./shift_chart.js";
import { UseBoard } from "./use_board.js";

/** @import { Choice } from "../player/choice.js" */
/** @import { Clock } from "../player/clock.js" */
/** @import { Diagram } from "../timetable/diagram.js" */
/** @import { Plan } from "../plan/plan.js" */
/** @import { Root } from "../common/root.js" */
/** @import { Shift } from "./shift.js" */
/** @import { Theme } from "../drawing/theme.js" */
/** @import { Words } from "../language/words.js" */

/** The views that only the page of a shift has. */
export class ShiftViews {
  /**
   * @param {Root} root
   * @param {Plan} plan
   * @param {Clock} clock
   * @param {Choice} choice
   * @param {Theme} theme
   * @param {Words} words
   * @param {Diagram} diagram
   */
  constructor(root, plan, clock, choice, theme, words, diagram) {
    const { raw } = /** @type {Shift} */ (plan.shift);
    this.board = new UseBoard(root, plan, raw, clock, choice, words);
    this.rounds = makeRoundList(root, plan, raw, clock, choice, words);
    diagram.shift = new ShiftChart(plan, raw, theme, choice, words, diagram.census);
    this.legend = root.part("bottleneck-legend");
    for (const event of ["choice", "bottleneck"])
      choice.on(event, () => this.#showBottleneck(choice));
    const [first] = raw.bottlenecks;
    root.part("bottleneck").hidden = !first;
    if (!first) return;
    const [vertex, ticks] = first;
    const text = texts.shift.bottleneck({
      place: words.vertex(vertex),
      time: words.time(ticks),
    });
    if (this.legend.lastElementChild) this.legend.lastElementChild.textContent = text;
    this.hasBottleneck = true;
    this.#showBottleneck(choice);
  }

  hasBottleneck = false;

  /** @param {Choice} choice */
  #showBottleneck(choice) {
    this.legend.hidden = !this.hasBottleneck || !choice.bottleneck;
  }

  refresh() {
    this.board.refresh();
    this.rounds.refresh();
  }
}
