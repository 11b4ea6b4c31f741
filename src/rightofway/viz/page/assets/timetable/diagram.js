import { AXIS_HEIGHT, Area, paintAxis } from "./axis.js";
import { Layer, contextOf, fitCanvas } from "../drawing/canvas.js";
import { Census } from "./census.js";
import { texts } from "../language/language.js";
import { MOST_ROWS, RobotRows } from "./robot_rows.js";
import { pointer } from "../drawing/shapes.js";
import { SpaceTime } from "./space_time.js";
import { SteadyBand } from "./steady_band.js";

/** @import { Root } from "../common/root.js" */
/** @import { Bottleneck } from "./bottleneck.js" */
/** @import { Choice } from "../player/choice.js" */
/** @import { JobMarks } from "../jobs/job_marks.js" */
/** @import { Moments } from "../player/clock.js" */
/** @import { Plan } from "../plan/plan.js" */
/** @import { ShiftChart } from "../shift/shift_chart.js" */
/** @import { Theme } from "../drawing/theme.js" */
/** @import { Use } from "../plan/use.js" */
/** @import { Words } from "../language/words.js" */

const EDGE = 5; // pixels below a diagram that has another one below it

/**
 * The diagram below the slider: of the views on the plan, the one that explains most. One of several below
 * each other has a canvas of its own and the `axis` of the first one; the last one has the labels.
 */
export class Diagram {
  /**
   * @param {Root} root
   * @param {Plan} plan
   * @param {Moments} clock
   * @param {Choice} choice
   * @param {Theme} theme
   * @param {Words} words
   * @param {Use} use
   * @param {Bottleneck} bottleneck
   * @param {{ canvas?: HTMLCanvasElement, axis?: { plan: Plan, words: Words } }} [options]
   */
  constructor(root, plan, clock, choice, theme, words, use, bottleneck, { canvas, axis } = {}) {
    this.root = root;
    this.plan = plan;
    this.clock = clock;
    this.choice = choice;
    this.theme = theme;
    this.words = words;
    this.axis = axis ?? { plan, words };
    /** @type {JobMarks | null} */
    this.jobs = null; // of a plan with jobs
    /** @type {ShiftChart | null} */
    this.shift = null;
    this.hasLabels = true;
    this.area = new Area(theme.root.top, 0, 0, plan.end); // until the first frame
    this.canvas = canvas ?? root.part("diagram", HTMLCanvasElement);
    this.needle = canvas ? null : root.part("needle");
    this.heading = canvas ? null : root.part("diagram-title");
    this.spaceTime = new SpaceTime(plan, theme, words, use, choice, bottleneck);
    this.rows = new RobotRows(plan, theme, choice, bottleneck);
    this.census = new Census(plan, theme, choice);
    this.band = new SteadyBand(plan, clock, choice, theme, words);
    this.layer = new Layer((context, width, height) => this.#paintView(context, width, height));
    this.#listen();
  }

  /** The view that suits what is chosen and how large the fleet is. */
  get view() {
    if (this.shift && !this.choice.corridor) return this.shift;
    if (this.choice.robot || this.choice.corridor || this.plan.line.length) return this.spaceTime;
    return this.plan.robots.length <= MOST_ROWS ? this.rows : this.census;
  }

  /** Paint a frame: the picture if it is stale, else only the needle moves. */
  paint() {
    const size = fitCanvas(this.canvas);
    if (!size.width) return; // no room for it on a low screen
    if (size.changed || this.layer.stale) {
      this.area = this.#areaOf(size);
      const context = contextOf(this.canvas);
      context.setTransform(1, 0, 0, 1, 0, 0);
      context.clearRect(0, 0, this.canvas.width, this.canvas.height);
      this.layer.drawOn(context, size);
      if (this.heading) this.heading.textContent = this.heading.title = this.#title;
      this.canvas.setAttribute("aria-label", this.#title);
    }
    if (this.needle) this.needle.style.transform = `translateX(${this.area.x(this.clock.tick)}px)`;
  }

  get #title() {
    const { picked } = this.choice;
    if (!picked) return this.view.title;
    if (!picked.length) return texts.corridorBegins;
    return texts.corridorEnds({ place: this.words.vertex(picked[0]) });
  }

  /**
   * @param {{ width: number, height: number }} options
   * @param {{ end: number }} [other]
   */
  #areaOf({ width, height }, { end } = this.plan) {
    return new Area(
      this.theme.root.top,
      width,
      height,
      end,
      this.band.height,
      this.hasLabels ? AXIS_HEIGHT : EDGE,
    );
  }

  /**
   * @param {CanvasRenderingContext2D} context
   * @param {number} width
   * @param {number} height
   */
  #paintView(context, width, height) {
    const area = this.#areaOf({ width, height });
    const { plan, words } = this.axis;
    this.band.paint(context, area);
    paintAxis(
      context,
      this.#areaOf({ width, height }, plan),
      plan,
      this.theme,
      words,
      this.hasLabels,
    );
    context.save();
    context.beginPath();
    context.rect(0, 0, area.right + 1, height); // laps go on beyond the end
    context.clip();
    const { view } = this;
    view.paint(context, area);
    if ("lanes" in view)
      this.jobs?.paintDiagram(context, area, (robot, vertex) => view.lanes(robot, vertex));
    this.#decisions(context, area);
    context.restore();
  }

  /**
   * A small triangle at the top wherever somebody was given the right of way.
   *
   * @param {CanvasRenderingContext2D} context
   * @param {Area} area
   */
  #decisions(context, area) {
    const { decisions } = this.plan;
    context.fillStyle = this.theme.muted;
    context.globalAlpha = Math.max(0.9 - decisions.length / 200, 0.2);
    for (const decision of decisions) pointer(context, area.x(decision.tick), 3.5);
    context.globalAlpha = 1;
    context.fillStyle = this.theme.ink;
    if (this.choice.decision) pointer(context, area.x(this.choice.decision.tick), 5);
  }

  /** Pressing or dragging goes to that moment; pressing a robot's name chooses it. */
  #listen() {
    const { canvas } = this;
    canvas.addEventListener("pointerdown", (event) => {
      if (event.offsetX < this.area.left - 8) this.#chooseAt(event.offsetY);
      else {
        canvas.setPointerCapture(event.pointerId);
        this.clock.pause();
        this.clock.seek(this.area.tick(event.offsetX));
      }
    });
    canvas.addEventListener("pointermove", (event) => {
      if (canvas.hasPointerCapture(event.pointerId)) this.clock.seek(this.area.tick(event.offsetX));
    });
  }

  /** @param {number} y */
  #chooseAt(y) {
    const robot = this.view === this.rows ? this.rows.robotAt(y) : -1;
    if (robot >= 0) this.choice.chooseRobot(robot);
  }
}
