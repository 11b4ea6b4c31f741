import { lastOf } from "../common/arrays.js";

/** @import { Corridor, Entry } from "../plan/corridor.js" */
/** @import { Area } from "./axis.js" */

const NAME_GAP = 14; // pixels between two names, at least
const SECTION_GAP = 22; // pixels between two sections of a corridor
const TALLEST_FIELD = 24; // pixels
const PAD = TALLEST_FIELD / 2 + 1; // pixels above the upper and below the lower row

/** @typedef {{ vertex: number, y: number, half: number, entry?: Entry, at: number }} Row A place: its middle, half the height of its field, where it is along the line. */

/** Places upwards in a diagram. */
class SpaceAxis {
  /** @param {Omit<Row, "half">[]} places */
  constructor(places) {
    const rows = places.map((place) => ({ ...place, half: 0 }));
    /** @type {Row[]} */
    this.rows = rows;
    /** @type {Map<number, Row[]>} */
    this.byVertex = new Map();
    for (const row of rows) this.byVertex.set(row.vertex, [...this.spots(row.vertex), row]);
    const sorted = [...rows].sort((one, other) => other.y - one.y);
    sorted.forEach((row, i) => {
      const apart = [sorted[i - 1], sorted[i + 1]]
        .filter(Boolean)
        .map((next) => Math.abs(next.y - row.y));
      row.half = Math.min(
        Math.max(Math.min(...apart, TALLEST_FIELD / 0.8) * 0.4, 1),
        TALLEST_FIELD / 2,
      );
    });
  }

  /** Width of a robot's line [pixels]. */
  get line() {
    return Math.min(...this.rows.map(({ half }) => half)) > 4 ? 2.25 : 1.75;
  }

  /**
   * The rows of a vertex: none, one, or several.
   *
   * @param {number} vertex
   */
  spots(vertex) {
    return this.byVertex.get(vertex) ?? [];
  }

  /**
   * The rows to name, none over another: the important ones first.
   *
   * @param {(row: Row, index: number) => boolean} isImportant
   */
  named(isImportant) {
    /** @type {Row[]} */
    const named = [];
    const order = [...this.rows.filter(isImportant), ...this.rows];
    for (const row of order)
      if (named.every(({ y }) => Math.abs(y - row.y) >= NAME_GAP)) named.push(row);
    return named;
  }
}

/** Rows along a corridor, true to scale: a slope is a speed. */
export class CorridorAxis extends SpaceAxis {
  /**
   * @param {Corridor} corridor
   * @param {Area} area
   */
  constructor(corridor, area) {
    const gaps = Math.min(SECTION_GAP * (corridor.sections.length - 1), area.height * 0.4);
    const room = area.height - 2 * PAD - gaps;
    const perSection = gaps / Math.max(corridor.sections.length - 1, 1);
    super(
      corridor.entries.map((entry) => ({
        vertex: entry.vertex,
        y:
          area.bottom -
          PAD -
          (entry.at / (corridor.length || 1)) * room -
          entry.section * perSection,
        at: entry.at,
        entry,
      })),
    );
    this.corridor = corridor;
    this.perLength = room / (corridor.length || 1); // pixels
    this.rowOf = new Map(this.rows.map((row) => [row.entry, row]));
  }

  /**
   * The rows between which a way leads, if it is in the corridor.
   *
   * @param {number} tail
   * @param {number} head
   */
  way(tail, head) {
    const way = this.corridor.way(tail, head);
    const [from, to] = way ? way.map((entry) => this.rowOf.get(entry)) : [];
    return from && to ? { from, to, isTrue: true } : null;
  }
}

/** Rows of all places of a small fleet in one line: at their distances, but never one over another. */
export class LineAxis extends SpaceAxis {
  /**
   * @param {{ vertex: number, at: number }[]} line
   * @param {Area} area
   * @param {(tail: number, head: number) => number} distance
   */
  constructor(line, area, distance) {
    const steps = line.slice(1).map(({ at }, i) => at - line[i].at);
    const room = area.height - 2 * PAD;
    const least = Math.min(NAME_GAP + 2, room / Math.max(steps.length, 1));
    /** @param {number} perLength */
    const total = (perLength) =>
      steps.reduce((sum, step) => sum + Math.max(step * perLength, least), 0);
    const span = line.length ? lastOf(line).at - line[0].at : 0;
    let [low, high] = [0, room / (span || 1)];
    for (let i = 0; i < 40; i++)
      [low, high] =
        total((low + high) / 2) > room ? [low, (low + high) / 2] : [(low + high) / 2, high];
    let y = area.bottom - PAD;
    super(
      line.map(({ vertex, at }, i) => {
        if (i) y -= Math.max(steps[i - 1] * low, least);
        return { vertex, y, at };
      }),
    );
    this.distance = distance;
  }

  /**
   * The rows between which a way leads, and whether the line has them about as far apart as they are.
   *
   * @param {number} tail
   * @param {number} head
   */
  way(tail, head) {
    const [[from], [to]] = [this.spots(tail), this.spots(head)];
    if (!from || !to) return null;
    return { from, to, isTrue: Math.abs(to.at - from.at) < 1.6 * this.distance(tail, head) };
  }
}
