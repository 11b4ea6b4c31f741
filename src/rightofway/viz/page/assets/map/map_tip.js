import { nearest } from "../common/arrays.js";
import { all, element, swatch } from "../common/dom.js";
import { figure, said, texts } from "../language/language.js";
import { DRIVE } from "../plan/phases.js";
import { several } from "../language/words.js";

/** @import { Choice } from "../player/choice.js" */
/** @import { Moments } from "../player/clock.js" */
/** @import { MapSizes } from "./map_sizes.js" */
/** @import { Motion } from "../plan/motion.js" */
/** @import { Site } from "../plan/site.js" */
/** @import { Robot } from "../plan/robot.js" */
/** @import { Space } from "../plan/space.js" */
/** @import { Use } from "../plan/use.js" */
/** @import { Viewport } from "../drawing/viewport.js" */
/** @import { Words } from "../language/words.js" */

/** @typedef {{ text: string, kind?: string, robot?: Robot }} Line */

const TIP_GAP = 16; // pixels from the pointer

/** What is under the pointer, beside it: a robot and what it does, a place and the robot there, coordinates. */
export class MapTip {
  /**
   * @param {HTMLCanvasElement} canvas
   * @param {Site} plan
   * @param {Motion} motion
   * @param {Moments} clock
   * @param {Choice} choice
   * @param {Words} words
   * @param {Use} use
   * @param {Space} space
   */
  constructor(canvas, plan, motion, clock, choice, words, use, space) {
    this.canvas = canvas;
    this.plan = plan;
    this.motion = motion;
    this.clock = clock;
    this.choice = choice;
    this.words = words;
    this.use = use;
    this.space = space;
    this.box = all(".hover", HTMLElement, canvas.parentElement ?? document)[0];
    this.text = "";
  }

  /**
   * The pointer is elsewhere.
   *
   * @param {Viewport} viewport
   * @param {MapSizes} sizes
   */
  show(viewport, sizes) {
    this.refresh(viewport, sizes);
    if (this.box.hidden) return;
    const { width, height } = this.canvas.getBoundingClientRect();
    const [x, y] = [
      viewport.left + viewport.pointer.x * viewport.scale,
      viewport.top + viewport.pointer.y * viewport.scale,
    ];
    const { offsetWidth: wide, offsetHeight: high } = this.box;
    const left = x + TIP_GAP + wide < width ? x + TIP_GAP : Math.max(x - TIP_GAP - wide, 4);
    const top = y + TIP_GAP + high < height ? y + TIP_GAP : Math.max(y - TIP_GAP - high, 4);
    this.box.style.transform = `translate(${Math.round(left)}px, ${Math.round(top)}px)`;
  }

  /**
   * Time goes on below a pointer that rests.
   *
   * @param {Viewport} viewport
   * @param {MapSizes} sizes
   */
  refresh(viewport, sizes) {
    const { x, y } = viewport.pointer;
    const lines = Number.isNaN(x) ? [] : this.#about(x, y, sizes.robot / viewport.scale);
    this.box.hidden = !lines.length;
    const text = lines.map((line) => line.text).join("\n");
    if (text === this.text) return;
    this.text = text;
    this.box.replaceChildren(
      ...lines.map(({ text: words, robot, kind }) =>
        element("div", { className: kind ?? "" }, ...(robot ? [swatch(robot)] : []), words),
      ),
    );
  }

  /**
   * @param {number} x
   * @param {number} y
   * @param {number} radius
   * @returns {Line[]}
   */
  #about(x, y, radius) {
    const index = nearest(this.motion.x, this.motion.y, x, y, Math.max(radius * 1.2, 0.3));
    const vertex = this.plan.roadmap.near(x, y);
    const obstacle = this.plan.roadmap.obstacleAt(x, y);
    return [
      ...(index < 0 ? [] : this.#aboutRobot(this.choice.robots[index])),
      ...(vertex < 0 ? [] : this.#aboutPlace(vertex, index)),
      ...(vertex < 0 ? [] : this.#aboutZones(vertex)),
      ...this.plan.closures
        .filter(({ vertices }) => vertices.includes(vertex))
        .map((closure) => ({ text: said(closure.text) })),
      ...(obstacle ? [{ text: obstacle.name, kind: "title" }] : []),
      { text: this.#position(x, y), kind: "position" },
    ];
  }

  /**
   * Its name, what it does, since when and until when.
   *
   * @param {Robot} robot
   * @returns {Line[]}
   */
  #aboutRobot(robot) {
    const { words } = this;
    if (this.plan.isStill) return [{ text: robot.name, robot, kind: "title" }];
    const phase = this.motion.phase[robot.index];
    const { begin, visit } = robot.phases;
    const activity = this.motion.activity[robot.index];
    const here = words.vertex(robot.vertices[visit[phase]]);
    const does =
      activity === DRIVE
        ? texts.doesTo({
            activity: texts.activities[DRIVE],
            place: words.vertex(robot.vertices[visit[phase] + 1]),
          })
        : texts.doesIn({ activity: texts.activities[activity], place: here });
    const end = robot.phases.end(phase);
    const times =
      end === Infinity
        ? texts.since({ moment: words.moment(begin[phase]) })
        : texts.fromTo({ from: words.moment(begin[phase]), to: words.moment(end) });
    return [{ text: robot.name, robot, kind: "title" }, { text: `${does}, ${times}` }];
  }

  /**
   * The zones of a place, and the robot that holds each.
   *
   * @param {number} vertex
   * @returns {Line[]}
   */
  #aboutZones(vertex) {
    const zones = this.space.zonesOf.get(String(vertex)) ?? [];
    const holders = zones.length ? this.space.zoneHolders : new Map();
    return zones.map((zone) => {
      const { name } = this.plan.roadmap.zones[zone];
      const robot = holders.get(zone);
      return {
        text: robot ? texts.zoneHeldBy({ name, robot: robot.name }) : texts.zone({ name }),
        robot,
      };
    });
  }

  /**
   * Its name, the robot there if it was not named yet, and the next robot.
   *
   * @param {number} vertex
   * @param {number} named
   */
  #aboutPlace(vertex, named) {
    const now = this.clock.tick;
    const { words } = this;
    const visits = this.use
      .visitsAt(vertex)
      .sort(([one, a], [two, b]) => one.enter[a] - two.enter[b]);
    const here = visits.find(
      ([robot, visit]) => robot.enter[visit] <= now && now < robot.leave(visit),
    );
    const next = visits.find(([robot, visit]) => robot.enter[visit] > now);
    /** @type {Line[]} */
    const lines = [{ text: this.#placeName(vertex), kind: "title" }];
    if (this.plan.isStill) return lines;
    if (here && here[0].index !== named) {
      const leave = here[0].leave(here[1]);
      const [{ name }] = here;
      const text =
        leave === Infinity
          ? texts.stays({ name })
          : texts.until({ name, moment: words.moment(leave) });
      lines.push({ text, robot: here[0] });
    }
    if (next)
      lines.push({
        text: texts.next({ name: next[0].name, moment: words.moment(next[0].enter[next[1]]) }),
        robot: next[0],
      });
    if (this.choice.heat)
      lines.push({ text: texts.heldFor({ time: words.duration(this.use.held[vertex]) }) });
    return lines;
  }

  /**
   * Where a place is, its name, and whose home or stop it is.
   *
   * @param {number} vertex
   */
  #placeName(vertex) {
    const homes = this.choice.robots
      .filter((robot) => robot.home === vertex)
      .map(({ name }) => name);
    const stops = (this.plan.stops.get(vertex) ?? []).map(({ name }) => name);
    const uses = [
      homes.length ? texts.homeOf({ names: several(homes) }) : "",
      stops.length ? texts.stopOf({ names: several(stops) }) : "",
    ];
    const { roadmap } = this.plan;
    const name = roadmap.isMeasured ? roadmap.name(vertex) : ""; // as files and tables call it
    return [roadmap.where(vertex), name, roadmap.uses(vertex), ...uses].filter(Boolean).join(", ");
  }

  /**
   * Coordinates in the site's frame, to a hundredth of a cell or so.
   *
   * @param {number} x
   * @param {number} y
   */
  #position(x, y) {
    const { roadmap, quantities } = this.plan;
    const digits = Math.max(0, Math.ceil(-Math.log10(roadmap.unit / 50)));
    const [right, up] = roadmap
      .toSite(x, y)
      .map((value) => figure(value.toFixed(Math.min(digits, 6))));
    const unit = quantities.units.length ? ` ${quantities.units.length}` : "";
    return `x ${right}${unit}, y ${up}${unit}`;
  }
}
