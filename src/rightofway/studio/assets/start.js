/** How one begins: a new floor by its size, a file, what was left as a draft, an example. */

import { html, useEffect, useRef, useState } from "./vendor/htm-preact.js";
import { isUnnamed } from "./document.js";
import { nameOf } from "./fault_place.js";
import { Gallery, ago } from "./gallery.js";
import { words } from "./words.js";
/** @import { DraftEntry, ExampleEntry, FileEntry } from "./api_types.js" */
/** @import { CardData, Props, ScenarioDocument } from "./types.js" */
/** @import { PageEvent } from "./vendor/htm-preact.js" */

const FORMAT = "rightofway-scenario/1";
const UNITS = { length: "m", time: "s" };

/**
 * An empty floor.
 * @param {{width: number, height: number, cell: number, isAdaptive: boolean}} floor
 * @returns {ScenarioDocument}
 */
function newFloor({ width, height, cell, isAdaptive }) {
  const cells = isAdaptive ? { cell_size: "adaptive", smallest: cell } : { cell_size: cell };
  return {
    format: FORMAT,
    map: { floor: { size: [width, height], obstacles: [] }, ...cells },
    units: UNITS,
    robots: [],
    rules: { walls: "strict" },
  };
}

/**
 * A roadmap with one lane, to go on from.
 * @returns {ScenarioDocument}
 */
const newRoadmap = () => ({
  format: FORMAT,
  map: {
    roadmap: { vertices: { V1: [0, 0], V2: [4, 0] }, edges: [["V1", "V2"]] },
    y: "up",
  },
  units: UNITS,
  robots: [],
});

/** @param {Props} props */
export function Start({ studio }) {
  const { complaints, about, shelf } = studio;
  const { drafts, examples, files, waiting } = shelf;
  /** @param {string} folder */
  const titleOf = (folder) =>
    folder
      ? html`<span class="hint">${about.folder} / </span>${folder.replaceAll("/", " / ")}`
      : words.inFolder({ name: about.folder ?? "" });
  return html`
    <main class="start">
      <h2 class="title">${words.startTitle}</h2>
      ${complaints.length > 0 && html`<div class="wrong" role="alert">${complaints.map((fault) => html`<p>${nameOf(fault) && html`<b>${nameOf(fault)}</b>: `}<span lang="en">${fault.message}</span></p>`)}${waiting && html`<p>${words.pictureMissing}</p>`}</div>`}
      <div class="choices">
        <${NewFloor} studio=${studio} />
        <section aria-labelledby="open-title">
          <h3 id="open-title">${words.openTitle}</h3>
          <label class="drop-zone"><span>${words.drop}</span><span class="framed">${words.choose}</span>
            <input type="file" multiple aria-label=${words.choose} onChange=${(event) => shelf.take(event.target.files ?? [])} /></label>
          <p class="hint">${words.formats}</p>
        </section>
      </div>
      ${
        drafts.length > 0 &&
        html`<section class="shelf" aria-labelledby="drafts-title"><h3 id="drafts-title">${words.draftsTitle}</h3>
        <${Gallery} documents=${drafts.map(draftCard)} open=${(/** @type {CardData} */ { name }) => shelf.openDraft(name)} remove=${(/** @type {CardData} */ { name }) => shelf.removeDraft(name)} /></section>`
      }
      ${byFolder(files).map(
        ([folder, inside]) => html`
      <section class="shelf" key=${folder} aria-label=${words.inFolder({ name: folder || (about.folder ?? "") })}><h3>${titleOf(folder)}</h3>
        <${Gallery} documents=${inside.map(fileCard)} open=${(/** @type {CardData} */ { name }) => shelf.open(name)} /></section>`,
      )}
      ${
        examples.length > 0 &&
        html`<section class="shelf" aria-labelledby="examples-title"><h3 id="examples-title">${words.examplesTitle}</h3>
        <${Gallery} documents=${examples.map(exampleCard)} open=${(/** @type {CardData} */ { name }) => shelf.openExample(name)} /></section>`
      }
    </main>`;
}

/**
 * @param {DraftEntry} draft
 * @returns {CardData}
 */
const draftCard = ({ name, saved }) => ({
  source: "drafts",
  name,
  revision: saved,
  title: isUnnamed(name) ? words.unnamed : name,
  note: ago(saved),
});

/**
 * @param {FileEntry} file
 * @returns {CardData}
 */
const fileCard = ({ path, modified }) => ({
  source: "files",
  name: path,
  revision: modified,
  title: path.slice(path.lastIndexOf("/") + 1),
});

/**
 * @param {ExampleEntry} example
 * @returns {CardData}
 */
const exampleCard = ({ name }) => ({
  source: "examples",
  name,
  revision: "",
  title: words.examples[name] ?? words.paperCase({ name: name.split("/").at(-1) ?? name }),
});

/**
 * Files that can be opened, by their folders: those at the top first.
 * @param {FileEntry[]} files
 * @returns {[string, FileEntry[]][]}
 */
function byFolder(files) {
  /** @type {Map<string, FileEntry[]>} */
  const folders = new Map();
  for (const file of files) {
    if (file.kind === "picture") continue;
    const folder = file.path.split("/").slice(0, -1).join("/");
    folders.set(folder, [...(folders.get(folder) ?? []), file]);
  }
  return [...folders].sort(([one], [other]) => one.localeCompare(other));
}

/** @param {Props} props */
function NewFloor({ studio }) {
  const [floor, setFloor] = useState({ width: 12, height: 8, cell: 0.5, isAdaptive: false });
  const button = useRef(null);
  useEffect(() => {
    if (document.activeElement === document.body) button.current.focus({ preventScroll: true });
  }, []);
  /**
   * @param {"width" | "height" | "cell"} key
   * @param {string} text
   * @param {string} least
   * @param {string} [hint]
   */
  const number = (key, text, least, hint = "") => html`
    <label title=${hint}>${text}<span><input type="number" required min=${least} step="any" value=${floor[key]} onInput=${(event) => setFloor({ ...floor, [key]: Number(event.target.value) })} /> m</span></label>`;
  /**
   * @param {PageEvent} event
   * @returns {void}
   */
  const create = (event) => {
    event.preventDefault();
    studio.open({ document: newFloor(floor), tool: "line" });
  };
  return html`
    <section aria-labelledby="new-title">
      <h3 id="new-title">${words.newFloor}</h3>
      <form class="fields" onSubmit=${create}>
        ${number("width", words.width, "0.1")}${number("height", words.height, "0.1")}${number("cell", words.cellSize, "0.01", words.cellHint)}
        <label class="check"><input type="checkbox" checked=${floor.isAdaptive} onChange=${(event) => setFloor({ ...floor, isAdaptive: event.target.checked })} /> ${words.adaptive}</label>
        <div class="buttons"><button type="submit" class="framed strong" ref=${button}>${words.create}</button>
        <button type="button" class="framed" onClick=${() => studio.open({ document: newRoadmap(), tool: "lane" })}>${words.newRoadmap}</button></div>
      </form>
    </section>`;
}
