import { JOBS_PANEL, JOBS_TAB } from "../jobs/job_list.js";
import { ROUNDS_PANEL, ROUNDS_TAB } from "./round_list.js";
import { SHIFT_PANEL, SHIFT_TAB } from "./use_board.js";
import { Shift } from "./shift.js";
import { ShiftCards } from "./shift_cards.js";
import { makeKnownList } from "./known_list.js";
import { ShiftMarks } from "./shift_marks.js";
import { ShiftViews } from "./shift_views.js";

/** @import { Working } from "../jobs/working.js" */

/**
 * What a player needs to show a shift.
 *
 * @type {Working}
 */
export const SHIFTING = {
  JobCards: ShiftCards,
  JobMarks: ShiftMarks,
  makeJobList: makeKnownList,
  tab: SHIFT_TAB + JOBS_TAB + ROUNDS_TAB,
  panel: SHIFT_PANEL + JOBS_PANEL + ROUNDS_PANEL,
  Shift,
  ShiftViews,
};
