import { lastOf, nearest } from "../common/arrays.js";
import { Layer, contextOf, fitCanvas } from "../drawing/canvas.js";
import { Choice } from "../player/choice.js";
import { element, link } from "../common/dom.js";
import { texts } from "../language/language.js";
import { MapBase } from "./map_base.js";
import { MapNames } from "./map_names.js";
import { MapRobots } from "./map_robots.js";
import { MapRoute } from "./map_route.js";
import { MapSizes } from "./map_sizes.js";
import { MapSpace } from "./map_space.js";
import { MapTip } from "./map_tip.js";
import { Motion } from "../plan/motion.js";
import { paintScaleBar } from "../drawing/scale_bar.js";
import { Space } from "../plan/space.js";
import { Use } from "../plan/use.js";
import { Viewport } from "../drawing/viewport.js";
import { Words } from "../language/words.js";

/** @import { JobMarks } from "../jobs/job_marks.js" */
/** @import { MapReleased } from "./map_released.js" */
/** @import { Root } from "../common/root.js" */
/** @import { ShiftMarks } from "../shift/shift_marks.js" */
/** @import { Site } from "../plan/site.js" */
/** @import { Theme } from "../drawing/theme.js" */
/** @import { Moments } from "../player/clock.js" */
/** @import { Bottleneck } from "../timetable/bottleneck.js" */

/**
 * What a map shares with other views of the same plan.
 *
 * @typedef {object} MapParts
 * @property {Motion} [motion]
 * @property {Motion} [ghosts] where robots are by plan
 * @property {Moments} [clock]
 * @property {Choice} [choice]
 * @property {Words} [words]
 * @property {Use} [use]
 * @property {Bottleneck | null} [bottleneck]
 * @property {Root | null} [tools] where the buttons that act on it are
 * @property {((sizes: MapSizes) => MapReleased) | null} [released] what is released to a fleet that is driven
 * @property {JobMarks & { paintBelow?: ShiftMarks["paintBelow"] } | null} [jobs] of a plan with jobs, or a shift
 */

/** The moment of a map on which nothing moves. */
const STILL = Object.freeze({ tick: 0, playing: false, loop: null, pause() {}, seek() {} });

/**
 * The map: what does not move is painted once, robots at each frame. Of a `Site` alone it needs canvas,
 * site and theme; a page that plays a plan gives what it shares with its other views. The canvas lies in
 * an element with room for a tip (class `hover`); without `tools`, no button of the page acts on it.
 */
export class MapView {
  /**
   * @param {HTMLCanvasElement} canvas
   * @param {Site} plan
   * @param {Theme} theme
   * @param {MapParts} [options]
   */
  constructor(
    canvas,
    plan,
    theme,
    {
      choice = new Choice(plan),
      motion = new Motion(choice),
      ghosts = motion,
      clock = STILL,
      words = new Words(plan),
      use = new Use(choice),
      bottleneck = null,
      tools = null,
      released = null,
      jobs = null,
    } = {},
  ) {
    this.canvas = canvas;
    this.motion = motion;
    this.clock = clock;
    this.choice = choice;
    this.words = words;
    this.use = use;
    this.bottleneck = bottleneck;
    this.context = contextOf(canvas);
    this.roadmap = plan.roadmap;
    this.viewport = new Viewport(canvas, plan.roadmap, plan.largestRadius / plan.roadmap.unit);
    this.sizes = new MapSizes(plan, this.viewport);
    const base = new MapBase(plan, this.viewport, this.sizes, theme, choice, use, bottleneck);
    this.base = new Layer((context, width, height) => {
      base.paint(context);
      paintScaleBar(context, width, height, plan, this.viewport, theme);
      this.names.refresh();
    });
    this.space = new Space(plan, motion);
    this.bookings = new MapSpace(
      plan,
      motion,
      clock,
      this.space,
      this.viewport,
      this.sizes,
      theme,
      choice,
      base.marks,
    );
    this.robots = new MapRobots(plan, motion, ghosts, this.sizes, theme, choice);
    this.route = new MapRoute(plan, motion, this.sizes, theme, choice);
    this.released = released?.(this.sizes) ?? null;
    this.jobs = jobs;
    this.names = new MapNames(plan, motion, this.viewport, this.sizes, clock, theme, choice, use);
    this.tip = new MapTip(canvas, plan, motion, clock, choice, words, use, this.space);
    canvas.parentElement?.style.setProperty(
      "--ratio",
      String(plan.roadmap.width / plan.roadmap.height),
    );
    const { length } = plan.robots;
    canvas.setAttribute(
      "aria-label",
      length
        ? texts.mapOf({ what: texts.robots({ count: length }) })
        : texts.mapOf({ what: texts.vertices({ count: plan.roadmap.size }) }),
    );
    this.viewport.on("click", () => this.#click());
    this.viewport.on("hover", () => this.tip.show(this.viewport, this.sizes));
    choice.on("choice", () => this.#bringIntoSight());
    if (tools) this.#listenToTools(plan, tools);
  }

  /** Paint a frame. */
  paint() {
    const size = fitCanvas(this.canvas);
    if (size.changed) this.viewport.resized();
    const { context } = this;
    context.setTransform(1, 0, 0, 1, 0, 0);
    context.clearRect(0, 0, this.canvas.width, this.canvas.height);
    this.base.drawOn(context, size);
    const { left, top, scale } = this.viewport;
    context.translate(left, top);
    context.scale(scale, scale);
    this.bookings.paint(context, scale);
    this.route.paint(context, scale);
    this.released?.paint(context, scale, this.clock.tick);
    this.jobs?.paintBelow?.(context, scale, (vertex) => this.#coverAt(vertex));
    this.bottleneck?.paintRobots(context, this.motion, scale);
    this.robots.paint(context, scale);
    this.bookings.paintOver(context, scale);
    this.jobs?.paintMap(context, scale);
    context.setTransform(size.ratio, 0, 0, size.ratio, 0, 0);
    this.names.paint(context, size.width, size.height);
    this.bookings.write(context, this.words);
    this.tip.refresh(this.viewport, this.sizes);
    this.#sayView();
  }

  /**
   * Say on the element round the map what is painted, for programs that press on it: `data-view` leads
   * from a place of the site [length unit] to pixels of the map, as `matrix()` of CSS; `data-lit` names
   * the places that are lit, `data-bottleneck` those of the circuit that is lit.
   */
  #sayView() {
    const { dataset } = this.canvas.parentElement ?? this.canvas;
    const { left, top, scale } = this.viewport;
    const [[x, y], ...ends] = [
      [0, 0],
      [1, 0],
      [0, 1],
    ].map(([right, up]) => this.roadmap.toDrawing(right, up));
    const axes = ends.flatMap(([toX, toY]) => [scale * (toX - x), scale * (toY - y)]);
    const view = [...axes, left + scale * x, top + scale * y].join(" ");
    if (dataset.view !== view) dataset.view = view;
    const { lit } = this.choice;
    if (this.#lit !== lit) dataset.lit = this.#names(lit);
    this.#lit = lit;
    const circuit = this.bottleneck?.circuit ?? [];
    const bottleneck = this.#names(circuit.map(({ vertex }) => vertex));
    if ((dataset.bottleneck ?? "") !== bottleneck) dataset.bottleneck = bottleneck;
  }

  /** @type {readonly number[] | null} */
  #lit = null; // the places that were lit in the last frame

  /** @param {readonly number[]} vertices */
  #names(vertices) {
    return vertices.map((vertex) => this.roadmap.name(vertex)).join(", ");
  }

  /**
   * The radius of the robot that covers a vertex, in units of the map; 0 for none.
   *
   * @param {number} vertex
   */
  #coverAt(vertex) {
    const { x, y } = this.roadmap;
    const reach = this.sizes.robot / this.viewport.scale;
    const robot = nearest(this.motion.x, this.motion.y, x[vertex], y[vertex], reach);
    return robot < 0 ? 0 : reach;
  }

  #click() {
    const { x, y } = this.viewport.pointer;
    if (this.choice.picked) {
      const vertex = nearest(
        this.roadmap.x,
        this.roadmap.y,
        x,
        y,
        Math.max(0.5, 16 / this.viewport.scale),
      );
      if (vertex >= 0) this.choice.pickEnd(vertex);
      return;
    }
    const reach = Math.max(0.45, (this.sizes.robot + 8) / this.viewport.scale);
    const robot = nearest(this.motion.x, this.motion.y, x, y, reach);
    const job = robot < 0 ? (this.jobs?.jobAt(this.roadmap.near(x, y)) ?? -1) : -1;
    if (job >= 0) this.choice.chooseJob(job);
    else this.choice.chooseRobot(robot);
  }

  #bringIntoSight() {
    const { robotIndex } = this.choice;
    if (robotIndex >= 0) this.viewport.show(this.motion.x[robotIndex], this.motion.y[robotIndex]);
  }

  /**
   * @param {Site} plan
   * @param {Root} root
   */
  #listenToTools(plan, root) {
    /**
     * @param {string} id
     * @param {() => void} action
     */
    const press = (id, action) => root.find(id)?.addEventListener("click", action);
    press("zoom-in", () => this.viewport.zoom(1.5));
    press("zoom-out", () => this.viewport.zoom(1 / 1.5));
    press("fit", () => this.viewport.fit());
    press("heat", () => this.choice.toggleHeat());
    press("corridor", () => this.choice.toggleCorridor());
    press("space", () => this.choice.toggleSpace());
    root.part("space").hidden = !plan.hasSpace;
    this.choice.on("space", () =>
      root.part("space").setAttribute("aria-pressed", String(this.choice.space)),
    );
    for (const event of ["space", "choice", "mode"])
      this.choice.on(event, () => this.#showClosest(root));
    this.choice.on("corridor", () => {
      const { picked, corridor } = this.choice;
      root.find("corridor")?.setAttribute("aria-pressed", String(Boolean(picked || corridor)));
    });
    this.choice.on("heat", () => this.#showHeat(root));
    this.choice.on("mode", () => this.#showHeat(root));
  }

  /**
   * The closest approach of the fleet, which one can go to, while no robot is chosen.
   *
   * @param {Root} root
   */
  #showClosest(root) {
    const legend = root.part("space-legend");
    const closest = this.choice.space && !this.choice.robot ? this.space.closest : null;
    legend.hidden = !closest;
    if (!closest) return;
    const { robot, other, tick } = closest;
    const who = texts.twoTitles({ one: robot.name, other: other.name });
    const text = `${who}, ${this.words.apart(closest)}, ${texts.at({ moment: this.words.moment(tick) })}`;
    legend.replaceChildren(
      texts.closestOfAll,
      link(text, () => {
        this.clock.pause();
        this.clock.seek(tick);
        this.choice.chooseRobot(robot.index);
        this.choice.lookAtPair(other.index);
      }),
    );
  }

  /**
   * The scale of the heat map is linear, with its unit.
   *
   * @param {Root} root
   */
  #showHeat(root) {
    root.part("heat").setAttribute("aria-pressed", String(this.choice.heat));
    root.part("heat-legend").hidden = !this.choice.heat;
    const marks = [0, this.use.most / 2, this.use.most];
    const times = [
      ...marks.slice(0, -1).map((ticks) => this.words.time(ticks)),
      this.words.duration(lastOf(marks)),
    ];
    const labels = times.map((text) => element("span", {}, text));
    root.part("heat-scale").replaceChildren(...labels);
  }
}
