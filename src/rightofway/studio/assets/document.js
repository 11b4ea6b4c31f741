/** The scenario that is edited: plain data, undo and redo, a draft, and what the library says about it. */

import { Observable } from "../../viz/page/assets/common/observable.js";
import { UNREACHABLE, get, inAddress, post, put, remove } from "./api.js";
import { connection } from "./connection.js";
import { Latest } from "./latest.js";
import { liesAt, liesIn } from "./fault_place.js";
import { later, present } from "./given.js";
/** @import { Refusal } from "./api.js" */
/** @import { DocumentFault, SurveyData } from "./api_types.js" */
/** @import { Edit, Found, ScenarioDocument, SitePayload } from "./types.js" */

const CHANGED = 412; // the status of a draft that another page has changed
const RETRY = 3000; // pause before what could not be kept is sent again [ms]
const MANY = 2000; // vertices from which on findings come after the map

/** @type {SurveyData} */
const UNKNOWN = Object.freeze({
  ok: true,
  faults: [],
  notes: [],
  site: null,
  findings: [],
  sentences: [],
  phrases: [],
});

/**
 * A document is never changed: an edit makes another one that shares what stays. So undo is a list.
 * Events: `document` when another one is shown, then `open`, `edit`, `undo` or `redo` if it is by these;
 * `survey` when the library has looked at it, `findings` when those of a large map come after that; `kept` when
 * the draft was kept, or was not; `trouble`.
 */
export class ScenarioStore extends Observable {
  /** @type {ScenarioDocument} */
  document = later();
  folder = "";
  path = ""; // the file that it is saved to; empty until it has a name
  /** @type {string | null} */
  revision = null; // of that file; empty if there must be none
  /** @type {[string, string] | null} */
  origin = null; // what it was made from, if that is something else: [kind, name]
  /** @type {SurveyData & {of?: ScenarioDocument}} */
  survey = UNKNOWN;
  /** @type {SitePayload | null} */
  site = null; // the last map that could be drawn
  isKept = false; // whether the draft has been written
  elsewhere = ""; // the name of the draft, if another page has changed it; nothing is kept until that is decided
  /** @type {Refusal | null} */
  unsaved = null; // why the draft lacks what was drawn last; it is sent again until it is kept
  /** @type {Refusal} */
  trouble = later(); // the last one
  opened = 0; // how many documents have been opened
  /** @type {Set<string>} */
  names = new Set(); // that the document has had since then: runs of it are under one of them

  /** @type {ScenarioDocument[]} */
  #past = [];
  /** @type {ScenarioDocument[]} */
  #future = [];
  /** @type {ScenarioDocument | null} */
  #saved = null;
  #draft = "";
  #known = ""; // revision of the draft that this page has read or written; empty if there must be none
  /** @type {ScenarioDocument | null} */
  #sent = null; // the draft that was sent last
  /** @type {ReturnType<typeof setTimeout> | undefined} */
  #retry; // the timer of the next attempt
  #work = {
    survey: new Latest(() => this.#look()),
    findings: new Latest(() => this.#inspect()),
    draft: new Latest(() => this.#keep()),
  };

  constructor() {
    super();
    connection.on("back", () => {
      if (this.unsaved) this.#work.draft.ask();
      if (this.opened && this.survey.of !== this.document) this.#work.survey.ask();
    });
  }

  /**
   * Begin with a document; one that is not in a file yet counts as changed.
   * @param {Found} found
   * @returns {void}
   */
  open({ document, folder = "", path = "", revision = "", draft = "", origin = null, known = "" }) {
    this.document = document;
    this.folder = folder;
    this.path = path;
    this.revision = revision;
    this.origin = origin;
    this.survey = UNKNOWN;
    this.site = null;
    this.opened++;
    this.#past = [];
    this.#future = [];
    this.#saved = revision ? document : null;
    this.#draft = draft || path || unnamedDraft();
    this.names = new Set([this.#draft, this.name]);
    this.#known = known;
    this.elsewhere = "";
    this.unsaved = this.#sent = null;
    clearTimeout(this.#retry);
    this.tell("document");
    this.tell("open");
    this.#work.survey.ask();
    if (!revision && !draft && !origin) this.#work.draft.ask(); // it is nowhere else
  }

  /**
   * Change the document by a function; nothing happens if it returns what it was given.
   * @param {Edit} edit
   * @param {{isSame?: boolean}} [options]
   * @returns {void}
   */
  change(edit, { isSame = false } = {}) {
    const next = edit(this.document);
    if (next === this.document) return;
    if (!isSame) this.#past.push(this.document); // else one undo takes it back with the change before
    this.#future = [];
    this.#show(next);
    this.tell("edit");
  }

  /** The name of the draft. */
  get draft() {
    return this.#draft;
  }

  /** The document before the last edit, or null. */
  get before() {
    return this.#past.at(-1) ?? null;
  }

  get canUndo() {
    return this.#past.length > 0;
  }

  get canRedo() {
    return this.#future.length > 0;
  }

  get isSaved() {
    return this.document === this.#saved;
  }

  undo() {
    if (!this.canUndo) return;
    this.#future.push(this.document);
    this.#show(present(this.#past.pop()));
    this.tell("undo");
  }

  redo() {
    if (!this.canRedo) return;
    this.#past.push(this.document);
    this.#show(present(this.#future.pop()));
    this.tell("redo");
  }

  /** Save under the present path; the draft is not needed any more. */
  async save() {
    const { document, folder, path, revision } = this;
    const saved = await put(`/documents/${inAddress(path)}`, {
      document,
      folder,
      revision,
    });
    this.revision = saved.revision;
    this.#saved = document;
    await this.#work.draft.idle();
    const mine = `/drafts/${inAddress(this.#draft)}?revision=${this.#known}`;
    if (this.#known) await remove(mine).catch(() => {}); // that of another page stays
    this.#draft = path;
    this.#known = this.elsewhere = "";
    this.unsaved = null;
    clearTimeout(this.#retry);
    this.tell("document");
  }

  /** Its file, or the name of its draft. */
  get name() {
    return this.path || this.#draft;
  }

  /**
   * Save to another file from now on, which must not be there yet.
   * @param {string} path
   * @returns {void}
   */
  rename(path) {
    if (path === this.path) return;
    this.path = path;
    this.revision = "";
    this.names.add(path);
    this.#saved = null;
    this.tell("document");
  }

  /** Go on with a copy, without a file: what another page has drawn stays as it is. */
  keepCopy() {
    this.#draft = unnamedDraft();
    this.names.add(this.#draft);
    this.#known = this.elsewhere = "";
    this.#saved = null;
    this.path = this.revision = "";
    this.tell("document");
    this.#work.draft.ask();
  }

  /**
   * Faults at a place of the document and below it.
   * @param {...(string | number)} path The keys and indices that lead to the place.
   * @returns {DocumentFault[]}
   */
  faultsAt(...path) {
    return this.faults.filter((fault) => liesIn(fault, ...path));
  }

  /** All faults; an empty fleet is no fault while one draws. */
  get faults() {
    const isEmpty = Array.isArray(this.document?.robots) && !this.document.robots.length;
    return this.survey.faults.filter((fault) => !(isEmpty && liesAt(fault, "robots")));
  }

  /** Resolves when the library has looked at the present document. */
  settled() {
    return this.#work.survey.idle();
  }

  /**
   * @param {ScenarioDocument} document
   * @returns {void}
   */
  #show(document) {
    this.document = document;
    this.tell("document");
    this.#work.survey.ask();
    this.#work.draft.ask();
  }

  async #look() {
    const { document, folder, opened } = this;
    try {
      const { findings, sentences, phrases } = this.survey;
      const isNew = !this.site; // just opened
      const isLarge = isNew || sizeOf(present(this.site).map) > MANY;
      const survey = await post("/survey", {
        document,
        folder,
        inspects: !isLarge,
        identifies: isNew,
      });
      if (opened !== this.opened) return;
      const kept = isLarge && { findings, sentences, phrases };
      this.survey = { ...survey, ...kept, of: document };
      this.site = survey.site ?? this.site;
      this.tell("survey");
      if (isLarge) this.#work.findings.ask();
    } catch (error) {
      this.trouble = /** @type {Refusal} */ (error);
      if (this.trouble.kind !== UNREACHABLE) this.tell("trouble"); // else it is asked again
    }
  }

  /** Inspect a large map, which takes longer than to draw it. */
  async #inspect() {
    const { document, folder } = this;
    const { findings, sentences, phrases } = await post("/survey", { document, folder }).catch(
      () => UNKNOWN,
    );
    if (document !== this.document) return;
    this.survey = { ...this.survey, findings, sentences, phrases };
    this.tell("findings");
  }

  async #keep() {
    if (this.elsewhere) return;
    clearTimeout(this.#retry);
    const { document, opened } = this;
    const [name, before] = [this.#draft, this.#known];
    try {
      const kept = await put(`/drafts/${inAddress(name)}`, { document, revision: before });
      if (opened !== this.opened) return;
      this.#known = kept.revision;
      this.isKept = true;
      this.unsaved = this.#sent = null;
    } catch (error) {
      if (opened === this.opened) await this.#lack(/** @type {Refusal} */ (error), name, document);
    }
    if (opened === this.opened) this.tell("kept");
  }

  /**
   * A draft was not kept: send it again, unless another page has changed it.
   * @param {Refusal} trouble
   * @param {string} name
   * @param {ScenarioDocument} document
   * @returns {Promise<void>}
   */
  async #lack(trouble, name, document) {
    const isOurs = trouble.status !== CHANGED || (await this.#knowAgain(name));
    if (trouble.kind === UNREACHABLE) this.#sent = document; // it may be kept, without an answer
    this.unsaved = trouble;
    if (isOurs) this.#retry = setTimeout(() => this.#work.draft.ask(), RETRY);
    else this.elsewhere = name;
  }

  /**
   * Learn the revision of a draft that is not the one that this page knows: one that was kept while the
   * answer was lost, or none at all. False where it is of another page.
   * @param {string} name
   * @returns {Promise<boolean>}
   */
  async #knowAgain(name) {
    try {
      const there = await get(`/drafts/${inAddress(name)}`);
      if (JSON.stringify(there.document) !== JSON.stringify(this.#sent)) return false;
      this.#known = there.revision;
    } catch (error) {
      const { status } = /** @type {Refusal} */ (error);
      if (status === 404) this.#known = ""; // the studio started again without it
    }
    return true;
  }
}

/** The name of the draft of a document that has none. */
const unnamedDraft = () => `new ${new Date().toISOString().slice(0, 23).replace(/[T.]/g, " ")}`;

/**
 * How many vertices a map has, at most.
 * @param {SitePayload["map"]} map
 * @returns {number}
 */
const sizeOf = (map) => ("rows" in map ? map.rows.length * map.rows[0].length : map.names.length);

/**
 * Whether a draft is one of a document without a name, and not that of a file like "new hall.yaml".
 * @param {string} name
 * @returns {boolean}
 */
export const isUnnamed = (name) => /^new \d{4}-\d\d-\d\d \d\d:\d\d:\d\d \d{3}$/.test(name);
