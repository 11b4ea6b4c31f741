import { figure, texts } from "./language.js";
import { BROKEN } from "../plan/phases.js";

/** @import { Site } from "../plan/site.js" */
/** @import { Robot } from "../plan/robot.js" */

/**
 * "R1, R2 and R3"; the first few of many.
 *
 * @param {string[]} names
 */
export function several(names) {
  const few =
    names.length > 4 ? [...names.slice(0, 3), texts.more({ count: names.length - 3 })] : names;
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

/** Names, times and lengths as people write them, and what depends on the moment that is shown. */
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
    const text = this.plan.places.get(vertex);
    return text === undefined
      ? this.where(vertex)
      : this.#numbered(this.plan.phrases.said(text), vertex);
  }

  /**
   * A time where there is little room: "6 min 23 s"; a bare number where no unit is known.
   *
   * @param {number | string} ticks
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
    return `${percent && percent < 9.95 ? figure(percent.toFixed(1)) : Math.round(percent)} %`;
  }

  /**
   * How far two robots are apart, and how far they have to be: "0.95 m apart, 0.9 m needed".
   *
   * @param {{ distance: number, room: number }} options
   */
  apart({ distance, room }) {
    const { quantities } = this.plan;
    return texts.apart({
      distance: quantities.length(rounded(distance)),
      needed: quantities.length(rounded(room)),
    });
  }

  /**
   * Why a robot never gets on.
   *
   * @param {Robot | null} behind
   */
  stuck(behind) {
    return behind
      ? texts.stuckBehind({ name: behind.name, isBroken: behind.ending === BROKEN })
      : texts.never;
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
    return ticks > 0 ? late({ time: this.time(ticks) }) : early({ time: this.time(-ticks) });
  }
}
