import { RATES } from "./clock.js";
import { element } from "../common/dom.js";
import { texts } from "../language/language.js";

/** @import { Root } from "../common/root.js" */
/** @import { Clock } from "./clock.js" */
/** @import { Plan } from "../plan/plan.js" */
/** @import { Words } from "../language/words.js" */

/** Play, step, slider, speed, and the moment in figures. */
export class Transport {
  #written = "";

  /**
   * @param {Root} root
   * @param {Plan} plan
   * @param {Clock} clock
   * @param {Words} words
   */
  constructor(root, plan, clock, words) {
    this.root = root;
    this.plan = plan;
    this.clock = clock;
    this.words = words;
    this.slider = root.part("slider", HTMLInputElement);
    this.play = root.part("play");
    this.speed = root.part("speed", HTMLSelectElement);
    this.readout = root.part("readout");
    this.slider.max = String(plan.end);
    this.digits = plan.end / clock.ticksPerUnit < 10 ? 2 : 1;
    /** @param {number} rate */
    const label = (rate) => (rate < 1 ? `1/${1 / rate} ×` : `${rate} ×`);
    this.speed.append(
      ...RATES.map((rate) => element("option", { value: String(rate) }, label(rate))),
    );
    this.speed.title = texts.rate({ unit: plan.quantities.units.time ?? texts.timeUnit });
    this.#listen();
    this.#showPlaying();
  }

  /** Write the moment: exactly while time stands still, with as many decimals all the time while it runs. */
  refresh() {
    const { tick, playing, end } = this.clock;
    this.slider.value = String(tick);
    this.slider.style.setProperty("--over", `${(100 * tick) / end}%`);
    const now = playing ? this.plan.quantities.running(tick, this.digits) : this.words.time(tick);
    if (now === this.#written) return;
    this.#written = now;
    const [moment, ofAll] = texts.of({ time: now, all: this.words.time(end) });
    this.readout.replaceChildren(element("b", {}, moment), element("span", {}, ofAll));
    if (!playing) this.slider.setAttribute("aria-valuetext", `${moment}${ofAll}`);
  }

  #listen() {
    const { clock } = this;
    /**
     * @param {string} id
     * @param {() => void} action
     */
    const press = (id, action) => this.root.part(id).addEventListener("click", action);
    press("play", () => clock.toggle());
    press("back", () => clock.step(-1));
    press("forth", () => clock.step(1));
    this.slider.addEventListener("input", () => {
      clock.pause();
      clock.seek(Number(this.slider.value));
    });
    this.speed.addEventListener("change", () => clock.setRate(Number(this.speed.value)));
    clock.on("playing", () => this.#showPlaying());
    clock.on("end", () => (this.slider.max = String(clock.end)));
  }

  #showPlaying() {
    const { playing, rate } = this.clock;
    this.play.classList.toggle("playing", playing);
    this.play.setAttribute("aria-label", playing ? texts.pause : texts.markup.play);
    this.speed.value = String(rate);
  }
}
