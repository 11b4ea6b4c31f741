/** The studio as a whole: which document, which tab, what the server has refused. */

import { UNREACHABLE, address, get, post } from "./api.js";
import { connection } from "./connection.js";
import { ScenarioStore } from "./document.js";
import { Backdrop } from "./draw/backdrop.js";
import { Clipboard } from "./draw/clipboard.js";
import { Editor } from "./draw/editor.js";
import { PlaceDrag } from "./draw/place_drag.js";
import { itemOf } from "./fault_place.js";
import { Notices } from "./notices.js";
import { PlaceInAddress } from "./place.js";
import { FormerRoute } from "./runs/former.js";
import { RunStore } from "./runs/run_store.js";
import { lossOn } from "./runs/waits.js";
import { Shelf } from "./shelf.js";
import { Stage } from "./stage.js";
import { Observable } from "../../viz/page/assets/common/observable.js";
import { setLanguage, words } from "./words.js";
import { present } from "./given.js";
/** @import { Refusal } from "./api.js" */
/** @import { About, LossData, NewLaps, NewSimulation } from "./api_types.js" */
/** @import { Complaint, Edit, Found, ScenarioDocument, SearchForm, SearchSettings, StageElements, Tab } from "./types.js" */

/** @type {Tab[]} */
export const TABS = ["map", "robots", "jobs", "plan"];

/**
 * The tool that a tab begins with.
 * @type {Partial<Record<Tab, string>>}
 */
const TOOL_OF = { robots: "robot", jobs: "job" };

/** Event: `change` when the page is to be drawn again. */
export class Studio extends Observable {
  /** @type {Tab} */
  tab = "map";
  isStarting = true;
  isLive = false; // whether each change is planned at once
  isHelping = false;
  isFresh = false; // whether the document has just been opened
  suggested = ""; // a name for the file of the document
  seeksChange = false; // whether the next difference is to be brought into view
  /** @type {import("../../viz/page/assets/payload.d.ts").PhraseData[]} */
  notes = [];
  /** @type {Complaint[]} */
  complaints = []; // what the server has refused: { place, named, message }
  /** @type {SearchForm} */
  settings = { planner: "", options: {}, time_limit: 5, seed: 0 };
  /** @type {Partial<About>} */
  about = {};

  /**
   * Take the elements that the map and the player are shown in.
   * @param {StageElements} elements
   */
  constructor(elements) {
    super();
    this.store = new ScenarioStore();
    this.runs = new RunStore();
    this.stage = new Stage(elements);
    this.editor = new Editor(this.store, this.stage);
    this.backdrop = new Backdrop(this.store, this.stage);
    this.shelf = new Shelf(this);
    this.notices = new Notices();
    this.place = new PlaceInAddress(this);
    this.notices.watch(this.store, () => this.editor.tool.frees);
    this.former = new FormerRoute(this.runs, this.stage);
    this.clipboard = new Clipboard(this.editor);
    this.places = new PlaceDrag(this.editor, (edit) => this.#drop(edit));
    /** @type {[Observable, string[]][]} */
    const sources = [
      [this.store, ["document", "survey", "findings", "kept"]],
      [connection, ["lost", "back"]],
      [this.runs, ["runs"]],
      [this.editor, ["editor"]],
      [this.backdrop, ["image"]],
      [this.stage, ["choice"]],
      [this.notices, ["notice"]],
    ];
    for (const [source, events] of sources)
      for (const event of events) source.on(event, () => this.tell("change"));
    addEventListener("beforeunload", (event) => this.store.unsaved && event.preventDefault());
    connection.on("back", () => void (this.isStarting && this.attempt(() => this.shelf.list())));
    this.store.on("survey", () => this.#surveyed());
    for (const event of ["undo", "redo"]) this.store.on(event, () => this.#showItsPlan());
    this.store.on("trouble", () => this.complain(this.store.trouble));
    this.runs.on("payload", () => this.#planned());
    this.runs.on("refusal", () => {
      this.complain(this.runs.refusal);
      if ("vertices" in this.runs.refusal) this.light(this.runs.refusal.vertices ?? []);
    });
  }

  /** Find out what there is; open the file that the studio was started with. */
  begin() {
    return this.attempt(async () => {
      const [about] = await Promise.all([get("/"), this.runs.load(), this.shelf.list()]);
      this.about = about;
      if (!this.place.go() && about.file) await this.shelf.open(about.file);
      this.tell("change");
    });
  }

  /**
   * Do something that the server may refuse, and show why.
   * @param {() => unknown} action
   * @returns {Promise<void>}
   */
  async attempt(action) {
    this.complaints = [];
    try {
      await action();
    } catch (refusal) {
      this.complain(/** @type {Refusal} */ (refusal));
    }
    this.tell("change");
  }

  /**
   * @param {{message?: string, faults?: Complaint[], kind?: string}} refusal
   * @returns {void}
   */
  complain({ message, faults, kind }) {
    if (kind === UNREACHABLE) return; // the head says so as long as it lasts
    this.complaints = faults?.length ? faults : [{ place: "", message: message ?? "" }];
    this.tell("change");
  }

  /**
   * Show a document, from the start.
   * @param {Found} found
   * @returns {void}
   */
  open(found) {
    const { notes = [], suggested = "", tool = "select" } = found;
    this.isStarting = false;
    this.notes = notes;
    this.suggested = suggested;
    this.isFresh = true;
    this.runs.hide();
    this.store.open(found);
    this.runs.hearOf(this.store);
    this.editor.select([]);
    this.editor.isOn = true;
    this.editor.take(tool);
    this.showTab(this.place.lastTab ?? "map");
  }

  /**
   * Speak another language; the map is written anew.
   * @param {string} code
   * @returns {void}
   */
  speak(code) {
    setLanguage(code);
    if (this.stage.raw) this.stage.show(this.stage.raw, { keeps: true });
    this.tell("change");
  }

  /**
   * @param {boolean} isShown
   * @returns {void}
   */
  help(isShown) {
    this.isHelping = isShown;
    this.tell("change");
  }

  /** Show all files; not while what is drawn here is nowhere else. */
  toStart() {
    if (this.store.unsaved && !this.isStarting) return this.notices.say(words.unsavedStay);
    return this.attempt(async () => {
      this.isStarting = true;
      this.place.leave();
      await this.shelf.list();
    });
  }

  /** Show the list of faults; those of robots stand in their table too. */
  showFaults() {
    this.showTab("map");
    document.getElementById("faults-title")?.scrollIntoView();
  }

  /**
   * Go to where a fault can be mended.
   * @param {Complaint} fault
   * @returns {void}
   */
  goTo(fault) {
    const [robot, job] = [itemOf(fault, "robots"), itemOf(fault, "jobs")];
    if (robot < 0 && job < 0) return;
    this.showTab(robot < 0 ? "jobs" : "robots");
    this.editor.select([robot < 0 ? { kind: "job", id: job } : { kind: "robot", id: robot }]);
    requestAnimationFrame(() => {
      const row = document.querySelector(`table.robots tr[data-row="${Math.max(robot, job)}"]`); // once it is drawn
      /** @type {HTMLElement | null | undefined} */
      const wrong = row?.querySelector("[aria-invalid=true]");
      (wrong ?? row?.querySelector("input"))?.focus();
    });
  }

  /**
   * @param {Tab} tab
   * @returns {void}
   */
  showTab(tab) {
    if (tab !== this.tab) {
      this.tab = tab;
      this.complaints = [];
      this.place.keepTab();
    }
    const { payload } = this.runs;
    const isPlan = tab === "plan" && payload !== null;
    if (!isPlan && this.stage.isPlan) this.stage.choice.chooseNothing();
    this.editor.isOn = !isPlan;
    this.editor.tool.cancel();
    const { [tab]: own } = TOOL_OF;
    const isOfTab = Object.values(TOOL_OF).some(
      (name) => this.editor.tool === this.editor.tools.get(name),
    );
    if (own) this.editor.take(own);
    else if (tab === "map" && isOfTab) this.editor.take("select");
    if (isPlan) this.stage.show(payload, { keeps: true });
    else if (this.store.site && this.stage.isPlan)
      this.stage.show(this.store.site, { keeps: true });
    this.tell("change");
  }

  /** Why nothing can be planned yet; empty if it can. */
  get notReady() {
    const { document, faults, survey } = this.store;
    if (Array.isArray(document?.robots) && !document.robots.length) return words.needsRobots;
    return survey.ok ? "" : words.needsMending({ count: faults.length });
  }

  /** Plan what is drawn, and watch it; or lead to what keeps it from being planned. */
  plan() {
    if (this.notReady) {
      this.notices.say(this.notReady);
      if (this.store.faults.length) this.showFaults();
      else this.showTab("robots");
      return null;
    }
    return this.attempt(async () => {
      this.runs.beside = null;
      this.#isPlaying = true;
      await this.runs.plan(this.store, this.#search());
      this.showTab("plan");
    });
  }

  /**
   * Show the plan of a run.
   * @param {number} number
   * @returns {Promise<void>}
   */
  showRun(number) {
    return this.attempt(async () => {
      this.showTab("plan");
      await this.runs.show(number);
    });
  }

  /**
   * Queue laps or a simulation, and show what comes of it.
   * @param {NewLaps | NewSimulation} request
   * @param {ScenarioDocument} [document]
   * @returns {Promise<void>}
   */
  study(request, document) {
    return this.attempt(async () => {
      this.#isPlaying = true;
      await this.runs.begin(request, document);
      this.showTab("plan");
    });
  }

  /**
   * Change the document, and plan it at once: who gains, who loses.
   * @param {Edit} edit
   * @returns {void}
   */
  whatIf(edit) {
    this.#isAsked = true;
    this.store.change(edit);
  }

  /**
   * As `whatIf`, but nothing changes where the library finds something wrong that was not wrong before;
   * resolves with these faults.
   * @param {Edit} edit
   * @returns {Promise<Complaint[]>}
   */
  async tryOut(edit) {
    const { document, folder, faults: known } = this.store;
    const { faults } = await post("/validate", { document: edit(document), folder });
    /**
     * @param {Complaint} fault
     * @returns {boolean}
     */
    const isKnown = ({ place, message }) =>
      known.some((fault) => fault.place === place && fault.message === message);
    const news = faults.filter((fault) => !isKnown(fault));
    if (news.length) return news;
    this.seeksChange = true;
    this.whatIf(edit);
    return [];
  }

  /**
   * Something was dropped on the map of a plan: show the difference, or why it cannot be there.
   * @param {Edit} edit
   * @returns {Promise<void>}
   */
  #drop(edit) {
    return this.attempt(async () => {
      const faults = await this.tryOut(edit);
      if (faults.length) this.complain({ faults });
    });
  }

  /** Edit again what the plan that is shown was made from. */
  takeBack() {
    return this.attempt(async () => {
      const document = await this.runs.documentOf(present(this.runs.shown));
      this.#replanned = document;
      this.store.change(() => document);
    });
  }

  /**
   * Give up what has been tried: the document and the plan of a run before it are back.
   * @param {number} number
   * @returns {Promise<void>}
   */
  putBack(number) {
    return this.attempt(async () => {
      const document = await this.runs.documentOf(number);
      this.#replanned = document;
      this.store.change(() => document);
      await this.runs.show(number);
    });
  }

  /**
   * Light vertices by their names on the map that is shown.
   * @param {string[]} names
   * @returns {void}
   */
  light(names) {
    const { plan, choice } = this.stage;
    choice?.light(
      names.map((name) => plan.roadmap.vertexNamed(name)).filter((vertex) => vertex >= 0),
    );
  }

  /**
   * Show the moment at which a robot begins to lose time, and why.
   * @param {LossData} loss
   * @returns {void}
   */
  watchLoss(loss) {
    const { clock, choice, plan } = this.stage;
    clock.pause();
    clock.seek(loss.tick);
    choice.chooseRobot(plan.robots.findIndex(({ name }) => name === loss.robot));
    choice.light(lossOn(this.stage, loss)?.places ?? []);
    this.reveal("#waits-title", "start");
  }

  /**
   * Let the robot that waits go first, and show what that costs.
   * @param {LossData} loss
   * @returns {Promise<void>}
   */
  flip(loss) {
    return this.attempt(async () => {
      await this.runs.flip(loss);
      this.reveal(".change");
    });
  }

  /**
   * Bring a part of the side panel into view, once it is written.
   * @param {string} selector
   * @param {ScrollLogicalPosition} [block]
   * @returns {void}
   */
  reveal(selector, block = "nearest") {
    const look = () => document.querySelector(selector)?.scrollIntoView({ block });
    requestAnimationFrame(() => requestAnimationFrame(look));
  }

  /** @returns {SearchSettings} */
  #search() {
    const { planner, options, time_limit, seed } = this.settings;
    return {
      planner: planner || this.runs.planners.default,
      options,
      time_limit: Number(time_limit),
      seed: Number(seed),
    };
  }

  #isPlaying = false; // whether the next plan is to be played from its start
  #isAsked = false; // whether the document that is looked at is to be planned, too
  /** @type {ScenarioDocument | null} */
  #replanned = null; // the document that was planned by itself last

  #surveyed() {
    const { store, stage } = this;
    if (store.site && (this.tab !== "plan" || !this.runs.payload))
      stage.show(store.site, { keeps: !this.isFresh });
    this.isFresh = false;
    const { scenario, of } = store.survey;
    if (scenario && of && !this.#isPlaying) this.attempt(() => this.runs.showLatest(scenario, of));
    if (store.survey.of !== store.document) return; // that is looked at next
    const isWanted = this.isLive || this.#isAsked;
    this.#isAsked = false;
    if (
      !isWanted ||
      !store.survey.ok ||
      this.#replanned === store.document ||
      this.runs.isOf(store.document)
    )
      return;
    this.#replanned = store.document;
    this.attempt(() => this.runs.replan(store, this.#search()));
  }

  /** Beside a plan, an undo of what was tried shows the plan of before again. */
  #showItsPlan() {
    const { document } = this.store;
    const number = this.tab === "plan" ? this.runs.madeFrom(document) : undefined;
    if (number === undefined || number === this.runs.shown) return;
    this.#replanned = document;
    this.attempt(() => this.runs.show(number));
  }

  #planned() {
    const { runs, stage } = this;
    if (!runs.payload) this.showTab(this.tab);
    if (this.tab !== "plan" || !runs.payload) return;
    this.editor.isOn = false;
    stage.show(runs.payload, { keeps: Boolean(stage.view) });
    if (this.#isPlaying) {
      stage.clock.seek(0);
      if (!matchMedia("(prefers-reduced-motion: reduce)").matches) stage.clock.play();
    }
    this.#isPlaying = false;
    this.tell("change");
  }

  /**
   * Where a plan can be had in a form.
   * @param {string} form
   * @returns {string}
   */
  exportAddress(form) {
    return address(`/runs/${this.runs.shown}/export/${form}`);
  }
}
