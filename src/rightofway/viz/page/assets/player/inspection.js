import { nearest } from "../common/arrays.js";
import { all, element } from "../common/dom.js";
import { connectFind, matches } from "../lists/find.js";
import { bindKeys } from "./keys.js";
import {
  askedLanguage,
  learn,
  offerLanguages,
  said,
  setLanguage,
  texts,
  withKey,
  writeMarkup,
} from "../language/language.js";
import { MapView } from "../map/map_view.js";
import { INSPECTION } from "./markup.js";
import { Root } from "../common/root.js";
import { Site } from "../plan/site.js";
import { Theme } from "../drawing/theme.js";
import { VirtualList } from "../lists/virtual_list.js";
import { upperFirst } from "../language/words.js";

/** @import { WithTexts } from "../language/language.js" */
/** @import { PlayerHandle } from "./player.js" */
/** @import { FindingData, InspectionPayload, PhraseData } from "../payload.d.ts" */

const SEVERITIES = /** @type {const} */ (["error", "warning", "note"]); // the worst first
const FEW_NOTES = 3; // of the reader, which stand open

/**
 * Show an inspection in an element, which it fills.
 *
 * @param {HTMLElement} box `document.body` where the inspection is the page
 * @param {InspectionPayload & WithTexts} payload
 * @returns {PlayerHandle}
 */
export function createInspection(box, payload) {
  const root = new Root(box);
  root.fill(INSPECTION);
  box.classList.add("inspect");
  learn(payload.texts);
  setLanguage(askedLanguage(root.isPart), root.top);
  writeMarkup(box);
  offerLanguages(root.part("language", HTMLSelectElement));
  new InspectPage(root, payload);
  return {
    destroy() {
      root.destroy();
      box.classList.remove("inspect");
    },
  };
}

/** The parts of an inspection: a level of the site at a time, its problems as a list. */
class InspectPage {
  /**
   * @param {Root} root
   * @param {InspectionPayload} raw
   */
  constructor(root, raw) {
    this.root = root;
    this.raw = raw;
    this.theme = new Theme(root);
    this.sizes = new ResizeObserver(() => this.#ask());
    root.atEnd(() => this.sizes.disconnect());
    /** @type {FindingData | null} */
    this.chosen = null;
    this.level = raw.levels[0];
    this.site = new Site({ ...this.level, title: raw.title });
    this.view = new MapView(this.root.part("map", HTMLCanvasElement), this.site, this.theme);
    this.find = this.root.part("find-finding", HTMLInputElement);
    this.list = new VirtualList(this.root.part("finding-list"), {
      rowHeight: 92,
      className: "two long finding",
      none: raw.levels.some(({ findings }) => findings.length)
        ? texts.noFindingFits
        : texts.noFindings,
      fill: (row, finding) => this.#fill(row, finding),
      choose: (finding) => this.choose(finding),
    });
    connectFind(this.find, this.list, () => this.#select());
    this.#showHead();
    this.#listen();
    this.showLevel(0);
  }

  /**
   * Draw a level and list its findings.
   *
   * @param {number} index
   */
  showLevel(index) {
    this.level = this.raw.levels[index];
    this.root.part("level", HTMLSelectElement).value = String(index);
    this.root.part("size").textContent = this.level.sentences.map(said).join(" ");
    const before = this.root.part("map", HTMLCanvasElement);
    before.replaceWith(before.cloneNode()); // without the listeners of another level's map
    const canvas = this.root.part("map", HTMLCanvasElement);
    this.site = new Site({ ...this.level, title: this.raw.title });
    this.view = new MapView(canvas, this.site, this.theme);
    this.view.viewport.on("view", () => this.#repaint());
    this.view.viewport.on("hover", () => this.#ask());
    this.view.viewport.on("click", () => this.#chooseAtPointer());
    this.view.choice.on("choice", () => this.#repaint());
    this.sizes.disconnect();
    this.sizes.observe(canvas);
    this.#showCounts();
    this.#select();
    this.choose(null);
    this.view.viewport.fit();
  }

  /**
   * Light a finding on the map and say all of it; null to light none.
   *
   * @param {FindingData | null} finding
   */
  choose(finding) {
    this.chosen = finding;
    const { choice, viewport } = this.view;
    const { x, y } = this.site.roadmap;
    choice.light(finding?.vertices ?? []);
    if (finding?.vertices.length)
      viewport.showAll(finding.vertices.map((vertex) => [x[vertex], y[vertex]]));
    this.list.setChosen(finding);
    this.#showCard(finding);
  }

  #showHead() {
    const { title, description, notes, levels } = this.raw;
    if (!this.root.isPart) document.title = [title, said(description)].filter(Boolean).join(": ");
    this.root
      .part("headline")
      .replaceChildren(
        element("b", { className: "name" }, title),
        element("span", {}, said(description)),
      );
    this.root.part("level-choice").hidden = levels.length < 2;
    this.root
      .part("level", HTMLSelectElement)
      .replaceChildren(
        ...levels.map(({ name }, index) => element("option", { value: String(index) }, name)),
      );
    const box = this.root.part("notes", HTMLDetailsElement);
    box.hidden = !notes.length;
    box.open = notes.length <= FEW_NOTES;
    for (const summary of all("summary", HTMLElement, box))
      summary.textContent = texts.readerNotes({ count: notes.length });
    for (const list of all("ul", HTMLElement, box))
      list.replaceChildren(...notes.map((note) => element("li", {}, said(note))));
  }

  /** The findings of each severity, the worst first. */
  get #groups() {
    return SEVERITIES.filter((severity) => severity in this.raw.headings).map((severity) => ({
      severity,
      name: said(this.raw.names[severity]),
      heading: said(this.raw.headings[severity]),
      found: this.level.findings.filter((finding) => finding.severity === severity),
    }));
  }

  /** How many findings there are of each severity. */
  #showCounts() {
    this.root
      .part("figures")
      .replaceChildren(
        ...this.#groups.map(({ severity, name, heading, found }) =>
          element(
            "div",
            { title: heading },
            element("dt", {}, severitySign(severity), name),
            element("dd", {}, String(found.length)),
          ),
        ),
      );
  }

  /**
   * @param {HTMLElement & { filled?: FindingData }} row
   * @param {FindingData} finding
   */
  #fill(row, finding) {
    if (row.filled === finding) return;
    row.filled = finding;
    row.title = `${said(finding.fact)} (${said(finding.remedy)})`;
    row.replaceChildren(
      severitySign(finding.severity),
      element("span", { className: "text name" }, said(finding.fact)),
      element("span", { className: "text name" }, said(finding.remedy)),
    );
  }

  /** @param {FindingData | null} finding */
  #showCard(finding) {
    const box = this.root.part("card");
    box.hidden = !finding;
    if (!finding) return;
    const close = element(
      "button",
      {
        type: "button",
        className: "quiet",
        ariaLabel: texts.chooseNothing,
        title: withKey(texts.chooseNothing, "Esc"),
      },
      "✕",
    );
    close.addEventListener("click", () => this.choose(null));
    const { severity, kind, fact, remedy } = finding;
    /** @type {Partial<Record<string, string>>} */
    const kinds = texts.findingKinds;
    box.replaceChildren(
      element(
        "header",
        {},
        severitySign(finding.severity),
        element("h2", {}, `${upperFirst(texts.severities[severity])}: ${kinds[kind] ?? kind}`),
        close,
      ),
      element("p", { className: "name" }, `${said(fact)}.`),
      element("p", { className: "name" }, `${upperFirst(said(remedy))}.`),
    );
    box.scrollTop = 0;
  }

  /** The first finding about the place at the pointer, or the next one if that is chosen. */
  #chooseAtPointer() {
    const { viewport } = this.view;
    const { roadmap } = this.site;
    const vertex = nearest(
      roadmap.x,
      roadmap.y,
      viewport.pointer.x,
      viewport.pointer.y,
      Math.max(0.5, 12 / viewport.scale),
    );
    const about = this.level.findings.filter(({ vertices }) => vertices.includes(vertex));
    this.choose(
      about[(about.findIndex((each) => each === this.chosen) + 1) % about.length] ?? null,
    );
  }

  #select() {
    this.list.setItems(
      this.level.findings.filter(({ severity, kind, fact, remedy }) =>
        matches(`${severity} ${kind} ${said(fact)} ${said(remedy)}`, this.find.value),
      ),
    );
  }

  #listen() {
    const actions = {
      "zoom-in": () => this.view.viewport.zoom(1.5),
      "zoom-out": () => this.view.viewport.zoom(1 / 1.5),
      fit: () => this.view.viewport.fit(),
      print: () => window.print(),
    };
    for (const [id, action] of Object.entries(actions))
      this.root.part(id).addEventListener("click", action);
    const level = this.root.part("level", HTMLSelectElement);
    level.addEventListener("change", () => this.showLevel(Number(level.value)));
    /** @type {Record<string, () => void>} */
    const keys = {
      "+": actions["zoom-in"],
      "=": actions["zoom-in"],
      "-": actions["zoom-out"],
      0: actions.fit,
      "/": () => this.find.focus(),
      Escape: () => this.choose(null),
    };
    bindKeys(this.root, keys);
    this.theme.on("theme", () => this.#repaint());
    this.root.listen(window, "beforeprint", () => this.#lay(true));
    this.root.listen(window, "afterprint", () => this.#lay(false));
  }

  /**
   * Get ready for paper, with all findings as a list, or for the screen again.
   *
   * @param {boolean} onPaper
   */
  #lay(onPaper) {
    this.root.top.classList.toggle("on-paper", onPaper);
    this.theme.refresh();
    this.#paint();
    this.root
      .part("paper-findings")
      .replaceChildren(
        ...this.#groups
          .filter(({ found }) => found.length)
          .flatMap(({ heading, found }) => [
            element("h2", {}, `${heading}: ${found.length}`),
            element(
              "ul",
              {},
              ...found.map(({ fact, remedy }) =>
                element("li", {}, `${said(fact)} (${said(remedy)})`),
              ),
            ),
          ]),
      );
  }

  #repaint() {
    this.view.base.stale = true;
    this.#ask();
  }

  #isAsked = false;

  #ask() {
    if (this.#isAsked) return;
    this.#isAsked = true;
    this.root.ask(() => this.#paint());
  }

  #paint() {
    this.#isAsked = false;
    this.view.paint();
  }
}

/**
 * A sign of how much a finding hurts: shape and colour.
 *
 * @param {FindingData["severity"]} severity
 */
function severitySign(severity) {
  const sign = element(
    "span",
    { className: `severity ${severity}`, title: texts.severities[severity] },
    { error: "✕", warning: "!", note: "i" }[severity],
  );
  sign.setAttribute("role", "img");
  sign.setAttribute("aria-label", texts.severities[severity]);
  return sign;
}
