import { fillTwoLines } from "./decision_list.js";
import { connectFind, matches } from "./find.js";
import { texts } from "./language.js";
import { VirtualList } from "./virtual_list.js";
import { upperFirst } from "./words.js";

/** @import { Root } from "./root.js" */
/** @import { Choice } from "./choice.js" */
/** @import { Clock } from "./clock.js" */
/** @import { FaultData } from "./payload.d.ts" */
/** @import { Plan } from "./plan.js" */
/** @import { Words } from "./words.js" */
/** @import { TwoLines } from "./decision_list.js" */

const LINE = 36; // letters of a fault that surely fit in a line

/** All faults of a plan that breaks rules: the earliest first; choosing one goes to its moment and place. */
export class FaultList {
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
    this.find = root.part("find-fault", HTMLInputElement);
    /** @type {TwoLines[]} */
    this.items = plan.faults.map((fault, index) => this.#item(fault, index));
    const isLong = this.items.some(
      ({ head, detail }) => Math.max(head.length, detail.length) > LINE,
    );
    this.list = new VirtualList(root.part("fault-list"), {
      rowHeight: isLong ? 72 : 52,
      className: isLong ? "two long" : "two",
      none: this.items.length ? texts.noFaultFits : texts.noFaults,
      fill: fillTwoLines,
      choose: (item) => item.choose(),
    });
    connectFind(this.find, this.list, () => this.#select());
    choice.on("choice", () => this.list.setChosen(this.items[choice.faultIndex] ?? null));
    if (plan.faultCount > plan.faults.length)
      this.find.placeholder = texts.findAmong(plan.faults.length);
    this.#select();
  }

  refresh() {
    this.list.refresh();
  }

  /**
   * @param {FaultData} fault
   * @param {number} index
   */
  #item(fault, index) {
    const { phrases, noPlan } = this.plan;
    const [name, reason, remedy] = [fault.name, fault.reason, fault.remedy].map((text) =>
      phrases.said(text),
    );
    return {
      isEnglish: phrases.languageOf(fault.reason) === "en",
      head: reason,
      detail: noPlan
        ? remedy && upperFirst(`${remedy}.`)
        : `${texts.at(this.words.moment(fault.tick))} · ${name}`,
      choose: () => {
        this.clock.pause();
        this.clock.seek(fault.tick);
        this.choice.chooseFault(index);
      },
    };
  }

  #select() {
    this.list.setItems(
      this.items.filter(({ head, detail }) => matches(`${head} ${detail}`, this.find.value)),
    );
  }
}
