/** Select, move, copy and delete what is on the map: one thing, several with Shift, all in a box. */

import { changeRobots, removeRobots, robotsOf, stopsOf, withStops } from "../robots/fleet.js";
import { removeRows } from "../robots/rows.js";
import { ring } from "../../../viz/page/assets/drawing/shapes.js";
import { words } from "../words.js";
import { arranged, boundsOf, movedCells, turnOf } from "./arrange.js";
import { cellOf, obstaclesOf, withObstacles } from "./ground.js";
import { Handles } from "./handles.js";
import { positionOf, removeLanes, removeVertices, roadmapOf } from "./network.js";
import { radiusAt } from "./overlay.js";
import { isEmpty, middleOf, pieceOf, withPiece } from "./piece.js";
import { toDrawing } from "./places.js";
import { lengthText, wayText } from "./readout.js";
import { blockShift, paintGuides, roundStep, snapped } from "./snapping.js";
import { present } from "../given.js";
/** @import { Theme } from "../../../viz/page/assets/drawing/theme.js" */
/** @import { DrawingPoint, Item, Piece, Point, PointMap, Rect, ScenarioDocument, Shift, Turn } from "../types.js" */
/** @import { Editor } from "./editor.js" */

const STILL = 4; // pixels that a press may move
const FAR = 5; // steps that arrow keys go with Shift

export class SelectTool {
  static called = "select";
  isDrawn = true;
  /** @type {DrawingPoint | null} */
  start = null; // where the pointer was pressed
  /** @type {DrawingPoint | null} */
  now = null; // and where it is
  /** @type {Item | null} */
  hit = null; // what it was pressed at
  isMoving = false;
  isBending = false; // whether a handle of a lane is dragged

  /** @param {Editor} editor */
  constructor(editor) {
    this.editor = editor;
    this.handles = new Handles(editor);
  }

  get isBusy() {
    return this.start !== null;
  }

  /**
   * @param {DrawingPoint} point
   * @returns {void}
   */
  press(point) {
    const { editor } = this;
    this.start = this.now = point;
    this.isMoving = false;
    this.isBending = this.handles.take(point);
    this.hit = this.isBending ? null : editor.hits.at(point, editor.stage.view.viewport.scale);
    const { hit } = this;
    if (hit && !point.isMore && !editor.selection.has(hit)) editor.select([hit]);
  }

  /**
   * @param {DrawingPoint} point
   * @returns {void}
   */
  drag(point) {
    this.now = point;
    if (this.isBending) return this.handles.drag(point);
    const { editor, hit } = this;
    const start = present(this.start);
    const { scale } = editor.stage.view.viewport;
    if (this.isMoving || Math.hypot(point.x - start.x, point.y - start.y) * scale <= STILL) return;
    this.isMoving = true;
    if (hit && !editor.selection.has(hit)) editor.select([...editor.selection.items, hit]);
  }

  hover() {}

  /**
   * @param {DrawingPoint} point
   * @returns {void}
   */
  release(point) {
    if (!this.start) return;
    this.now = point;
    const { editor, hit, isMoving, start } = this;
    if (this.isBending) this.handles.release();
    else if (!hit && isMoving)
      editor.select([
        ...(start.isMore ? editor.selection.items : []),
        ...editor.hits.inside(this.#box()),
      ]);
    else if (!hit && !start.isMore) editor.select([]);
    else if (hit && isMoving && point.isCopy) this.#put(pieceOf(editor), this.#shift().shift);
    else if (hit && isMoving) this.#move(this.#shift().shift);
    else if (hit && start.isMore) {
      editor.selection.toggle(hit);
      editor.select(editor.selection.items);
    }
    this.cancel();
  }

  cancel() {
    this.handles.cancel();
    this.start = this.now = this.hit = null;
    this.isMoving = this.isBending = false;
  }

  /** Take away what is selected; a robot without its only stop goes too. */
  remove() {
    const { editor } = this;
    const { selection } = editor;
    if (!selection.size) return;
    const [robots, stops] = [selection.of("robot"), selection.of("stop")];
    const [vertices, lanes] = [selection.of("vertex"), selection.of("lane")];
    const [obstacles, jobs] = [selection.of("obstacle"), selection.of("job")];
    const cells = selection.of("cell").map(cellOf);
    selection.clear();
    editor.store.change((document) => {
      let next = document;
      if (stops.length) next = withoutStops(next, stops);
      if (robots.length) next = removeRobots(next, robots);
      if (jobs.length) next = removeRows(next, "jobs", jobs);
      if (lanes.length) next = removeLanes(next, lanes);
      if (vertices.length) next = removeVertices(next, vertices);
      if (cells.length) next = present(editor.ground).free(next, cells);
      if (obstacles.length)
        next = withObstacles(
          next,
          obstaclesOf(next).filter((_, index) => !obstacles.includes(index)),
        );
      return next;
    });
    editor.select([]);
  }

  /** Copy what is selected beside itself, and select the copies. */
  duplicate() {
    const { editor } = this;
    const side = editor.ground?.side ?? 0.5;
    this.#put(pieceOf(editor), this.#onSite([side, side]));
  }

  /**
   * Put a piece of a drawing below the pointer, or beside where it was taken, and select it.
   * @param {Piece} piece
   * @param {DrawingPoint | null} [over]
   * @returns {void}
   */
  paste(piece, over = this.editor.over) {
    const { editor } = this;
    const { roadmap, ground } = editor;
    const side = ground?.side ?? 0.5;
    const middle = middleOf(piece);
    const wanted = over
      ? roadmap.toSite(over.x, over.y).map((length, axis) => length - middle[axis])
      : this.#onSite([side, side]);
    const step = ground ? side * roadmap.unit : roundStep(editor);
    this.#put(
      piece,
      wanted.map((length) => Math.round(length / step) * step),
    );
  }

  /**
   * @param {Piece} piece
   * @param {Point} shift
   * @returns {void}
   */
  #put(piece, shift) {
    const { editor } = this;
    if (isEmpty(piece)) return;
    /** @type {Item[]} */
    let items = [];
    editor.store.change((document) => {
      const found = withPiece(editor, document, piece, shift);
      ({ items } = found);
      return found.document;
    });
    editor.select(items);
    if (!items.length) editor.say(words.noRoomHere);
  }

  /**
   * Turn what is selected to the right, or mirror it.
   * @param {Turn} kind
   * @returns {void}
   */
  turn(kind) {
    if (boundsOf(this.editor)) this.#arrange(turnOf(this.editor, kind));
  }

  /**
   * Let arrow keys move what is selected by one step, or by several.
   * @param {Point} way
   * @param {boolean} isFar
   * @returns {void}
   */
  nudge([right, down], isFar) {
    const { editor } = this;
    const step = editor.ground?.side ?? roundStep(editor) / editor.roadmap.unit;
    const far = isFar ? FAR : 1;
    this.#move(this.#onSite([right * step * far, down * step * far]));
  }

  /**
   * Put the vertices that are selected into one row, or one column: that of their middle.
   * @param {number} axis
   * @returns {void}
   */
  align(axis) {
    const { editor } = this;
    const [x, y, width, height] = present(boundsOf(editor));
    const middle = [x + width / 2, y + height / 2];
    const step = roundStep(editor);
    const to = Math.round(middle[axis] / step) * step;
    this.#arrange((at) => at.map((length, each) => (each === axis ? to : length)));
  }

  /**
   * @param {Point} shift
   * @returns {void}
   */
  #move(shift) {
    if (shift.some(Boolean)) this.#arrange((at) => at.map((length, axis) => length + shift[axis]));
  }

  /**
   * @param {PointMap} map
   * @returns {void}
   */
  #arrange(map) {
    const { editor } = this;
    /** @type {number[]} */
    const lost = [];
    const cells = movedCells(editor, map);
    editor.store.change((document) => arranged(editor, document, map, lost));
    if (cells.length)
      editor.select([
        ...editor.selection.items.filter(({ kind }) => kind !== "cell"),
        ...cells.map((cell) => /** @type {Item} */ ({ kind: "cell", id: cell.join() })),
      ]);
    if (lost.length) editor.say(words.noVertexHere);
  }

  /**
   * A way in the drawing as one on the site.
   * @param {Point} way
   * @returns {Point}
   */
  #onSite([right, down]) {
    const { roadmap } = this.editor;
    const [from, to] = [roadmap.toSite(0, 0), roadmap.toSite(right, down)];
    return [to[0] - from[0], to[1] - from[1]];
  }

  /**
   * How far what is selected goes on the site, and what it is in line with then.
   * @returns {Shift}
   */
  #shift() {
    const { editor, hit } = this;
    const [start, now] = [present(this.start), present(this.now)];
    const { document, selection } = editor;
    /** @type {Point} */
    const way = [now.x - start.x, now.y - start.y];
    if (now.isMore) way[Math.abs(way[0]) < Math.abs(way[1]) ? 0 : 1] = 0;
    const point = { ...now, x: start.x + way[0], y: start.y + way[1] };
    const raw = this.#onSite(way);
    if (selection.of("vertex").length || selection.of("lane").length) {
      if (hit?.kind !== "vertex") return this.#rounded(raw, now);
      const from = positionOf(roadmapOf(document).vertices[hit.id]);
      const { at, guides } = snapped(point, editor, selection.of("vertex"));
      const kept = now.isMore ? (way[0] ? 0 : 1) : null; // the only axis along which it goes
      const shift = at.map((length, axis) =>
        kept === null || kept === axis ? length - from[axis] : 0,
      );
      return { shift, guides };
    }
    const obstacles = selection.of("obstacle");
    if (!obstacles.length && !selection.of("cell").length) return { shift: raw, guides: [] };
    const isFree = now.isFree && Boolean(document.map.floor);
    return blockShift(editor, present(boundsOf(editor)), raw, isFree, obstacles);
  }

  /**
   * @param {Point} raw
   * @param {DrawingPoint} point
   * @returns {Shift}
   */
  #rounded(raw, { isFree }) {
    const step = roundStep(this.editor);
    const shift = isFree ? raw : raw.map((length) => Math.round(length / step) * step);
    return { shift, guides: [] };
  }

  /** @returns {Rect} */
  #box() {
    const [start, now] = [present(this.start), present(this.now)];
    return [
      Math.min(start.x, now.x),
      Math.min(start.y, now.y),
      Math.max(start.x, now.x),
      Math.max(start.y, now.y),
    ];
  }

  /** What stands at the pointer while something is dragged. */
  get measure() {
    const { editor, start, now } = this;
    if (!start || !now || !this.isMoving) return "";
    if (this.hit) return wayText(editor, this.#shift().shift);
    const { unit } = editor.roadmap;
    const sides = [Math.abs(now.x - start.x) * unit, Math.abs(now.y - start.y) * unit];
    return sides.map((length) => lengthText(editor, length)).join(" × ");
  }

  /**
   * @param {CanvasRenderingContext2D} context
   * @param {Theme} theme
   * @param {number} scale
   * @returns {void}
   */
  paint(context, theme, scale) {
    this.handles.paint(context, theme, scale);
    if (!this.start || !this.isMoving) return;
    const { editor } = this;
    context.strokeStyle = theme.ink;
    context.lineWidth = 1.5 / scale;
    context.setLineDash([5 / scale, 4 / scale]);
    if (!this.hit) {
      const [left, top, right, bottom] = this.#box();
      context.strokeRect(left, top, right - left, bottom - top);
      context.setLineDash([]);
      return;
    }
    const { shift, guides } = this.#shift();
    const [zero, there] = [toDrawing(editor.roadmap, 0, 0), toDrawing(editor.roadmap, ...shift)];
    this.#ghosts(context, [there[0] - zero[0], there[1] - zero[1]]);
    context.setLineDash([]);
    paintGuides(context, editor, guides, scale);
  }

  /**
   * Frames of what is selected where it would come to lie.
   * @param {CanvasRenderingContext2D} context
   * @param {Point} way
   * @returns {void}
   */
  #ghosts(context, [right, down]) {
    const { selection, hits, roadmap, ground, stage } = this.editor;
    const { scale } = stage.view.viewport;
    for (const item of selection.items) {
      const { kind, id } = item;
      if (kind === "lane") continue;
      const vertex = hits.vertexOf(item);
      if (kind !== "cell" && kind !== "obstacle" && vertex < 0) continue;
      if (vertex >= 0 && !roadmap.hasCells) {
        const radius = radiusAt(roadmap, vertex, scale);
        ring(context, roadmap.x[vertex] + right, roadmap.y[vertex] + down, radius);
        continue;
      }
      const [x, y, wide, high] =
        kind === "cell"
          ? present(ground).boxOf(cellOf(id))
          : kind === "obstacle"
            ? hits.obstacles[id]
            : [roadmap.x[vertex] - 0.4, roadmap.y[vertex] - 0.4, 0.8, 0.8];
      context.strokeRect(x + right, y + down, wide, high);
    }
  }
}

/**
 * The document without some stops; a robot that has none left is taken away.
 * @param {ScenarioDocument} document
 * @param {string[]} ids
 * @returns {ScenarioDocument}
 */
function withoutStops(document, ids) {
  /** @type {Map<number, number[]>} */
  const gone = new Map();
  for (const id of ids) {
    const [index, number] = id.split("/").map(Number);
    gone.set(index, [...(gone.get(index) ?? []), number]);
  }
  const changed = changeRobots(document, [...gone.keys()], (robot, index) =>
    withStops(
      robot,
      stopsOf(robot).filter((_, number) => !gone.get(index)?.includes(number)),
    ),
  );
  return removeRobots(
    changed,
    [...gone.keys()].filter((index) => !stopsOf((robotsOf(changed) ?? [])[index]).length),
  );
}
