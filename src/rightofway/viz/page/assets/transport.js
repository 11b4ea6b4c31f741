"use strict";

/** Play, step, slider, speed, and the moment in figures. */
class Transport {
  #told = NaN;

  constructor(plan, clock, words) {
    Object.assign(this, { plan, clock, words });
    this.slider = document.getElementById("slider");
    this.play = document.getElementById("play");
    this.speed = document.getElementById("speed");
    this.readout = document.getElementById("readout");
    this.slider.max = plan.end;
    const label = (rate) => (rate < 1 ? `1/${1 / rate} ×` : `${rate} ×`);
    this.speed.append(...RATES.map((rate) => element("option", { value: rate }, label(rate))));
    this.speed.title = "Time units in a second";
    this.#listen();
    this.#showPlaying();
  }

  /** Write the moment. */
  refresh() {
    const { tick, wholeTick, end } = this.clock;
    this.slider.value = tick;
    this.slider.style.setProperty("--over", `${(100 * tick) / end}%`);
    if (wholeTick === this.#told) return;
    this.#told = wholeTick;
    const now = this.words.time(wholeTick);
    const isUnit = this.plan.tick.numerator === this.plan.tick.denominator;
    const ticks = isUnit ? "" : ` · tick ${wholeTick} of ${end}`;
    this.readout.replaceChildren(element("b", {}, now), ` of ${this.words.time(end)}${ticks}`);
    this.slider.setAttribute("aria-valuetext", `${now} of ${this.words.time(end)}, tick ${wholeTick}`);
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
    this.play.setAttribute("aria-label", playing ? "Pause" : "Play");
    this.speed.value = rate;
  }
}
