import { element, facts, link } from "../common/dom.js";
import { said, texts } from "../language/language.js";
import { DONE, WAIT } from "../plan/phases.js";
import { several, upperFirst } from "../language/words.js";

/** @import { Root } from "../common/root.js" */
/** @import { Choice } from "../player/choice.js" */
/** @import { Compared, ComparedFigures } from "./compared.js" */
/** @import { Comparison } from "./comparison.js" */
/** @import { JobCards } from "../jobs/job_cards.js" */
/** @import { Plan } from "../plan/plan.js" */
/** @import { Robot } from "../plan/robot.js" */
/** @import { Words } from "../language/words.js" */
/** @import { Steady } from "../plan/steady.js" */

/** @typedef {[string, string | Node | (string | Node)[], string]} Figure */

/** The head of the page: what the plan achieves, in plain words and few figures; how it was made, on request. */
export class Summary {
  /**
   * @param {Root} root
   * @param {Plan} plan
   * @param {Choice} choice
   * @param {Words} words
   * @param {Comparison | null} comparison
   * @param {JobCards | null} jobs of a plan with jobs
   */
  constructor(root, plan, choice, words, comparison, jobs) {
    this.jobs = jobs;
    this.root = root;
    this.plan = plan;
    this.choice = choice;
    this.words = words;
    this.comparison = comparison;
    const robots = texts.robots({ count: plan.robots.length });
    const outcome = this.#outcome();
    const titles = [plan, ...plan.others].map(({ title }) => title);
    if (comparison && !root.isPart) document.title = titles.join(", ");
    else if (plan.title && !root.isPart) document.title = `${plan.title}: ${robots}`;
    const rest = plan.title ? [robots, outcome] : [outcome];
    root
      .part("headline")
      .replaceChildren(
        ...this.#names(titles, robots),
        ...rest.filter(Boolean).map((part) => element("span", {}, part)),
      );
    root.element.classList.toggle("faulty", this.#faulty.length > 0);
    root
      .part("figures")
      .replaceChildren(
        ...this.figures.map(([term, value, title]) =>
          element("div", { title }, element("dt", {}, term), element("dd", {}, ...[value].flat())),
        ),
      );
    const [header] = root.all(".summary", HTMLElement);
    root.observe(
      header,
      () => (header.tabIndex = header.scrollWidth > header.clientWidth ? 0 : -1),
    ); // scrolls by keys
    root.part("about-open").hidden = plan.noPlan || Boolean(plan.shift);
    root.part("made").replaceChildren(facts(this.#made()), ...this.#explanation());
  }

  /**
   * The title; "A → B" for two plans, how many there are for more.
   *
   * @param {string[]} titles
   * @param {string} robots
   */
  #names(titles, robots) {
    /** @param {string} text */
    const name = (text) => element("b", { className: "name" }, text);
    if (titles.length > 2) return [name(texts.compared.plans({ count: titles.length }))];
    const [first, other] = titles;
    return [name(first || robots), ...(other ? [element("span", {}, "→"), name(other)] : [])];
  }

  /** What figures cannot say: faults, robots that are stuck, what repeats itself. */
  #outcome() {
    const { faultCount, noPlan, happened, steady, planned: robots } = this.plan;
    if (noPlan) return texts.noPlan;
    if (this.comparison) return this.#comparedOutcome();
    if (faultCount) return texts.doNotRun({ count: faultCount });
    if (happened && !this.plan.driven) {
      const failed = happened.filter(({ ending }) => ending !== DONE).length;
      return failed ? texts.neverArrived({ count: failed, isHome: this.plan.endsAtHome }) : "";
    }
    const stuck = robots.filter(({ ending }) => ending === WAIT).length;
    if (stuck) return texts.stuckForEver({ count: stuck });
    return steady ? this.#repetition(steady) : "";
  }

  get #faulty() {
    return [this.plan, ...this.plan.others].filter(({ faultCount }) => faultCount);
  }

  /** Which of the plans have faults. */
  #comparedOutcome() {
    return this.#faulty
      .map(({ title, faultCount }) => texts.doNotRunOther({ title, count: faultCount }))
      .join(", ");
  }

  /** @param {Steady} options */
  #repetition({ groups, groupOf }) {
    const robots = groupOf.filter(Boolean).length;
    if (robots < groupOf.length) return texts.someRepeat({ count: robots });
    return groups.length > 1 ? texts.groupsRepeat({ count: groups.length }) : "";
  }

  /**
   * Terms, values and explanations.
   *
   * @returns {Figure[]}
   */
  get figures() {
    const { noPlan, faultCount, happened, steady } = this.plan;
    if (noPlan) return [];
    if (this.comparison)
      return this.#faulty.length ? [] : this.#comparedFigures(this.comparison.compared);
    if (faultCount)
      return this.plan.faultKinds.map(([name, count]) => [
        this.plan.phrases.said(name),
        String(count),
        "",
      ]);
    if (this.plan.shift && this.jobs) return this.jobs.figures.filter(([, value]) => value);
    const figures =
      happened && !this.plan.driven
        ? this.#floorFigures()
        : steady
          ? this.#steadyFigures()
          : this.#planFigures();
    return figures.filter(([, value]) => value);
  }

  /** @returns {Figure[]} */
  #planFigures() {
    const { planned: robots, metrics, endsAtHome } = this.plan;
    const latest = mostOf(robots, ({ completion }) => completion);
    const loser = mostOf(robots, ({ delay }) => delay);
    return [
      ...(this.jobs?.figures ?? []),
      [
        texts.allAt({ isHome: endsAtHome }),
        this.words.time(metrics.makespan),
        texts.allAtLength({ isHome: endsAtHome }),
      ],
      [
        texts.latest,
        latest && !this.jobs ? this.#robot(latest) : "", // jobs have figures of their own
        texts.latestAtLength({ isHome: endsAtHome }),
      ],
      [texts.timeLost, this.#timeLost(robots), texts.timeLostAtLength],
      [
        texts.losesMost,
        loser && loser.delay > 0 ? [this.#robot(loser), `, ${this.words.time(loser.delay)}`] : "",
        texts.losesMostAtLength,
      ],
    ];
  }

  /**
   * The sum of all lost time, and its parts.
   *
   * @param {readonly Robot[]} robots
   */
  #timeLost(robots) {
    const lost = robots.reduce((sum, { delay }) => sum + delay, 0);
    return lost
      ? [this.words.time(lost), element("small", {}, ` ${this.#lostParts(robots)}`)]
      : texts.none;
  }

  /**
   * "(waiting 35 s, detours 6 s)"; the only part without its time.
   *
   * @param {readonly Robot[]} robots
   */
  #lostParts(robots) {
    /** @param {(robot: Robot) => number} part */
    const sum = (part) => robots.reduce((before, robot) => before + part(robot), 0);
    /** @type {[string, number][]} */
    const causes = [
      [texts.lost.waiting, sum(({ lost }) => lost.waiting)],
      [texts.lost.detours, sum(({ lost }) => lost.detours)],
      [texts.lost.makingRoom, sum(({ lost }) => lost.makingRoom)],
    ];
    const parts = causes.filter(([, ticks]) => ticks);
    return `(${parts.length > 1 ? parts.map(([what, ticks]) => `${what} ${this.words.time(ticks)}`).join(", ") : parts[0][0]})`;
  }

  /**
   * What the plans cost, and how many robots gain and lose by the other one; of many, the best.
   *
   * @param {Compared} compared
   * @returns {Figure[]}
   */
  #comparedFigures(compared) {
    const { endsAtHome } = this.plan;
    if (compared.plans.length > 2) {
      /** @type {["makespan" | "flowtime", string, string][]} */
      const rows = [
        ["makespan", texts.allAt({ isHome: endsAtHome }), texts.compared.firstAllAtLength],
        ["flowtime", texts.compared.least, texts.compared.leastAtLength],
      ];
      return rows
        .filter(([key]) => compared.best[key].length)
        .map(([key, term, title]) => {
          const names = compared.best[key].map((place) => compared.plans[place].title);
          return [
            term,
            `${compared.time(compared.plans[compared.best[key][0]][key])}, ${several(names)}`,
            title,
          ];
        });
    }
    /** @param {(plan: ComparedFigures) => number} value */
    const both = (value) => compared.plans.map((plan) => compared.time(value(plan))).join(" → ");
    const [earlier, later] = compared.counts(1);
    const { title } = compared.plans[1];
    return [
      [
        texts.allAt({ isHome: endsAtHome }),
        both(({ makespan }) => makespan),
        texts.allBothAtLength({ isHome: endsAtHome }),
      ],
      [texts.timeLost, both(({ flowtime, alone }) => flowtime - alone), texts.timeLostAtLength],
      [texts.earlier, String(earlier), texts.earlierAtLength({ title })],
      [texts.later, String(later), texts.laterAtLength({ title })],
    ];
  }

  /** @returns {Figure[]} */
  #steadyFigures() {
    const { steady } = this.plan;
    if (!steady) return [];
    const { largest, groups } = steady;
    const laps = largest.robots.reduce((sum, index) => sum + steady.lapsInPeriod(index), 0);
    return [
      [
        texts.repeatsEvery({ isLargest: groups.length > 1 }),
        this.words.time(largest.period),
        texts.repeatsEveryAtLength,
      ],
      [texts.from, this.words.time(largest.start), texts.fromAtLength],
      [texts.lapsInThat, largest.whole ? String(laps) : "", texts.lapsInThatAtLength],
    ];
  }

  /** @returns {Figure[]} */
  #floorFigures() {
    const { metrics, endsAtHome } = this.plan;
    const happened = this.plan.happened ?? [];
    const late = happened.filter(({ delayInAll }) => delayInAll > 0);
    const done = happened.filter(({ ending }) => ending === DONE);
    const latest = mostOf(done, ({ delayInAll }) => delayInAll);
    return [
      [
        texts.allAt({ isHome: endsAtHome }),
        done.length === happened.length ? this.#insteadOf(metrics.makespan) : "",
        texts.allWasAtLength({ isHome: endsAtHome }),
      ],
      [texts.late, texts.lateOf({ count: late.length, all: happened.length }), texts.lateAtLength],
      [
        texts.latestBy,
        latest && latest.delayInAll > 0
          ? [`${this.words.time(latest.delayInAll)}, `, this.#robot(latest)]
          : "",
        texts.latestByAtLength,
      ],
    ];
  }

  /**
   * When the last robot was there, and when it was to be.
   *
   * @param {number} makespan
   */
  #insteadOf(makespan) {
    const planned = this.words.time(makespan);
    const last = Math.max(...(this.plan.happened ?? []).map(({ completion }) => completion));
    return last === makespan
      ? texts.asPlanned({ time: planned })
      : texts.insteadOf({ time: this.words.time(last), planned });
  }

  /** @param {Robot} robot */
  #robot(robot) {
    return link(robot.name, () => this.choice.chooseRobot(robot.index));
  }

  /** @returns {[string, string | Node | null][]} */
  #made() {
    const {
      planner,
      metrics: { flowtime, makespan, lowerBound },
      tick,
    } = this.plan;
    const gap = lowerBound ? this.words.percent(flowtime / lowerBound - 1) : "";
    const isUnit = tick.numerator === tick.denominator;
    /** @type {[string, string | Node][]} */
    const origin = [
      [texts.planner, planner.name && element("span", { translate: false }, planner.name)],
      [texts.method, said(planner.method)],
    ];
    if (this.plan.faultCount) return origin; // its times are worth nothing
    return [
      ...origin,
      [upperFirst(texts.flowtime), this.words.time(flowtime)],
      [upperFirst(texts.lowerBound), this.words.time(lowerBound)],
      [texts.proven, planner.proven ? said(planner.proven) : ""],
      [texts.gap, gap],
      [upperFirst(texts.makespan), this.words.time(makespan)],
      [
        texts.timeLost,
        [this.#timeLost(this.plan.planned)]
          .flat()
          .map((part) => (typeof part === "string" ? part : part.textContent))
          .join(""),
      ],
      [texts.tick, isUnit ? "" : texts.tickAtLength({ time: this.words.duration(1) })],
    ];
  }

  #explanation() {
    if (this.plan.faultCount) return [];
    return texts.explanation.map((text) => element("p", {}, text));
  }
}

/**
 * The item with the largest value; the first one of several.
 *
 * @template I
 * @param {readonly I[]} items
 * @param {(item: I) => number} valueOf
 * @returns {I | null}
 */
function mostOf(items, valueOf) {
  /** @type {I | null} */
  let most = null;
  for (const item of items) if (most === null || valueOf(item) > valueOf(most)) most = item;
  return most;
}
