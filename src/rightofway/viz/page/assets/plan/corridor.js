/** @import { Roadmap } from "./roadmap.js" */

/**
 * A place on the axis, and what is beside it.
 *
 * @typedef {object} Entry
 * @property {number} vertex
 * @property {number} at
 * @property {Entry | null} up
 * @property {Entry | null} down
 * @property {number} section
 */

/**
 * A distance axis along a route: every way of the route is on it once, at its true length. A way
 * back is the way there; a loop ends where it began, and so that place is at both ends; a branch
 * begins a new section. An entry is { vertex, at, up, down, section }.
 */
export class Corridor {
  /** @type {Map<number, Entry[]>} */
  #spots = new Map();

  /**
   * @param {Roadmap} roadmap
   * @param {ArrayLike<number>} route
   */
  constructor(roadmap, route) {
    this.roadmap = roadmap;
    /** @type {Entry[][]} */
    this.sections = [];
    let entry = this.#begin(route[0]);
    for (const vertex of Array.from(route).slice(1))
      if (vertex !== entry.vertex) entry = this.#walk(entry, vertex);
    let at = 0;
    for (const section of this.sections) {
      const lowest = section[0].at;
      for (const it of section) it.at += at - lowest;
      at = section[section.length - 1].at;
    }
    this.length = at; // of all sections
  }

  get entries() {
    return this.sections.flat();
  }

  /**
   * Where a vertex is on the axis: nowhere, once, or at several places.
   *
   * @param {number} vertex
   */
  spots(vertex) {
    return this.#spots.get(vertex) ?? [];
  }

  /**
   * Where the way between two vertices is on the axis: two entries side by side, or null.
   *
   * @param {number} tail
   * @param {number} head
   * @returns {[Entry, Entry] | null}
   */
  way(tail, head) {
    for (const entry of this.spots(tail)) {
      if (entry.up?.vertex === head) return [entry, entry.up];
      if (entry.down?.vertex === head) return [entry, entry.down];
    }
    return null;
  }

  /** @param {number} vertex */
  #begin(vertex) {
    /** @type {Entry[]} */
    const section = [];
    this.sections.push(section);
    return this.#add({ vertex, at: 0, up: null, down: null, section: this.sections.length - 1 });
  }

  /** @param {Entry} entry */
  #add(entry) {
    const section = this.sections[entry.section];
    if (entry.up) section.unshift(entry);
    else section.push(entry);
    this.#spots.set(entry.vertex, [...this.spots(entry.vertex), entry]);
    return entry;
  }

  /**
   * The entry of the next vertex of the route.
   *
   * @param {Entry} entry
   * @param {number} vertex
   * @returns {Entry}
   */
  #walk(entry, vertex) {
    const known = this.way(entry.vertex, vertex);
    if (known) return known[1];
    const free = [entry, ...this.spots(entry.vertex)].find(({ up, down }) => !up || !down);
    const from = free ?? this.#begin(entry.vertex);
    const length = this.roadmap.distance(from.vertex, vertex);
    const { section } = from;
    if (!from.up)
      return (from.up = this.#add({ vertex, at: from.at + length, up: null, down: from, section }));
    return (from.down = this.#add({ vertex, at: from.at - length, up: from, down: null, section }));
  }
}

/**
 * The shortest way from a place to another as vertices; the way back where only that can be driven.
 *
 * @param {Roadmap} roadmap
 * @param {number} from
 * @param {number} to
 */
export function shortestWay(roadmap, from, to) {
  return searchWay(roadmap, from, to) ?? searchWay(roadmap, to, from)?.reverse() ?? null;
}

/**
 * @param {Roadmap} roadmap
 * @param {number} from
 * @param {number} to
 * @returns {number[] | null}
 */
function searchWay(roadmap, from, to) {
  const lengths = new Float64Array(roadmap.size).fill(Infinity);
  const before = new Int32Array(roadmap.size).fill(-1);
  lengths[from] = 0;
  const queue = [from];
  for (let i = 0; i < queue.length; i++) {
    const tail = queue[i];
    for (const head of roadmap.next(tail)) {
      const length = lengths[tail] + roadmap.distance(tail, head);
      if (length >= lengths[head] - 1e-9) continue;
      lengths[head] = length;
      before[head] = tail;
      queue.push(head);
    }
  }
  if (lengths[to] === Infinity) return null;
  const way = [to];
  while (way[0] !== from) way.unshift(before[way[0]]);
  return way;
}
