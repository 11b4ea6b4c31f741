import { lastOf } from "../common/arrays.js";
import { Area } from "./axis.js";
import { Corridor } from "../plan/corridor.js";
import { FloorRobot } from "../plan/floor.js";
import { texts } from "../language/language.js";
import { BROKEN, CHARGE, DONE, DRIVE, HELD, TURN, WAIT, WORK } from "../plan/phases.js";
import { crossedOut, line, shortened, stripes } from "../drawing/shapes.js";
import { CorridorAxis, LineAxis } from "./space_axis.js";
import { several } from "../language/words.js";

/** @import { Bottleneck } from "./bottleneck.js" */
/** @import { Choice } from "../player/choice.js" */
/** @import { DecisionData, FaultData } from "../payload.d.ts" */
/** @import { Plan } from "../plan/plan.js" */
/** @import { Robot } from "../plan/robot.js" */
/** @import { Row } from "./space_axis.js" */
/** @import { Theme } from "../drawing/theme.js" */
/** @import { Use } from "../plan/use.js" */
/** @import { Words } from "../language/words.js" */

/**
 * Space and time, as in a railway's graphic timetable: places upwards, time to the right. Fields are
 * bookings; a line is level while its robot stays, dashed while it waits, and slopes while it drives.
 * Along a corridor or the route of the chosen robot distances are true, and so slopes are speeds.
 */
export class SpaceTime {
  /**
   * @param {Plan} plan
   * @param {Theme} theme
   * @param {Words} words
   * @param {Use} use
   * @param {Choice} choice
   * @param {Bottleneck} bottleneck
   */
  constructor(plan, theme, words, use, choice, bottleneck) {
    this.plan = plan;
    this.theme = theme;
    this.words = words;
    this.use = use;
    this.choice = choice;
    this.bottleneck = bottleneck;
    this.area = new Area(theme.root.top, 0, 0, plan.end); // until the first frame
    /** @type {CorridorAxis | LineAxis} */
    this.axis = new LineAxis([], this.area, () => 0);
    /** @type {Row[]} */
    this.named = []; // the rows that have names
  }

  get title() {
    return this.choice.mode === "plan"
      ? `${this.#where}: ${this.#signs}`
      : `${this.#where}: ${this.#signsOfFloor}`;
  }

  /** The vertices along which distances are true; null for all places of a small fleet in one line. */
  get #route() {
    const { robot, decision, fault, corridor } = this.choice;
    if (corridor) return corridor;
    const isOfTwo = decision || fault;
    return robot && !(isOfTwo && this.plan.line.length) ? robot.way : null;
  }

  /** What the axis is. */
  get #where() {
    const { robot, corridor } = this.choice;
    const vertices = this.#route;
    if (!vertices) return texts.placeOverTime;
    const { roadmap, quantities } = this.plan;
    if (!corridor)
      return texts.routeOf({
        name: robot?.name ?? "",
        length: quantities.length(this.#rounded(this.#driven)),
      });
    const length = quantities.length(this.#rounded(new Corridor(roadmap, vertices).length));
    const [from, to] = [corridor[0], lastOf(corridor)].map((end) => this.words.vertex(end));
    return texts.wayBetween({ from, to, length });
  }

  /** How far the chosen robot drives, each way as often as it takes it [length unit]. */
  get #driven() {
    const { vertices } = this.choice.robot;
    return vertices.reduce((sum, head, visit) => {
      const tail = vertices[visit - 1] ?? head;
      return tail === head ? sum : sum + this.plan.roadmap.distance(tail, head);
    }, 0);
  }

  /** @param {number} length */
  #rounded(length) {
    return Number(length.toPrecision(4));
  }

  get #signs() {
    const { decision } = this.choice;
    if (decision)
      return texts.signs.decision({ names: several(this.#drawn().map(({ name }) => name)) });
    return this.#route ? texts.signs.route : texts.signs.fleet;
  }

  get #signsOfFloor() {
    const { floor, thin } = texts.signs;
    return this.choice.ghosts ? `${floor}, ${thin}` : floor;
  }

  /**
   * @param {CanvasRenderingContext2D} context
   * @param {Area} area
   */
  paint(context, area) {
    this.area = area;
    this.axis = this.#axis(area);
    this.#rowLines(context);
    const vertices = new Set(this.axis.rows.map(({ vertex }) => vertex));
    for (const vertex of vertices) this.#bookings(context, vertex);
    this.bottleneck.paintDiagram(
      context,
      area,
      ({ robot, vertex }) => this.lanes(robot, vertex)[0] ?? null,
    );
    const drawn = this.#drawn();
    const { beside } = this.choice;
    if (beside) for (const { index } of drawn) this.#line(context, beside[index], true);
    for (const robot of this.choice.robots)
      if (!this.#isDrawn(robot)) this.#passing(context, robot);
    for (const robot of drawn) this.#line(context, robot);
    if (this.choice.decision) this.#mark(context, this.choice.decision);
  }

  /** @param {Area} area */
  #axis(area) {
    const { roadmap } = this.plan;
    if (this.#route) return new CorridorAxis(new Corridor(roadmap, this.#route), area);
    return new LineAxis(this.plan.line, area, (tail, head) => roadmap.distance(tail, head));
  }

  /** The robots that have strong lines. */
  #drawn() {
    const { robot, decision } = this.choice;
    if (decision) return decision.robots.map((index) => this.choice.robots[index]);
    return robot ? [robot] : this.choice.robots;
  }

  /**
   * Whether a robot has a strong line.
   *
   * @param {Robot} robot
   */
  #isDrawn(robot) {
    return !this.choice.robot || this.choice.standsOut(robot.index);
  }

  /**
   * The rows of a vertex, the same for all robots.
   *
   * @param {Robot} _robot
   * @param {number} vertex
   */
  lanes(_robot, vertex) {
    return this.axis.spots(vertex).map((row) => {
      const half = Math.max(row.half * 0.62, 2.5);
      return { top: row.y - half, height: 2 * half };
    });
  }

  /**
   * Names of rows, and lines from them through the diagram.
   *
   * @param {CanvasRenderingContext2D} context
   */
  #rowLines(context) {
    const { robot } = this.choice;
    const ends = new Set(robot ? [robot.home, ...robot.stages.map(({ vertex }) => vertex)] : []);
    /**
     * @param {Row} row
     * @param {number} i
     */
    const isEnd = (row, i) => i === 0 || i === this.axis.rows.length - 1 || ends.has(row.vertex);
    const named = this.axis.named(isEnd);
    context.strokeStyle = this.theme.line;
    context.lineWidth = 1;
    context.beginPath();
    for (const { y } of named) line(context, this.area.left, y, this.area.right, y);
    context.stroke();
    context.font = this.theme.font(12);
    context.fillStyle = this.theme.muted;
    context.textAlign = "right";
    context.textBaseline = "middle";
    for (const { vertex, y } of named) {
      context.fillText(
        shortened(context, this.words.short(vertex), this.area.left - 34),
        this.area.left - 12,
        y + 0.5,
      );
    }
    this.named = named;
  }

  /**
   * @param {CanvasRenderingContext2D} context
   * @param {number} vertex
   */
  #bookings(context, vertex) {
    const { area } = this;
    for (const [robot, visit] of this.use.visitsAt(vertex)) {
      const [from, to] = this.plan.booking(robot, visit);
      const left = area.x(Math.max(from, 0));
      const width = Math.max(area.x(to) - left - 0.75, 0.75);
      context.fillStyle = robot.colour;
      context.globalAlpha = this.#strength(robot) * (robot.leave(visit) === Infinity ? 0.5 : 1);
      for (const { y, half } of this.axis.spots(vertex)) {
        context.beginPath();
        context.roundRect(left, y - half, width, 2 * half, Math.min(3, half * 0.6, width / 3));
        context.fill();
      }
    }
    context.globalAlpha = 1;
  }

  /**
   * Where one robot is chosen, the others are what stands in its way.
   *
   * @param {Robot} robot
   */
  #strength(robot) {
    if (!this.choice.robot) return 0.2;
    return robot === this.choice.robot ? 0.2 : this.choice.standsOut(robot.index) ? 0.5 : 0.3;
  }

  /**
   * The ways of another robot in the corridor, thin.
   *
   * @param {CanvasRenderingContext2D} context
   * @param {Robot} robot
   */
  #passing(context, robot) {
    const { phases, vertices } = robot;
    context.strokeStyle = robot.colour;
    context.lineWidth = 1.25;
    context.beginPath();
    for (let i = 0; i < phases.begin.length; i++) {
      const visit = phases.visit[i];
      const way =
        phases.activity[i] === DRIVE && this.axis.way(vertices[visit], vertices[visit + 1]);
      if (way)
        line(
          context,
          this.area.x(phases.begin[i]),
          way.from.y,
          this.area.x(phases.end(i)),
          way.to.y,
        );
    }
    context.stroke();
  }

  /**
   * @param {CanvasRenderingContext2D} context
   * @param {Robot} robot
   * @param {boolean} [ghost]
   */
  #line(context, robot, ghost = false) {
    const { phases, vertices } = robot;
    context.strokeStyle = robot.colour;
    context.lineJoin = "round";
    for (let i = 0; i < phases.begin.length; i++) {
      const activity = phases.activity[i];
      const visit = phases.visit[i];
      const way = activity === DRIVE ? this.axis.way(vertices[visit], vertices[visit + 1]) : null;
      const stays =
        activity === DRIVE
          ? []
          : this.axis.spots(vertices[visit]).map((row) => ({ from: row, to: row, isTrue: true }));
      for (const { from, to, isTrue } of way ? [way] : stays) {
        if (ghost || !isTrue)
          this.#thin(context, phases.begin[i], phases.end(i), from.y, to.y, isTrue);
        else {
          if (robot instanceof FloorRobot && activity === WAIT) this.#late(context, robot, i, from);
          this.#stroke(context, activity, phases.begin[i], phases.end(i), from, to);
        }
      }
    }
    context.setLineDash([]);
    context.lineCap = "butt";
    context.globalAlpha = 1;
  }

  /**
   * The plan beside what happened; dotted, a way that the rows have at another length.
   *
   * @param {CanvasRenderingContext2D} context
   * @param {number} begin
   * @param {number} end
   * @param {number} from
   * @param {number} to
   * @param {boolean} isTrue
   */
  #thin(context, begin, end, from, to, isTrue) {
    context.setLineDash(isTrue ? [] : [2, 4]);
    context.lineWidth = 1.5;
    context.globalAlpha = 0.75;
    context.beginPath();
    line(context, this.area.x(begin), from, this.area.x(end), to);
    context.stroke();
  }

  /**
   * Underlay the part of a wait that the plan did not have.
   *
   * @param {CanvasRenderingContext2D} context
   * @param {FloorRobot} robot
   * @param {number} phase
   * @param {Row} row
   */
  #late(context, robot, phase, row) {
    const [from, to] = [robot.unplannedFrom(phase), robot.phases.end(phase)];
    if (from >= to) return;
    const height = Math.max(row.half * 1.2, 4);
    const left = this.area.x(from);
    context.fillStyle = this.theme.wait;
    context.fillRect(left, row.y - height / 2, Math.max(this.area.x(to) - left, 1.5), height);
  }

  /**
   * @param {CanvasRenderingContext2D} context
   * @param {number} activity
   * @param {number} begin
   * @param {number} end
   * @param {Row} from
   * @param {Row} to
   */
  #stroke(context, activity, begin, end, from, to) {
    if (activity === HELD || activity === BROKEN) {
      this.#trouble(context, activity, begin, end, from);
      return;
    }
    const thin = this.axis.line;
    const heavy = [WORK, TURN, CHARGE].includes(activity);
    context.lineWidth = heavy ? thin * 2.2 : thin;
    context.lineCap = heavy ? "butt" : "round";
    context.setLineDash(activity === WAIT ? [0.1, thin * 2.4] : []);
    context.globalAlpha = activity === DONE ? 0.4 : activity === TURN ? 0.6 : 1;
    context.beginPath();
    line(context, this.area.x(begin), from.y, this.area.x(end), to.y);
    context.stroke();
  }

  /**
   * @param {CanvasRenderingContext2D} context
   * @param {number} activity
   * @param {number} begin
   * @param {number} end
   * @param {Row} row
   */
  #trouble(context, activity, begin, end, row) {
    const height = Math.max(row.half, 5);
    const left = this.area.x(begin);
    const width = Math.max(this.area.x(end) - left, 1.5);
    context.fillStyle = activity === HELD ? this.theme.held : this.theme.broken;
    if (activity === HELD) stripes(context, left, row.y - height / 2, width, height);
    else crossedOut(context, left, row.y, width, height);
  }

  /**
   * @param {CanvasRenderingContext2D} context
   * @param {DecisionData | FaultData} decision
   */
  #mark(context, decision) {
    const rows = decision.vertices.flatMap((vertex) => this.axis.spots(vertex));
    if (!rows.length) return;
    const top = Math.min(...rows.map(({ y, half }) => y - half));
    const height = Math.max(...rows.map(({ y, half }) => y + half)) - top;
    context.strokeStyle = this.theme.ink;
    context.lineWidth = 1.5;
    context.beginPath();
    context.roundRect(this.area.x(decision.tick) - 6, top, 12, height, 6);
    context.stroke();
  }
}
