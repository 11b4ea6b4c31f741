import { figure, texts } from "../language/language.js";
import { foundList } from "../player/markup.js";
import { TwoLineList, chooseAt } from "../lists/two_line_list.js";
import { upperFirst } from "../language/words.js";

/** @import { Root } from "../common/root.js" */
/** @import { Choice } from "../player/choice.js" */
/** @import { Clock } from "../player/clock.js" */
/** @import { Plan } from "../plan/plan.js" */
/** @import { ShiftData } from "../payload.d.ts" */
/** @import { Words } from "../language/words.js" */

export const ROUNDS_TAB = `<button type="button" role="tab" id="tab-rounds" aria-controls="rounds" aria-selected="false" tabindex="-1"><span data-text="rounds"></span> <b></b></button>`;

export const ROUNDS_PANEL = `<div class="panel" id="rounds" role="tabpanel" aria-labelledby="tab-rounds" hidden>
  ${foundList({ item: "round", label: "rounds", hint: "findRound", find: "findRound" })}
</div>`;

/**
 * The list of all rounds: when each began, how long it took, and whether its plan took over.
 *
 * @param {Root} root
 * @param {Plan} plan
 * @param {ShiftData} shift
 * @param {Clock} clock
 * @param {Choice} choice
 * @param {Words} words
 */
export function makeRoundList(root, plan, { rounds, told }, clock, choice, words) {
  /** @type {string[][]} */
  const reasons = rounds.map(() => []);
  for (const [round, text] of told) reasons[round].push(plan.phrases.said(text));
  let chosen = -1;
  const items = rounds.map(([begin, takeover, ms, count, stands], index) => {
    const then = stands
      ? texts.shift.stands
      : texts.shift.takesOver({ time: words.time(takeover) });
    return {
      head: texts.shift.round({
        time: words.time(begin),
        count,
        seconds: figure((ms / 1000).toFixed(2)),
      }),
      detail: upperFirst([then, ...reasons[index]].join(" · ")),
      isAlarm: Boolean(stands),
      isChosen: () => chosen === index,
      choose: () => {
        chosen = index;
        chooseAt(clock, begin, () => choice.chooseNothing());
        choice.tell("choice");
      },
    };
  });
  return new TwoLineList(root, "round", choice, items, {
    none: items.length ? texts.shift.noRoundFits : texts.shift.noRound,
    isLong: false,
  });
}
