/** Closed places and lanes: found, closed for a while or for ever, opened again. */

import { html } from "../vendor/htm-preact.js";
import { figure } from "../../../viz/page/assets/language/language.js";
import { Field } from "../field.js";
import { written } from "../robots/columns.js";
import { withKey } from "../robots/fleet.js";
import { words } from "../words.js";
import { endsOf, lanesOf, withoutKey } from "./network.js";
import { placeOf, textOfPlace, vertexOf } from "./places.js";
/** @import { Roadmap } from "../../../viz/page/assets/plan/roadmap.js" */
/** @import { ClosureData, Complaint, DrawingPoint, Props, ScenarioDocument, TimeKey } from "../types.js" */
/** @import { PageEvent } from "../vendor/htm-preact.js" */
/** @import { Editor } from "./editor.js" */

/**
 * @param {ClosureData} closure
 * @param {ClosureData} place
 * @param {Roadmap} roadmap
 * @returns {boolean}
 */
const isAt = (closure, place, roadmap) => {
  if (!closure.edge !== !place.edge) return false;
  /**
   * @param {ClosureData} closure
   * @returns {number[]}
   */
  const ends = ({ at, edge }) => (edge ?? [at]).map((end) => vertexOf(end, roadmap));
  const [one, other] = [ends(closure), ends(place)];
  return one.every((end) => other.includes(end));
};

/**
 * The place or the lane at a point of the map, as a closure names it; null where there is none.
 * @param {Editor} editor
 * @param {DrawingPoint} point
 * @returns {ClosureData | null}
 */
export function closableAt(editor, point) {
  const { hits, document, roadmap, stage } = editor;
  const hit = hits.at(point, stage.view.viewport.scale);
  if (hit?.kind === "lane") return { edge: endsOf(lanesOf(document)[hit.id]) };
  const vertex = editor.vertexAt(point);
  return vertex < 0 ? null : { at: placeOf(vertex, roadmap, document) };
}

/**
 * A document in which something more is closed: a place `at`, or a lane by its ends as `edge`.
 * @param {ScenarioDocument} document
 * @param {ClosureData} closure
 * @returns {ScenarioDocument}
 */
export const withClosure = (document, closure) => ({
  ...document,
  closures: [...(document.closures ?? []), closure],
});

/**
 * @param {ScenarioDocument} document
 * @param {number} index
 * @returns {ScenarioDocument}
 */
export function withoutClosure(document, index) {
  const left = (document.closures ?? []).filter((_, each) => each !== index);
  return left.length ? { ...document, closures: left } : withoutKey(document, "closures");
}

/**
 * A closure with one of its times, `from` or `until`, as it was typed: nothing for always.
 * @param {ClosureData} closure
 * @param {TimeKey} key
 * @param {string} text
 * @returns {ClosureData}
 */
export const withTime = (closure, key, text) => withKey(closure, key, written(text));

/**
 * A document with such a time of one of its closures.
 * @param {ScenarioDocument} document
 * @param {number} index
 * @param {TimeKey} key
 * @param {string} text
 * @returns {ScenarioDocument}
 */
export const changeTime = (document, index, key, text) => ({
  ...document,
  closures: document.closures?.map((closure, each) =>
    each === index ? withTime(closure, key, text) : closure,
  ),
});

/**
 * "N3", or "A – B" for a lane.
 * @param {ClosureData} closure
 * @returns {string}
 */
export const textOfClosure = ({ at, edge }) => (edge ?? [at]).map(textOfPlace).join(" – ");

/**
 * From when and until when something is closed: fields of a form, or with `write` those of a
 * `closure`. Fields whose `faults` the library has found are marked.
 * @param {{document: ScenarioDocument, faults: Complaint[], closure?: ClosureData, write?: (key: TimeKey, text: string) => void, of?: string}} props
 */
export function Times({ document, faults, closure, write, of = "" }) {
  const unit = document.units?.time ?? "";
  /** @param {TimeKey} key */
  const given = (key) =>
    write && {
      value: figure(String(closure?.[key] ?? "")),
      onChange: (/** @type {PageEvent} */ { target }) => write(key, target.value),
    };
  /**
   * @param {TimeKey} key
   * @returns {boolean}
   */
  const isWrong = (key) => faults.some(({ path }) => path?.[2] === key);
  /** @param {TimeKey} key */
  const field = (key) =>
    html`<label>${words[key]}<span>
      <${write ? Field : "input"} name=${key} aria-label=${of && `${of}: ${words[key]}`}
      inputmode="decimal" autocomplete="off" placeholder=${words.always[key]}
      aria-invalid=${String(isWrong(key))} ...${given(key)} /> ${unit}</span></label>`;
  return html`<div class="times">${field("from")}${field("until")}</div>`;
}

/**
 * Whether a place or a lane is closed, and when.
 * @param {Props & {place: ClosureData}} props
 */
export function ClosureFields({ studio, place }) {
  const { store, stage } = studio;
  const { closures = [] } = store.document;
  const index = closures.findIndex((each) => isAt(each, place, stage.plan.roadmap));
  const faults = store.faultsAt("closures", index);
  const isClosed = index >= 0;
  const toggle = () =>
    store.change((document) =>
      isClosed ? withoutClosure(document, index) : withClosure(document, place),
    );
  /**
   * @param {TimeKey} key
   * @param {string} text
   * @returns {void}
   */
  const write = (key, text) => store.change((document) => changeTime(document, index, key, text));
  return html`
    <label class="check"><input type="checkbox" checked=${isClosed} onChange=${toggle} /> ${words.closed}</label>
    ${isClosed && html`<${Times} document=${store.document} faults=${faults} closure=${closures[index]} write=${write} />`}
    ${isClosed && faults.map(({ message }) => html`<p class="wrong" role="alert" lang="en">${message}</p>`)}`;
}
