import { JobCards } from "./job_cards.js";
import { JOBS_PANEL, JOBS_TAB, makeJobList } from "./job_list.js";
import { JobMarks } from "./job_marks.js";

/** What a player needs to show a plan with jobs; pages of other plans do without. */
export const WORKING = { JobCards, JobMarks, makeJobList, tab: JOBS_TAB, panel: JOBS_PANEL };
