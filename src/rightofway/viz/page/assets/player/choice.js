import { shortestWay } from "../plan/corridor.js";
import { Observable } from "../common/observable.js";

/** @import { Site } from "../plan/site.js" */

/** @typedef {"plan" | "floor" | "both"} Mode What to show: the plan, what happened on the floor, or both. */

/**
 * What the user looks at: a robot, a decision, fault or forced loss, the heat map, the plan or what became of it,
 * the bottleneck, a corridor, what robots book, places of a finding. It is the fleet that views show, and
 * writes nothing into the plan. Events: `choice`, `heat`, `mode`,
 * `bottleneck`, `corridor`, `space`; `fleet` when the robots of a fleet that is driven have gone on.
 */
export class Choice extends Observable {
  /** @param {Site} plan */
  constructor(plan) {
    super();
    this.plan = plan;
    this.robotIndex = -1;
    this.decisionIndex = -1;
    this.faultIndex = -1;
    this.forcedIndex = -1; // of a loss that every plan has
    this.jobIndex = -1;
    this.heat = false;
    /** @type {Mode} */
    this.mode = plan.happened ? "both" : "plan";
    this.bottleneck = true;
    this.allFaulty = [...new Set(plan.faults.flatMap(({ robots }) => robots))];
    /** @type {() => number[]} */
    this.alarmed = () => []; // the robots with an alarm, of a fleet that is driven
    /** @type {number[] | null} */
    this.corridor = null; // the vertices of the way whose distances are the axis of the diagram
    this.space = false; // whether bookings and the room that robots need are shown
    this.pair = -1; // the robot whose distance to the one chosen is shown; -1 for the nearest one
    /** @type {number[]} */
    this.lit = []; // the vertices that a finding or a wait is about
    /** @type {number[] | null} */
    this.picked = null; // the ends of the next corridor that are chosen so far
  }

  /** The robots that are shown: as planned, or what became of them on the floor. */
  get robots() {
    const { planned, happened } = this.plan;
    return this.mode === "plan" ? planned : (happened ?? planned);
  }

  /** What they drive on. */
  get roadmap() {
    return this.plan.roadmap;
  }

  /** The robot, or null. */
  get robot() {
    return this.robots[this.robotIndex] ?? null;
  }

  /** The decision, fault or forced loss, or null: what happens between its `robots` at its `vertices` at its `tick`. */
  get decision() {
    return this.fault ?? this.forcedLoss ?? this.plan.decisions[this.decisionIndex] ?? null;
  }

  /** What robots lose to each other in every plan, or null. */
  get forcedLoss() {
    return this.plan.forcedLosses[this.forcedIndex] ?? null;
  }

  /** The job, or null. */
  get job() {
    return this.plan.jobs[this.jobIndex] ?? null;
  }

  /** The fault, or null. */
  get fault() {
    return this.plan.faults[this.faultIndex] ?? null;
  }

  /** The robots that are marked: those of the fault looked at, else of all faults, and those with an alarm. */
  get faulty() {
    return this.fault ? this.fault.robots : [...this.allFaulty, ...this.alarmed()];
  }

  /** @param {number} index */
  chooseRobot(index) {
    this.#set({ robot: index });
  }

  /**
   * Look at a decision, and so at the robot that waits.
   *
   * @param {number} index
   */
  chooseDecision(index) {
    this.#set({ robot: this.plan.decisions[index]?.waits, decision: index });
  }

  /**
   * Look at a fault, and so at the first of its robots.
   *
   * @param {number} index
   */
  chooseFault(index) {
    this.#set({ robot: this.plan.faults[index]?.robots[0], fault: index });
  }

  /**
   * Look at what robots lose in every plan, and so at the first of them.
   *
   * @param {number} index
   */
  chooseForcedLoss(index) {
    this.#set({ robot: this.plan.forcedLosses[index]?.robots[0], forced: index });
  }

  /**
   * Look at a job, and so at the robot that does it.
   *
   * @param {number} index
   */
  chooseJob(index) {
    this.#set({ robot: this.plan.jobs[index]?.robot, job: index });
  }

  /** Also ends the choice of a corridor that has begun. */
  chooseNothing() {
    if (this.picked) this.toggleCorridor();
    this.#set({});
  }

  toggleHeat() {
    this.heat = !this.heat;
    this.tell("heat");
  }

  toggleSpace() {
    this.space = !this.space;
    this.tell("space");
  }

  /**
   * Show how near another robot is to the one chosen.
   *
   * @param {number} other
   */
  lookAtPair(other) {
    this.pair = other;
    this.space = true;
    this.tell("space");
  }

  /**
   * Light places; none for an empty list.
   *
   * @param {number[]} vertices
   */
  light(vertices) {
    this.lit = vertices;
    this.tell("choice");
  }

  toggleBottleneck() {
    this.bottleneck = !this.bottleneck;
    this.tell("bottleneck");
  }

  /** Begin to choose a corridor by its ends; or show none any more. */
  toggleCorridor() {
    this.picked = this.picked || this.corridor ? null : [];
    this.corridor = null;
    this.tell("corridor");
  }

  /**
   * Choose an end of the corridor: with the second one it is the shortest way between both.
   *
   * @param {number} vertex
   */
  pickEnd(vertex) {
    if (!this.picked || this.picked.includes(vertex)) return;
    this.picked.push(vertex);
    if (this.picked.length === 2) this.showCorridor(this.picked[0], vertex);
    this.tell("corridor");
  }

  /**
   * Show the shortest way between two places; nothing changes without one, or for the place -1.
   *
   * @param {number} from
   * @param {number} to
   */
  showCorridor(from, to) {
    const corridor = from >= 0 && to >= 0 ? shortestWay(this.plan.roadmap, from, to) : null;
    if (corridor) [this.corridor, this.picked] = [corridor, null];
    else if (this.picked) this.picked = [];
    this.tell("corridor");
  }

  /**
   * Show the plan, what became of it on the `floor`, or `both`.
   *
   * @param {Mode} mode
   */
  show(mode) {
    if (mode === this.mode) return;
    this.mode = mode;
    this.tell("mode");
  }

  /** Whether the plan is shown beside what happened. */
  get ghosts() {
    return this.mode === "both";
  }

  /** The robots that the diagram draws thin beside those shown: by plan; or null. */
  get beside() {
    return this.ghosts ? this.plan.planned : null;
  }

  /**
   * The robots whose routes are drawn, by index.
   *
   * @returns {number[]}
   */
  get routed() {
    return this.decision?.robots ?? (this.robot ? [this.robotIndex] : []);
  }

  /**
   * Whether a robot is to stand out; all do while none is chosen.
   *
   * @param {number} index
   */
  standsOut(index) {
    if (this.decision) return this.decision.robots.includes(index);
    return this.robotIndex < 0 || this.robotIndex === index;
  }

  /** @param {{ robot?: number, decision?: number, fault?: number, forced?: number, job?: number }} indices */
  #set({ robot = -1, decision = -1, fault = -1, forced = -1, job = -1 }) {
    const isSame = [
      robot === this.robotIndex,
      decision === this.decisionIndex,
      fault === this.faultIndex,
      forced === this.forcedIndex,
      job === this.jobIndex,
    ];
    if (isSame.every(Boolean)) return;
    if (robot !== this.robotIndex) this.pair = -1;
    this.lit = [];
    this.faultIndex = fault;
    this.forcedIndex = forced;
    this.jobIndex = job;
    this.robotIndex = robot;
    this.decisionIndex = decision;
    this.tell("choice");
  }
}
