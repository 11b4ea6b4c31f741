export const MODES = ["plan", "floor", "both"];

/** What to show: the plan, what happened on the floor, or both. */
export class ModeSwitch {
  constructor(plan, choice) {
    Object.assign(this, { plan, choice });
    this.box = document.getElementById("mode");
    this.box.hidden = !plan.happened;
    this.box.addEventListener("change", (event) => choice.show(event.target.value));
    choice.on("mode", () => this.#show());
    this.#show();
  }

  /** Show what comes next. */
  next() {
    if (this.plan.happened)
      this.choice.show(MODES[(MODES.indexOf(this.choice.mode) + 1) % MODES.length]);
  }

  #show() {
    for (const radio of this.box.querySelectorAll("input"))
      radio.checked = radio.value === this.choice.mode;
  }
}
