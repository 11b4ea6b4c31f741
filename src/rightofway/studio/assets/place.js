/** The address of what is shown: a reload, a bookmark and the way back lead to the same document and tab. */

/** @import { Studio } from "./studio.js" */
/** @import { Tab } from "./types.js" */

const TABS = "tabs"; // the key of the tabs that documents were left at, by address, the latest last
const MOST_TABS = 50;

/** @returns {Map<string, Tab>} */
const tabs = () => new Map(JSON.parse(localStorage.getItem(TABS) ?? "[]"));

export class PlaceInAddress {
  /** @param {Studio} studio */
  constructor(studio) {
    this.studio = studio;
    this.opened = 0; // the document that the address has followed
    const { store } = studio;
    for (const event of ["open", "document"]) store.on(event, () => this.#follow());
    addEventListener("popstate", () => this.go());
  }

  /** Open what the address names; false where it names nothing. */
  go() {
    const { studio } = this;
    const [kind, ...rest] = decodeURIComponent(location.hash.slice(1)).split("=");
    const name = rest.join("=");
    if (kind === "file" && name) studio.shelf.open(name);
    else if (kind === "draft" && name) studio.shelf.openDraft(name);
    else if (kind === "example" && name) studio.shelf.openExample(name);
    else if (!studio.isStarting) studio.toStart();
    return Boolean(name);
  }

  /** The tab that the present document was left at; undefined for one that is new here. */
  get lastTab() {
    return tabs().get(location.hash);
  }

  /** Remember the tab of the present document. */
  keepTab() {
    const { tab } = this.studio;
    const others = [...tabs()].filter(([hash]) => hash !== location.hash);
    const kept = [...others, [location.hash, tab]].slice(-MOST_TABS);
    localStorage.setItem(TABS, JSON.stringify(kept));
  }

  /** Be at the start page. */
  leave() {
    if (location.hash) history.pushState(null, "", location.pathname + location.search);
  }

  /** Keep up with the document: another one is a step, another name of it is none. */
  #follow() {
    const { store } = this.studio;
    /** @type {[string, string]} */
    const own = store.isSaved ? ["file", store.path] : ["draft", store.draft];
    const isOld = store.origin && !store.canUndo; // as it was opened: from a layout, an example, a plan
    const [kind, name] = (isOld && store.origin) || own;
    const hash = `#${kind}=${encodeURIComponent(name)}`;
    const isStep = store.opened !== this.opened;
    this.opened = store.opened;
    if (location.hash === hash) return;
    history[isStep ? "pushState" : "replaceState"](null, "", hash);
    if (!isStep) this.keepTab();
  }
}
