/** Robots by two presses: the home, and the place to work at; with Shift more places before the last one. */

import { placeOf } from "../draw/places.js";
import { paintTrip, radiusAt } from "../draw/overlay.js";
import { ring } from "../../../viz/page/assets/drawing/shapes.js";
import { words } from "../words.js";
import { addRobots, robotsOf, withStops, writtenIn } from "./fleet.js";
/** @import { Theme } from "../../../viz/page/assets/drawing/theme.js" */
/** @import { Editor } from "../draw/editor.js" */
/** @import { DrawingPoint, Place, Point } from "../types.js" */

export class RobotTool {
  static called = "robot";
  isDrawn = false;

  /** @param {Editor} editor */
  constructor(editor) {
    this.editor = editor;
    this.home = -1;
    /** @type {number[]} */
    this.stops = [];
    this.over = -1;
  }

  get isBusy() {
    return this.home >= 0;
  }

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
    this.over = this.editor.vertexAt(point);
  }

  leave() {
    this.over = -1;
  }

  /**
   * @param {DrawingPoint} point
   * @returns {void}
   */
  release(point) {
    const { editor } = this;
    const vertex = editor.vertexAt(point);
    if (vertex < 0) return editor.say(words.noVertexHere);
    if (!robotsOf(editor.document)) return editor.say(words.robotsElsewhere);
    if (this.home < 0) {
      if (editor.hits.robots.some(({ home }) => home === vertex))
        return editor.say(words.homeTaken);
      this.home = vertex;
      return editor.say(words.pressStop);
    }
    this.stops.push(vertex);
    if (point.isMore) return editor.say(words.pressMore);
    return this.#add();
  }

  #add() {
    const { editor, home, stops } = this;
    /**
     * @param {number} vertex
     * @returns {Place}
     */
    const place = (vertex) => placeOf(vertex, editor.roadmap, editor.document);
    const robots = writtenIn(editor.document);
    const { work } = robots.at(-1) ?? {}; // as long as the one before; the first one not at all, as in a file
    const trip = stops.map((stop) =>
      work === undefined ? { at: place(stop) } : { at: place(stop), work },
    );
    this.cancel();
    editor.store.change((document) =>
      addRobots(document, [withStops({ home: place(home) }, trip)]),
    );
    editor.select([{ kind: "robot", id: robots.length }]);
    editor.say(words.pressHome);
  }

  cancel() {
    this.home = -1;
    this.stops = [];
  }

  /**
   * @param {CanvasRenderingContext2D} context
   * @param {Theme} theme
   * @param {number} scale
   * @returns {void}
   */
  paint(context, theme, scale) {
    const { roadmap } = this.editor;
    /** @type {(vertex: number) => Point} */
    const at = (vertex) => [roadmap.x[vertex], roadmap.y[vertex]];
    context.strokeStyle = theme.ink;
    context.lineWidth = 2 / scale;
    if (this.home >= 0) {
      const places = [this.home, ...this.stops, ...(this.over >= 0 ? [this.over] : [])];
      paintTrip(context, this.editor, scale, places.map(at));
    }
    if (this.over >= 0) ring(context, ...at(this.over), radiusAt(roadmap, this.over, scale) * 0.8);
  }
}
