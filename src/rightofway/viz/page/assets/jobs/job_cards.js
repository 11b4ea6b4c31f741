import { element, facts, goTo, link, swatch } from "../common/dom.js";
import { texts } from "../language/language.js";
import { chooseAt } from "../lists/two_line_list.js";
import { chargeCurve } from "./charge_curve.js";
import { upperFirst } from "../language/words.js";

/** @import { Choice } from "../player/choice.js" */
/** @import { Clock } from "../player/clock.js" */
/** @import { JobData, TourRow } from "../payload.d.ts" */
/** @import { Plan } from "../plan/plan.js" */
/** @import { Robot } from "../plan/robot.js" */
/** @import { Words } from "../language/words.js" */

const MOST_ITEMS = 200; // of a tour in a card

/** What the card has of a job, and of the tour of a robot. */
export class JobCards {
  /**
   * @param {Plan} plan
   * @param {Clock} clock
   * @param {Choice} choice
   * @param {Words} words
   */
  constructor(plan, clock, choice, words) {
    this.plan = plan;
    this.clock = clock;
    this.choice = choice;
    this.words = words;
  }

  /**
   * How many jobs are done, and how long they took, with explanations.
   *
   * @returns {[string, string, string][]}
   */
  get figures() {
    const { jobs } = this.plan;
    const done = jobs.flatMap(({ times }) => (times ? [times[2]] : []));
    const service = done.reduce((sum, ticks) => sum + ticks, 0);
    const count = texts.lateOf({ count: done.length, all: jobs.length });
    const { serviceTime, serviceTimeAtLength } = texts.jobs;
    return [
      [texts.jobs.done, count, texts.jobs.doneAtLength],
      [serviceTime, this.words.time(service), serviceTimeAtLength],
    ];
  }

  /** @param {JobData} job */
  title({ name, robot }) {
    const dots = robot === undefined ? [] : [swatch(this.choice.robots[robot])];
    return [...dots, element("h2", { className: "name" }, name)];
  }

  /**
   * Who does a job when, its stops, and why that robot.
   *
   * @param {JobData} job
   * @returns {HTMLElement[]}
   */
  job(job) {
    const { words, choice } = this;
    const { robot, times, due } = job;
    const reason =
      job.reason === undefined ? "" : upperFirst(`${this.plan.phrases.said(job.reason)}.`);
    return [
      ...(reason ? [element("p", { className: "wrong" }, reason)] : []),
      facts([
        [
          texts.jobs.robot,
          robot === undefined ? null : link(words.robot(robot), () => choice.chooseRobot(robot)),
        ],
        [texts.jobs.serviceTime, times ? words.time(times[2]) : ""],
        [texts.jobs.due, due === undefined ? "" : words.time(due)],
        [texts.jobs.late, times?.[3] ? words.time(times[3]) : ""],
      ]),
      element("h3", {}, texts.jobs.stops),
      element("ol", {}, ...job.stops.map((stop) => this.#stop(stop))),
      ...this.#costs(job),
    ];
  }

  /** @param {JobData["stops"][number]} stop */
  #stop([vertex, load, begin, end]) {
    const text = [this.words.where(vertex), ...this.#doing(load, end - begin)].join(", ");
    if (begin < 0) return goTo("", text, () => this.choice.light([vertex]));
    return goTo(this.words.time(begin), text, () =>
      chooseAt(this.clock, begin, () => this.choice.light([vertex])),
    );
  }

  /**
   * @param {number} load
   * @param {number} work
   */
  #doing(load, work) {
    const parts = [];
    if (load) parts.push(texts.jobs[load > 0 ? "loads" : "unloads"]({ count: Math.abs(load) }));
    if (work) parts.push(texts.works({ time: this.words.duration(work) }));
    return parts;
  }

  /**
   * What the job would cost on each robot that may do it.
   *
   * @param {JobData} job
   */
  #costs({ robot: own, costs }) {
    if (!costs?.length) return [];
    const { words, choice } = this;
    const rows = costs.map(([robot, ticks]) =>
      element(
        "tr",
        { className: robot === own ? "taken" : "" },
        element(
          "th",
          { scope: "row" },
          link(words.robot(robot), () => choice.chooseRobot(robot)),
        ),
        element("td", {}, ticks === null ? texts.jobs.fitsNowhere : `+${words.time(ticks)}`),
      ),
    );
    return [
      element("h3", {}, own === undefined ? texts.jobs.costs : texts.jobs.whyThisRobot),
      element("table", { className: "job-costs" }, ...rows),
      element("p", { className: "note" }, texts.jobs.costsAtLength),
    ];
  }

  /**
   * What a robot does in turn, with its load, and its battery over time.
   *
   * @param {Robot} robot
   * @returns {HTMLElement[]}
   */
  tour(robot) {
    const tour = this.plan.tours[robot.index];
    const { items, charges } = tour;
    const title = element("h3", {}, texts.jobs.tour);
    if (!items.length) return [title, element("p", { className: "note" }, texts.jobs.noTour)];
    // of a long tour, those from the one before this moment on
    const now = items.findLastIndex(([, , , begin]) => begin <= this.clock.tick);
    const first = items.length > MOST_ITEMS ? Math.max(now, 0) : 0;
    const shown = items.slice(first, first + MOST_ITEMS);
    const lines = element("ol", {}, ...shown.map((item) => this.#item(robot, item)));
    const left = items.length - shown.length;
    if (left) lines.append(element("li", {}, texts.andMore({ count: left })));
    const curve = charges?.length
      ? [
          element("h3", {}, texts.jobs.charge),
          chargeCurve(tour, this.plan.end, this.words, (tick) => {
            this.clock.pause();
            this.clock.seek(tick);
          }),
        ]
      : [];
    return [...curve, title, lines];
  }

  /**
   * @param {Robot} robot
   * @param {TourRow} item
   */
  #item(robot, [job, stop, vertex, begin, end, load]) {
    const { words, choice } = this;
    const where = words.where(vertex);
    if (job < 0) {
      const text = texts.jobs.charges({ where, time: words.duration(end - begin) });
      return goTo(words.time(begin), text, () =>
        chooseAt(this.clock, begin, () => choice.light([vertex])),
      );
    }
    const { name, stops } = this.plan.jobs[job];
    const change = stops[stop][1];
    const parts = [where, ...this.#doing(change, end - begin)];
    if (change && load) parts.push(texts.jobs.onBoard({ count: load }));
    return goTo(words.time(begin), texts.jobs.item({ name, what: parts.join(", ") }), () =>
      chooseAt(this.clock, begin, () => choice.chooseJob(job)),
    );
  }
}
