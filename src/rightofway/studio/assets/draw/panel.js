/** What is said about the map: what is selected, its size, faults and findings in the library's words. */

import { html } from "../vendor/htm-preact.js";
import { words } from "../words.js";
import { BackdropPanel } from "./backdrop.js";
import { LanePanel, VertexPanel, ZoneList } from "./network_panel.js";
import { withObstacles } from "./ground.js";
import { numberOf } from "./places.js";

export function MapPanel({ studio }) {
  const { store, editor, notes } = studio;
  const { map } = store.document;
  const elsewhere = map.layout ?? map.file;
  return html`
    <div class="scroll">
      ${
        elsewhere &&
        html`<div class="aside"><p>${words.mapElsewhere(elsewhere)}</p>
        <button type="button" class="framed" onClick=${() => studio.inline()} disabled=${!store.survey.ok}>${words.drawOnIt}</button></div>`
      }
      <${Selected} studio=${studio} />
      <${Size} studio=${studio} />
      ${editor.fitting.includes("lane") && html`<${ZoneList} studio=${studio} /><${BackdropPanel} studio=${studio} />`}
      <${Faults} studio=${studio} />
      ${[...notes, ...store.survey.notes].length > 0 && html`<details class="notes"><summary>${words.notes}</summary><ul>${[...new Set([...notes, ...store.survey.notes])].map((note) => html`<li>${note}</li>`)}</ul></details>`}
    </div>
    ${
      Array.isArray(store.document.robots) &&
      !store.document.robots.length &&
      html`<div class="next">
      <button type="button" class="framed strong" onClick=${() => studio.showTab("robots")}>${words.nextRobots}</button></div>`
    }`;
}

/** Faults, then findings, the worst first; pressing one lights its places. */
function Faults({ studio }) {
  const { store, stage } = studio;
  const { findings, sentences } = store.survey;
  const light = (names) => {
    const { roadmap } = stage.plan;
    const vertices = names.map((name) => roadmap.vertexNamed(name)).filter((vertex) => vertex >= 0);
    stage.choice.light(vertices);
    if (vertices.length)
      stage.view.viewport.showAll(vertices.map((vertex) => [roadmap.x[vertex], roadmap.y[vertex]]));
  };
  return html`
    <section>
      <h2 id="faults-title">${words.findings}</h2>
      ${
        store.faults.length > 0 &&
        html`<ul class="findings" role="alert">${store.faults.map(
          (fault) => html`
        <li><button type="button" onClick=${() => studio.goTo(fault.place)}><span class="severity error" aria-hidden="true">✕</span><span><b>${fault.named || fault.place}</b> ${fault.message}</span></button></li>`,
        )}</ul>`
      }
      ${
        findings.length > 0 &&
        html`<ul class="findings">${findings.map(
          (finding) => html`
        <li><button type="button" onClick=${() => light(finding.vertices)}><span class=${`severity ${finding.severity}`} role="img" aria-label=${finding.severity}>${{ error: "✕", warning: "!", note: "i" }[finding.severity]}</span>
          <span>${finding.fact}<br /><small>${finding.remedy}</small></span></button></li>`,
        )}</ul>`
      }
      ${!store.faults.length && !findings.length && html`<p class="hint">${words.nothingFound}</p>`}
      <p class="hint">${sentences.join(" ")}</p>
    </section>`;
}

/** Size and cells, where the document has them. */
function Size({ studio }) {
  const { store } = studio;
  const { map, units = {} } = store.document;
  const setMap = (change) =>
    store.change((document) => ({ ...document, map: { ...document.map, ...change } }));
  const unit = units.length ?? "";
  const place = map.floor ? "map.floor" : "map";
  const number = (
    text,
    value,
    set,
  ) => html`<label>${text}<span><input type="number" min="0.01" step="any" value=${numberOf(value) || ""} placeholder=${Number.isNaN(numberOf(value, 0)) ? value : ""}
    onChange=${({ target }) => target.reportValidity() && set(Number(target.value))} /> ${unit}</span></label>`;
  const wrong = store.faultsAt(place).concat(store.faultsAt("map.cell_size"));
  return html`
    <section><h2>${words.size}</h2>
      <div class="fields">
        ${
          map.floor &&
          html`${number(words.width, map.floor.size[0], (width) => setMap({ floor: { ...map.floor, size: [width, map.floor.size[1]] } }))}
          ${number(words.height, map.floor.size[1], (height) => setMap({ floor: { ...map.floor, size: [map.floor.size[0], height] } }))}`
        }
        ${
          map.cell_size === "adaptive"
            ? number(words.smallest, map.smallest ?? "", (smallest) => setMap({ smallest }))
            : !map.roadmap &&
              number(words.cellSize, map.cell_size ?? 1, (size) => setMap({ cell_size: size }))
        }
        ${(map.roadmap || map.layout) && !map.cell_size && number(words.spacing, map.spacing ?? "", (spacing) => setMap({ spacing }))}
        <label>${words.units}<select value=${unit} onChange=${({ target }) => store.change((document) => ({ ...document, units: { ...document.units, length: target.value } }))}>
          ${["", "mm", "cm", "m"].map((name) => html`<option value=${name} disabled=${!name}>${name}</option>`)}</select></label>
      </div>
      ${wrong.map(({ message }) => html`<p class="wrong">${message}</p>`)}
    </section>`;
}

/** What is selected on the map, and what can be done with it. */
function Selected({ studio }) {
  const { store, editor } = studio;
  const { selection } = editor;
  if (!selection.size) return null;
  const [vertices, lanes, obstacles] = ["vertex", "lane", "obstacle"].map((kind) =>
    selection.of(kind),
  );
  const known = store.document.map.floor?.obstacles ?? [];
  const [obstacle] = obstacles;
  const isOne = selection.size === 1;
  return html`
    <section class="selected"><h2>${words.selected(selection.size)}</h2>
      ${
        isOne &&
        known[obstacle] &&
        html`<label class="wide">${words.name}<input value=${known[obstacle].name ?? ""}
        onChange=${({ target }) =>
          store.change((document) =>
            withObstacles(
              document,
              document.map.floor.obstacles.map((each, i) =>
                i === obstacle ? { ...each, name: target.value } : each,
              ),
            ),
          )} /></label>`
      }
      ${isOne && vertices.length === 1 && html`<${VertexPanel} studio=${studio} name=${vertices[0]} />`}
      ${lanes.length > 0 && html`<${LanePanel} studio=${studio} lanes=${lanes} />`}
      <div class="buttons">
        <button type="button" class="framed" onClick=${() => editor.tools.get("select").duplicate()}>${words.duplicate}</button>
        <button type="button" class="framed" onClick=${() => editor.remove()}>${words.remove}</button>
      </div>
    </section>`;
}
