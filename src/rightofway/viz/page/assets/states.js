"use strict";

const DISC = '<circle cx="8" cy="8" r="4" fill="currentColor" stroke="none"/>';
const SIGNS = [
  '<circle cx="8" cy="8" r="5" fill="currentColor" stroke="none"/>',
  '<circle cx="8" cy="8" r="4.2" stroke-width="1.8"/>',
  `${DISC}<path d="M8 1.5a6.5 6.5 0 1 1-6.4 7.6"/>`,
  `${DISC}<path d="M8 1.5a6.5 6.5 0 0 1 5 2.3M8 14.5a6.5 6.5 0 0 1-5-2.3"/>`,
  '<circle cx="8" cy="8" r="5" fill="currentColor" stroke="none" opacity=".38"/>',
];

/** How many robots do what now; the legend of the map at the same time. */
class States {
  #counts;

  constructor(motion) {
    this.motion = motion;
    this.#counts = ACTIVITY_WORDS.map(() => element("b"));
    const digits = String(motion.plan.robots.length).length;
    for (const count of this.#counts) count.style.minWidth = `${digits}ch`; // or the layout would move with the count
    const rows = ACTIVITY_WORDS.map((word, activity) => {
      const sign = document.createElementNS("http://www.w3.org/2000/svg", "svg");
      sign.setAttribute("viewBox", "0 0 16 16");
      sign.setAttribute("aria-hidden", "true");
      sign.innerHTML = SIGNS[activity]; // our own constants only
      return element("li", {}, sign, word, this.#counts[activity]);
    });
    document.getElementById("states").replaceChildren(...rows);
  }

  refresh() {
    this.#counts.forEach((count, activity) => {
      count.textContent = this.motion.counts[activity];
    });
  }
}
