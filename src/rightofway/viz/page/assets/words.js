import { lastOf } from "./arrays.js";
import { FloorRobot } from "./floor.js";
import { language, texts } from "./language.js";
import { BROKEN } from "./phases.js";
import { FOLLOWS, MAKES_ROOM } from "./robot.js";

/** @import { DecisionData, FaultData } from "./payload.d.ts" */
/** @import { Site } from "./site.js" */
/** @import { Loss, Robot } from "./robot.js" */
/** @import { Closure } from "./site.js" */
/** @import { Group } from "./steady.js" */

/**
 * The language of what is said about a fault: a reason of the library is English.
 *
 * @param {FaultData} options
 */
export function languageOfFault({ reason }) {
  return reason ? "en" : language;
}

/**
 * "R1, R2 and R3"; the first few of many.
 *
 * @param {string[]} names
 */
export function several(names) {
  const few = names.length > 4 ? [...names.slice(0, 3), texts.more(names.length - 3)] : names;
  return joined(few).join("");
}

/**
 * Names or elements, with what stands between them.
 *
 * @template P
 * @param {P[]} parts
 * @returns {(P | string)[]}
 */
export function joined(parts) {
  /** @param {number} i */
  const between = (i) => (i < parts.length - 1 ? ", " : ` ${texts.and} `);
  return parts.flatMap((part, i) => (i ? [between(i), part] : [part]));
}

/**
 * Whether both choices of a decision cost the same.
 *
 * @param {DecisionData} options
 */
function isTie({ level, completionSums }) {
  return level === "robot" && completionSums !== null && completionSums[0] === completionSums[1];
}

/**
 * A length without the noise of floating point.
 *
 * @param {number} length
 */
function rounded(length) {
  return Number(length.toPrecision(9));
}

/** @param {string} text */
export function upperFirst(text) {
  return text[0].toUpperCase() + text.slice(1);
}

/** Durations as people write them, names, and sentences made of them. */
export class Words {
  /** @param {Site} plan */
  constructor(plan) {
    this.plan = plan;
  }

  /** @param {number} index */
  robot(index) {
    return this.plan.robots[index].name;
  }

  /**
   * Where a place is, where there is little room: "Press", "(7.25, 4.75)", "N5".
   *
   * @param {number} vertex
   */
  short(vertex) {
    const { roadmap } = this.plan;
    return roadmap.isMeasured ? roadmap.label(vertex) : roadmap.name(vertex);
  }

  /**
   * Where a place is, in a list, with the number of a cell as in tables and on the command line:
   * "Press (N24)", "N24 (7.25, 4.75)", "N5".
   *
   * @param {number} vertex
   */
  where(vertex) {
    const { roadmap } = this.plan;
    if (!roadmap.isMeasured) return roadmap.name(vertex);
    return roadmap.stations.has(vertex)
      ? this.#numbered(roadmap.label(vertex), vertex)
      : `${roadmap.name(vertex)} ${roadmap.where(vertex)}`;
  }

  /**
   * @param {string} name
   * @param {number} vertex
   */
  #numbered(name, vertex) {
    return `${name} (${this.plan.roadmap.name(vertex)})`;
  }

  /**
   * A place in a sentence: a cell that is the home or the only stop of one robot is called that.
   *
   * @param {number} vertex
   */
  vertex(vertex) {
    const { roadmap } = this.plan;
    if (!roadmap.isMeasured || roadmap.stations.has(vertex)) return this.where(vertex);
    this.#known ??= this.#knownPlaces();
    const known = this.#known.get(vertex);
    return known ? this.#numbered(known, vertex) : this.where(vertex);
  }

  /** @type {Map<number, string> | null} */
  #known = null;

  #knownPlaces() {
    const { planned, stops } = this.plan;
    /** @type {Map<number, string>} */
    const known = new Map();
    /** @type {Map<Robot, number>} */
    const counts = new Map();
    for (const robots of stops.values())
      for (const robot of robots) counts.set(robot, (counts.get(robot) ?? 0) + 1);
    for (const [vertex, [robot, other]] of stops)
      if (!other && counts.get(robot) === 1) known.set(vertex, texts.theStop(robot.name));
    for (const { home, name } of planned) known.set(home, texts.theHome(name));
    return known;
  }

  /**
   * A time where there is little room: "6 min 23 s"; a bare number where no unit is known.
   *
   * @param {number} ticks
   */
  time(ticks) {
    return this.plan.quantities.short(ticks);
  }

  /**
   * How long something lasts, in a sentence: "6 min 23 s", "2 time units".
   *
   * @param {number} ticks
   */
  duration(ticks) {
    return this.plan.quantities.duration(ticks);
  }

  /**
   * A point in time, in a sentence: "6 min 23 s", "time 2".
   *
   * @param {number} ticks
   */
  moment(ticks) {
    return this.plan.quantities.moment(ticks);
  }

  /**
   * A share in per cent, with as many places as help.
   *
   * @param {number} share
   */
  percent(share) {
    const percent = 100 * share;
    return `${percent && percent < 9.95 ? percent.toFixed(1) : Math.round(percent)} %`;
  }

  /**
   * How a robot loses time, and on the floor how much more than planned.
   *
   * @param {Loss} loss
   * @param {Robot} robot
   */
  loss(loss, robot) {
    const more = robot instanceof FloorRobot ? robot.unplanned(loss) : 0;
    return more > 0 ? texts.loss.more(this.#loss(loss), this.time(more)) : this.#loss(loss);
  }

  /**
   * How far two robots are apart, and how far they have to be: "0.95 m apart, 0.9 m needed".
   *
   * @param {{ distance: number, room: number }} options
   */
  apart({ distance, room }) {
    const { quantities } = this.plan;
    return texts.apart(quantities.length(rounded(distance)), quantities.length(rounded(room)));
  }

  /**
   * When a place is closed.
   *
   * @param {Closure} options
   */
  closure({ from, until, vertices }) {
    const what =
      vertices.length > 1
        ? texts.closedWay(this.vertex(vertices[0]), this.vertex(lastOf(vertices)))
        : texts.closed;
    return until === Infinity
      ? texts.closedFrom(what, this.moment(from))
      : texts.closedFromUntil(what, this.moment(from), this.moment(until));
  }

  /**
   * Why a robot never gets on.
   *
   * @param {Robot | null} behind
   */
  stuck(behind) {
    return behind ? texts.stuckBehind(behind.name, behind.ending === BROKEN) : texts.never;
  }

  /** @param {Loss} options */
  #loss({ kind, forRobot, vertex, until, towards, freed, tick, ticks }) {
    const [here, lasts] = [this.vertex(vertex), this.duration(ticks)];
    const other = forRobot === null ? "" : this.robot(forRobot);
    if (kind === MAKES_ROOM) return texts.loss.makesRoom(here, other, lasts);
    if (kind === FOLLOWS) return texts.loss.follows(other, here, this.vertex(until), lasts);
    if (forRobot === null || freed === null) {
      const closure = this.#closureAhead(vertex, towards, tick);
      if (!closure) return texts.loss.waitsAlone(lasts, here);
      const place = closure.vertices.map((each) => this.vertex(each)).join(" – ");
      return texts.loss.waitsClosed(lasts, here, place, this.moment(closure.until));
    }
    return texts.loss.waits(lasts, here, other, this.vertex(freed), freed === towards);
  }

  /**
   * What is closed after a tick of what a robot drives to next, for a while.
   *
   * @param {number} vertex
   * @param {number} towards
   * @param {number} tick
   */
  #closureAhead(vertex, towards, tick) {
    return this.plan.closures.find(
      ({ vertices, until }) =>
        until > tick &&
        until < Infinity &&
        vertices.includes(towards) &&
        (vertices.length === 1 || vertices.includes(vertex)),
    );
  }

  /**
   * How late a robot is.
   *
   * @param {number | null} ticks
   */
  lateness(ticks) {
    const { elsewhere, onTime, late, early } = texts.lateness;
    if (ticks === null) return elsewhere;
    if (!ticks) return onTime;
    return ticks > 0 ? late(this.time(ticks)) : early(this.time(-ticks));
  }

  /**
   * What keeps a group from repeating itself sooner, in a line.
   *
   * @param {Group} options
   */
  bottleneck({ circuit, period }) {
    const names = [...new Set(circuit.map(({ robot }) => robot.name))];
    return texts.bottleneck(several(names), names.length === 1, this.time(period));
  }

  /**
   * The same with its places.
   *
   * @param {Group} group
   */
  bottleneckAtLength(group) {
    const steps = group.circuit.map(({ robot, vertex }) =>
      texts.isIn(robot.name, this.vertex(vertex)),
    );
    return texts.bottleneckSteps(this.bottleneck(group), steps.join(", "));
  }

  /**
   * What is wrong, in a sentence.
   *
   * @param {FaultData} options
   */
  fault({ kind, robots, vertices, reason }) {
    if (reason) return reason;
    const names = robots.map((robot) => this.robot(robot));
    const places = vertices.map((vertex) => this.vertex(vertex));
    const [who, where] = [several(names), several(places) || texts.offTheMap];
    const [from, to = texts.nowhere] = places;
    return texts.faultKinds[kind]?.says(who, where, from, to) ?? texts.anyFault(who, kind, where);
  }

  /**
   * What would be right, in a sentence.
   *
   * @param {Pick<FaultData, "kind" | "remedy">} options
   */
  remedy({ kind, remedy }) {
    if (remedy) return `${upperFirst(remedy)}.`;
    return texts.faultKinds[kind]?.remedy ?? "";
  }

  /**
   * Where two robots would have met.
   *
   * @param {DecisionData} decision
   */
  place(decision) {
    const names = decision.vertices.map((vertex) => this.vertex(vertex));
    return names.length === 1 ? names[0] : texts.fromTo(names[0], lastOf(names));
  }

  /**
   * The robot that goes first.
   *
   * @param {DecisionData} decision
   */
  first(decision) {
    return decision.robots[0] === decision.waits ? decision.robots[1] : decision.robots[0];
  }

  /**
   * Who waits for whom, in a line.
   *
   * @param {DecisionData} decision
   */
  decision(decision) {
    const [waits, first] = [this.robot(decision.waits), this.robot(this.first(decision))];
    const { headOn, follows, waits: meets } = texts.decision;
    /** @type {Partial<Record<DecisionData["kind"], typeof meets>>} */
    const known = { "head-on": headOn, following: follows };
    const says = known[decision.kind] ?? meets;
    return says(waits, first, this.place(decision));
  }

  /**
   * What the robot that waits loses by a decision, in few words.
   *
   * @param {DecisionData} decision
   */
  cost(decision) {
    return decision.ticks
      ? texts.decision.cost(this.duration(decision.ticks))
      : texts.decision.free;
  }

  /**
   * Why a decision was taken, in few words.
   *
   * @param {DecisionData} decision
   */
  why(decision) {
    return isTie(decision) ? texts.decision.tie : texts.decision.why[decision.level];
  }

  /**
   * The same in whole sentences.
   *
   * @param {DecisionData} decision
   */
  decisionAtLength(decision) {
    const { waitsIn, givesWay } = texts.decision;
    const [waits, first] = [this.robot(decision.waits), this.robot(this.first(decision))];
    const here = this.vertex(decision.waitsAt);
    const how = decision.ticks
      ? waitsIn(waits, this.duration(decision.ticks), here, first)
      : givesWay(waits, here, first);
    return `${this.#meeting(decision)} ${how}`;
  }

  /** @param {DecisionData} decision */
  #meeting(decision) {
    const { metHeadOn, sameWay, tooNear, bothIn } = texts.decision;
    const [one, other] = decision.robots.map((robot) => this.robot(robot));
    const place = this.place(decision);
    switch (decision.kind) {
      case "head-on":
        return metHeadOn(one, other, place);
      case "following":
        return sameWay(one, other, place);
      case "crossing":
        return tooNear(one, other, this.robot(this.first(decision)), place);
      default:
        return bothIn(one, other, place);
    }
  }

  /**
   * Why that one waits.
   *
   * @param {DecisionData} decision
   */
  reason(decision) {
    const { reason } = texts.decision;
    const says = isTie(decision) ? reason.tie : (reason[decision.level] ?? reason.robot);
    return says(this.robot(decision.waits), this.robot(this.first(decision)));
  }

  /**
   * What both choices lead to: a label, and a figure for each robot if it is the one that waits.
   *
   * @param {DecisionData} decision
   */
  figures(decision) {
    const rows = [];
    if (decision.conflictsLeft.some((count) => count !== null)) {
      const counts = decision.conflictsLeft.map((count) => count ?? texts.impossible);
      rows.push([texts.conflictsLeft, ...counts]);
    }
    if (decision.completionSums) {
      const sums = decision.completionSums.map((sum) =>
        sum === null ? texts.noWay : this.time(sum),
      );
      rows.push([texts.completionSums, ...sums]);
    }
    return rows;
  }

  /**
   * A decision, why it was taken, and its figures: "Conflicts left: 2 if R1 waits, 5 if R2 waits."
   *
   * @param {DecisionData} decision
   */
  explained(decision) {
    const [one, other] = decision.robots.map((robot) => this.robot(robot));
    const figures = this.figures(decision).map(([label, ifOne, ifOther]) =>
      texts.ifEitherWaits(String(label), one, ifOne, other, ifOther),
    );
    return [this.decisionAtLength(decision), this.reason(decision), ...figures].join(" ");
  }
}
