import { Observable } from "./observable.js";

/** The page's colours for drawing on a canvas. Event: `theme` when light turns dark. */
export class Theme extends Observable {
  constructor() {
    super();
    this.#read();
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.refresh());
  }

  /** Read the colours again. */
  refresh() {
    this.#read();
    this.tell("theme");
  }

  #read() {
    const style = getComputedStyle(document.documentElement);
    for (const name of THEME_COLOURS) {
      this[name.replace(/-./g, (dash) => dash[1].toUpperCase())] = style
        .getPropertyValue(`--${name}`)
        .trim();
    }
    this.sans = style.getPropertyValue("--sans");
  }

  font(size, weight = 400) {
    return `${weight} ${size}px ${this.sans}`;
  }
}

const THEME_COLOURS = [
  "paper",
  "panel",
  "floor",
  "wall",
  "line",
  "ink",
  "muted",
  "heat-low",
  "heat-high",
  "drive",
  "wait",
  "work",
  "turn",
  "held",
  "broken",
  "lit",
  "lit-edge",
  "zone",
];

/** The channels of "#rrggbb", 0 to 255. */
function channels(colour) {
  const number = Number.parseInt(colour.slice(1), 16);
  return [number >> 16, (number >> 8) & 255, number & 255];
}

/** The colour at `share` (0 to 1) of the way between two. */
export function blend(low, high, share) {
  const [from, to] = [channels(low), channels(high)];
  const mixed = from.map((start, i) => Math.round(start + (to[i] - start) * share));
  return `#${mixed.map((channel) => channel.toString(16).padStart(2, "0")).join("")}`;
}

/** White or near-black, whichever reads better on a colour. */
export function inkOn(colour) {
  const [red, green, blue] = channels(colour).map((channel) => (channel / 255) ** 2.2);
  return 0.2126 * red + 0.7152 * green + 0.0722 * blue > 0.25 ? "#16191d" : "#ffffff";
}
