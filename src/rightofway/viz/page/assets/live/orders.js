import { sendOrder } from "./feed.js";
import { said, texts } from "../language/language.js";

/** @import { Choice } from "../player/choice.js" */
/** @import { Driven } from "./driven.js" */
/** @import { Root } from "../common/root.js" */

/** What a person asks the control for: hold one robot or all, let them go, say where one is that was in trouble. */
export class Orders {
  /**
   * @param {Root} root
   * @param {Driven} driven
   * @param {Choice} choice
   * @param {string} address empty where nobody takes orders
   */
  constructor(root, driven, choice, address) {
    this.root = root;
    this.driven = driven;
    this.choice = choice;
    this.address = address;
    this.box = root.part("orders");
    this.answer = root.part("order-answer");
    this.dialog = root.part("order-confirm", HTMLDialogElement);
    this.one = root.part("hold-one", HTMLButtonElement);
    this.clear = root.part("clear-one", HTMLButtonElement);
    this.remove = root.part("remove-one", HTMLButtonElement);
    this.place = root.part("place-one", HTMLButtonElement);
    this.at = root.part("order-at", HTMLInputElement);
    const { driven: own } = texts;
    root.part("hold-all").addEventListener("click", () => this.#send("hold")); // safe: not asked first
    this.seen = root.part("seen-form", HTMLFormElement);
    const person = root.part("seen-name", HTMLInputElement);
    this.seen.addEventListener("submit", (event) => {
      event.preventDefault();
      if (person.value.trim()) this.#send("seen", person.value.trim());
    });
    root.part("stop-all").addEventListener("click", () => this.#send("stop"));
    root.part("go-all").addEventListener("click", () => this.#confirm(own.goAllAsked, "go"));
    this.one.addEventListener("click", () => this.#send(this.#isHeld ? "go" : "hold", this.#name));
    this.clear.addEventListener("click", () =>
      this.#confirm(own.clearAsked({ name: this.#name }), "clear", this.#name),
    );
    this.remove.addEventListener("click", () =>
      this.#confirm(own.removeAsked({ name: this.#name }), "remove", this.#name),
    );
    this.place.addEventListener("click", () =>
      this.#confirm(own.placeAsked({ name: this.#name }), "place", this.#name),
    );
    root.part("order-yes").addEventListener("click", () => this.#asked());
  }

  #asked = () => {};

  get #name() {
    return this.choice.robot?.name ?? "";
  }

  get #isHeld() {
    const { robot } = this.choice;
    return robot !== null && this.driven.isHeld(robot.index, Infinity);
  }

  /**
   * Show what may be asked for now.
   *
   * @param {number} tick
   * @param {boolean} isConnected
   */
  refresh(tick, isConnected) {
    const { robot } = this.choice;
    this.box.hidden = !(this.address && this.driven.runs);
    this.seen.hidden = this.box.hidden || !isConnected;
    for (const button of this.box.querySelectorAll("button")) button.disabled = !isConnected;
    this.one.hidden = !robot;
    const isFaulty =
      robot !== null &&
      this.driven
        .alarmsAt(Infinity)
        .some((alarm) => alarm.robot === robot.index && alarm.kind === "fault");
    this.clear.hidden = this.remove.hidden = !isFaulty;
    this.place.hidden = robot === null || !this.driven.isOff(robot.index, Infinity);
    if (!robot) return;
    const { driven: own } = texts;
    this.#write(
      this.one,
      this.#isHeld ? own.goOne({ name: robot.name }) : own.holdOne({ name: robot.name }),
    );
    this.#write(this.clear, own.clearOne({ name: robot.name }));
    this.#write(this.remove, own.removeOne({ name: robot.name }));
    this.#write(this.place, own.placeOne({ name: robot.name }));
  }

  /**
   * @param {HTMLElement} button
   * @param {string} text
   */
  #write(button, text) {
    if (button.textContent !== text) button.textContent = text;
  }

  /**
   * Ask the person first.
   *
   * @param {string} question
   * @param {string} kind
   * @param {string} [name]
   */
  #confirm(question, kind, name) {
    this.root.part("order-question").textContent = question;
    this.at.value = "";
    this.root.part("order-place").hidden = kind !== "place";
    this.#asked = () => this.#send(kind, name, this.at.value.trim() || undefined);
    this.dialog.showModal();
  }

  /**
   * @param {string} kind
   * @param {string} [name]
   * @param {string} [at]
   */
  async #send(kind, name, at) {
    this.answer.textContent = texts.driven.asked;
    const { done, text } = await sendOrder(this.address, { kind, name, at });
    const { driven: own } = texts;
    const reason = text ? said(text) : own.disconnected;
    this.answer.textContent = done ? own.carriedOut : own.refused({ reason });
  }
}
