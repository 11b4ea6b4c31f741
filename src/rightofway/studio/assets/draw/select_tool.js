/** Select, move, copy and delete what is on the map: one thing, several with Shift, all in a box. */

import {
  addRobots,
  changeRobots,
  removeRobots,
  robotsOf,
  stopsOf,
  withStops,
} from "../robots/fleet.js";
import { words } from "../words.js";
import { cellOf, withObstacles } from "./ground.js";
import {
  addLane,
  addVertex,
  asMapping,
  endsOf,
  freeVertexName,
  isNetwork,
  lanesOf,
  moveVertices,
  positionOf,
  removeLanes,
  removeVertices,
} from "./network.js";
import { snapped } from "./network_tools.js";
import { numberOf, placeOf, rounded, vertexOf } from "./places.js";

const STILL = 4; // pixels that a press may move

export class SelectTool {
  static called = "select";
  isDrawn = true;

  constructor(editor) {
    this.editor = editor;
    this.cancel();
  }

  get isBusy() {
    return this.start !== null;
  }

  press(point) {
    const { editor } = this;
    this.start = this.now = point;
    this.hit = editor.hits.at(point, editor.stage.view.viewport.scale);
    this.isMoving = false;
    const { hit } = this;
    if (!hit) return;
    if (point.isMore) editor.selection.toggle(hit);
    else if (!editor.selection.has(hit)) editor.select([hit]);
  }

  drag(point) {
    this.now = point;
    const { scale } = this.editor.stage.view.viewport;
    if (Math.hypot(point.x - this.start.x, point.y - this.start.y) * scale > STILL)
      this.isMoving = true;
  }

  hover() {}

  release(point) {
    if (!this.start) return;
    this.now = point;
    const { editor, hit, isMoving } = this;
    const moved = this.#box();
    if (!hit && isMoving)
      editor.select([
        ...(point.isMore ? editor.selection.items : []),
        ...editor.hits.inside(moved),
      ]);
    else if (!hit && !point.isMore) editor.select([]);
    else if (hit && isMoving) this.#move();
    this.cancel();
  }

  cancel() {
    Object.assign(this, { start: null, now: null, hit: null, isMoving: false });
  }

  /** Take away what is selected; a robot without its only stop goes too. */
  remove() {
    const { editor } = this;
    const { selection } = editor;
    if (!selection.size) return;
    const [robots, stops, vertices, lanes, obstacles] = [
      "robot",
      "stop",
      "vertex",
      "lane",
      "obstacle",
    ].map((kind) => selection.of(kind));
    const cells = selection.of("cell").map(cellOf);
    selection.clear();
    editor.store.change((document) => {
      let next = document;
      if (stops.length) next = withoutStops(next, stops);
      if (robots.length) next = removeRobots(next, robots);
      if (lanes.length) next = removeLanes(next, lanes);
      if (vertices.length) next = removeVertices(next, vertices);
      if (cells.length) next = editor.ground.free(next, cells);
      if (obstacles.length)
        next = withObstacles(
          next,
          next.map.floor.obstacles.filter((_, index) => !obstacles.includes(index)),
        );
      return next;
    });
    editor.select([]);
  }

  /** Copy what is selected beside itself, and select the copies. */
  duplicate() {
    const { editor } = this;
    const { document, selection, roadmap } = editor;
    const copies = [];
    editor.store.change((before) => {
      let next = before;
      const obstacles = next.map.floor?.obstacles ?? [];
      for (const index of selection.of("obstacle")) {
        const side = (editor.ground?.side ?? 1) * roadmap.unit;
        const [x, y, ...size] = obstacles[index].rect.map((length) => numberOf(length));
        copies.push({ kind: "obstacle", id: next.map.floor.obstacles.length });
        next = withObstacles(next, [
          ...next.map.floor.obstacles,
          { ...obstacles[index], rect: [rounded(x + side), rounded(y + side), ...size] },
        ]);
      }
      const cells = selection
        .of("cell")
        .map(cellOf)
        .map(([column, row]) => [column + 1, row + 1]);
      if (cells.length) next = editor.ground.block(next, cells);
      copies.push(...cells.map((cell) => ({ kind: "cell", id: cell.join() })));
      for (const index of selection.of("robot")) {
        const home = this.#freeBeside(editor.hits.robots[index].home, next);
        if (home < 0) continue;
        const { name, ...rest } = robotsOf(document)[index];
        copies.push({ kind: "robot", id: robotsOf(next).length });
        next = addRobots(next, [{ ...rest, home: placeOf(home, roadmap, next) }]);
      }
      return selection.of("vertex").length && isNetwork(next)
        ? this.#copyVertices(next, copies)
        : next;
    });
    editor.select(copies);
  }

  #copyVertices(document, copies) {
    const { editor } = this;
    const { roadmap } = editor;
    const names = new Map();
    let next = document;
    for (const name of editor.selection.of("vertex")) {
      const vertex = roadmap.vertexNamed(name);
      const copy = freeVertexName(next);
      names.set(name, copy);
      copies.push({ kind: "vertex", id: copy });
      next = addVertex(
        next,
        copy,
        roadmap.toSite(roadmap.x[vertex] + 0.5, roadmap.y[vertex] + 0.5),
      );
    }
    for (const lane of lanesOf(document)) {
      const [from, to] = endsOf(lane).map((end) => names.get(end));
      if (from && to) next = addLane(next, from, to, asMapping(lane).both_ways ?? true);
    }
    return next;
  }

  /** The free vertex that is nearest to another one. */
  #freeBeside(vertex, document) {
    const { roadmap } = this.editor;
    const seen = new Set([vertex]);
    const taken = new Set(robotsOf(document).map(({ home }) => vertexOf(home, roadmap)));
    for (const at of seen) {
      if (!taken.has(at)) return at;
      for (const next of roadmap.next(at)) seen.add(next);
    }
    return -1;
  }

  #move() {
    const { editor, start, now } = this;
    const { selection, roadmap } = editor;
    const [robots, stops, vertices, obstacles] = ["robot", "stop", "vertex", "obstacle"].map(
      (kind) => selection.of(kind),
    );
    const shift = [now.x - start.x, now.y - start.y];
    const lost = [];
    const moved = (vertex) => {
      const at = editor.vertexAt({
        x: roadmap.x[vertex] + shift[0],
        y: roadmap.y[vertex] + shift[1],
      });
      if (at < 0) lost.push(vertex);
      return at;
    };
    editor.store.change((document) => {
      let next = document;
      if (robots.length) {
        next = changeRobots(next, robots, (robot, index) => {
          const at = moved(editor.hits.robots[index].home);
          return at < 0 ? robot : { ...robot, home: placeOf(at, roadmap, document) };
        });
      }
      for (const id of stops) {
        const [index, number] = id.split("/").map(Number);
        const at = moved(editor.hits.robots[index].stops[number]);
        if (at < 0) continue;
        next = changeRobots(next, [index], (robot) =>
          withStops(
            robot,
            stopsOf(robot).map((stop, i) =>
              i === number ? { ...stop, at: placeOf(at, roadmap, document) } : stop,
            ),
          ),
        );
      }
      if (vertices.length) next = moveVertices(next, vertices, this.#siteShift());
      if (obstacles.length) next = this.#moveObstacles(next, obstacles, shift);
      return next;
    });
    this.#moveCells(shift);
    if (lost.length) editor.say(words.noVertexHere);
  }

  /** Blocked cells of a grid go by whole cells, and stay selected. */
  #moveCells(shift) {
    const { editor } = this;
    const cells = editor.selection.of("cell").map(cellOf);
    const [right, down] = shift.map(Math.round);
    if (!cells.length || !(right || down)) return;
    const there = cells.map(([column, row]) => [column + right, row + down]);
    editor.store.change((document) =>
      editor.ground.block(editor.ground.free(document, cells), there),
    );
    editor.select([
      ...editor.selection.items.filter(({ kind }) => kind !== "cell"),
      ...there.map((cell) => ({ kind: "cell", id: cell.join() })),
    ]);
  }

  /** How far vertices go on the site, so that the one that was pressed lies in line, or at a round length. */
  #siteShift() {
    const { editor, hit, start, now } = this;
    const { roadmap, document } = editor;
    const isVertex = hit.kind === "vertex";
    const from = isVertex
      ? positionOf(document.map.roadmap.vertices[hit.id])
      : roadmap.toSite(start.x, start.y);
    const to = isVertex ? snapped(now, editor) : roadmap.toSite(now.x, now.y);
    return [to[0] - from[0], to[1] - from[1]];
  }

  #moveObstacles(document, chosen, [right, down]) {
    const { roadmap, ground } = this.editor;
    const [x, y] = [right, down].map(
      (length) => Math.round(length / ground.side) * ground.side * roadmap.unit,
    );
    const up = roadmap.frame.yUp ? -y : y;
    return withObstacles(
      document,
      document.map.floor.obstacles.map((each, index) => {
        if (!chosen.includes(index)) return each;
        const [left, top, ...size] = each.rect.map((length) => numberOf(length));
        return { ...each, rect: [rounded(left + x), rounded(top + up), ...size] };
      }),
    );
  }

  #box() {
    const { start, now } = this;
    return [
      Math.min(start.x, now.x),
      Math.min(start.y, now.y),
      Math.max(start.x, now.x),
      Math.max(start.y, now.y),
    ];
  }

  paint(context, theme, scale) {
    if (!this.start || !this.isMoving) return;
    const { editor } = this;
    context.strokeStyle = theme.ink;
    context.lineWidth = 1.5 / scale;
    context.setLineDash([5 / scale, 4 / scale]);
    if (!this.hit) {
      const [left, top, right, bottom] = this.#box();
      context.strokeRect(left, top, right - left, bottom - top);
    } else {
      const [right, down] = [this.now.x - this.start.x, this.now.y - this.start.y];
      for (const item of editor.selection.items) {
        const vertex = editor.hits.vertexOf(item);
        const [x, y, wide, high] =
          item.kind === "cell"
            ? editor.ground.boxOf(cellOf(item.id))
            : item.kind === "obstacle"
              ? editor.hits.obstacles[item.id]
              : [editor.roadmap.x[vertex] - 0.4, editor.roadmap.y[vertex] - 0.4, 0.8, 0.8];
        context.strokeRect(x + right, y + down, wide, high);
      }
    }
    context.setLineDash([]);
  }
}

/** The document without some stops; a robot that has none left is taken away. */
function withoutStops(document, ids) {
  const gone = new Map();
  for (const id of ids) {
    const [index, number] = id.split("/").map(Number);
    gone.set(index, [...(gone.get(index) ?? []), number]);
  }
  const changed = changeRobots(document, [...gone.keys()], (robot, index) =>
    withStops(
      robot,
      stopsOf(robot).filter((_, number) => !gone.get(index).includes(number)),
    ),
  );
  return removeRobots(
    changed,
    [...gone.keys()].filter((index) => !stopsOf(changed.robots[index]).length),
  );
}
