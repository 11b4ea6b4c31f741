/** The runs of this studio: begun, heard, shown, compared; and what a plan says about waits. */

import { Observable } from "../viewer/observable.js";
import { get, listen, post, remove, request } from "../api.js";

export const isOver = (run) => !["queued", "running"].includes(run.state);
export const canBeShown = (run) => run.has_plan || run.has_payload;

const NO_COMMAND = ["flip", "opened"]; // kinds of runs that no command makes
const NO_CHOICES = { rules: {}, delays: { default: "", examples: {} }, formats: {} };
const NOTHING_SHOWN = {
  former: null,
  shown: null,
  payload: null,
  losses: null,
  report: null,
  command: "",
  beside: null,
  comparison: null,
};

/** Events: `runs` when any has changed, `payload` when another plan is to be shown or none, `refusal`. */
export class RunStore extends Observable {
  runs = [];
  planners = { default: "auto", planners: [] };
  choices = NO_CHOICES;
  shown = null; // number of the run that is shown
  payload = null;
  former = null; // the run that was shown before it, with its payload
  beside = null; // number of the run that it is compared with
  comparison = null;
  losses = null; // of the plan that is shown, once they are known
  report = null; // of laps or a simulation that is shown
  command = ""; // that gives the same as the run that is shown; empty where none does
  #documents = new Map(); // that each run of this page was made from
  #wanted = 0;
  #live = 0; // the last run that was made by a change

  async load() {
    const [planners, { runs }, choices] = await Promise.all([
      get("/planners"),
      get("/runs"),
      get("/choices"),
    ]);
    Object.assign(this, { planners, runs, choices });
    for (const run of runs) if (!isOver(run)) this.#hear(run.number);
    this.tell("runs");
  }

  /** The latest run that is queued or running. */
  get running() {
    return this.runs.find((run) => !isOver(run));
  }

  get run() {
    return this.find(this.shown);
  }

  find(number) {
    return this.runs.find((run) => run.number === number);
  }

  /** Whether the plan that is shown is of this document. */
  isOf(document) {
    const made = this.#documents.get(this.shown);
    return made === undefined || made === document;
  }

  /** The document that a run was made from. */
  async documentOf(number) {
    if (!this.#documents.has(number))
      this.#documents.set(number, (await get(`/runs/${number}/document`)).document);
    return this.#documents.get(number);
  }

  /** Queue a run of a document or of another run; it is shown as soon as there is a plan. */
  async begin(request, document) {
    const run = await post("/runs", request);
    if (document) this.#documents.set(run.number, document);
    this.#keep(run);
    this.#hear(run.number);
    return run.number;
  }

  plan({ document, folder, path }, settings) {
    return this.begin({ kind: "plan", document, folder, source: path, ...settings }, document);
  }

  /**
   * Plan at once what has just been changed, from the plan that is shown where the planner can start
   * from one; an earlier such run gives way.
   */
  async replan(given, settings) {
    const before = this.find(this.#live);
    const isSecond = before && !isOver(before);
    if (isSecond) await post(`/runs/${before.number}/cancel`).catch(() => {});
    const base = isSecond ? before.based_on : this.shown;
    const { has_plan, kind } = this.find(base) ?? {};
    const { improves } = this.planners.planners.find(({ name }) => name === settings.planner) ?? {};
    const start = has_plan && improves && kind !== "laps" ? { start: base } : {};
    this.#live = await this.plan(given, { ...settings, ...start, time_limit: 1, based_on: base });
    this.beside = base;
  }

  stop() {
    return post(`/runs/${this.running.number}/stop`);
  }

  cancel() {
    return post(`/runs/${this.running.number}/cancel`);
  }

  /** Show the plan of a run, and find out why its robots wait. */
  async show(number) {
    const turn = ++this.#wanted;
    const payload = await get(`/runs/${number}/payload`);
    if (turn !== this.#wanted) return;
    if (this.shown !== number && this.payload)
      this.former = { number: this.shown, payload: this.payload };
    if (this.shown !== number) Object.assign(this, { losses: null, report: null, command: "" });
    Object.assign(this, { shown: number, payload });
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
    Object.assign(this, { ...losses, report, ...command });
    this.tell("runs");
  }

  /** Play another run of the simulation that is shown. */
  async replay(replayed) {
    const [turn, number] = [++this.#wanted, this.shown];
    const payload = await get(`/runs/${number}/payload?replay=${replayed}`);
    if (turn !== this.#wanted) return;
    Object.assign(this, { payload, replayed });
    this.tell("payload");
  }

  /** Show no plan any more. */
  hide() {
    this.#wanted++;
    Object.assign(this, NOTHING_SHOWN);
    this.tell("payload");
  }

  /**
   * Compare the plan that is shown with that of another run; null to end that. What was compared
   * before stays until the answer is there, so that nothing jumps.
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

  /** Let a robot that waits go first, and show what follows. */
  async flip({ robot, for: other, end }) {
    const base = this.shown;
    const { run } = await post(`/runs/${base}/flip`, {
      waits: robot,
      goes_first: other,
      tick: end,
    });
    if (this.#documents.has(base)) this.#documents.set(run.number, this.#documents.get(base));
    this.#keep(run);
    this.beside = base;
    await this.show(run.number);
  }

  async rename(number, name) {
    this.#keep(await request("PATCH", `/runs/${number}`, { name }));
  }

  async forget(number) {
    await remove(`/runs/${number}`);
    this.runs = this.runs.filter((run) => run.number !== number);
    if (this.beside === number) Object.assign(this, { beside: null, comparison: null });
    if (this.shown === number) this.hide();
    this.tell("runs");
  }

  /** Take in a run that was made elsewhere. */
  add(run) {
    this.#keep(run);
  }

  #keep(run) {
    const before = this.find(run.number);
    const points = run.points?.length || !before ? run.points : before.points;
    const since = run.state === "running" ? (before?.since ?? performance.now()) : undefined; // clocks of server and browser may differ
    const kept = { ...run, points: points ?? [], since };
    this.runs = [kept, ...this.runs.filter(({ number }) => number !== run.number)].sort(
      (a, b) => b.number - a.number,
    );
    this.tell("runs");
  }

  #hear(number) {
    listen(number, {
      run: (run) => {
        this.#keep(run);
        if (!isOver(run)) return;
        if (canBeShown(run)) this.#try(() => this.show(number));
        if (run.error) this.#refuse(run.error);
      },
      progress: ({ seconds, flowtime, lower_bound: bound, message }) => {
        const run = this.find(number);
        if (!run) return;
        const points = flowtime === undefined ? run.points : [...run.points, [seconds, flowtime]];
        this.#keep({ ...run, points, bound: bound ?? run.bound, message: message ?? run.message });
      },
      plan: ({ figures }) => {
        const run = this.find(number);
        if (run) this.#keep({ ...run, figures, has_plan: true });
        this.#try(() => this.show(number));
      },
    });
  }

  async #try(action) {
    try {
      await action();
    } catch (refusal) {
      this.#refuse(refusal);
    }
  }

  #refuse(refusal) {
    this.refusal = refusal;
    this.tell("refusal");
  }
}
