/** A fleet that is dealt out at random: the same seed gives the same robots. */

import { placeOf } from "../draw/places.js";
import { html, useState } from "../vendor/htm-preact.js";
import { words } from "../words.js";
import { addRobots } from "./fleet.js";

/** Numbers from 0 to 1 from a seed (mulberry32). */
function randomFrom(seed) {
  let state = seed >>> 0;
  return () => {
    state = (state + 0x6d2b79f5) >>> 0;
    let mixed = Math.imul(state ^ (state >>> 15), state | 1);
    mixed ^= mixed + Math.imul(mixed ^ (mixed >>> 7), mixed | 61);
    return ((mixed ^ (mixed >>> 14)) >>> 0) / 2 ** 32;
  };
}

/** The vertices that can be reached from one another, roughly: those round the vertex that reaches most. */
function largestPart(roadmap) {
  let best = [];
  const seen = new Set();
  for (let vertex = 0; vertex < roadmap.size && best.length * 2 < roadmap.size; vertex++) {
    if (seen.has(vertex)) continue;
    const part = new Set([vertex]);
    for (const at of part) for (const next of roadmap.next(at)) part.add(next);
    for (const at of part) seen.add(at);
    if (part.size > best.length) best = [...part];
  }
  return best;
}

/** Robots at homes that are free, each with a place to work at; homes at parking, work at stations where there are some. */
export function dealt(document, roadmap, taken, { count, seed, work, speed }) {
  const random = randomFrom(seed);
  const draw = (from) => from.splice(Math.floor(random() * from.length), 1)[0];
  const free = largestPart(roadmap).filter((vertex) => !taken.has(vertex));
  const parked = free.filter((vertex) => roadmap.parking.has(vertex) || roadmap.charging.has(vertex));
  const stations = free.filter((vertex) => roadmap.stations.has(vertex));
  const homes = free.filter((vertex) => !parked.includes(vertex));
  const goals = stations.length > 1 ? stations : [...free];
  const robots = [];
  for (let number = 0; number < count && parked.length + homes.length > 0; number++) {
    const home = draw(parked.length ? parked : homes);
    const others = goals.filter((goal) => goal !== home);
    if (!others.length) break;
    const target = others[Math.floor(random() * others.length)];
    robots.push({ home: placeOf(home, roadmap, document), target: placeOf(target, roadmap, document), ...(work ? { work } : {}), ...(speed && speed !== 1 ? { speed } : {}) });
  }
  return robots;
}

export function RandomFleet({ studio }) {
  const [wanted, setWanted] = useState({ count: 5, seed: 1, work: 5, speed: 1 });
  const number = (key, least, step) => html`<label>${words.random[key]}<input type="number" required min=${least} step=${step} value=${wanted[key]}
    onInput=${({ target }) => setWanted({ ...wanted, [key]: Number(target.value) })} /></label>`;
  const deal = (event) => {
    event.preventDefault();
    const { store, editor } = studio;
    const taken = new Set(editor.hits.robots.map(({ home }) => home));
    store.change((document) => addRobots(document, dealt(document, editor.roadmap, taken, wanted)));
    setWanted({ ...wanted, seed: wanted.seed + 1 });
  };
  return html`
    <details class="random"><summary>${words.randomFleet}</summary>
      <form class="fields" onSubmit=${deal}>${number("count", 1, 1)}${number("seed", 0, 1)}${number("work", 0, "any")}${number("speed", 0.01, "any")}
        <button type="submit" class="framed">${words.deal}</button></form>
    </details>`;
}
