import { element } from "../common/dom.js";
import { said, texts } from "../language/language.js";
import { joined } from "../language/words.js";

/** @import { Compared, ComparedFigures } from "./compared.js" */
/** @import { ChangeData } from "../payload.d.ts" */

const MOST_CHANGES = 12; // that are listed of one plan
const FEW_NAMES = 2; // robots with the same change
const TIMES = /** @type {const} */ (["flowtime", "makespan", "lower_bound"]);
const RATES_OF_PLANS = /** @type {const} */ (["gap", "seconds"]);

/** The figures of plans, a column each, the best of each row marked; a press on a head makes that plan the base. */
export class ComparedTable {
  /** @type {HTMLElement[]} */
  heads = [];

  /**
   * @param {Compared} compared
   * @param {HTMLElement} box
   */
  constructor(compared, box) {
    this.compared = compared;
    this.box = box;
    const { plans } = compared;
    const isFaulty = plans.some(({ faults }) => faults);
    const rows = [
      isFaulty ? this.#row("faults", ({ faults }) => this.#faults(faults)) : null,
      this.#row("planner", ({ planner }) => planner),
      ...TIMES.map((key) => this.#row(key, (figures) => compared.time(figures[key]))),
      ...RATES_OF_PLANS.map((key) => this.#row(key, ({ text }) => said(text[key]))),
      this.#row("seed", ({ seed }) => String(seed)),
    ];
    if (new Set(plans.map(({ robots }) => robots)).size > 1)
      rows.push(this.#row("robots", ({ robots }) => String(robots)));
    const body = element("tbody", {}, ...rows.filter((row) => row !== null));
    this.table = element("table", { className: "compared-figures" }, this.#head(), body);
    box.replaceChildren(this.table, ...this.#changes());
    compared.on("base", () => this.#mark());
    this.#mark();
  }

  #head() {
    this.heads = this.compared.plans.map(({ title }, place) => {
      const button = element("button", { type: "button", className: "name" }, title);
      button.title = texts.compared.compareWith({ title });
      button.addEventListener("click", () => this.compared.setBase(place));
      return element("th", { scope: "col" }, button);
    });
    return element("thead", {}, element("tr", {}, element("td"), ...this.heads));
  }

  /** @param {number} count */
  #faults(count) {
    return count ? element("b", { className: "wrong" }, texts.doNotRun({ count })) : texts.none;
  }

  /**
   * A row of one figure; nothing where no plan has it.
   *
   * @param {keyof typeof texts["compared"]["figures"]} key
   * @param {(plan: ComparedFigures) => string | Node} valueOf
   */
  #row(key, valueOf) {
    const values = this.compared.plans.map(valueOf);
    if (values.every((value) => value === "")) return null;
    /** @type {Partial<Record<string, number[]>>} */
    const bests = { ...this.compared.best };
    const best = bests[key] ?? [];
    const cells = values.map((value, place) => {
      const cell = element("td", {}, value);
      if (!best.includes(place)) return cell;
      cell.className = "best";
      cell.append(element("span", { className: "unseen" }, ` (${texts.compared.isBest})`));
      return cell;
    });
    const { figures } = texts.compared;
    /** @type {Partial<Record<string, string>>} */
    const terms = texts.compared.terms;
    const head = element("th", { scope: "row", title: terms[key] ?? "" }, figures[key]);
    return element("tr", {}, head, ...cells);
  }

  /** In what the scenario of a plan differs from that of the first one, where it does. */
  #changes() {
    const [first, ...others] = this.compared.plans;
    return others
      .filter(({ changes }) => changes.length)
      .map(({ title, changes }) => {
        const shown = changes.slice(0, MOST_CHANGES).map(changeInWords);
        const left = changes.length - shown.length;
        const list = [...shown, ...(left ? [texts.andMore({ count: left })] : [])].map((text) =>
          element("li", { className: "name" }, text),
        );
        const head = element(
          "h3",
          { className: "name" },
          texts.compared.changes({ title, base: first.title }),
        );
        return element("div", { className: "compared-changes" }, head, element("ul", {}, ...list));
      });
  }

  #mark() {
    this.heads.forEach((head, place) => {
      const isBase = place === this.compared.base;
      head.classList.toggle("base", isBase);
      head.firstElementChild?.setAttribute("aria-pressed", String(isBase));
    });
  }
}

/**
 * A change of a scenario or of its jobs: "R2: speed 1 m/s → 2 m/s".
 *
 * @param {ChangeData} options
 */
export function changeInWords({ subject, robots, jobs, key, before, after }) {
  /** @type {Record<"whats" | "keys", Partial<Record<string, string>>>} */
  const { whats, keys } = texts.compared;
  const names = robots.length ? robots : jobs;
  const counted = robots.length ? texts.robots : texts.compared.jobs;
  const named =
    names.length > FEW_NAMES ? counted({ count: names.length }) : joined(names).join("");
  const whose = named || (whats[said(subject)] ?? said(subject));
  const values = [before, after].filter(Boolean).map(said).join(" → ");
  return `${whose}: ${[keys[key] ?? key, values].filter(Boolean).join(" ")}`;
}
