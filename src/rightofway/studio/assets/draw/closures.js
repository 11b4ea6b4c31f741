/** Closed places and lanes: found, closed for a while or for ever, opened again. */

import { html } from "../vendor/htm-preact.js";
import { Field } from "../field.js";
import { words } from "../words.js";
import { endsOf, lanesOf, withoutKey } from "./network.js";
import { placeOf, vertexOf } from "./places.js";

const isAt = (closure, place, roadmap) => {
  if (!closure.edge !== !place.edge) return false;
  const ends = ({ at, edge }) => (edge ?? [at]).map((end) => vertexOf(end, roadmap));
  const [one, other] = [ends(closure), ends(place)];
  return one.every((end) => other.includes(end));
};

/** The place or the lane at a point of the map, as a closure names it; null where there is none. */
export function closableAt(editor, point) {
  const { hits, document, roadmap, stage } = editor;
  const hit = hits.at(point, stage.view.viewport.scale);
  if (hit?.kind === "lane") return { edge: endsOf(lanesOf(document)[hit.id]) };
  const vertex = editor.vertexAt(point);
  return vertex < 0 ? null : { at: placeOf(vertex, roadmap, document) };
}

const indexOf = ({ closures = [] }, place, roadmap) =>
  closures.findIndex((closure) => isAt(closure, place, roadmap));

/** Close a place or a lane; `times` may have `from` and `until`. */
function closed(document, place, roadmap, times) {
  const closures = [...(document.closures ?? [])];
  const index = indexOf(document, place, roadmap);
  if (index < 0) closures.push({ ...place, ...times });
  else {
    const { from, until, ...rest } = closures[index];
    closures[index] = { ...rest, ...times };
  }
  return { ...document, closures };
}

function opened(document, place, roadmap) {
  const index = indexOf(document, place, roadmap);
  const closures = (document.closures ?? []).filter((_, each) => each !== index);
  return closures.length ? { ...document, closures } : withoutKey(document, "closures");
}

/** A closure with one of its times as somebody has typed it: nothing for always. */
export const withTime = (closure, key, text) => withKey(closure, key, written(text));

/**
 * From when and until when something is closed: fields of a form, or with `write` fields of a `closure`.
 * `isWrong` says of each whether the library refuses it.
 */
export function Times({ document, isWrong, closure, write }) {
  const unit = document.units?.time ?? "";
  const given = (key) =>
    write && { value: closure[key] ?? "", onChange: ({ target }) => write(key, target.value) };
  const field = (key) =>
    html`<label>${words[key]}<span><${write ? Field : "input"} name=${key} inputmode="decimal" autocomplete="off" placeholder=${words.always[key]} aria-invalid=${String(isWrong(key))} ...${given(key)} /> ${unit}</span></label>`;
  return html`<div class="times">${field("from")}${field("until")}</div>`;
}

/** Whether a place or a lane is closed, and when. */
export function ClosureFields({ studio, place }) {
  const { store, stage } = studio;
  const { roadmap } = stage.plan;
  const index = indexOf(store.document, place, roadmap);
  const closure = store.document.closures?.[index];
  const faults = store.faultsAt(`closures[${index}]`);
  const toggle = () =>
    store.change((document) =>
      closure ? opened(document, place, roadmap) : withClosure(document, place),
    );
  const write = (key, text) =>
    store.change((document) => changeClosure(document, index, (each) => withTime(each, key, text)));
  const isWrong = (key) => isTimeWrong(faults, key);
  return html`
    <label class="check"><input type="checkbox" checked=${Boolean(closure)} onChange=${toggle} /> ${words.closed}</label>
    ${closure && html`<${Times} document=${store.document} closure=${closure} isWrong=${isWrong} write=${write} />`}
    ${closure && faults.map(({ message }) => html`<p class="wrong" role="alert" lang="en">${message}</p>`)}`;
}
