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
  toggleUse,
} from "./network.js";

export function VertexPanel({ studio, name }) {
  const { store } = studio;
  const { stations = {}, parking = [], charging = [] } = store.document.map.roadmap;
  const station = Object.entries(stations).find(([, at]) => at === name)?.[0] ?? "";
  const check = (text, isOn, change) =>
    html`<label class="check"><input type="checkbox" checked=${isOn} onChange=${() => store.change(change)} /> ${text}</label>`;
  const rename = ({ target }) => {
    const after = target.value.trim();
    store.change((document) => renameVertex(document, name, after));
    studio.editor.select([
      { kind: "vertex", id: after in store.document.map.roadmap.vertices ? after : name },
    ]);
  };
  return html`
    <div class="fields">
      <label>${words.name}<${Field} value=${name} onChange=${rename} /></label>
      <label>${words.station}<${Field} value=${station} onChange=${({ target }) => store.change((document) => nameStation(document, name, target.value.trim()))} /></label>
      ${check(words.parking, parking.includes(name), (document) => toggleUse(document, "parking", name))}
      ${check(words.charging, charging.includes(name), (document) => toggleUse(document, "charging", name))}
      <${ClosureFields} studio=${studio} place=${{ at: name }} />
    </div>`;
}

export function LanePanel({ studio, lanes }) {
  const { store } = studio;
  const all = lanesOf(store.document);
  const known = lanes.filter((index) => all[index]);
  if (!known.length) return null;
  const first = asMapping(all[known[0]]);
  const set = (key, value) => store.change((document) => changeLanes(document, known, key, value));
  const wrong = known.flatMap((index) => store.faultsAt(`map.roadmap.edges[${index}]`));
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
        ${words.shapes.map((name, bends) => html`<option value=${String(bends)}>${name}</option>`)}</select></label>
      <${ClosureFields} studio=${studio} place=${{ edge: endsOf(first) }} />
    </div>
    ${known.length === 1 && html`<p class="hint">${words.bendHint}</p>`}
    ${wrong.map(({ message }) => html`<p class="wrong" lang="en">${message}</p>`)}`;
}

const BEND = 0.5; // how far control points are beside the straight line, in parts of its length

/** The document with lanes that have some bends: none, one to the left, or one to each side. */
function bent(document, lanes, bends) {
  let next = document;
  for (const index of lanes) {
    const [tail, head] = endsOf(lanesOf(document)[index]).map((name) =>
      positionOf(document.map.roadmap.vertices[name]),
    );
    const along = [head[0] - tail[0], head[1] - tail[1]];
    const beside = (share, side) => [
      tail[0] + along[0] * share - along[1] * side * BEND,
      tail[1] + along[1] * share + along[0] * side * BEND,
    ];
    const controls = [[], [beside(0.5, 1)], [beside(1 / 3, 1), beside(2 / 3, -1)]][bends];
    next = bendLane(next, index, controls);
  }
  return next;
}

export function ZoneList({ studio }) {
  const { store, editor } = studio;
  const zones = store.document.map.roadmap.zones ?? [];
  const [vertices, lanes] = ["vertex", "lane"].map((kind) => editor.selection.of(kind));
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
