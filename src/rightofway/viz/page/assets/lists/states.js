import { element } from "../common/dom.js";
import { texts } from "../language/language.js";
import { BROKEN, CHARGE, DONE, HELD } from "../plan/phases.js";

/** @import { Root } from "../common/root.js" */
/** @import { Choice } from "../player/choice.js" */
/** @import { Motion } from "../plan/motion.js" */

const DISC = '<circle cx="8" cy="8" r="4" fill="currentColor" stroke="none"/>';
const SIGNS = [
  '<circle cx="8" cy="8" r="5" fill="currentColor" stroke="none"/>',
  '<circle cx="8" cy="8" r="4.2" stroke-width="1.8"/>',
  `${DISC}<path d="M8 1.5a6.5 6.5 0 1 1-6.4 7.6"/>`,
  `${DISC}<path d="M8 1.5a6.5 6.5 0 0 1 5 2.3M8 14.5a6.5 6.5 0 0 1-5-2.3"/>`,
  '<circle cx="8" cy="8" r="5" fill="currentColor" stroke="none" opacity=".38"/>',
  '<circle cx="8" cy="8" r="4.2" stroke-width="1.8"/><path d="M11 5a4.2 4.2 0 1 1-6 6z" fill="currentColor" stroke="none"/>',
  '<circle cx="8" cy="8" r="4.2" stroke-width="1.8"/><path d="M3 3l10 10M3 13L13 3" stroke-width="1.8"/>',
  '<path d="M9.500 1.500 3.500 9h4l-1 5.500 6-7.500h-4z" fill="currentColor" stroke="none"/>',
];
const GHOST_SIGN = '<circle cx="8" cy="8" r="5" stroke-dasharray="2.6 2.63" stroke-width="1.3"/>';

/** How many robots do what now; the legend of the map at the same time. */
export class States {
  #counts;

  /**
   * @param {Root} root
   * @param {Motion} motion
   * @param {Choice} choice
   * @param {boolean} [isShift] whether robots that are done get other jobs later
   */
  constructor(root, motion, choice, isShift = false) {
    this.root = root;
    this.motion = motion;
    this.choice = choice;
    this.#counts = texts.activities.map(() => element("b"));
    const digits = String(motion.fleet.robots.length).length;
    for (const count of this.#counts) count.style.minWidth = `${digits}ch`; // or the layout would move with the count
    this.rows = texts.activities.map((word, activity) =>
      element(
        "li",
        {},
        sign(SIGNS[activity]),
        isShift && activity === DONE ? texts.shift.idle : word,
        this.#counts[activity],
      ),
    );
    this.ghost = element("li", {}, sign(GHOST_SIGN), texts.byPlan);
    root.part("states").replaceChildren(...this.rows, this.ghost);
    for (const event of ["mode", "fleet"]) choice.on(event, () => this.#suit());
    this.#suit();
  }

  /** Show the signs that may be on the map. */
  #suit() {
    for (const activity of [HELD, BROKEN, CHARGE]) {
      this.rows[activity].hidden = !this.motion.fleet.robots.some(({ phases }) =>
        phases.activity.includes(activity),
      );
    }
    this.ghost.hidden = !this.choice.ghosts;
  }

  refresh() {
    this.#counts.forEach((count, activity) => {
      count.textContent = String(this.motion.counts[activity]);
    });
  }
}

/**
 * A sign of the legend, from one of the constants above.
 *
 * @param {string} markup
 */
function sign(markup) {
  const made = document.createElementNS("http://www.w3.org/2000/svg", "svg");
  made.setAttribute("viewBox", "0 0 16 16");
  made.setAttribute("aria-hidden", "true");
  made.innerHTML = markup;
  return made;
}
