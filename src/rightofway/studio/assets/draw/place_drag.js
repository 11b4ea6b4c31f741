/** Home and stops of the robot that is chosen on a plan, dragged to other places of the map. */

import { changeRobots, robotsOf, withKey, withStopAt } from "../robots/fleet.js";
import { ring } from "../../../viz/page/assets/drawing/shapes.js";
import { words } from "../words.js";
import { paintTrip, radiusAt } from "./overlay.js";
import { placeOf, rounded } from "./places.js";
import { paintReadout } from "./readout.js";
import { present } from "../given.js";
/** @import { Edit, Place, Point, PointedAt, RobotHit } from "../types.js" */
/** @import { Editor } from "./editor.js" */

const STILL = 4; // pixels that a press may move
const TOUCH = 24; // pixels round a place that a finger reaches

export class PlaceDrag {
  /** @type {{number: number, vertex: number} | null} */
  #over = null; // what the pointer is at: { number, vertex }; the number of a stop, or -1: home
  /** @type {{number: number, vertex: number, robot: number, from: {x: number, y: number}} | null} */
  #held = null; // what is dragged, the same; `robot` is its index, `from` where the press was
  /** @type {PointedAt | null} */
  #to = null; // where it is dragged to, in units of the drawing; null before it has moved
  #isAsking = false; // whether the library looks at where it was dropped

  /**
   * `ask` takes an edit of the document, and resolves when it is made or refused.
   * @param {Editor} editor
   * @param {(edit: Edit) => Promise<void>} ask
   */
  constructor(editor, ask) {
    this.editor = editor;
    this.stage = editor.stage;
    this.ask = ask;
    const { holder } = this.stage;
    /**
     * @template {keyof HTMLElementEventMap} Name
     * @param {Name} name
     * @param {(event: HTMLElementEventMap[Name]) => unknown} action
     * @returns {void}
     */
    const on = (name, action) => holder.addEventListener(name, action, true);
    on("pointerdown", (event) => this.#down(event));
    on("pointermove", (event) => this.#move(event));
    on("pointerup", (event) => this.#up(event));
    on("pointercancel", (event) => event.isTrusted && this.#end());
    on("pointerleave", () => this.#hover(null));
    document.addEventListener("keydown", (event) => this.#key(event), true);
    this.stage.on("overlay", () => this.#paint());
  }

  /**
   * The chosen robot as the document has it: index, home, stops; null where nothing can be asked.
   * @returns {RobotHit | null}
   */
  get #robot() {
    const { editor, stage } = this;
    if (editor.isOn || !stage.isPlan || !stage.choice.robot) return null;
    const { name } = stage.choice.robot;
    const index = (robotsOf(editor.document) ?? []).findIndex((robot) => robot.name === name);
    return editor.hits.robots[index] ?? null;
  }

  /**
   * Where an event is on the map, in units of the drawing and [pixels].
   * @param {MouseEvent} event
   * @returns {PointedAt}
   */
  #point({ clientX, clientY }) {
    const { left, top } = this.stage.holder.getBoundingClientRect();
    const { viewport } = this.stage.view;
    const screen = { x: clientX - left, y: clientY - top };
    return { x: viewport.toX(screen.x), y: viewport.toY(screen.y), screen };
  }

  /**
   * The home or the stop of the robot that an event is at; null for none.
   * @param {PointerEvent} event
   * @returns {{number: number, vertex: number} | null}
   */
  #at(event) {
    const robot = this.#robot;
    if (!robot || this.stage.isPicking) return null;
    const { roadmap, stage } = this.editor;
    const { scale } = stage.view.viewport;
    const point = this.#point(event);
    const least = event.pointerType === "touch" ? TOUCH / scale : 0;
    const number = [robot.home, ...robot.stops].findIndex(
      (vertex) =>
        vertex >= 0 &&
        Math.hypot(roadmap.x[vertex] - point.x, roadmap.y[vertex] - point.y) <=
          Math.max(radiusAt(roadmap, vertex, scale), least),
    );
    if (number < 0) return null;
    return { number: number - 1, vertex: number ? robot.stops[number - 1] : robot.home };
  }

  /**
   * @param {PointerEvent} event
   * @returns {void}
   */
  #down(event) {
    if (event.button !== 0 || this.#isAsking) return;
    if (this.#held) return this.#end(); // two fingers move the map
    /**
     * @param {number} vertex
     * @returns {Point}
     */
    const at = this.#at(event);
    if (at)
      this.#held = { ...at, robot: present(this.#robot).index, from: this.#point(event).screen };
  }

  /**
   * @param {PointerEvent} event
   * @returns {void}
   */
  #move(event) {
    if (this.#isAsking) return;
    if (!this.#held) return event.buttons ? undefined : this.#hover(this.#at(event));
    event.stopPropagation(); // the map stays where it is
    this.#follow(event);
  }

  /**
   * Drag to where an event is, once that is not where the press was.
   * @param {PointerEvent} event
   * @returns {void}
   */
  #follow(event) {
    const point = this.#point(event);
    if (!this.#to) {
      const { from } = present(this.#held);
      if (Math.hypot(point.screen.x - from.x, point.screen.y - from.y) <= STILL) return;
      this.stage.giveUp(event);
      this.stage.holder.setPointerCapture(event.pointerId); // another plan may be shown meanwhile
    }
    this.#to = point;
    this.#show();
  }

  /**
   * @param {PointerEvent} event
   * @returns {Promise<void>}
   */
  async #up(event) {
    if (!this.#held || this.#isAsking) return;
    this.#follow(event);
    if (!this.#to) return void (this.#held = null); // a press, for the map
    event.stopPropagation();
    const { robot, number, vertex } = this.#held;
    const place = this.#place(this.#to);
    this.#isAsking = true;
    if (this.editor.vertexAt(this.#to) !== vertex)
      await this.ask((document) =>
        changeRobots(document, [robot], (each) =>
          number < 0 ? withKey(each, "home", place) : withStopAt(each, number, place),
        ),
      );
    this.#isAsking = false;
    this.#end();
  }

  /**
   * How the document names a place; one without a vertex too, so that the library says why not.
   * @param {{x: number, y: number}} point
   * @returns {Place}
   */
  #place({ x, y }) {
    const { roadmap, document } = this.editor;
    const vertex = this.editor.vertexAt({ x, y });
    if (vertex >= 0) return placeOf(vertex, roadmap, document);
    /** @type {Point} */
    const cell = roadmap.rows ? [Math.round(x), Math.round(y)] : [x, y];
    const [right, up] = roadmap.toSite(...cell).map(rounded);
    return { x: right, y: up };
  }

  /**
   * @param {KeyboardEvent} event
   * @returns {void}
   */
  #key(event) {
    if (event.key !== "Escape" || !this.#to || this.#isAsking) return;
    event.preventDefault();
    event.stopPropagation();
    this.#end();
  }

  #end() {
    this.#held = this.#to = this.#over = null;
    this.#show();
  }

  /**
   * @param {{number: number, vertex: number} | null} at
   * @returns {void}
   */
  #hover(at) {
    if (this.#over?.vertex === at?.vertex) return;
    this.#over = at;
    this.#show();
  }

  /** The pointer says what it would do. */
  #show() {
    const { holder } = this.stage;
    const isMoving = Boolean(this.#to);
    holder.classList.toggle("movable", Boolean(this.#over) && !isMoving);
    holder.classList.toggle("moving", isMoving);
    const isNowhere = this.#to !== null && this.editor.vertexAt(this.#to) < 0;
    holder.classList.toggle("nowhere", isNowhere);
    this.stage.ask();
  }

  /** What is dragged, where it would be; and what has been changed since this plan was made. */
  #paint() {
    const robot = this.#robot;
    if (!robot) return;
    const { editor, stage } = this;
    const { context, theme, view, choice } = stage;
    const { scale } = view.viewport;
    const { roadmap } = editor;
    /** @type {(vertex: number) => Point} */
    const at = (vertex) => [roadmap.x[vertex], roadmap.y[vertex]];
    const places = [robot.home, ...robot.stops];
    context.strokeStyle = theme.ink;
    context.lineWidth = 2 / scale;
    if (this.#over && !this.#to)
      ring(context, ...at(this.#over.vertex), radiusAt(roadmap, this.#over.vertex, scale));
    const chosen = present(choice.robot);
    const planned = new Set(chosen.stages.map(({ vertex }) => vertex));
    const isPlanned = places.every((vertex, i) =>
      i ? planned.has(vertex) : vertex === chosen.home,
    );
    if (!this.#to && isPlanned) return;
    const landing = this.#to ? editor.vertexAt(this.#to) : -1;
    const points = places.map((vertex) => (vertex < 0 ? null : at(vertex)));
    const number = this.#held?.number ?? -1; // of the stop that is dragged
    if (this.#to) points[number + 1] = landing < 0 ? [this.#to.x, this.#to.y] : at(landing);
    paintTrip(
      context,
      editor,
      scale,
      points.filter((point) => point !== null),
    );
    if (!this.#to) return;
    if (landing >= 0 && number >= 0)
      ring(context, ...at(landing), radiusAt(roadmap, landing, scale) * 0.8);
    const text = landing < 0 ? words.noVertexHere : roadmap.label(landing);
    paintReadout(context, editor, text, this.#to.screen);
  }
}
