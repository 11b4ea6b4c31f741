import { texts } from "../language/language.js";
import { TwoLineList, chooseAt } from "./two_line_list.js";
import { upperFirst } from "../language/words.js";

/** @import { Root } from "../common/root.js" */
/** @import { Choice } from "../player/choice.js" */
/** @import { Clock } from "../player/clock.js" */
/** @import { Plan } from "../plan/plan.js" */
/** @import { Words } from "../language/words.js" */

const LINE = 36; // letters of a fault that surely fit in a line

/**
 * The list of all faults of a plan that breaks rules: the earliest first; choosing one goes to its moment and place.
 *
 * @param {Root} root
 * @param {Plan} plan
 * @param {Clock} clock
 * @param {Choice} choice
 * @param {Words} words
 */
export function makeFaultList(root, plan, clock, choice, words) {
  const { phrases, noPlan } = plan;
  const items = plan.faults.map((fault, index) => {
    const [name, reason, remedy] = [fault.name, fault.reason, fault.remedy].map((text) =>
      phrases.said(text),
    );
    return {
      head: reason,
      detail: noPlan
        ? remedy && upperFirst(`${remedy}.`)
        : `${texts.at({ moment: words.moment(fault.tick) })} · ${name}`,
      isChosen: () => choice.faultIndex === index,
      choose: () => chooseAt(clock, fault.tick, () => choice.chooseFault(index)),
    };
  });
  const list = new TwoLineList(root, "fault", choice, items, {
    none: items.length ? texts.noFaultFits : texts.noFaults,
    isLong: items.some(({ head, detail }) => Math.max(head.length, detail.length) > LINE),
  });
  if (plan.faultCount > plan.faults.length)
    list.find.placeholder = texts.findAmong({ count: plan.faults.length });
  return list;
}
