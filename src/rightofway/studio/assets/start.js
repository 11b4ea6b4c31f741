/** How one begins: a new floor by its size, a file, what was left as a draft. */

import { html, useState } from "./vendor/htm-preact.js";
import { words } from "./words.js";

const FORMAT = "rightofway-scenario/1";
const UNITS = { length: "m", time: "s" };

/** An empty floor. */
export function newFloor({ width, height, cell, isAdaptive }) {
  const cells = isAdaptive ? { cell_size: "adaptive", smallest: cell } : { cell_size: cell };
  return {
    format: FORMAT,
    map: { floor: { size: [width, height], obstacles: [] }, ...cells },
    units: UNITS,
    robots: [],
  };
}

/** A roadmap with one lane, to go on from. */
const newRoadmap = () => ({
  format: FORMAT,
  map: { roadmap: { vertices: { V1: [0, 0], V2: [4, 0] }, edges: [["V1", "V2"]] }, y: "up" },
  units: UNITS,
  robots: [],
});

export function Start({ studio }) {
  const { files, drafts, complaints, about } = studio;
  return html`
    <main class="start">
      <h2 class="title">${words.startTitle}</h2>
      ${complaints.length > 0 && html`<p class="wrong" role="alert">${complaints.map(({ named, place, message }) => html`${named || place ? html`<b>${named || place}</b>: ` : ""}${message} `)}</p>`}
      <div class="choices">
        <${NewFloor} studio=${studio} />
        <section aria-labelledby="open-title">
          <h3 id="open-title">${words.openTitle}</h3>
          <label class="drop-zone">${words.drop}<span class="framed">${words.choose}</span>
            <input type="file" multiple onChange=${(event) => studio.take(event.target.files)} /></label>
          <p class="hint">${words.formats}</p>
          ${
            files.length > 0 &&
            html`<h4>${words.inFolder(about.folder)}</h4>
            <ul class="files">${files
              .filter(({ kind }) => kind !== "picture")
              .map(
                ({ path, kind }) => html`
              <li><button type="button" onClick=${() => studio.attempt(() => studio.openFile(path))}><span class="name">${path}</span> <small>${words.kinds[kind] ?? kind}</small></button></li>`,
              )}</ul>`
          }
        </section>
        ${
          drafts.length > 0 &&
          html`<section aria-labelledby="drafts-title">
          <h3 id="drafts-title">${words.draftsTitle}</h3>
          <ul class="files">${drafts.slice(0, 12).map(({ name }) => html`<li><button type="button" onClick=${() => studio.openDraft(name)}><span class="name">${name}</span></button></li>`)}</ul>
        </section>`
        }
      </div>
    </main>`;
}

function NewFloor({ studio }) {
  const [floor, setFloor] = useState({ width: 12, height: 8, cell: 0.5, isAdaptive: false });
  const number = (key, text, least) => html`
    <label>${text}<span><input type="number" required min=${least} step="any" value=${floor[key]} onInput=${(event) => setFloor({ ...floor, [key]: Number(event.target.value) })} /> m</span></label>`;
  const create = (event) => {
    event.preventDefault();
    studio.open({ document: newFloor(floor), tool: "line" });
  };
  return html`
    <section aria-labelledby="new-title">
      <h3 id="new-title">${words.newFloor}</h3>
      <form class="fields" onSubmit=${create}>
        ${number("width", words.width, "0.1")}${number("height", words.height, "0.1")}${number("cell", words.cellSize, "0.01")}
        <label class="check"><input type="checkbox" checked=${floor.isAdaptive} onChange=${(event) => setFloor({ ...floor, isAdaptive: event.target.checked })} /> ${words.adaptive}</label>
        <div class="buttons"><button type="submit" class="framed strong">${words.create}</button>
        <button type="button" class="framed" onClick=${() => studio.open({ document: newRoadmap(), tool: "lane" })}>${words.newRoadmap}</button></div>
      </form>
    </section>`;
}
