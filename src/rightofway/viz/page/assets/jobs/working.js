import { JobCards } from "./job_cards.js";
import { JOBS_PANEL, JOBS_TAB, makeJobList } from "./job_list.js";
import { JobMarks } from "./job_marks.js";

/** @import { Choice } from "../player/choice.js" */
/** @import { Clock } from "../player/clock.js" */
/** @import { Plan } from "../plan/plan.js" */
/** @import { Theme } from "../drawing/theme.js" */

/**
 * What a player needs to show a plan with jobs, and a shift.
 *
 * @typedef {object} Working
 * @property {typeof JobCards} JobCards
 * @property {new (plan: Plan, theme: Theme, choice: Choice, clock: Clock) => JobMarks} JobMarks
 * @property {(...views: Parameters<typeof makeJobList>) => { refresh(): void }} makeJobList
 * @property {string} tab
 * @property {string} panel
 * @property {typeof import("../shift/shift.js").Shift} [Shift]
 * @property {typeof import("../shift/shift_views.js").ShiftViews} [ShiftViews]
 */

/**
 * Pages of plans without jobs do without.
 *
 * @type {Working}
 */
export const WORKING = { JobCards, JobMarks, makeJobList, tab: JOBS_TAB, panel: JOBS_PANEL };
