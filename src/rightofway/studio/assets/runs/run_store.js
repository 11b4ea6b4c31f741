/** The runs of this studio: begun, heard, shown, compared; and what a plan says about waits. */

import { Observable } from "../viewer/observable.js";
import { get, listen, post, remove, request } from "../api.js";

export const isOver = (run) => !["queued", "running"].includes(run.state);

/** Events: `runs` when any has changed, `payload` when another plan is to be shown, `refusal`. */
export class RunStore extends Observable {
  runs = [];
  planners = { default: "auto", planners: [] };
  shown = null; // number of the run that is shown
  payload = null;
  beside = null; // number of the run that it is compared with
  comparison = null;
  losses = null; // of the plan that is shown, once they are known
  #documents = new Map(); // that each run of this page was made from
  #wanted = 0;
  #live = 0; // the last run that was made by a change

  async load() {
    const [planners, { runs }] = await Promise.all([get("/planners"), get("/runs")]);
    Object.assign(this, { planners, runs });
    for (const run of runs) if (!isOver(run)) this.#hear(run.number);
    this.tell("runs");
  }

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

  /** Plan a document; the plan is shown as soon as there is one. */
  async plan({ document, folder, path }, settings) {
    const run = await post("/runs", { kind: "plan", document, folder, source: path, ...settings });
    this.#documents.set(run.number, document);
    this.#keep(run);
    this.#hear(run.number);
    return run.number;
  }

  /** Plan at once what has just been changed; an earlier such run gives way. */
  async replan(given, settings) {
    const before = this.find(this.#live);
    if (before && !isOver(before)) await post(`/runs/${before.number}/cancel`).catch(() => {});
    const base = this.shown;
    this.#live = await this.plan(given, { ...settings, time_limit: 1, based_on: base });
    this.beside = base;
  }

  stop() {
    return post(`/runs/${this.running.number}/stop`);
  }

  /** Show the plan of a run, and find out why its robots wait. */
  async show(number) {
    const turn = ++this.#wanted;
    const payload = await get(`/runs/${number}/payload`);
    if (turn !== this.#wanted) return;
    const isOther = this.shown !== number;
    Object.assign(this, { shown: number, payload });
    if (isOther) Object.assign(this, { losses: null, comparison: null });
    this.tell("payload");
    const run = this.find(number);
    if (!run || !isOver(run)) return;
    const { losses } = await get(`/runs/${number}/losses`);
    if (this.shown !== number) return;
    this.losses = losses;
    this.tell("runs");
    if (this.beside && this.beside !== number) await this.compare(this.beside);
  }

  /** Compare the plan that is shown with that of another run; null to end that. */
  async compare(number) {
    this.beside = number;
    this.comparison = null;
    if (number) {
      const found = await get(`/compare?run=${number}&run=${this.shown}`);
      if (found.runs[1] === this.shown) this.comparison = found;
    }
    this.tell("runs");
  }

  /** Let a robot that waits go first, and show what follows. */
  async flip({ robot, for: other, end }) {
    const base = this.shown;
    const { run } = await post(`/runs/${base}/flip`, { waits: robot, goes_first: other, tick: end });
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
    this.tell("runs");
  }

  /** Take in a run that was made elsewhere. */
  add(run) {
    this.#keep(run);
  }

  #keep(run) {
    const before = this.find(run.number);
    const points = run.points?.length || !before ? run.points : before.points;
    this.runs = [{ ...run, points: points ?? [] }, ...this.runs.filter(({ number }) => number !== run.number)].sort((a, b) => b.number - a.number);
    this.tell("runs");
  }

  #hear(number) {
    listen(number, {
      run: (run) => {
        this.#keep(run);
        if (!isOver(run)) return;
        if (run.has_plan) this.#try(() => this.show(number));
        if (run.error) this.#refuse(run.error);
      },
      progress: ({ seconds, flowtime }) => {
        const run = this.find(number);
        if (flowtime !== undefined && run) this.#keep({ ...run, points: [...run.points, [seconds, flowtime]] });
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
