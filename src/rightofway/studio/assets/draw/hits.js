/** What is where on the map, by the document: robots' homes and stops, obstacles, vertices, lanes. */

import { robotsOf, stopsOf } from "../robots/fleet.js";
import { nearest } from "../viewer/arrays.js";
import { cellsOfBox, groundOf } from "./ground.js";
import { endsOf, isNetwork, lanesOf } from "./network.js";
import { numberOf, toDrawing, vertexOf } from "./places.js";

const REACH = 12; // pixels round a point that is small

export class Hits {
  constructor(document, roadmap) {
    Object.assign(this, { document, roadmap });
    this.ground = document.map.grid ? groundOf(document, roadmap) : null; // whose blocked cells are things of their own
    this.robots = (robotsOf(document) ?? []).map((robot, index) => ({
      index,
      robot,
      home: vertexOf(robot.home, roadmap),
      stops: stopsOf(robot).map(({ at }) => vertexOf(at, roadmap)),
    }));
    this.obstacles = (document.map.floor?.obstacles ?? []).map(({ rect }) => boxOf(rect, roadmap));
    this.lanes = isNetwork(document)
      ? lanesOf(document).map((lane) => endsOf(lane).map((name) => roadmap.vertexNamed(name)))
      : [];
  }

  vertexAt(x, y, scale) {
    const { roadmap } = this;
    return roadmap.hasCells
      ? roadmap.near(x, y)
      : nearest(roadmap.x, roadmap.y, x, y, Math.max(0.3, REACH / scale));
  }

  /** What is at a point: the robot or stop, the vertex, the lane, the obstacle, in this order; or null. */
  at({ x, y }, scale) {
    const vertex = this.vertexAt(x, y, scale);
    if (vertex >= 0) {
      const standing = this.robots.find(({ home }) => home === vertex);
      if (standing) return { kind: "robot", id: standing.index };
      const going = this.robots.find(({ stops }) => stops.includes(vertex));
      if (going) return { kind: "stop", id: `${going.index}/${going.stops.indexOf(vertex)}` };
      if (isNetwork(this.document)) return { kind: "vertex", id: this.roadmap.name(vertex) };
    }
    const lane = this.lanes.findIndex((ends) => this.#distance(ends, x, y) < REACH / scale);
    if (lane >= 0) return { kind: "lane", id: lane };
    const obstacle = this.obstacles.findLastIndex(
      ([left, top, width, height]) =>
        x >= left && y >= top && x <= left + width && y <= top + height,
    );
    if (obstacle >= 0) return { kind: "obstacle", id: obstacle };
    const cell = this.ground?.cellAt(x, y);
    return cell && this.ground.holds(cell) && this.ground.isBlocked(this.document, cell)
      ? { kind: "cell", id: cell.join() }
      : null;
  }

  /** All that lies in a rectangle of the drawing. */
  inside([left, top, right, bottom]) {
    const { x, y } = this.roadmap;
    const isIn = (vertex) =>
      vertex >= 0 &&
      x[vertex] >= left &&
      x[vertex] <= right &&
      y[vertex] >= top &&
      y[vertex] <= bottom;
    const names = isNetwork(this.document)
      ? Array.from(x.keys())
          .filter(isIn)
          .map((vertex) => ({ kind: "vertex", id: this.roadmap.name(vertex) }))
      : [];
    return [
      ...this.robots
        .filter(({ home }) => isIn(home))
        .map(({ index }) => ({ kind: "robot", id: index })),
      ...names,
      ...this.lanes.flatMap((ends, id) => (ends.every(isIn) ? [{ kind: "lane", id }] : [])),
      ...this.obstacles.flatMap(([l, t, w, h], id) =>
        l >= left && t >= top && l + w <= right && t + h <= bottom
          ? [{ kind: "obstacle", id }]
          : [],
      ),
      ...this.#blockedIn(left, top, right, bottom),
    ];
  }

  /** The blocked cells of a grid whose middle lies in a rectangle. */
  #blockedIn(left, top, right, bottom) {
    if (!this.ground) return [];
    const [from, to] = [
      [Math.max(Math.ceil(left), 0), Math.max(Math.ceil(top), 0)],
      [
        Math.min(Math.floor(right), this.ground.columns - 1),
        Math.min(Math.floor(bottom), this.ground.rows - 1),
      ],
    ];
    if (from[0] > to[0] || from[1] > to[1]) return [];
    return this.ground
      .blockedOf(this.document, cellsOfBox(from, to))
      .map((cell) => ({ kind: "cell", id: cell.join() }));
  }

  /** The vertex of what is selected, or -1. */
  vertexOf({ kind, id }) {
    if (kind === "robot") return this.robots[id]?.home ?? -1;
    if (kind === "vertex") return this.roadmap.vertexNamed(id);
    if (kind !== "stop") return -1;
    const [robot, stop] = id.split("/").map(Number);
    return this.robots[robot]?.stops[stop] ?? -1;
  }

  namesAt(vertex) {
    return this.robots
      .filter(({ home, stops }) => home === vertex || stops.includes(vertex))
      .map(({ robot }) => robot.name);
  }

  #distance([tail, head], px, py) {
    const { x, y } = this.roadmap;
    if (tail < 0 || head < 0) return Infinity;
    const [right, down] = [x[head] - x[tail], y[head] - y[tail]];
    const along =
      ((px - x[tail]) * right + (py - y[tail]) * down) / (right * right + down * down || 1);
    const share = Math.min(Math.max(along, 0), 1);
    return Math.hypot(px - x[tail] - right * share, py - y[tail] - down * share);
  }
}

/** A rectangle of a floor, in the drawing: left, top, width, height. */
function boxOf(rect, roadmap) {
  const [x, y, width, height] = rect.map((length) => numberOf(length));
  const [one, other] = [toDrawing(roadmap, x, y), toDrawing(roadmap, x + width, y + height)];
  return [
    Math.min(one[0], other[0]),
    Math.min(one[1], other[1]),
    Math.abs(one[0] - other[0]),
    Math.abs(one[1] - other[1]),
  ];
}
