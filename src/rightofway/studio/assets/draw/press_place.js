/** A place or a lane that somebody presses on the map that is shown, a plan's too. */

import { placeOf } from "./places.js";
/** @import { Roadmap } from "../../../viz/page/assets/plan/roadmap.js" */
/** @import { Stage } from "../stage.js" */
/** @import { Studio } from "../studio.js" */
/** @import { Place } from "../types.js" */
/** @import { PageEvent } from "../vendor/htm-preact.js" */

const STILL = 4; // pixels that a press may move
const REACH = 12; // pixels round a lane

/**
 * Wait for one press; resolves with the places as a document names them: one, both ends of a lane,
 * or none for Escape and for a signal that gives up.
 * @param {Studio} studio
 * @param {AbortSignal} signal
 * @returns {Promise<Place[]>}
 */
export function pressedPlace({ stage, store }, signal) {
  const { holder } = stage;
  const waiting = new AbortController();
  /**
   * @param {EventTarget} target
   * @param {string} name
   * @param {(event: PageEvent) => void} action
   * @returns {void}
   */
  const on = (target, name, action) =>
    target.addEventListener(name, /** @type {(event: Event) => void} */ (action), {
      capture: true,
      signal: waiting.signal,
    });
  const shows = (/** @type {boolean} */ isPicking) => {
    stage.isPicking = isPicking;
    holder.classList.toggle("picking", isPicking);
  };
  /**
   * @param {boolean} isPicking
   * @returns {void}
   */
  shows(true);
  return new Promise((resolve) => {
    /** @type {PageEvent | null} */
    let began = null;
    /**
     * @param {Place[]} places
     * @returns {void}
     */
    const end = (places) => {
      waiting.abort();
      shows(false);
      resolve(places);
    };
    signal.addEventListener("abort", () => end([]), { signal: waiting.signal });
    on(holder, "pointerdown", (event) => (began = event));
    on(holder, "pointerup", (event) => {
      const way = began
        ? Math.hypot(event.clientX - began.clientX, event.clientY - began.clientY)
        : 0;
      if (way > STILL) return; // the map was moved
      const places = placesAt(stage, event);
      if (!places.length) return;
      event.stopPropagation(); // the robot that is chosen stays so
      stage.giveUp(event);
      end(places.map((vertex) => placeOf(vertex, stage.plan.roadmap, store.document)));
    });
    on(document, "keydown", (event) => {
      if (event.key !== "Escape") return;
      event.stopPropagation();
      end([]);
    });
  });
}

/**
 * The vertex at an event, or both ends of the lane there.
 * @param {Stage} stage
 * @param {{clientX: number, clientY: number}} at
 * @returns {readonly number[]}
 */
function placesAt({ holder, view, plan: { roadmap } }, { clientX, clientY }) {
  const { left, top } = holder.getBoundingClientRect();
  const { viewport } = view;
  const [x, y] = [viewport.toX(clientX - left), viewport.toY(clientY - top)];
  const vertex = roadmap.near(x, y);
  if (vertex >= 0) return [vertex];
  const lanes = roadmap.lanes ? [...roadmap.lanes.bothWays, ...roadmap.lanes.oneWay] : [];
  return lanes.find((ends) => distanceTo(roadmap, ends, x, y) * viewport.scale < REACH) ?? [];
}

/**
 * @param {Roadmap} roadmap
 * @param {readonly number[]} ends
 * @param {number} px
 * @param {number} py
 * @returns {number}
 */
function distanceTo({ x, y }, [tail, head], px, py) {
  const [right, down] = [x[head] - x[tail], y[head] - y[tail]];
  const along =
    ((px - x[tail]) * right + (py - y[tail]) * down) / (right * right + down * down || 1);
  const share = Math.min(Math.max(along, 0), 1);
  return Math.hypot(px - x[tail] - right * share, py - y[tail] - down * share);
}
