/** Batteries, which robots name, and the places where they charge. */

import { figure } from "../../../viz/page/assets/language/language.js";
import { textOfPlace } from "../draw/places.js";
import { Field } from "../field.js";
import { placesOfText, written } from "../robots/columns.js";
import { html } from "../vendor/htm-preact.js";
import { words } from "../words.js";
/** @import { BatteryData, Props, ScenarioDocument } from "../types.js" */

/** @type {(keyof BatteryData)[]} */
const SHARES = ["drive", "on", "work", "charge", "reserve"];

/**
 * A document with other batteries; none at all where there are none.
 * @param {ScenarioDocument} document
 * @param {[string, BatteryData][]} batteries
 * @returns {ScenarioDocument}
 */
function withBatteries(document, batteries) {
  const { batteries: before, ...rest } = document;
  return batteries.length ? { ...rest, batteries: Object.fromEntries(batteries) } : rest;
}

/**
 * A battery with another share; it is left out where nothing is written.
 * @param {BatteryData} battery
 * @param {keyof BatteryData} key
 * @param {string} text
 * @returns {BatteryData}
 */
function withShare(battery, key, text) {
  const { [key]: before, ...rest } = battery;
  const value = written(text);
  return value === undefined ? rest : { ...battery, [key]: value };
}

/** @param {Props} props */
export function Batteries({ studio }) {
  const { store } = studio;
  const batteries = Object.entries(store.document.batteries ?? {});
  const faults = store.faults.filter(({ path = [] }) =>
    ["batteries", "charging"].includes(String(path[0])),
  );
  /**
   * @param {number} at
   * @param {string} name
   * @param {BatteryData} battery
   * @returns {void}
   */
  const put = (at, name, battery) => {
    const next = [...batteries];
    next.splice(at, 1, ...(name ? [/** @type {[string, BatteryData]} */ ([name, battery])] : []));
    store.change((document) => withBatteries(document, next));
  };
  /**
   * @param {string} text
   * @returns {void}
   */
  const charge = (text) =>
    store.change(({ charging, ...rest }) => {
      const places = placesOfText(text);
      return places.length ? { ...rest, charging: places } : rest;
    });
  /**
   * @param {[string, BatteryData]} battery
   * @param {number} at
   */
  const row = ([name, battery], at) => html`<tr key=${at}>
    <td><${Field} value=${name} aria-label=${name ? `${words.battery}, ${name}` : words.newBattery} placeholder=${name ? "" : words.newBattery} spellcheck="false"
      onChange=${({ target }) => put(at, target.value.trim(), battery)} /></td>
    ${SHARES.map(
      (
        key,
      ) => html`<td><${Field} value=${figure(String(battery[key] ?? ""))} placeholder="0" disabled=${!name} aria-label=${`${words.batteryShares[key][0]}, ${name || words.newBattery}`} title=${words.batteryShares[key][1]}
      onChange=${({ target }) => put(at, name, withShare(battery, key, target.value))} /></td>`,
    )}
  </tr>`;
  return html`<details class="batteries" open=${batteries.length > 0}>
    <summary>${words.batteries}</summary>
    <table class="robots">
      <thead><tr><th scope="col">${words.battery}</th>${SHARES.map((key) => html`<th scope="col" title=${words.batteryShares[key][1]}>${words.batteryShares[key][0]}</th>`)}</tr></thead>
      <tbody>${[...batteries, /** @type {[string, BatteryData]} */ (["", {}])].map(row)}</tbody>
    </table>
    ${faults.map(({ message }) => html`<p class="wrong" role="alert" lang="en">${message}</p>`)}
    <label class="charging">${words.chargingPlaces}
      <${Field} value=${(store.document.charging ?? []).map(textOfPlace).join("; ")} spellcheck="false" title=${words.chargingHint} onChange=${({ target }) => charge(target.value)} /></label>
    <p class="hint small">${words.batteryHint}</p>
  </details>`;
}
