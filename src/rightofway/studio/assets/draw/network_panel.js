/** Vertices, lanes, zones and closures of a roadmap, as fields. */

import { html } from "../vendor/htm-preact.js";
import { Field } from "../field.js";
import { words } from "../words.js";
import { ClosureFields } from "./closures.js";
import {
  addZone,
  asMapping,
  bendLane,
  changeLanes,
  endsOf,
  lanesOf,
  nameStation,
  positionOf,
  removeZone,
  renameVertex,
  isPassed,
  togglePass,
  toggleUse,
  roadmapOf,
} from "./network.js";
/** @import { Edit, LaneMapping, Point, Props, ScenarioDocument, ZoneData } from "../types.js" */

/** @param {Props & {name: string}} props */
export function VertexPanel({ studio, name }) {
  const { store } = studio;
  const { stations = {}, parking = [], charging = [] } = roadmapOf(store.document);
  const station = Object.entries(stations).find(([, at]) => at === name)?.[0] ?? "";
  /**
   * @param {string} text
   * @param {boolean} isOn
   * @param {Edit} change
   */
  const check = (text, isOn, change) =>
    html`<label class="check"><input type="checkbox" checked=${isOn} onChange=${() => store.change(change)} /> ${text}</label>`;
  /**
   * @param {{target: HTMLInputElement}} event
   * @returns {void}
   */
  const rename = ({ target }) => {
    const after = target.value.trim();
    store.change((document) => renameVertex(document, name, after));
    studio.editor.select([
      { kind: "vertex", id: after in roadmapOf(store.document).vertices ? after : name },
    ]);
  };
  return html`
    <div class="fields">
      <label>${words.name}<${Field} value=${name} onChange=${rename} /></label>
      <label>${words.station}<${Field} value=${station} onChange=${({ target }) => store.change((document) => nameStation(document, name, target.value.trim()))} /></label>
      ${check(words.parking, parking.includes(name), (document) => toggleUse(document, "parking", name))}
      ${check(words.charging, charging.includes(name), (document) => toggleUse(document, "charging", name))}
      ${check(words.passed, isPassed(store.document, name), (document) => togglePass(document, name))}
      <${ClosureFields} studio=${studio} place=${{ at: name }} />
    </div>`;
}

/** @param {Props & {lanes: number[]}} props */
export function LanePanel({ studio, lanes }) {
  const { store } = studio;
  const all = lanesOf(store.document);
  const known = lanes.filter((index) => all[index]);
  if (!known.length) return null;
  const first = asMapping(all[known[0]]);
  /**
   * @template {keyof LaneMapping} Key
   * @param {Key} key
   * @param {LaneMapping[Key]} value
   * @returns {void}
   */
  const set = (key, value) => store.change((document) => changeLanes(document, known, key, value));
  const wrong = known.flatMap((index) => store.faultsAt("map", "roadmap", "edges", index));
  return html`
    <p class="hint">${known
      .slice(0, 4)
      .map((index) =>
        endsOf(all[index]).join(asMapping(all[index]).both_ways === false ? " → " : " ↔ "),
      )
      .join(", ")}</p>
    <div class="fields">
      <label class="check"><input type="checkbox" checked=${first.both_ways ?? true} onChange=${({ target }) => set("both_ways", target.checked ? undefined : false)} /> ${words.bothWays}</label>
      <label>${words.maxSpeed}<${Field} type="number" min="0.01" step="any" value=${first.max_speed ?? ""} onChange=${({ target }) => set("max_speed", target.value === "" ? undefined : Number(target.value))} /></label>
      <label>${words.shape}<select value=${String(first.curve?.length ?? 0)} onChange=${({ target }) => store.change((document) => bent(document, known, Number(target.value)))}>
        ${words.shapes.map((/** @type {string} */ name, /** @type {number} */ bends) => html`<option value=${String(bends)}>${name}</option>`)}</select></label>
      <${ClosureFields} studio=${studio} place=${{ edge: endsOf(first) }} />
    </div>
    ${known.length === 1 && html`<p class="hint">${words.bendHint}</p>`}
    ${wrong.map(({ message }) => html`<p class="wrong" lang="en">${message}</p>`)}`;
}

const BEND = 0.5; // how far control points are beside the straight line, in parts of its length

/**
 * The document with lanes that have some bends: none, one to the left, or one to each side.
 * @param {ScenarioDocument} document
 * @param {number[]} lanes
 * @param {number} bends
 * @returns {ScenarioDocument}
 */
function bent(document, lanes, bends) {
  let next = document;
  for (const index of lanes) {
    const [tail, head] = endsOf(lanesOf(document)[index]).map((name) =>
      positionOf(roadmapOf(document).vertices[name]),
    );
    const along = [head[0] - tail[0], head[1] - tail[1]];
    /**
     * @param {number} share
     * @param {number} side
     * @returns {Point}
     */
    const beside = (share, side) => [
      tail[0] + along[0] * share - along[1] * side * BEND,
      tail[1] + along[1] * share + along[0] * side * BEND,
    ];
    const controls = [[], [beside(0.5, 1)], [beside(1 / 3, 1), beside(2 / 3, -1)]][bends];
    next = bendLane(next, index, controls);
  }
  return next;
}

/** @param {Props} props */
export function ZoneList({ studio }) {
  const { store, editor } = studio;
  const zones = roadmapOf(store.document).zones ?? [];
  const [vertices, lanes] = [editor.selection.of("vertex"), editor.selection.of("lane")];
  /**
   * @param {ZoneData} zone
   * @returns {void}
   */
  const lit = ({ vertices: names = [] }) =>
    editor.select(names.map((id) => ({ kind: "vertex", id })));
  return html`
    <section><h2>${words.zones}</h2>
      <ul class="rows">${zones.map(
        (
          zone,
          index,
        ) => html`<li><button type="button" class="link" onClick=${() => lit(zone)}>${zone.name}</button>
        <button type="button" class="quiet" aria-label=${`${words.remove}: ${zone.name}`} onClick=${() => store.change((document) => removeZone(document, index))}>✕</button></li>`,
      )}</ul>
      <button type="button" class="framed" disabled=${vertices.length + lanes.length < 1} onClick=${() => store.change((document) => addZone(document, vertices, lanes))}>${words.zoneOfSelected}</button>
    </section>`;
}
