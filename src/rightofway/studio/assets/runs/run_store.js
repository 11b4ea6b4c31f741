/** The runs of this studio: begun, heard, shown, compared; and what a plan says about waits. */

import { Observable } from "../../../viz/page/assets/common/observable.js";
import { get, patch, post, remove } from "../api.js";
import { connection } from "../connection.js";
import { listen, listenToAll } from "../events.js";
import { words } from "../words.js";
import { RunNotes } from "./notes.js";
import { later, present } from "../given.js";
/** @import { Refusal } from "../api.js" */
/** @import { Choices, Compared, ErrorData, GetAnswer, LossData, NewImprovement, NewLaps, NewPlan, NewSimulation, PlannerList, RunData } from "../api_types.js" */
/** @import { ScenarioStore } from "../document.js" */
/** @import { Hearer, LiveRun, ScenarioDocument, SearchSettings, SitePayload } from "../types.js" */

const ROUND = "round of jobs"; // the kind of a fact on the progress of planning that is shown

/**
 * @param {{state: string}} run
 * @returns {boolean}
 */
export const isOver = (run) => !["queued", "running"].includes(run.state);
/**
 * @param {Pick<RunData, "has_plan" | "has_payload">} run
 * @returns {boolean}
 */
export const canBeShown = (run) => run.has_plan || run.has_payload;
/**
 * @param {RunData} run
 * @returns {boolean}
 */
export const isWithoutPlan = (run) => isOver(run) && !canBeShown(run); // it failed or was cancelled

/**
 * What a run does, in words; where the server does not answer, nobody knows of one that was going on.
 * @param {Pick<RunData, "state">} run
 * @returns {string}
 */
export const stateOf = (run) =>
  connection.isLost && !isOver(run) ? words.stateUnknown : words.states[run.state];

const NO_COMMAND = ["flip", "opened"]; // kinds of runs that no command makes
const MOST_COMPARED = 8; // as the library has it
const NOBODY = { number: -1, source: "*", figures: null, based_on: null }; // a run of no document
const UNDO = 8500; // how long runs that are forgotten can be had back [ms], a little longer than the notice
/** @type {Choices} */
const NO_CHOICES = { rules: {}, delays: { default: "", examples: {} }, formats: {} };

/** Events: `runs` when any has changed, `payload` when another plan is to be shown or none, `refusal`. */
export class RunStore extends Observable {
  /** @type {LiveRun[]} */
  runs = [];
  /** @type {PlannerList} */
  planners = { default: "auto", improver: "", planners: [] };
  choices = NO_CHOICES;
  /** @type {number | null} */
  shown = null; // number of the run that is shown
  /** @type {SitePayload | null} */
  payload = null;
  /** @type {{number: number, payload: SitePayload} | null} */
  former = null; // the run that was shown before it, with its payload
  /** @type {number | null} */
  beside = null; // number of the run that it is compared with
  /** @type {Compared | null} */
  comparison = null;
  /** @type {ErrorData | Refusal} */
  refusal = later(); // the last one
  /** @type {LossData[] | null} */
  losses = null; // of the plan that is shown, once they are known
  /** @type {GetAnswer<`/runs/${number}/report`> | null} */
  report = null; // of laps or a simulation that is shown
  command = ""; // that gives the same as the run that is shown; empty where none does
  /** @type {number | null} */
  replayed = null; // the run of a simulation that was played last
  /** @type {number[]} */
  selected = []; // numbers of the runs that are compared, where there are two or more
  /** @type {Compared | null} */
  compared = null; // those plans beside each other
  notes = new RunNotes(this);
  /** @type {number | null} */
  #last = null; // the run that was selected last, where Shift begins
  /** @type {Set<number>} */
  #going = new Set(); // runs that are forgotten as soon as no undo is possible
  /** @type {Map<number, Hearer>} */
  #heard = new Map(); // runs that are shown as soon as they have a plan, and what hears of each
  /** @type {Map<number, ScenarioDocument>} */
  #documents = new Map(); // that each run of this page was made from
  /** @type {string | null} */
  #scenario = null; // the digest of the document as it was opened
  #wanted = 0;
  /** @type {number | null} */
  #awaited = null; // the run that is shown, or will be as soon as the server answers
  #live = 0; // the last run that was made by a change

  async load() {
    /** @type {Hearer} */
    const hearer = {
      runs: ({ runs }) => this.#keepAll(runs),
      run: (run) => this.#keep(run),
      deleted: ({ number }) => this.#drop([number]),
    };
    const asked = await Promise.all([get("/planners"), get("/choices"), listenToAll(hearer)]);
    [this.planners, this.choices] = asked;
    this.tell("runs");
  }

  /**
   * Hear of the runs of a document that is opened, and of no others.
   * @param {ScenarioStore} store
   * @returns {void}
   */
  hearOf(store) {
    this.#heard.clear();
    this.#scenario = null;
    for (const run of this.listed(store, null)) if (!isOver(run)) this.#hear(run.number);
  }

  /**
   * Show the latest plan of a scenario, which a document has; nothing changes where a run is shown.
   * @param {string} scenario
   * @param {ScenarioDocument} document
   * @returns {Promise<void>}
   */
  async showLatest(scenario, document) {
    this.#scenario = scenario;
    this.tell("runs");
    const isOf = (/** @type {LiveRun} */ run) =>
      canBeShown(run) && run.figures?.scenario === scenario;
    const latest = this.runs.find((run) => isOf(run) && !this.#going.has(run.number));
    if (!latest || this.#awaited !== null) return;
    this.#documents.set(latest.number, document);
    await this.show(latest.number);
  }

  /** The latest run of this page that is queued or running. */
  get running() {
    return this.runs.find((run) => !isOver(run) && this.#heard.has(run.number));
  }

  get run() {
    return this.find(this.shown);
  }

  /**
   * @param {number | null | undefined} number
   * @returns {LiveRun | undefined}
   */
  find(number) {
    return this.runs.find((run) => run.number === number);
  }

  /**
   * Whether the plan that is shown is of this document.
   * @param {ScenarioDocument} document
   * @returns {boolean}
   */
  isOf(document) {
    const made = this.shown === null ? undefined : this.#documents.get(this.shown);
    return made === undefined || made === document;
  }

  /**
   * The document that a run was made from.
   * @param {number} number
   * @returns {Promise<ScenarioDocument>}
   */
  async documentOf(number) {
    const known = this.#documents.get(number);
    if (known) return known;
    const { document } = await get(`/runs/${number}/document`);
    this.#documents.set(number, document);
    return document;
  }

  /**
   * The latest run of this page whose plan is of a document; undefined for none.
   * @param {ScenarioDocument} document
   * @returns {number | undefined}
   */
  madeFrom(document) {
    return this.runs.find(
      ({ number, has_plan: hasPlan }) => hasPlan && this.#documents.get(number) === document,
    )?.number;
  }

  /**
   * Queue a run of a document or of another run; it is shown as soon as there is a plan.
   * @param {NewPlan | NewLaps | NewSimulation | NewImprovement} asked
   * @param {ScenarioDocument} [document]
   * @returns {Promise<number>}
   */
  async begin(asked, document) {
    const run = await post("/runs", asked);
    if (document) this.#documents.set(run.number, document);
    this.#keep(run);
    this.#hear(run.number);
    return run.number;
  }

  /**
   * @param {ScenarioStore} store
   * @param {Partial<NewPlan>} settings
   * @returns {Promise<number>}
   */
  plan({ document, folder, name }, settings) {
    return this.begin({ kind: "plan", document, folder, source: name, ...settings }, document);
  }

  /**
   * Plan at once what has just been changed, from the plan that is shown where the planner can start
   * from one; an earlier such run gives way.
   * @param {ScenarioStore} given
   * @param {SearchSettings} settings
   * @returns {Promise<void>}
   */
  async replan(given, settings) {
    const before = this.find(this.#live);
    const isSecond = before && !isOver(before);
    if (isSecond) await post(`/runs/${before.number}/cancel`).catch(() => {});
    const base = isSecond ? before.based_on : this.shown;
    const { has_plan, kind } = this.find(base) ?? {};
    const spec = this.planners.planners.find(({ name }) => name === settings.planner);
    const start =
      has_plan && spec?.features.includes("improves") && kind !== "laps" ? { start: base } : {};
    this.#live = await this.plan(given, { ...settings, ...start, time_limit: 1, based_on: base });
    this.beside = base;
  }

  stop() {
    return post(`/runs/${present(this.running).number}/stop`);
  }

  cancel() {
    return post(`/runs/${present(this.running).number}/cancel`);
  }

  /**
   * Show the plan of a run, and find out why its robots wait.
   * @param {number} number
   * @returns {Promise<void>}
   */
  async show(number) {
    const turn = ++this.#wanted;
    this.#awaited = number;
    const payload = await get(`/runs/${number}/payload`);
    if (turn !== this.#wanted) return;
    if (this.shown !== number) {
      if (this.shown !== null && this.payload)
        this.former = { number: this.shown, payload: this.payload };
      this.losses = this.report = null;
      this.command = "";
    }
    this.shown = number;
    this.payload = payload;
    this.tell("payload");
    const run = this.find(number);
    const isCompared = this.beside && this.beside !== number && run?.has_plan;
    const comparing = this.compare(isCompared ? this.beside : null);
    if (!run || !isOver(run)) return comparing;
    const [losses, report, command] = await Promise.all([
      run.has_plan ? get(`/runs/${number}/losses`) : { losses: [] },
      run.has_report ? get(`/runs/${number}/report`) : null,
      NO_COMMAND.includes(run.kind) ? { command: "" } : get(`/runs/${number}/command`),
      comparing,
    ]);
    if (this.shown !== number) return;
    this.losses = losses.losses;
    this.report = report;
    this.command = command.command;
    this.tell("runs");
  }

  /**
   * Play another run of the simulation that is shown.
   * @param {number} replayed
   * @returns {Promise<void>}
   */
  async replay(replayed) {
    const [turn, number] = [++this.#wanted, this.shown];
    if (number === null) return;
    const payload = await get(`/runs/${number}/payload?replay=${replayed}`);
    if (turn !== this.#wanted) return;
    this.payload = payload;
    this.replayed = replayed;
    this.tell("payload");
  }

  /** Show no plan any more. */
  hide() {
    this.#wanted++;
    this.#awaited = null;
    this.former = this.shown = this.payload = this.losses = this.report = null;
    this.beside = this.comparison = null;
    this.command = "";
    this.tell("payload");
  }

  /**
   * Compare the plan that is shown with that of another run; null to end that. What was compared
   * before stays until the answer is there, so that nothing jumps.
   * @param {number | null} number
   * @returns {Promise<void>}
   */
  async compare(number) {
    this.beside = number;
    if (!number) this.comparison = null;
    if (number) {
      const found = await get(`/compare?run=${number}&run=${this.shown}`);
      if (found.runs[1] === this.shown && this.beside === number) this.comparison = found;
    }
    this.tell("runs");
  }

  /**
   * Let a robot that waits go first, and show what follows.
   * @param {LossData} loss
   * @returns {Promise<void>}
   */
  async flip({ robot, for: other, end }) {
    const base = present(this.shown);
    const { run } = await post(`/runs/${base}/flip`, {
      waits: robot,
      goes_first: present(other),
      tick: end,
    });
    const document = this.#documents.get(base);
    if (document) this.#documents.set(run.number, document);
    this.#keep(run);
    this.beside = base;
    await this.show(run.number);
  }

  /**
   * @param {number} number
   * @param {string} name
   * @returns {Promise<void>}
   */
  async rename(number, name) {
    this.#keep(await patch(`/runs/${number}`, { name }));
  }

  /**
   * The runs of a document, of a file, or all for "*"; the latest first. Of a document are also plans of
   * the scenario that it was opened with, whatever its name was then.
   * @param {ScenarioStore} store
   * @param {string | null} file
   * @returns {LiveRun[]}
   */
  listed(store, file) {
    const there = this.runs.filter(({ number }) => !this.#going.has(number));
    if (file === "*") return there;
    /** @type {(run: Pick<LiveRun, "number" | "source" | "figures" | "based_on">) => boolean | undefined | null} */
    const isOf = (run) =>
      file === null
        ? store.names.has(run.source) ||
          run.number === this.shown ||
          (this.#scenario && run.figures?.scenario === this.#scenario) ||
          (!run.source && isOf(this.find(run.based_on) ?? NOBODY))
        : run.source === file;
    return there.filter(isOf);
  }

  /**
   * Those of them that have a plan.
   * @param {ScenarioStore} store
   * @param {string | null} file
   * @returns {LiveRun[]}
   */
  plans(store, file) {
    return this.listed(store, file).filter(canBeShown);
  }

  /**
   * Whether somebody waits for a run, and it has failed.
   * @param {RunData} run
   * @returns {boolean}
   */
  hasJustFailed({ number, state }) {
    return this.#heard.has(number) && state !== "cancelled";
  }

  /**
   * The runs that are compared with another one.
   * @param {RunData} run
   * @returns {LiveRun[]}
   */
  besides({ number }) {
    const numbers = this.compared?.runs ?? [];
    return numbers.includes(number)
      ? numbers
          .filter((each) => each !== number)
          .map((each) => this.find(each))
          .filter((run) => run !== undefined)
      : [];
  }

  /**
   * Select a run or no more; with the runs in their order, all from the last one that was selected.
   * @param {number} number
   * @param {LiveRun[] | null} order
   * @returns {Promise<void>}
   */
  toggle(number, order) {
    const numbers = (order ?? []).filter(({ has_plan }) => has_plan).map((run) => run.number);
    const ends = [this.#last ?? -1, number].map((each) => numbers.indexOf(each));
    ends.sort((a, b) => a - b);
    this.#last = number;
    if (ends[0] >= 0)
      return this.select([...new Set([...this.selected, ...numbers.slice(ends[0], ends[1] + 1)])]);
    const isSelected = this.selected.includes(number);
    return this.select(
      isSelected ? this.selected.filter((each) => each !== number) : [...this.selected, number],
    );
  }

  /**
   * Select runs; two or more are compared.
   * @param {number[]} wanted
   * @returns {Promise<void>}
   */
  async select(wanted) {
    if (wanted.length > MOST_COMPARED)
      throw new Error(words.mostCompared({ count: MOST_COMPARED }));
    const numbers = wanted.toSorted((one, other) => one - other);
    this.selected = numbers;
    this.compared = null;
    this.tell("runs");
    if (numbers.length > 1) {
      const found = await get(`/compare?${numbers.map((each) => `run=${each}`).join("&")}`);
      if (this.selected === numbers) this.compared = found;
    }
    this.tell("runs");
  }

  /** Compare nothing any more. */
  async endComparison() {
    await this.select([]);
    await this.compare(null);
  }

  /**
   * Forget runs unless the function that is returned is called within seconds.
   * @param {number[]} numbers
   * @returns {() => void}
   */
  forgetSoon(numbers) {
    this.#forgetNow();
    const { shown } = this;
    for (const number of numbers) this.#going.add(number);
    this.#leave(numbers);
    const timer = setTimeout(() => this.#forgetNow(), UNDO);
    addEventListener("pagehide", () => this.#forgetNow(), { once: true });
    return () => {
      clearTimeout(timer);
      this.#going.clear();
      this.tell("runs");
      if (shown !== null && numbers.includes(shown)) this.#try(() => this.show(shown));
    };
  }

  #forgetNow() {
    for (const number of this.#going) this.#try(() => remove(`/runs/${number}`));
    this.#drop([...this.#going]);
    this.#going.clear();
  }

  /**
   * Take runs out of the list.
   * @param {number[]} numbers
   * @returns {void}
   */
  #drop(numbers) {
    this.runs = this.runs.filter(({ number }) => !numbers.includes(number));
    this.#leave(numbers);
  }

  /**
   * Show and compare some runs no more.
   * @param {number[]} numbers
   * @returns {void}
   */
  #leave(numbers) {
    this.selected = this.selected.filter((each) => !numbers.includes(each));
    if (this.compared?.runs.some((each) => numbers.includes(each))) this.compared = null;
    if (this.beside !== null && numbers.includes(this.beside)) this.beside = this.comparison = null;
    if (this.shown !== null && numbers.includes(this.shown)) this.hide();
    this.tell("runs");
  }

  /**
   * Take in a run that was made elsewhere.
   * @param {RunData} run
   * @returns {void}
   */
  add(run) {
    this.#keep(run);
  }

  /**
   * @param {LiveRun} run
   * @returns {void}
   */
  #keep(run) {
    this.#keepAll([run, ...this.runs.filter(({ number }) => number !== run.number)]);
  }

  /**
   * Take in all runs there are.
   * @param {LiveRun[]} runs
   * @returns {void}
   */
  #keepAll(runs) {
    this.runs = runs.map((run) => this.#grown(run)).sort((a, b) => b.number - a.number);
    this.tell("runs");
  }

  /**
   * A run with what this page knows of it: the curve so far, and since when it is going on.
   * @param {LiveRun} run
   * @returns {LiveRun}
   */
  #grown(run) {
    const before = this.find(run.number);
    if (before === run) return run;
    const points = run.points?.length || !before ? run.points : before.points;
    const since = run.state === "running" ? (before?.since ?? performance.now()) : undefined; // clocks of server and browser may differ
    return { ...run, points: points ?? [], since };
  }

  /**
   * @param {number} number
   * @returns {void}
   */
  #hear(number) {
    const isWanted = () => this.#heard.get(number) === hearer; // no other document was opened since
    /** @type {Hearer} */
    const hearer = {
      run: (run) => {
        this.#keep(run);
        if (!isWanted()) return;
        if (canBeShown(run) && (isOver(run) || this.#awaited !== number))
          this.#try(() => this.show(number));
        if (!isOver(run)) return;
        if (run.error) this.#refuse(run.error);
      },
      progress: ({ seconds, flowtime, lower_bound: bound, progress }) => {
        const run = this.find(number);
        if (!run) return;
        /** @type {[number, number][]} */
        const reached = flowtime === undefined ? [] : [[seconds ?? 0, flowtime]];
        const points = [...run.points, ...reached];
        const round = progress?.[0] === ROUND ? progress : run.round;
        this.#keep({ ...run, points, bound: bound ?? run.bound, round });
      },
      plan: ({ figures }) => {
        const run = this.find(number);
        if (run) this.#keep({ ...run, figures, has_plan: true });
        if (isWanted()) this.#try(() => this.show(number));
      },
    };
    this.#heard.set(number, hearer);
    listen(number, hearer);
  }

  /**
   * @param {() => unknown} action
   * @returns {Promise<void>}
   */
  async #try(action) {
    try {
      await action();
    } catch (refusal) {
      this.#refuse(/** @type {Refusal} */ (refusal));
    }
  }

  /**
   * @param {ErrorData | Refusal} refusal
   * @returns {void}
   */
  #refuse(refusal) {
    this.refusal = refusal;
    this.tell("refusal");
  }
}
