import { EMBEDDED } from "./dom.js";
import { MODES } from "./mode_switch.js";

/** Keeps moment and choice in the address, so that a link shows what its sender saw. */
export class DeepLink {
  #timer = 0;

  constructor(plan, clock, choice) {
    Object.assign(this, { plan, clock, choice });
    if (EMBEDDED) return;
    clock.on("tick", () => this.#soon());
    choice.on("choice", () => this.#soon());
    choice.on("mode", () => this.#soon());
    choice.on("corridor", () => this.#soon());
    window.addEventListener("hashchange", () => this.read());
  }

  /** Show what the address says; returns whether it says anything. */
  read() {
    const asked = new URLSearchParams(EMBEDDED ? "" : location.hash.slice(1));
    const robot = this.plan.robots.findIndex(({ name }) => name === asked.get("robot"));
    const decision = Number.parseInt(asked.get("decision") ?? "", 10) - 1;
    const fault = Number.parseInt(asked.get("fault") ?? "", 10) - 1;
    if (this.plan.faults[fault]) this.choice.chooseFault(fault);
    else if (this.plan.decisions[decision]) this.choice.chooseDecision(decision);
    else if (robot >= 0) this.choice.chooseRobot(robot);
    if (this.plan.happened && MODES.includes(asked.get("show")))
      this.choice.show(asked.get("show"));
    this.choice.showCorridor(
      ...["from", "to"].map((end) => this.plan.roadmap.vertexNamed(asked.get(end))),
    );
    const tick = asked.get("tick") ?? this.choice.decision?.tick ?? 0;
    this.clock.seek(Number.parseFloat(tick) || 0);
    return asked.size > 0;
  }

  /** Write when nothing has changed for a moment: browsers slow down pages that write often. */
  #soon() {
    clearTimeout(this.#timer);
    this.#timer = setTimeout(() => this.#write(), 300);
  }

  #write() {
    if (!this.clock.playing) history.replaceState(null, "", this.address);
  }

  /** The address of this moment and choice. */
  get address() {
    const state = new URLSearchParams({ tick: String(Math.round(this.clock.tick * 100) / 100) });
    if (this.choice.fault) state.set("fault", String(this.choice.faultIndex + 1));
    else if (this.choice.decision) state.set("decision", String(this.choice.decisionIndex + 1));
    else if (this.choice.robot) state.set("robot", this.choice.robot.name);
    if (this.plan.happened) state.set("show", this.choice.mode);
    const { corridor } = this.choice;
    if (corridor)
      ["from", "to"].forEach((end, i) => state.set(end, this.plan.roadmap.name(corridor.at(-i))));
    return `${location.href.split("#")[0]}#${state}`;
  }
}
