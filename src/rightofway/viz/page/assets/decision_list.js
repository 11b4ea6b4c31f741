import { element } from "./dom.js";
import { connectFind, matches } from "./find.js";
import { language, texts } from "./language.js";
import { languageOf, said } from "./library.js";
import { VirtualList } from "./virtual_list.js";

/** @import { Root } from "./root.js" */
/** @import { Choice } from "./choice.js" */
/** @import { Clock } from "./clock.js" */
/** @import { DecisionData, RerouteData } from "./payload.d.ts" */
/** @import { Plan } from "./plan.js" */
/** @import { Words } from "./words.js" */

/** @typedef {{ head: string, detail: string, isEnglish?: boolean, isChosen?: () => boolean, choose: () => void }} TwoLines An item of a list. */

/** All resolved conflicts, and the robots that were sent another way. */
export class DecisionList {
  /**
   * @param {Root} root
   * @param {Plan} plan
   * @param {Clock} clock
   * @param {Choice} choice
   * @param {Words} words
   */
  constructor(root, plan, clock, choice, words) {
    this.root = root;
    this.plan = plan;
    this.clock = clock;
    this.choice = choice;
    this.words = words;
    /** @type {TwoLines[]} */
    this.items = [
      ...plan.reroutes.map((reroute) => this.#reroute(reroute)),
      ...plan.decisions.map((decision, index) => this.#decision(decision, index)),
    ];
    const isLate = plan.noPlan || plan.planned.some(({ delay }) => delay > 0);
    const isSilent = !this.items.length && isLate; // as the plan of a search is
    const isLong = plan.roadmap.isMeasured && plan.decisions.length > 0; // coordinates are longer than names
    /** @type {string | number} */
    this.count = isSilent ? "–" : this.items.length;
    this.find = root.part("find-decision", HTMLInputElement);
    this.list = new VirtualList(root.part("decision-list"), {
      rowHeight: isLong ? 72 : 52,
      className: isLong ? "two long" : "two",
      none: isSilent
        ? texts.noDecisions
        : this.items.length
          ? texts.noDecisionFits
          : texts.noneNeeded,
      fill: fillTwoLines,
      choose: (item) => item.choose(),
    });
    connectFind(this.find, this.list, () => this.#select());
    choice.on("choice", () =>
      this.list.setChosen(this.items.find((item) => item.isChosen?.()) ?? null),
    );
    this.#select();
  }

  refresh() {
    this.list.refresh();
  }

  /**
   * @param {DecisionData} decision
   * @param {number} index
   */
  #decision(decision, index) {
    const { phrases } = this.plan;
    return {
      head: phrases.said(decision.head),
      detail: phrases.said(decision.detail),
      isChosen: () => this.choice.decisionIndex === index,
      choose: () => {
        this.clock.pause();
        this.clock.seek(decision.tick);
        this.choice.chooseDecision(index);
      },
    };
  }

  /** @param {RerouteData} reroute */
  #reroute(reroute) {
    return {
      head: texts.rerouted(this.words.robot(reroute.robot)),
      detail: said(reroute.because),
      isEnglish: languageOf(reroute.because) === "en",
      isChosen: () => this.choice.decisionIndex < 0 && this.choice.robotIndex === reroute.robot,
      choose: () => this.choice.chooseRobot(reroute.robot),
    };
  }

  #select() {
    this.list.setItems(
      this.items.filter(({ head, detail }) => matches(`${head} ${detail}`, this.find.value)),
    );
  }
}

/**
 * Write an item with a head and a detail into a row.
 *
 * @param {HTMLElement & { filled?: TwoLines }} row
 * @param {TwoLines} item
 */
export function fillTwoLines(row, item) {
  if (row.filled === item) return;
  row.filled = item;
  row.title = `${item.head}\n${item.detail}`;
  const lines = [item.head, item.detail].map((text) =>
    element("span", { className: "text name", lang: item.isEnglish ? "en" : language }, text),
  );
  row.lang = lines[0].lang; // of its title
  row.replaceChildren(...lines);
}
