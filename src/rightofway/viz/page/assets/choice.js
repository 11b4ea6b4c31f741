"use strict";

/** What the user looks at: a robot, a decision, the heat map. Tells `choice` and `heat`. */
class Choice extends Observable {
  constructor(plan) {
    super();
    this.plan = plan;
    this.robotIndex = -1;
    this.decisionIndex = -1;
    this.heat = false;
  }

  /** The robot, or null. */
  get robot() {
    return this.plan.robots[this.robotIndex] ?? null;
  }

  /** The decision, or null. */
  get decision() {
    return this.plan.decisions[this.decisionIndex] ?? null;
  }

  chooseRobot(index) {
    this.#set(index, -1);
  }

  /** Look at a decision, and so at the robot that waits. */
  chooseDecision(index) {
    this.#set(this.plan.decisions[index]?.waits ?? -1, index);
  }

  chooseNothing() {
    this.#set(-1, -1);
  }

  toggleHeat() {
    this.heat = !this.heat;
    this.tell("heat");
  }

  /** Whether a robot is to stand out; all do while none is chosen. */
  standsOut(index) {
    if (this.decision) return this.decision.robots.includes(index);
    return this.robotIndex < 0 || this.robotIndex === index;
  }

  #set(robot, decision) {
    if (robot === this.robotIndex && decision === this.decisionIndex) return;
    this.robotIndex = robot;
    this.decisionIndex = decision;
    this.tell("choice");
  }
}
