/** What is said about the map: what is selected, its size, what was found on it. */

import { liesIn } from "../fault_place.js";
import { AboutMap, Findings } from "../findings.js";
import { PlanButton } from "../header.js";
import { html } from "../vendor/htm-preact.js";
import { Field } from "../field.js";
import { words } from "../words.js";
import { BackdropPanel } from "./backdrop.js";
import { withoutKey } from "./network.js";
import { LanePanel, VertexPanel, ZoneList } from "./network_panel.js";
import { obstaclesOf, withObstacles } from "./ground.js";
import { numberOf } from "./places.js";
/** @import { ScenarioStore } from "../document.js" */
/** @import { MapData, Numeral, Props, RulesData } from "../types.js" */

/** @param {Props} props */
export function MapPanel({ studio }) {
  const { store, editor } = studio;
  const { map } = store.document;
  const elsewhere = map.layout ?? map.file;
  return html`
    <div class="scroll">
      ${
        elsewhere &&
        html`<div class="aside"><p>${words.mapElsewhere({ file: elsewhere })}</p>
        <button type="button" class="framed" onClick=${() => studio.shelf.inline()} disabled=${store.faults.length > 0}>${words.drawOnIt}</button></div>`
      }
      <${Selected} studio=${studio} />
      <${Size} studio=${studio} />
      ${editor.fitting.includes("lane") && html`<${ZoneList} studio=${studio} />`}
      <${Findings} studio=${studio} />
      <${BackdropPanel} studio=${studio} />
      <${AboutMap} key=${store.opened} studio=${studio} />
    </div>
    <div class="next">${
      Array.isArray(store.document.robots) && !store.document.robots.length
        ? html`<button type="button" class="framed strong" onClick=${() => studio.showTab("robots")}>${words.nextRobots}</button>`
        : html`<${PlanButton} studio=${studio} text=${words.nextPlan} />`
    }</div>`;
}

/**
 * Size and cells, where the document has them.
 * @param {Props} props
 */
function Size({ studio }) {
  const { store } = studio;
  const { map, units = {} } = store.document;
  const { floor } = map;
  /**
   * @param {Partial<MapData>} change
   * @returns {void}
   */
  const setMap = (change) =>
    store.change((document) => ({ ...document, map: { ...document.map, ...change } }));
  const unit = units.length ?? "";
  const hasCells = map.layout
    ? store.site !== null && ("rows" in store.site.map || Boolean(store.site.map.sides))
    : !map.roadmap;
  const place = map.floor ? ["map", "floor"] : ["map"];
  /**
   * @param {string} text
   * @param {Numeral} value
   * @param {(value: number) => void} set
   */
  const number = (
    text,
    value,
    set,
  ) => html`<label>${text}<span><${Field} type="number" min="0.01" step="any" value=${numberOf(value) || ""} placeholder=${Number.isNaN(numberOf(value, 0)) ? value : ""}
    onChange=${({ target }) => target.value && target.reportValidity() && set(Number(target.value))} /> ${unit}</span></label>`;
  const wrong = store.faults.filter(
    (fault) => liesIn(fault, ...place) || liesIn(fault, "map", "cell_size"),
  );
  return html`
    <section><h2>${words.size}</h2>
      <div class="fields">
        ${
          floor &&
          html`${number(words.width, floor.size[0], (width) => setMap({ floor: { ...floor, size: [width, floor.size[1]] } }))}
          ${number(words.height, floor.size[1], (height) => setMap({ floor: { ...floor, size: [floor.size[0], height] } }))}`
        }
        ${
          map.cell_size === "adaptive"
            ? number(words.smallest, map.smallest ?? "", (smallest) => setMap({ smallest }))
            : hasCells &&
              number(words.cellSize, map.cell_size ?? 1, (size) => setMap({ cell_size: size }))
        }
        ${!hasCells && number(words.spacing, map.spacing ?? "", (spacing) => setMap({ spacing }))}
        <label>${words.units}<select value=${unit} onChange=${({ target }) => store.change((document) => ({ ...document, units: { ...document.units, length: target.value } }))}>
          ${["", "mm", "cm", "m"].map((name) => html`<option value=${name} disabled=${!name}>${name || words.noUnit}</option>`)}</select></label>
      </div>
      ${(map.grid || map.floor) && html`<${StrictWalls} store=${store} />`}
      ${wrong.map(({ message }) => html`<p class="wrong" lang="en">${message}</p>`)}
    </section>`;
}

/**
 * Whether robots that are wider than a cell keep their distance from walls.
 * @param {{store: ScenarioStore}} props
 */
function StrictWalls({ store }) {
  const { rules } = store.document;
  if (typeof rules === "string") return null; // rules by name
  /**
   * @param {{target: HTMLInputElement}} event
   * @returns {void}
   */
  const toggle = ({ target }) =>
    store.change((document) => {
      const { walls, ...rest } = /** @type {RulesData} */ (document.rules ?? {});
      if (target.checked) return { ...document, rules: { ...rest, walls: "strict" } };
      return Object.keys(rest).length
        ? { ...document, rules: rest }
        : withoutKey(document, "rules");
    });
  return html`<label class="check" title=${words.strictWallsHint}><input type="checkbox" checked=${rules?.walls === "strict"} onChange=${toggle} /> ${words.strictWalls}</label>`;
}

/**
 * What is selected on the map, and what can be done with it.
 * @param {Props} props
 */
function Selected({ studio }) {
  const { store, editor } = studio;
  const { selection } = editor;
  if (!selection.size) return null;
  const [vertices, lanes] = [selection.of("vertex"), selection.of("lane")];
  const known = store.document.map.floor?.obstacles ?? [];
  const [obstacle] = selection.of("obstacle");
  const isOne = selection.size === 1;
  const select = editor.tools.get("select");
  const canTurn = !isOne || ["obstacle", "lane"].includes(selection.items[0].kind);
  /**
   * @param {string} text
   * @param {() => void} action
   */
  const button = (text, action) =>
    html`<button type="button" class="framed" onClick=${action}>${text}</button>`;
  return html`
    <section class="selected"><h2>${words.selected({ count: selection.size })}</h2>
      ${
        isOne &&
        known[obstacle] &&
        html`<label class="wide">${words.name}<${Field} value=${known[obstacle].name ?? ""}
        onChange=${({ target }) =>
          store.change((document) =>
            withObstacles(
              document,
              obstaclesOf(document).map((each, i) =>
                i === obstacle ? { ...each, name: target.value } : each,
              ),
            ),
          )} /></label>`
      }
      ${isOne && vertices.length === 1 && html`<${VertexPanel} studio=${studio} name=${vertices[0]} />`}
      ${lanes.length > 0 && html`<${LanePanel} studio=${studio} lanes=${lanes} />`}
      <div class="buttons">
        ${button(words.duplicate, () => select.duplicate())}
        ${canTurn && button(words.turn, () => select.turn("turn"))}
        ${canTurn && button(words.mirror, () => select.turn("mirror"))}
        ${canTurn && button(words.flip, () => select.turn("flip"))}
        ${vertices.length > 1 && button(words.alignRow, () => select.align(1))}
        ${vertices.length > 1 && button(words.alignColumn, () => select.align(0))}
        ${button(words.remove, () => editor.remove())}
      </div>
    </section>`;
}
