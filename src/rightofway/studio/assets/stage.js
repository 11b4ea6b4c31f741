/** A map that is drawn, a plan that is played on it, and room above it for what is being drawn. */

import { toDrawing } from "./draw/places.js";
import { later } from "./given.js";
import { RULER } from "./draw/readout.js";
import { beginWork, endWork } from "./busy.js";
import { Player } from "./runs/player.js";
import { fitCanvas } from "../../viz/page/assets/drawing/canvas.js";
import { Choice } from "../../viz/page/assets/player/choice.js";
import { Clock } from "../../viz/page/assets/player/clock.js";
import { FrameLoop } from "../../viz/page/assets/player/frame_loop.js";
import { JobMarks } from "../../viz/page/assets/jobs/job_marks.js";
import { MapView } from "../../viz/page/assets/map/map_view.js";
import { LEGENDS } from "../../viz/page/assets/player/markup.js";
import { Motion } from "../../viz/page/assets/plan/motion.js";
import { Observable } from "../../viz/page/assets/common/observable.js";
import { Plan } from "../../viz/page/assets/plan/plan.js";
import { Root } from "../../viz/page/assets/common/root.js";
import { Site } from "../../viz/page/assets/plan/site.js";
import { Theme } from "../../viz/page/assets/drawing/theme.js";
import { Words } from "../../viz/page/assets/language/words.js";
import { words as texts } from "./words.js";
/** @import { Roadmap } from "../../viz/page/assets/plan/roadmap.js" */
/** @import { Viewport } from "../../viz/page/assets/drawing/viewport.js" */
/** @import { SitePayload, StageElements } from "./types.js" */

const LEAST_IN_SIGHT = 0.2; // of a map, to keep the view of another one

/** Events: `show` when another map is drawn, `choice`, `overlay` to paint above the map (with `context`). */
export class Stage extends Observable {
  /** @type {Plan} A `Site`, without all that a plan has beside it, where no plan is shown. */
  plan = later();
  /** @type {Clock} */
  clock = later();
  /** @type {Choice} */
  choice = later();
  /** @type {Motion} */
  motion = later();
  /** @type {Motion} */
  ghosts = later();
  /** @type {Words} */
  words = later();
  /** @type {HTMLCanvasElement} */
  canvas = later();
  /** @type {HTMLCanvasElement} */
  over = later(); // above it
  /** @type {MapView} */
  view = later();
  /** @type {CanvasRenderingContext2D} */
  context = later(); // of what is above the map
  /** @type {SitePayload} */
  raw = later();
  /** @type {Player | null} */
  player = null;
  root = new Root(document.body); // the parts of the viewer stand all over the studio
  /** @type {FrameLoop | null} */
  loop = null;

  /**
   * All that is in `holder`, `below` and `time` is of the stage.
   * @param {StageElements} elements
   */
  constructor({ holder, below, time, card }) {
    super();
    this.holder = holder;
    this.below = below;
    this.time = time;
    this.card = card;
    this.theme = new Theme(this.root);
    this.isPicking = false; // whether a press on a place is waited for
    this.isMoved = false; // whether somebody has zoomed or moved the map
    this.theme.on("theme", () => this.repaint());
    new ResizeObserver(() => this.ask()).observe(holder);
  }

  /** Whether a plan is shown, not only a map. */
  get isPlan() {
    return this.plan instanceof Plan;
  }

  /**
   * Show a site or the payload of a plan; with `keeps`, moment and view stay what they are. Between a
   * map and a plan, which has less room, the view stays only where somebody has chosen it.
   * @param {SitePayload} raw
   * @param {{keeps?: boolean}} [options]
   * @returns {void}
   */
  show(raw, { keeps = false } = {}) {
    const { clock: before, view: old, isPlan: wasPlan } = this;
    const wasPlaying = before?.playing; // the player stops it when it ends
    this.raw = raw;
    const chosen = this.choice?.robot?.name;
    const plan = /** @type {Plan} */ ("metrics" in raw ? new Plan(raw) : new Site(raw));
    const clock = new Clock(plan);
    const [choice, motion, words] = [new Choice(plan), new Motion(plan), new Words(plan)];
    const ghosts = new Motion({ robots: plan.planned, roadmap: plan.roadmap });
    const canvas = this.#freshCanvas();
    this.plan = plan;
    this.clock = clock;
    this.loop = new FrameLoop(clock, askBusily(clock), () => this.#paint());
    this.choice = choice;
    this.motion = motion;
    this.ghosts = ghosts;
    this.words = words;
    this.canvas = canvas;
    this.player?.end();
    this.player = this.isPlan ? new Player(this) : null;
    if (!this.player) this.#clear();
    const view = new MapView(canvas, plan, this.theme, {
      motion,
      ghosts,
      clock,
      choice,
      words,
      use: this.player?.use,
      bottleneck: this.player?.bottleneck ?? null,
      tools: this.player ? this.root : null,
      jobs: this.isPlan && plan.tours.length ? new JobMarks(plan, this.theme, choice) : null,
    });
    this.view = view;
    this.player?.begin(view);
    view.viewport.border = this.isPlan ? 0 : RULER;
    view.viewport.fit();
    if (!keeps) this.isMoved = false;
    if (keeps && old && (this.isMoved || wasPlan === this.isPlan)) keepView(old, view);
    for (const event of ["tick", "playing"]) clock.on(event, () => this.ask());
    for (const event of ["choice", "heat", "space", "corridor", "bottleneck"])
      choice.on(event, () => this.repaint());
    choice.on("choice", () => this.tell("choice"));
    view.viewport.on("view", () => {
      this.isMoved = !view.viewport.fitted;
      this.repaint();
    });
    if (keeps && before && this.isPlan) {
      clock.seek(Math.min(before.tick, clock.end));
      if (wasPlaying) clock.play();
    }
    if (keeps && chosen !== undefined)
      choice.chooseRobot(plan.robots.findIndex(({ name }) => name === chosen));
    this.tell("show");
    this.repaint();
  }

  /**
   * Let the map follow a pointer no more: it is neither moved nor pressed by it.
   * @param {{pointerId: number}} event
   * @returns {void}
   */
  giveUp({ pointerId }) {
    for (const name of ["pointercancel", "pointerleave"])
      this.canvas.dispatchEvent(new PointerEvent(name, { pointerId }));
  }

  /**
   * Light a circle of visits of some robots that repeat themselves; null for the critical one.
   * @param {string[]} names
   * @param {[number, number][] | null} visits
   * @returns {void}
   */
  lightCircle(names, visits) {
    const { plan } = this;
    if (!this.isPlan || !plan.steady) return;
    const index = plan.planned.findIndex(({ name }) => name === names[0]);
    const group = plan.steady.groupOf[index];
    if (!group || (visits === null && group.isCritical)) return;
    group.light(visits, plan.planned);
    this.choice.tell("bottleneck");
  }

  #clear() {
    this.below.replaceChildren();
    this.time.replaceChildren();
    this.card.hidden = true;
  }

  /** The viewer listens to its canvas for ever, so each map has one of its own. */
  #freshCanvas() {
    const hadFocus = this.canvas === document.activeElement;
    const canvas = Object.assign(document.createElement("canvas"), { id: "map", tabIndex: 0 });
    canvas.setAttribute("role", "application");
    canvas.setAttribute("aria-roledescription", texts.mapRole);
    canvas.setAttribute("aria-describedby", "hover");
    this.over = Object.assign(document.createElement("canvas"), {
      className: "over",
      ariaHidden: "true",
    });
    this.holder.innerHTML = LEGENDS;
    this.holder.prepend(canvas, this.over);
    if (hadFocus) canvas.focus();
    return canvas;
  }

  /** Paint again what does not move, too. */
  repaint() {
    if (this.view) this.view.base.stale = true;
    this.player?.repaint();
    this.ask();
  }

  /** Have a frame painted soon; while nothing changes, none is. */
  ask() {
    if (this.view) this.loop?.ask();
  }

  /** Paint a frame; false where the map is not in sight. */
  #paint() {
    const { clock, motion, ghosts, choice, view } = this;
    if (!this.holder.clientWidth || !this.holder.clientHeight) return false;
    motion.moveTo(clock.tick);
    if (choice.ghosts) ghosts.moveTo(clock.tick);
    view.paint();
    this.#paintOn(this.over, "overlay");
    this.player?.paint();
    return true;
  }

  /**
   * What others paint above the map, in units of the drawing.
   * @param {HTMLCanvasElement} canvas
   * @param {string} event
   * @returns {void}
   */
  #paintOn(canvas, event) {
    const { view } = this;
    const { ratio } = fitCanvas(canvas);
    const context = /** @type {CanvasRenderingContext2D} */ (canvas.getContext("2d"));
    context.setTransform(1, 0, 0, 1, 0, 0);
    context.clearRect(0, 0, canvas.width, canvas.height);
    const { left, top, scale } = view.viewport;
    context.setTransform(ratio * scale, 0, 0, ratio * scale, ratio * left, ratio * top);
    this.context = context;
    this.tell(event);
  }
}

/**
 * What asks the browser for a frame: until it is painted the page is busy, unless a plan plays, which is
 * no work that ends.
 * @param {Clock} clock
 * @returns {(paint: (now: number) => void) => void}
 */
const askBusily = (clock) => (paint) => {
  const isStill = !clock.playing;
  if (isStill) beginWork();
  requestAnimationFrame((now) => {
    paint(now);
    if (isStill) endWork();
  });
};

/**
 * Let the same place of the site be where it was, as large as it was.
 * @param {MapView} before
 * @param {MapView} after
 * @returns {void}
 */
function keepView({ viewport: before, roadmap: old }, { viewport, roadmap }) {
  const isSame =
    old.width === roadmap.width && old.height === roadmap.height && old.unit === roadmap.unit;
  const { fitted } = before;
  const [x, y] = toDrawing(old, ...roadmap.toSite(0, 0));
  const { left, top, scale } = before;
  viewport.left = left + x * scale;
  viewport.top = top + y * scale;
  viewport.scale = (scale * roadmap.unit) / old.unit;
  viewport.fitted = fitted && isSame;
  viewport.canvas.classList.toggle("zoomed", !viewport.fitted);
  if (shareInSight(viewport, roadmap) < LEAST_IN_SIGHT) viewport.fit(); // it is another place
}

/**
 * How much of a map is on its canvas: 1 for all of it.
 * @param {Viewport} viewport
 * @param {Roadmap} roadmap
 * @returns {number}
 */
function shareInSight({ left, top, scale, canvas }, { width, height }) {
  /**
   * @param {number} from
   * @param {number} length
   * @param {number} room
   * @returns {number}
   */
  const inside = (from, length, room) =>
    Math.max(Math.min(from + length, room) - Math.max(from, 0), 0) / length;
  const [across, down] = [width * scale, height * scale];
  const [right, below] = [left - scale / 2, top - scale / 2];
  return inside(right, across, canvas.clientWidth) * inside(below, down, canvas.clientHeight);
}
