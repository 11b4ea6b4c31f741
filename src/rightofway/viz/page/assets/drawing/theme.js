import { Observable } from "../common/observable.js";
import { Root } from "../common/root.js";

/** The page's colours for drawing on a canvas. Event: `theme` when light turns dark. */
export class Theme extends Observable {
  paper = "";
  panel = "";
  floor = "";
  wall = "";
  line = "";
  ink = "";
  muted = "";
  heatLow = "";
  heatHigh = "";
  drive = "";
  wait = "";
  work = "";
  turn = "";
  held = "";
  broken = "";
  lit = "";
  litEdge = "";
  zone = "";
  sans = "";
  zoom = 1; // of names on a map

  /** @param {Root} [root] whose colours, those of the page by default */
  constructor(root = new Root(document.body)) {
    super();
    this.root = root;
    this.#read();
    root.listen(matchMedia("(prefers-color-scheme: dark)"), "change", () => this.refresh());
  }

  /** Read the colours again. */
  refresh() {
    this.#read();
    this.tell("theme");
  }

  #read() {
    const style = getComputedStyle(this.root.top);
    for (const [name, property] of THEME_COLOURS)
      this[name] = style.getPropertyValue(property).trim();
    this.sans = style.getPropertyValue("--sans");
    this.zoom = Number(style.getPropertyValue("--map-zoom")) || 1;
  }

  /**
   * @param {number} size
   * @param {number} [weight]
   */
  font(size, weight = 400) {
    return `${weight} ${size}px ${this.sans}`;
  }
}

/** The fields above and the properties of the style sheet that they are read from. */
const THEME_COLOURS = /** @type {const} */ ([
  ["paper", "--paper"],
  ["panel", "--panel"],
  ["floor", "--floor"],
  ["wall", "--wall"],
  ["line", "--line"],
  ["ink", "--ink"],
  ["muted", "--muted"],
  ["heatLow", "--heat-low"],
  ["heatHigh", "--heat-high"],
  ["drive", "--drive"],
  ["wait", "--wait"],
  ["work", "--work"],
  ["turn", "--turn"],
  ["held", "--held"],
  ["broken", "--broken"],
  ["lit", "--lit"],
  ["litEdge", "--lit-edge"],
  ["zone", "--zone"],
]);

/**
 * The channels of "#rrggbb", 0 to 255.
 *
 * @param {string} colour
 */
function channels(colour) {
  const number = Number.parseInt(colour.slice(1), 16);
  return [number >> 16, (number >> 8) & 255, number & 255];
}

/**
 * The colour at `share` (0 to 1) of the way between two.
 *
 * @param {string} low
 * @param {string} high
 * @param {number} share
 */
export function blend(low, high, share) {
  const [from, to] = [channels(low), channels(high)];
  const mixed = from.map((start, i) => Math.round(start + (to[i] - start) * share));
  return `#${mixed.map((channel) => channel.toString(16).padStart(2, "0")).join("")}`;
}

/**
 * White or near-black, whichever reads better on a colour.
 *
 * @param {string} colour
 */
export function inkOn(colour) {
  const [red, green, blue] = channels(colour).map((channel) => (channel / 255) ** 2.2);
  return 0.2126 * red + 0.7152 * green + 0.0722 * blue > 0.25 ? "#16191d" : "#ffffff";
}
