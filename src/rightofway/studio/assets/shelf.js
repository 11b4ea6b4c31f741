/** Files, drafts and examples: what there is, opened, dropped, saved. */

import { get, inAddress, post, put, remove, sameAs, upload } from "./api.js";
import { isUnnamed } from "./document.js";
import { liesAt } from "./fault_place.js";
import { words } from "./words.js";
import { present } from "./given.js";
/** @import { Refusal } from "./api.js" */
/** @import { DraftEntry, ExampleEntry, FileEntry } from "./api_types.js" */
/** @import { Studio } from "./studio.js" */
/** @import { DroppedFile, Found } from "./types.js" */

const PICTURES = /\.(png|pgm|jpe?g|bmp)$/i;
const MOST_DROPPED = 200; // files of a folder that is dropped

export class Shelf {
  /** @type {FileEntry[]} */
  files = [];
  /** @type {DraftEntry[]} */
  drafts = [];
  /** @type {ExampleEntry[]} */
  examples = [];
  waiting = ""; // a file that cannot be opened before its picture is there

  /** @param {Studio} studio */
  constructor(studio) {
    this.studio = studio;
  }

  async list() {
    const [{ files }, { drafts }, { examples }] = await Promise.all([
      get("/files"),
      get("/drafts"),
      get("/examples"),
    ]);
    this.files = files;
    this.drafts = drafts;
    this.examples = examples;
    this.studio.tell("change");
  }

  /**
   * Open a file; where what was drawn on it since is newer, that is opened.
   * @param {string} path
   * @returns {Promise<unknown>}
   */
  open(path) {
    const draft = this.drafts.find(({ name }) => name === path);
    const file = this.files.find((each) => each.path === path);
    const open = () => this.studio.attempt(() => this.#open(path));
    if (!draft || draft.saved < (file?.modified ?? 0)) return open();
    return this.openDraft(path).then(() =>
      this.studio.notices.say(words.draftIsNewer({ name: path }), words.openSaved, open),
    );
  }

  /**
   * A plan is played, a layout becomes the map of a new scenario.
   * @param {string} path
   * @returns {Promise<void>}
   */
  async #open(path) {
    const { studio } = this;
    const found = await get(`/documents/${inAddress(path)}`);
    this.waiting = "";
    if (found.run) {
      studio.runs.add(found.run);
      const { document, folder } = await get(`/runs/${found.run.number}/document`);
      studio.open({ document, folder, origin: ["file", path] });
      studio.store.names.add(found.run.source);
      await studio.runs.show(found.run.number);
      studio.showTab("plan");
      return;
    }
    const isNew = found.kind === "layout";
    const stem = (found.save_as ?? path).replace(/(\.[a-z]+)+$/i, "");
    const name = isNew ? await this.#freeName(`${stem}.scenario`) : path;
    const document = present(found.document);
    /** @type {Partial<Found>} */
    const made = isNew ? { revision: "", origin: ["file", path] } : {};
    studio.open({ ...found, document, ...made, path: name });
  }

  /**
   * @param {string} name
   * @returns {Promise<void>}
   */
  openExample(name) {
    return this.studio.attempt(async () => {
      const { document } = await get(`/examples/${inAddress(name)}`);
      this.studio.open({ document, suggested: name.split("/").at(-1), origin: ["example", name] });
    });
  }

  /**
   * @param {string} name
   * @returns {Promise<void>}
   */
  openDraft(name) {
    return this.studio.attempt(async () => {
      const { document, revision: known } = await get(`/drafts/${inAddress(name)}`);
      const isFile = this.files.some(({ path }) => path === name);
      const folder = name.includes("/") ? name.slice(0, name.lastIndexOf("/")) : "";
      this.studio.open({
        document,
        folder,
        path: isUnnamed(name) ? "" : name,
        revision: isFile ? null : "",
        draft: name,
        known,
      });
    });
  }

  /**
   * @param {string} name
   * @returns {Promise<void>}
   */
  removeDraft(name) {
    return this.studio.attempt(async () => {
      const address = /** @type {const} */ (`/drafts/${inAddress(name)}`);
      const { document } = await get(address);
      await remove(address);
      await this.list();
      this.studio.notices.say(words.draftRemoved, words.undo, async () => {
        await put(address, { document });
        await this.list();
      });
    });
  }

  /**
   * Take in files that were dropped or chosen, each with its path, and open the first that can be.
   * @param {Iterable<DroppedFile>} files
   * @param {{replace?: boolean}} [options]
   * @returns {Promise<void>}
   */
  take(files, { replace = false } = {}) {
    return this.studio.attempt(async () => {
      const given = [...files].slice(0, MOST_DROPPED);
      const others = [];
      for (const file of given) if (!(await this.#put(file, replace))) others.push(file);
      await this.list();
      const { notices, about } = this.studio;
      if (others.length) {
        const text = words.otherContent({ names: others.map(pathOf).join(", ") });
        notices.say(text, words.replace, () => this.take(given, { replace: true }));
        return;
      }
      try {
        await this.#openTaken(given.find(({ name }) => !PICTURES.test(name)) ?? given[0], given);
      } finally {
        notices.say(
          words.putIntoFolder({ names: given.map(pathOf).join(", "), folder: about.folder ?? "" }),
        );
      }
    });
  }

  /**
   * @param {DroppedFile} first
   * @param {DroppedFile[]} given
   * @returns {Promise<void>}
   */
  async #openTaken(first, given) {
    const path = this.waiting && PICTURES.test(first.name) ? this.waiting : pathOf(first);
    if (given.length > 1 && given.some((file) => pathOf(file).includes("/"))) {
      await this.studio.toStart(); // a folder: all of it is listed there
      return;
    }
    try {
      await this.#open(path);
    } catch (error) {
      const refusal = /** @type {Refusal} */ (error);
      const isAlone = refusal.faults?.some((fault) => liesAt(fault, "image"));
      this.waiting = isAlone ? path : "";
      throw refusal;
    }
  }

  /**
   * Put a file into the folder; false where a file of that name has another content.
   * @param {DroppedFile} file
   * @param {boolean} replace
   * @returns {Promise<boolean>}
   */
  async #put(file, replace) {
    const path = pathOf(file);
    try {
      await upload(file, path, { replace });
    } catch (error) {
      const refusal = /** @type {Refusal} */ (error);
      if (refusal.status !== 412) throw refusal;
      return sameAs(file, path);
    }
    return true;
  }

  /** Put map and robots into the document that are in other files, so that they can be changed. */
  inline() {
    return this.studio.attempt(async () => {
      const { document, folder } = this.studio.store;
      const { document: whole } = await post("/inline", { document, folder });
      this.studio.store.change((now) => (now === document ? whole : now));
    });
  }

  save() {
    return this.studio.attempt(async () => {
      const { store } = this.studio;
      if (!store.path) store.rename(await this.#freeName(this.studio.suggested || words.newName));
      await store.save();
      await this.list();
      this.studio.notices.say(words.savedAs({ name: store.path }));
    });
  }

  /**
   * A name that no file has: floor.yaml, floor2.yaml, ...
   * @param {string} stem
   * @returns {Promise<string>}
   */
  async #freeName(stem) {
    await this.list();
    const taken = new Set(this.files.map(({ path }) => path));
    let [name, number] = [`${stem}.yaml`, 2];
    while (taken.has(name)) name = `${stem}${number++}.yaml`;
    return name;
  }
}

/**
 * Where a file goes: those of a folder that was dropped keep their folder.
 * @param {DroppedFile} file
 * @returns {string}
 */
const pathOf = (file) => file.path ?? (file.webkitRelativePath || file.name);

/**
 * The files of a drop, also those in folders that were dropped: `File`s with a `path`. Entries are told
 * apart by their flags, for Chromium has no class `FileSystemEntry` to compare with.
 * @param {DataTransfer} dropped
 * @returns {Promise<DroppedFile[]>}
 */
export async function droppedFiles({ items, files }) {
  const entries = [...items]
    .map((item) => item.webkitGetAsEntry?.() ?? null)
    .filter((entry) => entry !== null);
  if (!entries.some(({ isDirectory }) => isDirectory)) return [...files];
  /** @type {DroppedFile[]} */
  const found = [];
  /**
   * @param {FileSystemEntry} entry
   * @returns {Promise<void>}
   */
  const visit = async (entry) => {
    if (found.length >= MOST_DROPPED || entry.name.startsWith(".")) return;
    if (entry.isFile) {
      const leaf = /** @type {FileSystemFileEntry} */ (entry);
      /** @type {File} */
      const file = await new Promise((done, fail) => leaf.file(done, fail));
      if (OPENED.test(file.name))
        found.push(Object.assign(file, { path: entry.fullPath.slice(1) }));
      return;
    }
    const reader = /** @type {FileSystemDirectoryEntry} */ (entry).createReader();
    /** @returns {Promise<FileSystemEntry[]>} */
    const read = () => new Promise((done, fail) => reader.readEntries(done, fail));
    for (let part = await read(); part.length; part = await read())
      for (const each of part) await visit(each);
  };
  for (const entry of entries) await visit(entry);
  return found;
}

const OPENED = /\.(ya?ml|json|xls[xm]|xml|graphml|geojson|csv|map|scen|txt|png|pgm|jpe?g|bmp)$/i;
