import { said, texts } from "../language/language.js";
import { TwoLineList, chooseAt } from "./two_line_list.js";

/** @import { Root } from "../common/root.js" */
/** @import { Choice } from "../player/choice.js" */
/** @import { Clock } from "../player/clock.js" */
/** @import { Plan } from "../plan/plan.js" */
/** @import { TwoLines } from "./two_line_list.js" */
/** @import { Words } from "../language/words.js" */

/**
 * The list of what robots lose in every plan, of the robots that were sent another way, and of all resolved
 * conflicts.
 *
 * @param {Root} root
 * @param {Plan} plan
 * @param {Clock} clock
 * @param {Choice} choice
 * @param {Words} words
 */
export function makeDecisionList(root, plan, clock, choice, words) {
  const { phrases } = plan;
  /** @type {TwoLines[]} */
  const reroutes = plan.reroutes.map(({ robot, because }) => ({
    head: texts.rerouted({ name: words.robot(robot) }),
    detail: said(because),
    isChosen: () => !choice.decision && choice.robotIndex === robot,
    choose: () => choice.chooseRobot(robot),
  }));
  /** @type {TwoLines[]} */
  const decisions = plan.decisions.map((decision, index) => ({
    head: phrases.said(decision.head),
    detail: phrases.said(decision.detail),
    isChosen: () => choice.decisionIndex === index,
    choose: () => chooseAt(clock, decision.tick, () => choice.chooseDecision(index)),
  }));
  /** @type {TwoLines[]} */
  const forced = plan.forcedLosses.map((loss, index) => ({
    head: phrases.said(loss.head),
    detail: texts.whyNoneIsBetter,
    isChosen: () => choice.forcedIndex === index,
    choose: () => chooseAt(clock, loss.tick, () => choice.chooseForcedLoss(index)),
  }));
  const items = [...forced, ...reroutes, ...decisions];
  const isSilent = hasNoReasons(plan);
  const none = isSilent ? texts.noDecisions : texts.noneNeeded;
  return new TwoLineList(root, "decision", choice, items, {
    none: items.length ? texts.noDecisionFits : none,
    isLong: plan.roadmap.isMeasured && plan.decisions.length > 0, // coordinates are longer than names
  });
}

/**
 * Whether robots wait for no reason that the plan gives, as in the plan of a search.
 *
 * @param {Plan} plan
 */
export function hasNoReasons(plan) {
  const isLate = plan.noPlan || plan.planned.some(({ delay }) => delay > 0);
  return isLate && ![plan.forcedLosses, plan.reroutes, plan.decisions].some(({ length }) => length);
}
