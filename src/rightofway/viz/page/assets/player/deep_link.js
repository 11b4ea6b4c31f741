import { lastOf } from "../common/arrays.js";
import { MODES } from "./mode_switch.js";

/** @import { Root } from "../common/root.js" */
/** @import { Choice } from "./choice.js" */
/** @import { Clock } from "./clock.js" */
/** @import { Plan } from "../plan/plan.js" */

/** Keeps moment and choice in the address, so that a link shows what its sender saw. */
export class DeepLink {
  #timer = 0;

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
    if (root.isEmbedded) return;
    clock.on("tick", () => this.#soon());
    choice.on("choice", () => this.#soon());
    choice.on("mode", () => this.#soon());
    choice.on("corridor", () => this.#soon());
    root.listen(window, "hashchange", () => this.read());
    root.atEnd(() => clearTimeout(this.#timer));
  }

  /** Show what the address says; returns whether it says anything. */
  read() {
    const asked = new URLSearchParams(this.root.isEmbedded ? "" : location.hash.slice(1));
    const job = this.plan.jobs.findIndex(({ name }) => name === asked.get("job"));
    const robot = this.plan.robots.findIndex(({ name }) => name === asked.get("robot"));
    const decision = Number.parseInt(asked.get("decision") ?? "", 10) - 1;
    const fault = Number.parseInt(asked.get("fault") ?? "", 10) - 1;
    const forced = Number.parseInt(asked.get("forced") ?? "", 10) - 1;
    if (this.plan.faults[fault]) this.choice.chooseFault(fault);
    else if (this.plan.forcedLosses[forced]) this.choice.chooseForcedLoss(forced);
    else if (this.plan.decisions[decision]) this.choice.chooseDecision(decision);
    else if (job >= 0) this.choice.chooseJob(job);
    else if (robot >= 0) this.choice.chooseRobot(robot);
    const mode = MODES.find((each) => each === asked.get("show"));
    if (this.plan.happened && mode) this.choice.show(mode);
    const { roadmap } = this.plan;
    this.choice.showCorridor(
      roadmap.vertexNamed(asked.get("from")),
      roadmap.vertexNamed(asked.get("to")),
    );
    const tick = asked.get("tick") ?? this.choice.decision?.tick ?? 0;
    this.clock.seek(Number.parseFloat(String(tick)) || 0);
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
    else if (this.choice.forcedLoss) state.set("forced", String(this.choice.forcedIndex + 1));
    else if (this.choice.decision) state.set("decision", String(this.choice.decisionIndex + 1));
    else if (this.choice.job) state.set("job", this.choice.job.name);
    else if (this.choice.robot) state.set("robot", this.choice.robot.name);
    if (this.plan.happened) state.set("show", this.choice.mode);
    const { corridor } = this.choice;
    if (corridor) {
      state.set("from", this.plan.roadmap.name(corridor[0]));
      state.set("to", this.plan.roadmap.name(lastOf(corridor)));
    }
    return `${location.href.split("#")[0]}#${state}`;
  }
}
