import { element } from "../common/dom.js";
import { texts } from "../language/language.js";

/** @import { TourData } from "../payload.d.ts" */
/** @import { Words } from "../language/words.js" */

const SVG = "http://www.w3.org/2000/svg";
const [WIDTH, HEIGHT] = [300, 60]; // units of the drawing, which fills its place

/**
 * The state of charge of a robot over the time of the plan, with charges and the reserve; pressing it
 * goes to that moment.
 *
 * @param {TourData} tour
 * @param {number} end
 * @param {Words} words
 * @param {(tick: number) => void} goTo
 */
export function chargeCurve({ items, charges = [], reserve = 0 }, end, words, goTo) {
  /** @param {number} tick */
  const x = (tick) => (tick / end) * WIDTH;
  /** @param {number} share */
  const y = (share) => (1 - share) * HEIGHT;
  const shares = charges.map(([, share]) => share);
  const [first, last, least] = [shares[0], shares.at(-1) ?? 0, Math.min(...shares)];
  const drawing = shape("svg", { viewBox: `0 0 ${WIDTH} ${HEIGHT}`, preserveAspectRatio: "none" });
  const label = texts.jobs.chargeAtLength({
    first: words.percent(first),
    last: words.percent(last),
    least: words.percent(least),
    reserve: words.percent(reserve),
  });
  drawing.setAttribute("role", "img");
  drawing.setAttribute("aria-label", label);
  for (const [job, , , begin, until] of items)
    if (job < 0)
      drawing.append(
        shape("rect", {
          class: "charge",
          x: x(begin),
          y: 0,
          width: x(until) - x(begin),
          height: HEIGHT,
        }),
      );
  drawing.append(
    shape("line", { class: "reserve", x1: 0, x2: WIDTH, y1: y(reserve), y2: y(reserve) }),
    shape("polyline", {
      class: "soc",
      points: charges.map(([tick, share]) => `${x(tick)},${y(share)}`).join(" "),
    }),
  );
  drawing.addEventListener("click", (event) => {
    const { left, width } = drawing.getBoundingClientRect();
    goTo(((event.clientX - left) / width) * end);
  });
  const marks = [1, 0].map((share) => element("span", {}, words.percent(share)));
  const note = element("p", { className: "note" }, label);
  return element(
    "figure",
    { className: "soc-curve" },
    element("div", { className: "marks" }, ...marks),
    drawing,
    note,
  );
}

/**
 * An element of a drawing.
 *
 * @param {string} tag
 * @param {Record<string, string | number>} attributes
 */
function shape(tag, attributes) {
  const made = document.createElementNS(SVG, tag);
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, String(value));
  return made;
}
