import { texts, withKey } from "../language/language.js";

/** @import { Root } from "../common/root.js" */
/** @import { Choice } from "./choice.js" */
/** @import { Clock } from "./clock.js" */
/** @import { Plan } from "../plan/plan.js" */

/** The button that plays one period for ever. */
export class Loop {
  /**
   * @param {Root} root
   * @param {Plan} plan
   * @param {Clock} clock
   * @param {Choice} choice
   */
  constructor(root, plan, clock, choice) {
    this.root = root;
    this.plan = plan;
    this.clock = clock;
    this.choice = choice;
    this.button = root.part("loop", HTMLButtonElement);
    this.button.hidden = !plan.steady;
    this.button.addEventListener("click", () => this.toggle());
    clock.on("loop", () => this.#show());
    choice.on("choice", () => clock.loop && clock.setLoop(this.#window));
    choice.on("mode", () => choice.mode === "plan" || clock.setLoop(null));
    this.#show();
  }

  toggle() {
    if (this.button.hidden || this.button.disabled) return;
    if (this.clock.loop) this.clock.setLoop(null);
    else {
      this.choice.show("plan");
      this.clock.setLoop(this.#window);
      this.clock.play();
    }
  }

  /** The first period of the group that is looked at; null where the plan ends before it does. */
  get #window() {
    const group = this.plan.steady?.group(this.choice.robot);
    return group?.whole ? { from: group.start, to: group.start + group.period } : null;
  }

  #show() {
    if (!this.plan.steady) return;
    this.button.disabled = !this.#window;
    this.button.title = this.#window ? withKey(texts.loopAtLength, "L") : texts.noLoop;
    this.button.setAttribute("aria-pressed", String(Boolean(this.clock.loop)));
  }
}
