import { all } from "../common/dom.js";

/** @import { Root } from "../common/root.js" */
/** @import { Choice, Mode } from "./choice.js" */
/** @import { Plan } from "../plan/plan.js" */

/** @type {Mode[]} */
export const MODES = ["plan", "floor", "both"];

/** What to show: the plan, what happened on the floor, or both. */
export class ModeSwitch {
  /**
   * @param {Root} root
   * @param {Plan} plan
   * @param {Choice} choice
   */
  constructor(root, plan, choice) {
    this.root = root;
    this.plan = plan;
    this.choice = choice;
    this.box = root.part("mode");
    this.box.hidden = !plan.happened;
    for (const radio of all("input", HTMLInputElement, this.box))
      radio.addEventListener("change", () => choice.show(modeOf(radio)));
    choice.on("mode", () => this.#show());
    this.#show();
  }

  /** Show what comes next. */
  next() {
    if (this.plan.happened)
      this.choice.show(MODES[(MODES.indexOf(this.choice.mode) + 1) % MODES.length]);
  }

  #show() {
    for (const radio of all("input", HTMLInputElement, this.box))
      radio.checked = modeOf(radio) === this.choice.mode;
  }
}

/** @param {HTMLInputElement} radio */
function modeOf({ value }) {
  return MODES.find((mode) => mode === value) ?? "plan";
}
