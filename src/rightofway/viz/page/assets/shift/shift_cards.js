import { element, facts, link } from "../common/dom.js";
import { JobCards } from "../jobs/job_cards.js";
import { shareBar, useLine } from "./use_board.js";
import { texts } from "../language/language.js";
import { joined } from "../language/words.js";

/** @import { JobData } from "../payload.d.ts" */
/** @import { Robot } from "../plan/robot.js" */
/** @import { Shift } from "./shift.js" */

/** What head and card have of a shift: its figures, when a job became known, the use of a robot. */
export class ShiftCards extends JobCards {
  get shift() {
    return /** @type {Shift} */ (this.plan.shift);
  }

  /** @returns {[string, string, string][]} */
  get figures() {
    const { words } = this;
    const { done, late, known, until, service, underWay, unserved } = this.shift.raw;
    const reasons = unserved.map(([text]) => this.plan.phrases.said(text)).join(", ");
    const left = unserved.reduce((sum, [, count]) => sum + count, 0);
    const [median, p95, max] = (service ?? []).map((ticks) => words.time(Math.round(ticks)));
    return [
      [texts.jobs.done, texts.lateOf({ count: done, all: known.length }), texts.shift.doneAtLength],
      [
        texts.shift.inTime,
        done ? texts.lateOf({ count: done - late, all: done }) : "",
        texts.shift.inTimeAtLength,
      ],
      [
        texts.shift.throughput,
        done ? texts.shift.every({ time: words.time(Math.round((10 * until) / done) / 10) }) : "",
        texts.shift.throughputAtLength,
      ],
      [
        texts.jobs.serviceTime,
        service ? texts.shift.serviceTimes({ median, p95 }) : "",
        texts.shift.serviceTimeAtLength({ max: max ?? "" }),
      ],
      [texts.shift.underWay, underWay ? String(underWay) : "", texts.shift.underWayAtLength],
      [texts.shift.notServed, left ? String(left) : "", reasons],
    ];
  }

  /**
   * @param {JobData} job
   * @returns {HTMLElement[]}
   */
  job(job) {
    const known = this.shift.known[this.plan.jobs.indexOf(job)];
    return [facts([[texts.shift.known, this.words.time(known)]]), ...super.job(job)];
  }

  /**
   * @param {Robot} robot
   * @returns {HTMLElement[]}
   */
  tour(robot) {
    const { words, choice } = this;
    const { robots, waits, until } = this.shift.raw;
    const row = robots[robot.index];
    const others = waits[robot.index].map(([other, ticks]) =>
      element(
        "span",
        {},
        link(words.robot(other), () => choice.chooseRobot(other)),
        ` ${words.time(ticks)}`,
      ),
    );
    return [
      shareBar(row, until),
      element("p", { className: "note" }, useLine(row, until, words)),
      facts([
        [texts.jobs.done, String(row[0])],
        [
          texts.shift.waitsFor,
          others.length ? element("span", {}, ...joined(others)) : texts.shift.waitsForNobody,
        ],
      ]),
      ...super.tour(robot),
    ];
  }
}
