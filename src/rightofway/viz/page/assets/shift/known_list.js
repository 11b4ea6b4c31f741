import { element } from "../common/dom.js";
import { texts } from "../language/language.js";
import { connectFind, matches } from "../lists/find.js";
import { VirtualList } from "../lists/virtual_list.js";
import { chooseAt } from "../lists/two_line_list.js";
import { upperFirst } from "../language/words.js";

/** @import { Root } from "../common/root.js" */
/** @import { Choice } from "../player/choice.js" */
/** @import { Clock } from "../player/clock.js" */
/** @import { JobData } from "../payload.d.ts" */
/** @import { Plan } from "../plan/plan.js" */
/** @import { Shift } from "./shift.js" */
/** @import { Words } from "../language/words.js" */

/**
 * The jobs that are known at the moment that is shown, those that became known last first.
 *
 * @param {Root} root
 * @param {Plan} plan
 * @param {Clock} clock
 * @param {Choice} choice
 * @param {Words} words
 */
export function makeKnownList(root, plan, clock, choice, words) {
  return new KnownList(root, plan, clock, choice, words);
}

class KnownList {
  /**
   * @param {Root} root
   * @param {Plan} plan
   * @param {Clock} clock
   * @param {Choice} choice
   * @param {Words} words
   */
  constructor(root, plan, clock, choice, words) {
    this.plan = plan;
    this.shift = /** @type {Shift} */ (plan.shift);
    this.clock = clock;
    this.words = words;
    this.known = -1; // how many jobs the list was made of
    this.find = root.part("find-job", HTMLInputElement);
    this.count = root.all("#tab-jobs b", HTMLElement)[0]; // a page of a shift has one player
    this.index = new Map(plan.jobs.map((job, index) => [job, index]));
    this.list = new VirtualList(root.part("job-list"), {
      rowHeight: 52,
      className: "two",
      none: texts.shift.noneKnown,
      fill: (row, job) => this.#fill(row, job),
      choose: (job) => this.#choose(choice, job),
    });
    connectFind(this.find, this.list, () => this.#select());
    choice.on("choice", () => this.list.setChosen(choice.job));
    this.refresh();
  }

  /** Show what has become known, and write again what has become of the jobs in sight. */
  refresh() {
    const known = this.shift.countKnown(this.clock.tick);
    if (known === this.known) {
      this.list.refresh();
      return;
    }
    const more = known - Math.max(this.known, 0);
    this.known = known;
    this.count.textContent = String(known);
    const { box, rowHeight } = this.list;
    const { scrollTop } = box;
    this.#select();
    // new jobs come in at the top, above those that are read
    if (scrollTop > rowHeight && !this.find.value) box.scrollTop = scrollTop + more * rowHeight;
  }

  #select() {
    const jobs = this.plan.jobs.slice(0, this.known).reverse();
    const { value } = this.find;
    this.list.setItems(value ? jobs.filter((job) => this.#fits(job, value)) : jobs);
  }

  /**
   * @param {JobData} job
   * @param {string} value a part of its name, of its robot or of what has become of it
   */
  #fits(job, value) {
    return matches(`${this.#head(job)} ${this.#detail(job)}`, value);
  }

  /** @param {JobData} job */
  #indexOf(job) {
    return this.index.get(job) ?? -1;
  }

  /** @param {JobData} job */
  #head(job) {
    const { name, robot } = job;
    const state = this.shift.stateOf(this.#indexOf(job), this.clock.tick);
    if (state === "open" || robot === undefined) return texts.shift.isOpen({ name });
    return texts.shift[state === "done" ? "isDone" : "isUnderWay"]({
      name,
      robot: this.words.robot(robot),
    });
  }

  /** @param {JobData} job */
  #detail(job) {
    const { words } = this;
    const index = this.#indexOf(job);
    const since = texts.shift.knownSince({ time: words.time(this.shift.known[index]) });
    if (job.times && this.shift.stateOf(index, this.clock.tick) === "done") {
      const [, end, service, late] = job.times;
      const parts = [
        texts.shift.endedAt({ time: words.time(end) }),
        texts.jobs.inService({ time: words.time(service) }),
        ...(late ? [texts.lateness.late({ time: words.time(late) })] : []),
      ];
      return parts.join(" · ");
    }
    const isLast = job.reason !== undefined && this.clock.tick >= this.clock.end;
    return isLast ? `${since} · ${upperFirst(this.plan.phrases.said(job.reason ?? -1))}` : since;
  }

  /**
   * @param {import("../lists/virtual_list.js").ListRow<JobData>} row
   * @param {JobData} job
   */
  #fill(row, job) {
    const lines = [this.#head(job), this.#detail(job)];
    const text = lines.join("\n");
    if (row.title === text) return;
    row.title = text;
    row.replaceChildren(...lines.map((line) => element("span", { className: "text name" }, line)));
  }

  /**
   * @param {Choice} choice
   * @param {JobData} job
   */
  #choose(choice, job) {
    const index = this.#indexOf(job);
    const begin = this.shift.begins[index];
    const isBegun = begin <= this.clock.tick;
    if (isBegun) chooseAt(this.clock, begin, () => choice.chooseJob(index));
    else choice.chooseJob(index);
  }
}
