/** Tools for roadmaps: vertices, lanes from one vertex to the next, marks of what a vertex is for. */

import { ring } from "../../../viz/page/assets/drawing/shapes.js";
import { words } from "../words.js";
import {
  addLane,
  addVertex,
  freeVertexName,
  nameStation,
  splitLane,
  toggleUse,
  roadmapOf,
} from "./network.js";
import { radiusAt } from "./overlay.js";
import { toDrawing } from "./places.js";
import { wayText } from "./readout.js";
import { paintGuides, snapped } from "./snapping.js";
import { present } from "../given.js";
/** @import { Theme } from "../../../viz/page/assets/drawing/theme.js" */
/** @import { DrawingPoint, Guide, Point } from "../types.js" */
/** @import { Editor } from "./editor.js" */

class PointTool {
  isDrawn = false;
  /** @type {DrawingPoint | null} */
  over = null;

  /** @param {Editor} editor */
  constructor(editor) {
    this.editor = editor;
  }

  /** @type {(point: DrawingPoint) => void} */
  press() {}

  /**
   * @param {DrawingPoint} point
   * @returns {void}
   */
  drag(point) {
    this.hover(point);
  }

  /**
   * @param {DrawingPoint} point
   * @returns {void}
   */
  hover(point) {
    this.over = point;
  }

  leave() {
    this.over = null;
  }

  /** Whether something has begun. */
  get isBusy() {
    return false;
  }

  cancel() {}

  /**
   * The name of the vertex at a point, or null; those between pieces of a lane have none to draw with.
   * @param {DrawingPoint} point
   * @returns {string | null}
   */
  vertexNameAt(point) {
    const { editor } = this;
    const vertex = editor.vertexAt(point);
    return vertex >= 0 && editor.hits.isWritten(vertex) ? editor.roadmap.name(vertex) : null;
  }

  /**
   * Make a vertex at a point, on the lane that is there or beside all, and return its name.
   * @param {DrawingPoint} point
   * @returns {string}
   */
  make(point) {
    const { editor } = this;
    const name = freeVertexName(editor.document);
    const lane = point.isFree ? null : editor.hits.laneAt(point, editor.stage.view.viewport.scale);
    const { at } = snapped(point, editor);
    editor.store.change((document) =>
      lane ? splitLane(document, lane.index, lane.share, name) : addVertex(document, name, at),
    );
    return name;
  }

  /**
   * Where a vertex would be, in the drawing, and what it would be in line with.
   * @param {DrawingPoint} point
   * @returns {{x: number, y: number, vertex: number, guides: Guide[]}}
   */
  aimed(point) {
    const { editor } = this;
    const { roadmap } = editor;
    const vertex = editor.vertexAt(point);
    if (vertex >= 0) return { x: roadmap.x[vertex], y: roadmap.y[vertex], vertex, guides: [] };
    const lane = point.isFree ? null : editor.hits.laneAt(point, editor.stage.view.viewport.scale);
    if (lane) return { x: lane.x, y: lane.y, vertex, guides: [] };
    const { at, guides } = snapped(point, editor);
    const [x, y] = toDrawing(roadmap, ...at);
    return { x, y, vertex, guides };
  }

  /**
   * @param {CanvasRenderingContext2D} context
   * @param {Theme} theme
   * @param {number} scale
   * @returns {void}
   */
  paint(context, theme, scale) {
    const { editor, over } = this;
    if (!over) return;
    const { x, y, vertex, guides } = this.aimed(over);
    paintGuides(context, editor, guides, scale);
    context.strokeStyle = theme.ink;
    context.lineWidth = 1.5 / scale;
    ring(context, x, y, vertex >= 0 ? radiusAt(editor.roadmap, vertex, scale) : 5 / scale);
  }
}

/** A vertex at a point, on the lane that is there; with Shift also a lane from the vertex before. */
export class VertexTool extends PointTool {
  static called = "vertex";

  /**
   * @param {DrawingPoint} point
   * @returns {void}
   */
  release(point) {
    const { editor } = this;
    if (editor.vertexAt(point) >= 0) return;
    const [from] = editor.selection.of("vertex");
    const name = this.make(point);
    if (point.isMore && from)
      editor.store.change((document) => addLane(document, from, name, true), { isSame: true });
    editor.select([{ kind: "vertex", id: name }]);
  }
}

/** Lanes: press or drag from vertex to vertex; a place without one gets it. With Shift for one way. */
export class LaneTool extends PointTool {
  static called = "lane";
  isDrawn = true;
  /** @type {string | null} */
  began = null; // where the lane before ended when the present press began
  /** @type {string | null} */
  from = null; // the name of the vertex that the next lane begins at

  get isBusy() {
    return this.from !== null;
  }

  cancel() {
    this.from = null;
  }

  /**
   * @param {DrawingPoint} point
   * @returns {void}
   */
  press(point) {
    this.began = this.from;
    if (this.from === null) this.from = this.#at(point);
  }

  /**
   * @param {DrawingPoint} point
   * @returns {void}
   */
  release(point) {
    const { editor } = this;
    const before = this.from;
    if (before !== null && this.vertexNameAt(point) === before) {
      if (this.began === before) this.from = null; // pressed twice: the chain ends
      return editor.say(this.from === null ? "" : words.pressLane);
    }
    const to = this.#at(point);
    if (before !== null)
      editor.store.change((document) => addLane(document, before, to, !point.isMore));
    this.from = to;
    editor.say(words.pressLane);
  }

  /**
   * The vertex at a point, which is made where there is none.
   * @param {DrawingPoint} point
   * @returns {string}
   */
  #at(point) {
    return this.vertexNameAt(point) ?? this.make(point);
  }

  /**
   * Where the lane begins, in the drawing; null while none has begun.
   * @returns {Point | null}
   */
  get #begin() {
    const { editor, from } = this;
    const vertex = from === null ? -1 : editor.roadmap.vertexNamed(from);
    return vertex < 0 || !this.over ? null : [editor.roadmap.x[vertex], editor.roadmap.y[vertex]];
  }

  get measure() {
    const begin = this.#begin;
    if (!begin) return "";
    const { roadmap } = this.editor;
    const { x, y } = this.aimed(present(this.over));
    const [from, to] = [roadmap.toSite(...begin), roadmap.toSite(x, y)];
    return wayText(this.editor, [to[0] - from[0], to[1] - from[1]]);
  }

  /**
   * @param {CanvasRenderingContext2D} context
   * @param {Theme} theme
   * @param {number} scale
   * @returns {void}
   */
  paint(context, theme, scale) {
    super.paint(context, theme, scale);
    const begin = this.#begin;
    if (!begin) return;
    const { x, y } = this.aimed(present(this.over));
    context.setLineDash([6 / scale, 4 / scale]);
    context.beginPath();
    context.moveTo(...begin);
    context.lineTo(x, y);
    context.stroke();
    context.setLineDash([]);
  }
}

/** What a vertex is for: a station, with Shift a place to park. */
export class MarkTool extends PointTool {
  static called = "mark";

  /**
   * @param {DrawingPoint} point
   * @returns {void}
   */
  release(point) {
    const { editor } = this;
    const vertex = editor.vertexAt(point);
    if (vertex < 0) return editor.say(words.noVertexHere);
    const name = editor.roadmap.name(vertex);
    const stations = Object.entries(roadmapOf(editor.document).stations ?? {});
    editor.store.change((document) => {
      if (point.isMore) return toggleUse(document, "parking", name);
      return nameStation(
        document,
        name,
        stations.some(([, at]) => at === name) ? "" : `S${stations.length + 1}`,
      );
    });
    editor.select([{ kind: "vertex", id: name }]);
  }
}
