/** Tools for roadmaps: vertices, lanes from one vertex to the next, marks of what a vertex is for. */

import { ring } from "../viewer/shapes.js";
import { words } from "../words.js";
import {
  addLane,
  addVertex,
  freeVertexName,
  nameStation,
  positionOf,
  toggleUse,
} from "./network.js";
import { radiusAt } from "./overlay.js";
import { rounded, toDrawing } from "./places.js";

const ALIGNED = 8; // pixels within which a point keeps to the row or column of a vertex

/** Where on the site a point is: in line with vertices that are near, else at a round length; as it is with Alt. */
export function snapped(point, editor) {
  const { document, roadmap } = editor;
  const there = roadmap.toSite(point.x, point.y);
  if (point.isFree) return there;
  const pixel = roadmap.unit / editor.stage.view.viewport.scale;
  const step = 10 ** Math.floor(Math.log10(24 * pixel));
  const known = Object.values(document.map.roadmap.vertices).map(positionOf);
  return there.map((length, axis) => {
    const near = known.reduce(
      (best, at) => (Math.abs(at[axis] - length) < Math.abs(best - length) ? at[axis] : best),
      Infinity,
    );
    return Math.abs(near - length) < ALIGNED * pixel
      ? near
      : rounded(Math.round(length / step) * step);
  });
}

class PointTool {
  isDrawn = false;
  isBusy = false;
  over = null;

  constructor(editor) {
    this.editor = editor;
  }

  press() {}

  drag(point) {
    this.hover(point);
  }

  hover(point) {
    this.over = point;
  }

  cancel() {
    this.isBusy = false;
  }

  paint(context, theme, scale) {
    const { editor, over } = this;
    if (!over) return;
    const vertex = editor.vertexAt(over);
    context.strokeStyle = theme.ink;
    context.lineWidth = 1.5 / scale;
    const [x, y] =
      vertex >= 0
        ? [editor.roadmap.x[vertex], editor.roadmap.y[vertex]]
        : toDrawing(editor.roadmap, ...snapped(over, editor));
    ring(context, x, y, vertex >= 0 ? radiusAt(editor.roadmap, vertex, scale) : 5 / scale);
  }
}

/** A vertex at a point; with Shift also a lane from the vertex before. */
export class VertexTool extends PointTool {
  static called = "vertex";

  release(point) {
    const { editor } = this;
    if (editor.vertexAt(point) >= 0) return;
    const name = freeVertexName(editor.document);
    const [from] = editor.selection.of("vertex");
    const at = snapped(point, editor);
    editor.store.change((document) => {
      const added = addVertex(document, name, at);
      return point.isMore && from ? addLane(added, from, name, true) : added;
    });
    editor.select([{ kind: "vertex", id: name }]);
  }
}

/** Lanes: press or drag from vertex to vertex; a place without one gets it. With Shift for one way. */
export class LaneTool extends PointTool {
  static called = "lane";
  isDrawn = true;
  from = null; // the name of the vertex that the next lane begins at

  get isBusy() {
    return this.from !== null;
  }

  set isBusy(_) {
    this.from = null;
  }

  press(point) {
    this.began = this.from;
    if (this.from === null) this.from = this.#at(point);
  }

  release(point) {
    const { editor } = this;
    const before = this.from;
    const vertex = editor.vertexAt(point);
    if (before !== null && vertex >= 0 && editor.roadmap.name(vertex) === before) {
      if (this.began === before) this.from = null; // pressed twice: the chain ends
      return editor.say(this.from === null ? "" : words.pressLane);
    }
    const to = this.#at(point);
    editor.store.change((document) => addLane(document, before, to, !point.isMore));
    this.from = to;
    editor.say(words.pressLane);
  }

  /** The vertex at a point, which is made where there is none. */
  #at(point) {
    const { editor } = this;
    const vertex = editor.vertexAt(point);
    if (vertex >= 0) return editor.roadmap.name(vertex);
    const name = freeVertexName(editor.document);
    const at = snapped(point, editor);
    editor.store.change((document) => addVertex(document, name, at));
    return name;
  }

  paint(context, theme, scale) {
    super.paint(context, theme, scale);
    const vertex = this.from === null ? -1 : this.editor.roadmap.vertexNamed(this.from);
    if (vertex < 0 || !this.over) return;
    context.setLineDash([6 / scale, 4 / scale]);
    context.beginPath();
    context.moveTo(this.editor.roadmap.x[vertex], this.editor.roadmap.y[vertex]);
    context.lineTo(this.over.x, this.over.y);
    context.stroke();
    context.setLineDash([]);
  }
}

/** What a vertex is for: a station, with Shift a place to park. */
export class MarkTool extends PointTool {
  static called = "mark";

  release(point) {
    const { editor } = this;
    const vertex = editor.vertexAt(point);
    if (vertex < 0) return editor.say(words.noVertexHere);
    const name = editor.roadmap.name(vertex);
    const stations = Object.entries(editor.document.map.roadmap.stations ?? {});
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
