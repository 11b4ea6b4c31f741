import { RATES } from "./clock.js";
import { element } from "./dom.js";
import { texts } from "./language.js";

/** Play, step, slider, speed, and the moment in figures. */
export class Transport {
  #written = "";

  constructor(plan, clock, words) {
    Object.assign(this, { plan, clock, words });
    this.slider = document.getElementById("slider");
    this.play = document.getElementById("play");
    this.speed = document.getElementById("speed");
    this.readout = document.getElementById("readout");
    this.slider.max = plan.end;
    this.digits = plan.end / clock.ticksPerUnit < 10 ? 2 : 1;
    const label = (rate) => (rate < 1 ? `1/${1 / rate} ×` : `${rate} ×`);
    this.speed.append(...RATES.map((rate) => element("option", { value: rate }, label(rate))));
    this.speed.title = texts.rate(plan.quantities.units.time ?? texts.timeUnit);
    this.#listen();
    this.#showPlaying();
  }

  /** Write the moment: exactly while time stands still, with as many decimals all the time while it runs. */
  refresh() {
    const { tick, playing, end } = this.clock;
    this.slider.value = tick;
    this.slider.style.setProperty("--over", `${(100 * tick) / end}%`);
    const now = playing ? this.plan.quantities.running(tick, this.digits) : this.words.time(tick);
    if (now === this.#written) return;
    this.#written = now;
    const [moment, ofAll] = texts.of(now, this.words.time(end));
    this.readout.replaceChildren(element("b", {}, moment), element("span", {}, ofAll));
    if (!playing) this.slider.setAttribute("aria-valuetext", `${moment}${ofAll}`);
  }

  #listen() {
    const { clock } = this;
    const press = (id, action) => document.getElementById(id).addEventListener("click", action);
    press("play", () => clock.toggle());
    press("back", () => clock.step(-1));
    press("forth", () => clock.step(1));
    this.slider.addEventListener("input", () => {
      clock.pause();
      clock.seek(Number(this.slider.value));
    });
    this.speed.addEventListener("change", () => clock.setRate(Number(this.speed.value)));
    clock.on("playing", () => this.#showPlaying());
  }

  #showPlaying() {
    const { playing, rate } = this.clock;
    this.play.classList.toggle("playing", playing);
    this.play.setAttribute("aria-label", playing ? texts.pause : texts.markup.play);
    this.speed.value = rate;
  }
}
