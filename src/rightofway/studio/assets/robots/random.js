/** A fleet that is dealt out at random: the same seed gives the same robots. */

import { post } from "../api.js";
import { placeOf, vertexOf } from "../draw/places.js";
import { html, useState } from "../vendor/htm-preact.js";
import { words } from "../words.js";
import { addRobots, robotsOf } from "./fleet.js";

/** Add robots that the server deals out; homes of robots that are there already are left to them. */
async function deal({ store, editor }, { count, seed, work, speed }) {
  const { document, folder } = store;
  const { roadmap } = editor;
  const taken = new Set(robotsOf(document).map(({ home }) => vertexOf(home, roadmap)));
  const request = {
    document,
    folder,
    robots: count + taken.size,
    seed,
    speeds: [speed],
    work: [work, work],
  };
  const place = (name) => placeOf(roadmap.vertexNamed(name), roadmap, document);
  const { robots } = await post("/deal", request);
  const news = robots
    .filter(({ home }) => !taken.has(roadmap.vertexNamed(home)))
    .slice(0, count)
    .map(({ home, target, ...rest }) => ({
      home: place(home),
      target: place(target),
      work: rest.work,
      speed: rest.speed,
    }));
  store.change((now) => (now === document ? addRobots(now, news) : now));
}

export function RandomFleet({ studio }) {
  const [wanted, setWanted] = useState({ count: 5, seed: 1, work: 5, speed: 1 });
  const number = (
    key,
    least,
    step,
  ) => html`<label>${words.random[key]}<input type="number" required min=${least} step=${step} value=${wanted[key]}
    onInput=${({ target }) => setWanted({ ...wanted, [key]: Number(target.value) })} /></label>`;
  const submit = (event) => {
    event.preventDefault();
    studio.attempt(() => deal(studio, wanted));
    setWanted({ ...wanted, seed: wanted.seed + 1 });
  };
  return html`
    <details class="random"><summary>${words.randomFleet}</summary>
      <form class="fields" onSubmit=${submit}>${number("count", 1, 1)}${number("seed", 0, 1)}${number("work", 0, 1)}${number("speed", 0.01, "any")}
        <button type="submit" class="framed">${words.deal}</button></form>
    </details>`;
}
