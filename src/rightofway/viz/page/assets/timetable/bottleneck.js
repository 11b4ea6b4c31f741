import { disc, line } from "../drawing/shapes.js";
import { NARROWEST_PERIOD } from "./steady_band.js";

/** @import { Root } from "../common/root.js" */
/** @import { Area } from "./axis.js" */
/** @import { Choice } from "../player/choice.js" */
/** @import { Moments } from "../player/clock.js" */
/** @import { Motion } from "../plan/motion.js" */
/** @import { Plan } from "../plan/plan.js" */
/** @import { Step } from "../plan/steady.js" */
/** @import { Theme } from "../drawing/theme.js" */

/** @typedef {{ top: number, height: number }} SpanRow Where the row of a visit is. */

/** The critical circuit of the group that is looked at, lit on the map and in the diagram. */
export class Bottleneck {
  /**
   * @param {Root} root
   * @param {Plan} plan
   * @param {Moments} clock
   * @param {Choice} choice
   * @param {Theme} theme
   */
  constructor(root, plan, clock, choice, theme) {
    this.root = root;
    this.plan = plan;
    this.clock = clock;
    this.choice = choice;
    this.theme = theme;
    this.button = root.part("bottleneck");
    this.legend = root.part("bottleneck-legend");
    this.button.hidden = !plan.steady?.groups.some(({ circuit }) => circuit.length);
    this.button.addEventListener("click", () => choice.toggleBottleneck());
    choice.on("bottleneck", () => this.#show());
    choice.on("choice", () => this.#show());
    this.#show();
  }

  /** The visits to light: none while that is switched off. */
  get circuit() {
    if (!this.choice.bottleneck || !this.plan.steady) return [];
    return this.group.circuit;
  }

  get group() {
    const { steady } = this.plan;
    if (!steady)
      throw new Error("bottleneck: the plan does not repeat itself (ask for its circuit)");
    return steady.group(this.choice.robot);
  }

  /**
   * The places of the circuit, in map units; under everything that moves.
   *
   * @param {CanvasRenderingContext2D} context
   * @param {number} scale
   */
  paintMap(context, scale) {
    const { circuit } = this;
    if (!circuit.length) return;
    const { x, y } = this.plan.roadmap;
    const around = [...circuit, circuit[0]].map(({ vertex }) => vertex);
    context.lineCap = context.lineJoin = "round";
    const trace = () => {
      context.beginPath();
      around.forEach((vertex, i) => context[i ? "lineTo" : "moveTo"](x[vertex], y[vertex]));
      context.stroke();
    };
    const width = Math.max(0.34, 5 / scale);
    context.strokeStyle = this.theme.litEdge;
    context.lineWidth = width + 2 / scale;
    trace();
    context.strokeStyle = this.theme.lit;
    context.lineWidth = width;
    trace();
    context.lineCap = "butt";
  }

  /**
   * A disc under the robots that are on the circuit at this moment.
   *
   * @param {CanvasRenderingContext2D} context
   * @param {Motion} motion
   * @param {number} scale
   */
  paintRobots(context, motion, scale) {
    for (const index of this.robotsNow(this.clock.tick)) {
      context.fillStyle = this.theme.lit;
      context.strokeStyle = this.theme.litEdge;
      context.lineWidth = Math.max(0.03, 1.25 / scale);
      disc(context, motion.x[index], motion.y[index], Math.max(0.44, 8 / scale));
      context.stroke();
    }
  }

  /**
   * Who is on the circuit at this moment.
   *
   * @param {number} tick
   */
  robotsNow(tick) {
    const { circuit } = this;
    if (!circuit.length || tick < this.group.start || this.choice.mode !== "plan") return [];
    const { period } = this.group;
    /** @param {Step} options */
    const since = ({ begin }) => (((tick - begin) % period) + period) % period;
    return [
      ...new Set(
        circuit.filter((step) => since(step) < step.ticks).map(({ robot }) => robot.index),
      ),
    ];
  }

  /**
   * Light the visits of all periods; `rowOf` returns top and height of a visit's row, or nothing.
   *
   * @param {CanvasRenderingContext2D} context
   * @param {Area} area
   * @param {(step: Step) => SpanRow | null} rowOf
   */
  paintDiagram(context, area, rowOf) {
    const { circuit } = this;
    if (!circuit.length || this.choice.mode !== "plan") return;
    const { period, until } = this.group;
    if (area.x(period) - area.x(0) < NARROWEST_PERIOD) return;
    const rows = circuit.map(rowOf);
    for (let shift = -this.group.turn; shift < until; shift += period) {
      circuit.forEach((step, i) => this.#cell(context, area, rows[i], step, shift));
      circuit.forEach((step, i) => {
        const next = (i + 1) % circuit.length;
        if (circuit[next].robot !== step.robot)
          this.#link(context, area, rows[i], rows[next], step, shift);
      });
    }
  }

  /**
   * Whether the plan repeats itself at a tick.
   *
   * @param {number} tick
   */
  #repeats(tick) {
    return tick >= this.group.start && tick < this.group.until;
  }

  /**
   * @param {CanvasRenderingContext2D} context
   * @param {Area} area
   * @param {SpanRow | null} row
   * @param {Step} options
   * @param {number} shift
   */
  #cell(context, area, row, { begin, ticks }, shift) {
    if (!row || !ticks || !this.#repeats(begin + shift)) return;
    const { top, height } = row;
    const left = area.x(begin + shift);
    const width = Math.max(area.x(Math.min(begin + shift + ticks, this.group.until)) - left, 1.5);
    context.fillStyle = this.theme.lit;
    context.strokeStyle = this.theme.litEdge;
    context.lineWidth = 1;
    context.beginPath();
    context.roundRect(left, top, width, height, Math.min(3, height / 3, width / 3));
    context.fill();
    if (width >= 4) context.stroke();
  }

  /**
   * From a visit to that of another robot, which waits for it.
   *
   * @param {CanvasRenderingContext2D} context
   * @param {Area} area
   * @param {SpanRow | null} from
   * @param {SpanRow | null} to
   * @param {Step} options
   * @param {number} shift
   */
  #link(context, area, from, to, { begin, next }, shift) {
    if (
      !from ||
      !to ||
      from.top === to.top ||
      !this.#repeats(begin + shift) ||
      !this.#repeats(next + shift)
    )
      return;
    const down = to.top > from.top;
    const x = area.x(next + shift);
    context.strokeStyle = this.theme.litEdge;
    context.lineWidth = 1.5;
    context.beginPath();
    line(
      context,
      x,
      down ? from.top + from.height : from.top,
      x,
      down ? to.top : to.top + to.height,
    );
    context.stroke();
  }

  #show() {
    const { circuit, button, legend } = this;
    button.setAttribute("aria-pressed", String(this.choice.bottleneck));
    legend.hidden = !circuit.length || !this.group.isCritical;
    if (legend.hidden) return;
    const [short, atLength] = this.group.bottleneck.map((text) => this.plan.phrases.said(text));
    if (legend.lastElementChild) legend.lastElementChild.textContent = short;
    legend.title = atLength;
  }
}
