import { element, facts, link } from "./dom.js";
import { DONE, WAIT } from "./phases.js";
import { counted } from "./quantities.js";

/** The head of the page: what the plan achieves, in plain words and few figures; how it was made, on request. */
export class Summary {
  constructor(plan, choice, words, comparison) {
    Object.assign(this, { plan, choice, words, comparison });
    const robots = counted(plan.robots.length, "robot");
    const outcome = this.#outcome();
    if (plan.other) document.title = `${plan.title} and ${plan.other.title}`;
    const rest = plan.title ? [robots, outcome] : [outcome];
    document
      .getElementById("headline")
      .replaceChildren(
        element("b", { className: "name" }, plan.title || robots),
        ...(plan.other
          ? [element("span", {}, "→"), element("b", { className: "name" }, plan.other.title)]
          : []),
        ...rest.filter(Boolean).map((part) => element("span", {}, part)),
      );
    document.body.classList.toggle("faulty", plan.faultCount > 0 || plan.other?.faultCount > 0);
    document
      .getElementById("figures")
      .replaceChildren(
        ...this.figures.map(([term, value, title]) =>
          element("div", { title }, element("dt", {}, term), element("dd", {}, ...[value].flat())),
        ),
      );
    const header = document.querySelector(".summary");
    new ResizeObserver(
      () => (header.tabIndex = header.scrollWidth > header.clientWidth ? 0 : -1),
    ).observe(header); // scrolls by keys
    document.getElementById("about-open").hidden = plan.noPlan;
    document.getElementById("made").replaceChildren(facts(this.#made()), ...this.#explanation());
  }

  /** What figures cannot say: faults, robots that are stuck, what repeats itself. */
  #outcome() {
    const { faultCount, noPlan, other, happened, steady, robots } = this.plan;
    if (noPlan) return "no plan exists";
    if (other) return this.#comparedOutcome();
    if (faultCount) return `${counted(faultCount, "fault")}: do not run this plan`;
    if (happened) {
      const failed = happened.filter(({ ending }) => ending !== DONE).length;
      return failed ? `${failed} of them never ${this.#arrived}` : "";
    }
    const stuck = robots.filter(({ ending }) => ending === WAIT).length;
    if (stuck) return `${stuck} of them stuck for ever`;
    return steady ? this.#repetition(steady) : "";
  }

  /** Which of two plans has faults. */
  #comparedOutcome() {
    const faulty = [this.plan, this.plan.other].filter(({ faultCount }) => faultCount);
    return faulty
      .map(({ title, faultCount }) => `${title} has ${counted(faultCount, "fault")}: do not run it`)
      .join(", ");
  }

  /** What a robot is that has done everything. */
  get #arrived() {
    return this.plan.endsAtHome ? "home" : "done";
  }

  #repetition({ groups, groupOf }) {
    const robots = groupOf.filter(Boolean).length;
    if (robots < groupOf.length) return `${robots} of them known to repeat themselves`;
    return groups.length > 1 ? `in ${groups.length} groups that repeat themselves` : "";
  }

  /** Terms, values and explanations. */
  get figures() {
    const { noPlan, faultCount, happened, steady } = this.plan;
    if (noPlan) return [];
    if (this.plan.other?.faultCount) return [];
    if (faultCount)
      return Object.entries(this.plan.faultKinds).map(([kind, count]) => [
        kind,
        String(count),
        this.words.remedy({ kind }),
      ]);
    if (this.comparison) return this.#comparedFigures();
    const figures = happened
      ? this.#floorFigures()
      : steady
        ? this.#steadyFigures()
        : this.#planFigures();
    return figures.filter(([, value]) => value);
  }

  #planFigures() {
    const { robots, metrics } = this.plan;
    const latest = mostOf(robots, ({ completion }) => completion);
    const loser = mostOf(robots, ({ delay }) => delay);
    return [
      [
        `All ${this.#arrived} at`,
        this.words.time(metrics.makespan),
        `When the last robot is ${this.#arrived}`,
      ],
      ["Latest", this.#robot(latest), `The robot that is ${this.#arrived} last`],
      [
        "Time lost",
        this.#timeLost(robots),
        "How much later the robots arrive, all together, than if each drove alone",
      ],
      [
        "Loses most",
        loser.delay > 0 ? [this.#robot(loser), `, ${this.words.time(loser.delay)}`] : "",
        "The robot that loses most time to others",
      ],
    ];
  }

  /** The sum of all lost time, and its parts. */
  #timeLost(robots) {
    const all = robots.reduce((sum, { delay }) => sum + delay, 0);
    return all
      ? [this.words.time(all), element("small", {}, ` ${this.#lostParts(robots)}`)]
      : "none";
  }

  /** "(waiting 35 s, detours 6 s)"; the only part without its time. */
  #lostParts(robots) {
    const sum = (part) => robots.reduce((all, robot) => all + part(robot), 0);
    const parts = [
      ["waiting", sum(({ lost }) => lost.waiting)],
      ["detours", sum(({ lost }) => lost.detours)],
      ["making room", sum(({ lost }) => lost.makingRoom)],
    ].filter(([, ticks]) => ticks);
    return `(${parts.length > 1 ? parts.map(([what, ticks]) => `${what} ${this.words.time(ticks)}`).join(", ") : parts[0][0]})`;
  }

  /** Both plans, and how many robots gain by the other one. */
  #comparedFigures() {
    const { plan, words, comparison } = this;
    const both = (value) => `${words.time(value(plan))} → ${words.time(value(plan.other))}`;
    const changes = plan.planned.map((robot) => comparison.change(robot));
    const count = (holds) => String(changes.filter(holds).length);
    return [
      [
        `All ${this.#arrived} at`,
        both(({ metrics }) => metrics.makespan),
        `When the last robot is ${this.#arrived}, in both plans`,
      ],
      [
        "Time lost",
        both(({ metrics }) => metrics.flowtime - metrics.lowerBound),
        "How much later the robots arrive, all together, than if each drove alone",
      ],
      [
        "Earlier",
        count((change) => change < 0),
        `Robots that arrive earlier in ${plan.other.title}`,
      ],
      ["Later", count((change) => change > 0), `Robots that arrive later in ${plan.other.title}`],
    ];
  }

  #steadyFigures() {
    const { steady } = this.plan;
    const { largest, groups } = steady;
    const laps = largest.robots.reduce((sum, index) => sum + steady.lapsInPeriod(index), 0);
    const whose = groups.length > 1 ? " (largest group)" : "";
    return [
      [
        `Repeats every${whose}`,
        this.words.time(largest.period),
        "The period: the time after which all visits repeat",
      ],
      [
        "From",
        this.words.time(largest.start),
        "The transient: how long it takes until everything repeats",
      ],
      [
        "Laps in that time",
        largest.whole ? String(laps) : "",
        "Laps that all robots together make in a period",
      ],
    ];
  }

  #floorFigures() {
    const { happened, metrics } = this.plan;
    const late = happened.filter(({ delayInAll }) => delayInAll > 0);
    const done = happened.filter(({ ending }) => ending === DONE);
    const latest = mostOf(done, ({ delayInAll }) => delayInAll);
    return [
      [
        `All ${this.#arrived} at`,
        done.length === happened.length ? this.#insteadOf(metrics.makespan) : "",
        `When the last robot was ${this.#arrived}`,
      ],
      [
        "Late",
        `${late.length} of ${happened.length}`,
        "Robots that arrived later than planned, or never",
      ],
      [
        "Latest by",
        latest?.delayInAll > 0
          ? [`${this.words.time(latest.delayInAll)}, `, this.#robot(latest)]
          : "",
        "The largest delay of a robot that arrived",
      ],
    ];
  }

  /** When the last robot was there, and when it was to be. */
  #insteadOf(makespan) {
    const planned = this.words.time(makespan);
    const last = Math.max(...this.plan.happened.map(({ completion }) => completion));
    return last === makespan
      ? `${planned}, as planned`
      : `${this.words.time(last)} instead of ${planned}`;
  }

  #robot(robot) {
    return link(robot.name, () => this.choice.chooseRobot(robot.index));
  }

  /** What a search gained over its first plan; of other planners, what they report. */
  #method() {
    const { status, saved, tries } = this.plan.planner;
    if (saved === undefined) return status;
    const gain = saved > 0 ? `saved ${this.words.duration(saved)}` : "found no better plan";
    return `${tries === null ? "attempts" : counted(tries, "attempt")} to improve the first plan ${gain}`;
  }

  #made() {
    const {
      planner,
      metrics: { flowtime, makespan, lowerBound },
      tick,
    } = this.plan;
    const gap = lowerBound ? this.words.percent(flowtime / lowerBound - 1) : "";
    const isUnit = tick.numerator === tick.denominator;
    const origin = [
      ["Planner", planner.name],
      ["Method", this.#method()],
    ];
    if (this.plan.faultCount) return origin; // its times are worth nothing
    return [
      ...origin,
      ["Flowtime", this.words.time(flowtime)],
      ["Lower bound", this.words.time(lowerBound)],
      ["Gap", gap],
      ["Makespan", this.words.time(makespan)],
      [
        "Time lost",
        [this.#timeLost(this.plan.planned)]
          .flat()
          .map((part) => part.textContent ?? part)
          .join(""),
      ],
      ["Tick", isUnit ? "" : `${this.words.duration(1)}, the step in which times are counted`],
    ];
  }

  #explanation() {
    if (this.plan.faultCount) return [];
    return [
      "The flowtime is the sum of the times at which the robots are done. The lower bound is the same sum if each robot " +
        "drove alone: no plan has a smaller flowtime. The gap is how far the flowtime of this plan is above the lower bound.",
      "The makespan is the time at which the last robot is done.",
    ].map((text) => element("p", {}, text));
  }
}

/** The item with the largest value; the first one of several. */
function mostOf(items, valueOf) {
  return items.reduce(
    (most, item) => (most === null || valueOf(item) > valueOf(most) ? item : most),
    null,
  );
}
