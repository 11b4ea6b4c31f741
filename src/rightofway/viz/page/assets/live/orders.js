import { sendOrder } from "./feed.js";
import { said, texts } from "../language/language.js";

/** @import { Choice } from "../player/choice.js" */
/** @import { Driven } from "./driven.js" */
/** @import { Root } from "../common/root.js" */

const ORDERS = new Set(["by person", "operated", "all operated"]); // kinds of sentences on orders
const PERSON = "rightofway person"; // where a browser keeps the name

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
    this.person = root.part("person", HTMLInputElement);
    this.person.value = recall();
    this.person.addEventListener("change", () => remember(this.#who));
    this.last = root.part("last-order");
    this.seen.addEventListener("submit", (event) => {
      event.preventDefault();
      this.#send("seen", this.#who);
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
  #isSeen = false; // whether the last order was to mark alarms as seen

  /** Who gives orders here; empty where that is not known. */
  get #who() {
    return this.person.value.trim();
  }

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
    const alarms = this.driven.alarmsAt(Infinity);
    this.seen.hidden = this.box.hidden || !isConnected || alarms.every((alarm) => alarm.person);
    this.#showLast();
    this.#showWhoHasSeen(alarms);
    for (const button of this.box.querySelectorAll("button")) button.disabled = !isConnected;
    this.one.hidden = !robot;
    const isFaulty =
      robot !== null &&
      alarms.some((alarm) => alarm.robot === robot.index && alarm.kind === "fault");
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

  /** The last order of a person, on whichever screen. */
  #showLast() {
    const { story } = this.driven;
    const told = story.findLast(({ kind, text }) => kind === "news" && ORDERS.has(text[0]));
    this.last.hidden = !told;
    if (told) this.#write(this.last, texts.driven.lastOrder({ order: said(told.text) }));
  }

  /**
   * Name who was first where two people have marked the same alarms as seen.
   *
   * @param {import("./driven.js").Alarm[]} alarms
   */
  #showWhoHasSeen(alarms) {
    const others = alarms.filter(({ person }) => person);
    if (!this.#isSeen || !others.length || others.some(({ person }) => person === this.#who))
      return;
    const { person = "" } = others[0];
    this.#write(this.answer, texts.driven.seenBefore({ person }));
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
    this.#isSeen = kind === "seen";
    this.answer.textContent = texts.driven.asked;
    const { done, text } = await sendOrder(this.address, {
      kind,
      name,
      at,
      person: this.#who || undefined,
    });
    const { driven: own } = texts;
    const reason = text ? said(text) : own.disconnected;
    this.answer.textContent = done ? own.carriedOut : own.refused({ reason });
  }
}

/** The name that was entered in this browser. */
function recall() {
  try {
    return localStorage.getItem(PERSON) ?? "";
  } catch {
    return ""; // the browser keeps nothing
  }
}

/** @param {string} person */
function remember(person) {
  try {
    localStorage.setItem(PERSON, person);
  } catch {
    // it is entered anew after the next start
  }
}
