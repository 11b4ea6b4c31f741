import { LabelBoard, SIDES, TextWidths, boxBeside, cut } from "../drawing/label_board.js";
import { CHARGE, BROKEN, DONE, DRIVE, TURN, WORK } from "../plan/phases.js";
import { PlaceNames } from "./place_names.js";
import { haloed } from "../drawing/shapes.js";
import { inkOn } from "../drawing/theme.js";

/** @import { Choice } from "../player/choice.js" */
/** @import { Moments } from "../player/clock.js" */
/** @import { Box } from "../drawing/label_board.js" */
/** @import { MapSizes } from "./map_sizes.js" */
/** @import { Motion } from "../plan/motion.js" */
/** @import { Site } from "../plan/site.js" */
/** @import { Theme } from "../drawing/theme.js" */
/** @import { Use } from "../plan/use.js" */
/** @import { Viewport } from "../drawing/viewport.js" */

const MOST_NAMED = 100; // robots in sight; of more, only names with room while time stands still
const ROBOT_TYPE = 13; // pixels

/**
 * Names of robots and places, none over another. Robots come first, then homes and stops, then
 * other vertices; a name without room is left out. A place keeps its spot while the view does, and
 * is left out while a robot or a robot's name covers it.
 */
export class MapNames {
  #robots = new LabelBoard();
  #sides; // of each robot's name, so that it does not jump
  #widths = new TextWidths();

  /**
   * @param {Site} plan
   * @param {Motion} motion
   * @param {Viewport} viewport
   * @param {MapSizes} sizes
   * @param {Moments} clock
   * @param {Theme} theme
   * @param {Choice} choice
   * @param {Use} use
   */
  constructor(plan, motion, viewport, sizes, clock, theme, choice, use) {
    this.plan = plan;
    this.motion = motion;
    this.viewport = viewport;
    this.sizes = sizes;
    this.clock = clock;
    this.theme = theme;
    this.choice = choice;
    this.#sides = new Int8Array(plan.robots.length);
    this.places = new PlaceNames(plan, viewport, sizes, theme, choice, use);
    /** @type {{ name: string, box: Box }[]} */
    this.written = []; // what the last frame shows: { name, box } of each label
    this.inks = plan.robots.map((robot) => inkOn(robot.colour));
  }

  /** The view or the choice is another one: places find their spots again. */
  refresh() {
    this.places.refresh();
  }

  /**
   * Write all names, in pixels of the canvas.
   *
   * @param {CanvasRenderingContext2D} context
   * @param {number} width
   * @param {number} height
   */
  paint(context, width, height) {
    this.written = [];
    const places = this.places.find(context, width, height);
    this.#robots.clear(width, height);
    const inSight = this.#inSight(width, height);
    const isCrowd = inSight.length > MOST_NAMED;
    const named =
      isCrowd && this.clock.playing ? inSight.filter((index) => this.#isChosen(index)) : inSight;
    if (!named.length && !places) return;
    for (const index of inSight) {
      const [x, y] = this.#at(index);
      this.#robots.takeDisc(x, y, this.#radius(index));
    }
    const outside = named.filter((index) => !this.#fitsInside(context, index, this.#radius(index)));
    for (const index of outside) this.#beside(context, index, this.#radius(index), isCrowd);
    const outsiders = new Set(outside);
    for (const index of named)
      if (!outsiders.has(index)) this.#inside(context, index, this.#radius(index));
    this.written.push(...this.places.write(context, this.#robots));
  }

  /** @param {number} index */
  #radius(index) {
    return this.sizes.of(this.plan.robots[index]);
  }

  /** @param {number} index */
  #isChosen(index) {
    return this.choice.robotIndex >= 0 && this.choice.standsOut(index);
  }

  /** @param {number} index */
  #at(index) {
    const { left, top, scale } = this.viewport;
    return [left + this.motion.x[index] * scale, top + this.motion.y[index] * scale];
  }

  /**
   * The robots in sight, those chosen first, and those that are done last.
   *
   * @param {number} width
   * @param {number} height
   */
  #inSight(width, height) {
    const found = [];
    for (let index = 0; index < this.plan.robots.length; index++) {
      const [x, y] = this.#at(index);
      if (x > -5 && x < width + 5 && y > -5 && y < height + 5) found.push(index);
    }
    /** @param {number} index */
    const rank = (index) =>
      this.#isChosen(index) ? 0 : this.motion.activity[index] === DONE ? 2 : 1;
    return found.length > MOST_NAMED && this.clock.playing
      ? found
      : found.sort((one, other) => rank(one) - rank(other) || one - other);
  }

  /** @param {number} radius */
  #insideFont(radius) {
    return this.theme.font(Math.min(Math.round(radius * 0.78), 20 * this.theme.zoom), 600);
  }

  /**
   * @param {CanvasRenderingContext2D} context
   * @param {number} index
   * @param {number} radius
   */
  #fitsInside(context, index, radius) {
    return (
      radius >= 13 &&
      this.motion.activity[index] !== CHARGE && // a bolt is there
      this.#widths.of(context, this.plan.robots[index].name, this.#insideFont(radius)) <
        radius * 1.7
    );
  }

  /**
   * @param {CanvasRenderingContext2D} context
   * @param {number} index
   * @param {number} radius
   */
  #inside(context, index, radius) {
    const { name } = this.plan.robots[index];
    const activity = this.motion.activity[index];
    const hollow = ![DRIVE, WORK, TURN].includes(activity);
    const [x, y] = this.#at(index);
    context.globalAlpha = this.choice.standsOut(index) ? 1 : 0.4;
    context.font = this.#insideFont(radius);
    context.textAlign = "center";
    context.textBaseline = "middle";
    const ink = hollow ? this.theme.ink : this.inks[index];
    if (activity === BROKEN) haloed(context, name, x, y + 1, ink, this.theme.floor, 5);
    else {
      context.fillStyle = ink;
      context.fillText(name, x, y + 1);
    }
    context.globalAlpha = 1;
    const half = this.#widths.of(context, name, context.font) / 2;
    this.written.push({ name, box: [x - half, y - radius * 0.4, x + half, y + radius * 0.4] });
  }

  /**
   * Beside its disc: where it was if that is free, rather not over the name of a place, a mark or a route.
   * While time runs on, a name changes its side only for another robot. In a crowd it covers none of these.
   *
   * @param {CanvasRenderingContext2D} context
   * @param {number} index
   * @param {number} radius
   * @param {boolean} isCrowd
   */
  #beside(context, index, radius, isCrowd) {
    const name = cut(this.plan.robots[index].name);
    const type = ROBOT_TYPE * this.theme.zoom;
    const font = this.theme.font(type, 600);
    const width = this.#widths.of(context, name, font);
    const [x, y] = this.#at(index);
    const away = Math.max(
      this.#isHome(index) ? this.sizes.homeOf(this.plan.robots[index]) : 0,
      radius + (this.#isChosen(index) ? 5 : 0),
    );
    const change = this.clock.playing ? 9 : 1;
    let [best, least] = [-1, Infinity];
    /** @type {Box | null} */
    let box = null;
    for (let step = 0; step < SIDES.length; step++) {
      const side = (this.#sides[index] + step) % SIDES.length;
      const there = boxBeside(x, y, away, width, type + 2, SIDES[side]);
      if (!this.#robots.isFree(...there)) continue;
      const covered =
        (this.places.names.isFree(...there) ? 0 : 3) +
        (this.places.marks.isFree(...there) ? 0 : 2) +
        (this.places.routes.isFree(...there) ? 0 : 2);
      if (isCrowd && covered && !this.#isChosen(index)) continue;
      const cost = covered + (step ? change : 0);
      if (cost < least) [best, least, box] = [side, cost, there];
      if (least <= (step ? change : change - 1)) break;
    }
    if (!box && !this.#isChosen(index)) return;
    if (box) this.#sides[index] = best;
    else box = this.#overOthers(SIDES.map((side) => boxBeside(x, y, away, width, type + 2, side)));
    this.#robots.take(...box);
    context.font = font;
    context.globalAlpha = this.choice.standsOut(index) ? 1 : 0.6;
    this.#write(
      context,
      name,
      box,
      this.motion.activity[index] === DONE ? this.theme.muted : this.theme.ink,
    );
    context.globalAlpha = 1;
  }

  /**
   * Where the name of a chosen robot stands in a crowd: over other robots, but over no other name.
   *
   * @param {Box[]} boxes
   */
  #overOthers(boxes) {
    /**
     * @param {Box} box
     * @param {{ box: Box }} it
     */
    const covers = (box, it) =>
      box[0] < it.box[2] && it.box[0] < box[2] && box[1] < it.box[3] && it.box[1] < box[3];
    const { width, height } = this.#robots;
    const inside = boxes.filter(
      ([left, top, right, bottom]) => left >= 0 && top >= 0 && right <= width && bottom <= height,
    );
    return (
      inside.find((box) => !this.written.some((it) => covers(box, it))) ?? inside[0] ?? boxes[0]
    );
  }

  /** @param {number} index */
  #isHome(index) {
    const { x, y } = this.plan.roadmap;
    const { home } = this.plan.robots[index];
    return (
      Math.hypot(this.motion.x[index] - x[home], this.motion.y[index] - y[home]) *
        this.viewport.scale <
      3
    );
  }

  /**
   * @param {CanvasRenderingContext2D} context
   * @param {string} name
   * @param {Box} box
   * @param {string} ink
   */
  #write(context, name, box, ink) {
    context.textAlign = "left";
    context.textBaseline = "middle";
    haloed(context, name, box[0], (box[1] + box[3]) / 2 + 0.5, ink, this.theme.floor, 3.5);
    this.written.push({ name, box });
  }
}
