/** A fleet that is dealt out at random: the same seed gives the same robots. */

import { post } from "../api.js";
import { placeOf, vertexOf } from "../draw/places.js";
import { html, useState } from "../vendor/htm-preact.js";
import { words } from "../words.js";
import { addRobots, writtenIn } from "./fleet.js";
/** @import { Studio } from "../studio.js" */
/** @import { Place, Props } from "../types.js" */
/** @import { PageEvent } from "../vendor/htm-preact.js" */

const FEW = 3;

/**
 * Add robots that the server deals out; homes of robots that are there already are left to them.
 * @param {Studio} studio
 * @param {{count: number, seed: number, work: number, speed: number, between: "stations" | "anywhere"}} fleet
 * @returns {Promise<void>}
 */
async function deal({ store, editor }, { count, seed, work, speed, between }) {
  const { document, folder } = store;
  const { roadmap } = editor;
  const taken = new Set(writtenIn(document).map(({ home }) => vertexOf(home, roadmap)));
  const request = {
    document,
    folder,
    robots: count + taken.size,
    seed,
    speeds: [speed],
    work: [work, work],
    between,
  };
  /**
   * @param {string} name
   * @returns {Place}
   */
  const place = (name) => placeOf(roadmap.vertexNamed(name), roadmap, document);
  const { robots } = await post("/deal", request);
  const news = robots
    .filter(({ home }) => !taken.has(roadmap.vertexNamed(home)))
    .slice(0, count)
    .map(({ home, target, ...rest }) => ({
      home: place(home),
      target: place(target),
      ...(rest.work ? { work: rest.work } : {}), // no work is 0, as in a file
      speed: rest.speed,
    }));
  store.change((now) => (now === document ? addRobots(now, news) : now));
}

/**
 * Whether the map says where robots work.
 * @param {Studio} studio
 * @returns {boolean}
 */
const hasStations = ({ editor }) => editor.isReady && editor.roadmap.stations.size > 0;

/**
 * Three robots with one press, for whoever wants to see them drive.
 * @param {Props} props
 */
export function FewRobots({ studio }) {
  const count = writtenIn(studio.store.document).length;
  const between = hasStations(studio) ? "stations" : "anywhere";
  /** @type {Parameters<typeof deal>[1]} */
  const few = { count: FEW, seed: count + 1, work: 0, speed: 1, between };
  return html`<button type="button" class="framed" disabled=${!studio.editor.isReady} onClick=${() => studio.attempt(() => deal(studio, few))}>${words.dealFew({ count: FEW, between })}</button>`;
}

/** @param {Props} props */
export function RandomFleet({ studio }) {
  const [wanted, setWanted] = useState({ count: 5, seed: 1, work: 0, speed: 1, isAnywhere: false });
  /**
   * @param {"count" | "seed" | "work" | "speed"} key
   * @param {number} least
   * @param {number | string} step
   */
  const number = (
    key,
    least,
    step,
  ) => html`<label>${words.random[key]}<input type="number" required min=${least} step=${step} value=${wanted[key]}
    onInput=${({ target }) => setWanted({ ...wanted, [key]: Number(target.value) })} /></label>`;
  /**
   * @param {PageEvent} event
   * @returns {void}
   */
  const submit = (event) => {
    event.preventDefault();
    const { isAnywhere, ...fleet } = wanted;
    const between = hasStations(studio) && !isAnywhere ? "stations" : "anywhere";
    studio.attempt(() => deal(studio, { ...fleet, between }));
    setWanted({ ...wanted, seed: wanted.seed + 1 });
  };
  return html`
    <details class="random"><summary>${words.randomFleet}</summary>
      <form class="fields" onSubmit=${submit}>${number("count", 1, 1)}${number("seed", 0, 1)}${number("work", 0, 1)}${number("speed", 0.01, "any")}
        ${hasStations(studio) && html`<label class="check"><input type="checkbox" checked=${!wanted.isAnywhere} onChange=${({ target }) => setWanted({ ...wanted, isAnywhere: !target.checked })} /> ${words.betweenStations}</label>`}
        <button type="submit" class="framed">${words.deal}</button></form>
    </details>`;
}
