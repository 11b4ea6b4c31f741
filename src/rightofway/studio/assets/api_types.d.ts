// Generated from studio/routes/answers.py: change it there, then run `just types-refresh`.

import type { PhraseData } from "../../viz/page/assets/payload.d.ts";
import type { ComparisonPayload, ScenarioDocument, SitePayload } from "./types.js";

/** A studio: its version, folder and limits. */
export interface About {
  version: string;
  folder: string;
  file: string | null;
  keeps: boolean;
  limits: Limits;
}

/** A decision that a wait follows from. */
export interface Because {
  index: number;
  decision: string;
  reason: string;
  phrase: PhraseData;
}

/** Collisions of robots that drive by the clock alone. */
export interface ByClock {
  share_of_runs: number;
}

/** Differences of the scenario of a run from that of a run before it. */
export interface Changes {
  before: number | null;
  changes: Array<ScenarioChange>;
}

/** Rules of laps, notations of delays, formats of exports, each with a sentence. */
export interface Choices {
  rules: Record<string, PhraseData>;
  delays: DelayChoices;
  formats: Record<string, PhraseData>;
}

/** A step of the circle that sets the pace of laps. */
export interface CirclePiece {
  kind: string;
  robot: string;
  after: string | null;
  vertices: Array<string>;
  for: number | string;
  text: PhraseData;
}

/** A circle that sets the pace for some values. */
export interface CircuitData {
  periods: number;
  pieces: Array<CirclePiece> | null;
  visits: Array<[number, number]>;
}

/** The command line that gives the same; empty where none does. */
export interface CommandLine {
  command: string;
}

/** A comparison of plans. */
export interface Compared {
  runs: Array<number>;
  plans: Array<ComparedFigures>;
  robots: Array<RobotCompletions>;
  titles: Array<string>;
  comparison: ComparisonPayload;
}

/** Costs of a plan, compared with another one. */
export interface ComparedFigures {
  flowtime: number;
  makespan: number;
  lower_bound: number;
  alone: number;
  text: FigureTexts;
  tick: [number, number];
  units: UnitNames;
  scenario: string;
  start?: Kept | null;
  robots?: number;
  faults?: number;
  time: Record<string, number>;
}

/** The period as a function of a speed, a work time or the headway. */
export interface CurveData {
  kind: "speed" | "work" | "headway";
  robot: string | null;
  stop: number | null;
  value: number | string;
  pieces: Array<CurvePiece>;
}

/** The period as a function of a value, from one value to another. */
export interface CurvePiece {
  from: number | string;
  to: number | string;
  fixed: number | string;
  slope: number | string;
  circuit: number;
}

/** The period as functions of parameters. */
export interface Curves {
  exact: boolean;
  why: FactData | null;
  reason: PhraseData | null;
  curves: Array<CurveData>;
  circuits: Array<CircuitData>;
}

/** A fleet that is to be dealt out over the map of a document. */
export interface Deal {
  document: ScenarioDocument;
  folder?: string;
  robots: number;
  seed?: number;
  speeds?: Array<string | number>;
  work?: [number, number];
  between?: "anywhere" | "stations";
}

/** Robots that were dealt out. */
export interface Dealt {
  robots: Array<DealtRobot>;
}

/** A robot that was dealt out. */
export interface DealtRobot {
  name: string;
  home: string;
  target: string;
  speed: number | string;
  work: number | string;
}

/** Notations of delays, and the meaning of each. */
export interface DelayChoices {
  default: string;
  examples: Record<string, string>;
}

/** Results of a plan with delays. */
export interface DelaysReport {
  units: UnitNames;
  tick: number | string;
  runs: number;
  collisions: number;
  played: number;
  lateness: LatenessData;
  by_clock: ByClock;
  spread: SpreadData | null;
  ranks: Ranks;
}

/** One thing wrong with a document: where, as text, as keys and indices, and for people. */
export interface DocumentFault {
  place: string;
  path: Array<string | number>;
  message: string;
  line: number | null;
  named: string;
  about: string;
}

/** A document that somebody draws. */
export interface DraftBody {
  document: ScenarioDocument;
  revision?: string | null;
}

/** A draft. */
export interface DraftData {
  name: string;
  saved: number;
  revision: string;
  document: ScenarioDocument;
}

/** A draft in a list. */
export interface DraftEntry {
  name: string;
  saved: number;
  size: number;
}

/** The drafts, the latest first. */
export interface DraftList {
  drafts: Array<DraftEntry>;
  are_kept: boolean;
}

/** A plan that simulated robots drive, or have driven; ``page`` is where to watch them. */
export interface DriveData {
  number: number;
  run: number;
  state: "driving" | "done" | "stopped" | "failed";
  error: ErrorData | null;
  page: string;
}

/** The drives of a studio, the latest first. */
export interface DriveList {
  drives: Array<DriveData>;
}

/** Why a request was refused or a run has failed. */
export interface ErrorData {
  kind: string;
  message: string;
  phrase?: PhraseData;
  status?: number;
  faults?: Array<DocumentFault>;
  reasons?: Array<Reason>;
  robots?: Array<string>;
  vertices?: Array<string>;
}

/** An example. */
export interface ExampleData {
  kind: string;
  document: ScenarioDocument;
}

/** An example in a list. */
export interface ExampleEntry {
  name: string;
  sentence: string;
}

/** The examples. */
export interface ExampleList {
  examples: Array<ExampleEntry>;
}

/** A finding and its remedy. */
export interface FactAndRemedy {
  fact: PhraseData;
  remedy: PhraseData;
}

/** A fact as plain data: its kind, and its values by name. */
export interface FactData {
  kind: string;
  values: Record<string, unknown>;
}

/** Figures as people read them. */
export interface FigureTexts {
  flowtime: PhraseData | string;
  makespan: PhraseData | string;
  lower_bound: PhraseData | string;
  alone: PhraseData | string;
  gap: PhraseData | string;
}

/** A file of the folder. */
export interface FileEntry {
  path: string;
  kind: string;
  size: number;
  modified: number;
}

/** The files that may be opened. */
export interface FileList {
  files: Array<FileEntry>;
  is_whole: boolean;
}

/** A right of way to reverse. */
export interface Flip {
  waits: string;
  goes_first: string;
  tick: number;
  time_limit?: number;
  name?: string;
}

/** A timetable in which another robot goes first. */
export interface FlippedPlan {
  before: PlanFigures;
  run: RunData;
}

/** A document as a card shows it. */
export interface Glance {
  kind: string;
  description: string;
  robots: number | null;
  extent: Array<string>;
  unit: string | null;
  picture: string;
}

/** The place of a robot at each time of a table, and its marks there. */
export interface GroupRow {
  robot: string;
  kind: "planned" | "list 1" | "list 2";
  places: Array<string>;
  marks: Array<"collision" | "swap" | "near" | "wait" | null>;
}

/** A document with its map and robots in it. */
export interface Inlined {
  document: ScenarioDocument;
}

/** Number of robots that a plan has kept from the plan that it was made from. */
export interface Kept {
  routes: number;
  tracks: number;
}

/** A draft as it was kept. */
export interface KeptDraft {
  name: string;
  saved: number;
  revision: string;
}

/** The period as a function of a value, from one value to another. */
export interface LapConflict {
  robots: Array<string>;
  waits: string;
  for: number | string;
}

/** Robots that share places, and how they repeat themselves; null where they do not. */
export interface LapGroup {
  robots: Array<string>;
  why: FactData | null;
  reason: PhraseData | string;
  period: number | string | null;
  laps_per_period: Record<string, number>;
  mean_lap: Record<string, number | string | null>;
  waiting_share: Record<string, number | string | null>;
  conflicts: Array<LapConflict> | null;
  bottleneck: Array<CirclePiece> | null;
  curves: Curves | null;
}

/** Results of laps in a new order. */
export interface LapsAnswer {
  groups: Array<LapGroup>;
}

/** Results of a fleet that repeats its trips. */
export interface LapsReport {
  units: UnitNames;
  groups: Array<LapGroup>;
}

/** Lateness of the fleet and of each robot. */
export interface LatenessData {
  flowtime: LatenessFigures;
  robots: Array<RobotLatenessData>;
}

/** Lateness over all runs [ticks]. */
export interface LatenessFigures {
  median: number;
  p90: number;
  max: number;
}

/** Limits of the server. */
export interface Limits {
  body: number;
  seconds: number;
  runs_at_once: number;
}

/** A wait, or another cause of lost time [ticks]. */
export interface LossData {
  kind: string;
  robot: string;
  for: string | null;
  vertex: string;
  towards: string;
  freed: string | null;
  tick: number;
  end: number;
  ticks: number;
  sentence: string;
  phrase: PhraseData;
  because: Array<Because>;
}

/** Why robots lose time. */
export interface LossList {
  losses: Array<LossData>;
}

/** Both movement groups of a decision: the paper's List 1 and List 2, and their sums. */
export interface MovementGroups {
  heading: string;
  times: Array<string>;
  rows: Array<GroupRow>;
  sums: Array<PhraseData>;
}

/** Settings of a drive of simulated robots. */
export interface NewDrive {
  delays?: Array<string>;
  seed?: number;
  laps?: number | null;
  time_scale?: number;
}

/** A run whose plan is to be improved. */
export interface NewImprovement {
  planner?: string | null;
  options?: Record<string, string | number>;
  time_limit?: number;
  seed?: number;
  kind: "improve";
  based_on: number;
  name?: string;
}

/** A document whose robots are to repeat their trips. */
export interface NewLaps {
  kind: "laps";
  document: ScenarioDocument;
  folder?: string;
  source?: string;
  name?: string;
  rule?: string;
  routes?: string | null;
  time_limit?: number;
  seed?: number;
}

/** A document that is to be planned. */
export interface NewPlan {
  planner?: string | null;
  options?: Record<string, string | number>;
  time_limit?: number;
  seed?: number;
  kind?: "plan";
  document: ScenarioDocument;
  folder?: string;
  source?: string;
  name?: string;
  based_on?: number | null;
  start?: number | null;
}

/** A run whose plan is to be executed with delays. */
export interface NewSimulation {
  kind: "simulate";
  based_on: number;
  name?: string;
  delays?: Array<string>;
  runs?: number;
  run?: number | "typical" | "worst";
  seed?: number;
  switch?: boolean;
  replan?: boolean;
  time_limit?: number;
}

/** A file that was opened. */
export interface Opened {
  path: string;
  folder: string;
  kind: "scenario" | "layout" | "plan";
  notes?: Array<PhraseData | string>;
  document?: ScenarioDocument;
  save_as?: string;
  revision?: string;
  figures?: PlanFigures;
  run?: RunData;
}

/** Another value of a speed, a work time or the headway of laps. */
export interface OtherLaps {
  kind: "speed" | "work" | "headway";
  robot?: string | null;
  stop?: number | null;
  value: string | number;
  time_limit?: number;
}

/** Jobs of rows of a table, as a document has them. */
export interface PastedJobs {
  jobs: Array<Record<string, unknown>>;
}

/** A document, and where it stands. */
export interface Placed {
  document: ScenarioDocument;
  folder?: string;
}

/** A document, and the folder that its paths are in. */
export interface PlacedDocument {
  document: ScenarioDocument;
  folder: string;
}

/** Costs of a plan [ticks]. */
export interface PlanFigures {
  flowtime: number;
  makespan: number;
  lower_bound: number;
  alone: number;
  text: FigureTexts;
  tick: [number, number];
  units: UnitNames;
  scenario: string;
  start?: Kept | null;
  robots?: number;
  faults?: number;
}

/** An event: a run has a better plan. */
export interface PlanFound {
  number: number;
  revision: number;
  figures: PlanFigures;
}

/** The report of `plan --json`; the page shows the plan itself. */
export interface PlanSummary {
}

/** A planner. */
export interface PlannerEntry {
  name: string;
  summary: PhraseData | string;
  features: Array<string>;
  options: Array<PlannerOption>;
}

/** The planners; which is the default, and which improves plans. */
export interface PlannerList {
  default: string;
  improver: string;
  planners: Array<PlannerEntry>;
}

/** An option of a planner. */
export interface PlannerOption {
  name: string;
  default: number | string;
  summary: PhraseData | string;
  choices: Array<string>;
  least: number | string;
  most: number | string | null;
  whole: boolean;
}

/** Runs from the best to the worst. */
export interface Ranks {
  rank: Array<number>;
  run: Array<number>;
  flowtime: Array<number | null>;
}

/** A proof that no plan exists: its kind, its sentence, and the vertices in it. */
export interface Reason {
  kind: string;
  reason: string;
  phrase: PhraseData | string;
  robots: Array<string>;
  vertices: Array<string>;
}

/** The answer to a request that is refused. */
export interface RefusalData {
  error: ErrorData;
}

/** A name for a run. */
export interface Rename {
  name: string;
}

/** When a robot completes in each plan [time unit]; null where it is not in it. */
export interface RobotCompletions {
  name: string;
  completion: Array<number | null>;
}

/** How late a robot is over all runs, by itself and for others [ticks]. */
export interface RobotLatenessData {
  name: string;
  mean: number;
  p95: number;
  own: number;
  waiting: Record<string, number>;
}

/** Rows of a table, as they are copied from a spreadsheet. */
export interface Rows {
  text: string;
}

/** A run. */
export interface RunData {
  number: number;
  name: string;
  kind: "plan" | "improve" | "laps" | "simulate" | "flip" | "opened";
  state: "queued" | "running" | "done" | "stopped" | "cancelled" | "failed" | "interrupted";
  request: RunRequest;
  source: string;
  based_on: number | null;
  created: number;
  started: number | null;
  ended: number | null;
  status: PhraseData | null;
  figures: PlanFigures | null;
  error: ErrorData | null;
  points: Array<[number, number]>;
  revision: number;
  has_report: boolean;
  has_payload: boolean;
  has_plan: boolean;
}

/** The runs, the latest first. */
export interface RunList {
  runs: Array<RunData>;
  are_kept: boolean;
}

/** A run that was deleted. */
export interface RunNumber {
  number: number;
}

/** An event of a run that is going on. */
export interface RunProgress {
  number: number;
  seconds?: number;
  flowtime?: number;
  lower_bound?: number;
  progress?: PhraseData;
}

/** The settings of the task of a run; which there are depends on its kind. */
export interface RunRequest {
  planner?: string;
  options?: Record<string, string | number>;
  time_limit?: number;
  seed?: number;
  start?: number;
  rule?: string;
  routes?: string | null;
  delays?: Array<string>;
  runs?: number;
  run?: number | string;
  switch?: boolean;
  replan?: boolean;
  revision?: string;
  waits?: string;
  goes_first?: string;
  tick?: number;
}

/** A document that is to be saved. */
export interface Save {
  document: ScenarioDocument;
  folder?: string;
  revision?: string | null;
}

/** A file as it was written. */
export interface Saved {
  path: string;
  revision: string;
}

/** Something in which a scenario differs from another one. */
export interface ScenarioChange {
  subject: PhraseData | string;
  robots: Array<string>;
  jobs: Array<string>;
  key: string;
  before: PhraseData | string;
  after: PhraseData | string;
  text: string;
}

/** Weaknesses of a map. */
export interface SiteFinding {
  kind: string;
  severity: "error" | "warning" | "note";
  fact: FactData;
  remedy: FactData;
  vertices: Array<string>;
  robots: Array<string>;
  sentence: string;
  phrases: FactAndRemedy;
}

/** Numbers of runs by flowtime [ticks]. */
export interface SpreadData {
  counts: Array<number>;
  planned: number;
  from: number;
  to: number;
}

/** A document that somebody changes. */
export interface Survey {
  document: ScenarioDocument;
  folder?: string;
  inspects?: boolean;
  identifies?: boolean;
}

/** The view of an editor after each change. */
export interface SurveyData {
  ok: boolean;
  faults: Array<DocumentFault>;
  notes: Array<PhraseData | string>;
  site: SitePayload | null;
  findings: Array<SiteFinding>;
  sentences: Array<string>;
  phrases: Array<PhraseData>;
  scenario?: string | null;
}

/** Units of a scenario, each a name or null, and the instant of time 0. */
export interface UnitNames {
  length: string | null;
  time: string | null;
  start?: string;
}

/** The faults of a document. */
export interface Validation {
  ok: boolean;
  faults: Array<DocumentFault>;
  notes: Array<PhraseData | string>;
}

/** What DELETE answers, by the path with what follows it. */
export type DeleteAnswer<Path extends string> =
  Path extends `/runs/${number}` | `/runs/${number}?${string}` ? RunNumber :
  unknown;

/** What GET answers, by the path with what follows it. */
export type GetAnswer<Path extends string> =
  Path extends `/runs/${number}/decisions/${string}` | `/runs/${number}/decisions/${string}?${string}` ? MovementGroups :
  Path extends `/glances/${string}/${string}` | `/glances/${string}/${string}?${string}` ? Glance :
  Path extends `/runs/${number}/changes` | `/runs/${number}/changes?${string}` ? Changes :
  Path extends `/runs/${number}/command` | `/runs/${number}/command?${string}` ? CommandLine :
  Path extends `/runs/${number}/document` | `/runs/${number}/document?${string}` ? PlacedDocument :
  Path extends `/runs/${number}/losses` | `/runs/${number}/losses?${string}` ? LossList :
  Path extends `/runs/${number}/payload` | `/runs/${number}/payload?${string}` ? SitePayload :
  Path extends `/runs/${number}/report` | `/runs/${number}/report?${string}` ? LapsReport | DelaysReport | PlanSummary :
  Path extends `/documents/${string}` | `/documents/${string}?${string}` ? Opened :
  Path extends `/drafts/${string}` | `/drafts/${string}?${string}` ? DraftData :
  Path extends `/drives/${number}` | `/drives/${number}?${string}` ? DriveData :
  Path extends `/examples/${string}` | `/examples/${string}?${string}` ? ExampleData :
  Path extends `/runs/${number}` | `/runs/${number}?${string}` ? RunData :
  Path extends `/` | `/?${string}` ? About :
  Path extends `/choices` | `/choices?${string}` ? Choices :
  Path extends `/compare` | `/compare?${string}` ? Compared :
  Path extends `/drafts` | `/drafts?${string}` ? DraftList :
  Path extends `/drives` | `/drives?${string}` ? DriveList :
  Path extends `/examples` | `/examples?${string}` ? ExampleList :
  Path extends `/files` | `/files?${string}` ? FileList :
  Path extends `/planners` | `/planners?${string}` ? PlannerList :
  Path extends `/runs` | `/runs?${string}` ? RunList :
  unknown;

/** What PATCH answers, by the path with what follows it. */
export type PatchAnswer<Path extends string> =
  Path extends `/runs/${number}` | `/runs/${number}?${string}` ? RunData :
  unknown;

/** What POST answers, by the path with what follows it. */
export type PostAnswer<Path extends string> =
  Path extends `/drives/${number}/stop` | `/drives/${number}/stop?${string}` ? DriveData :
  Path extends `/runs/${number}/cancel` | `/runs/${number}/cancel?${string}` ? RunData :
  Path extends `/runs/${number}/drives` | `/runs/${number}/drives?${string}` ? DriveData :
  Path extends `/runs/${number}/flip` | `/runs/${number}/flip?${string}` ? FlippedPlan :
  Path extends `/runs/${number}/laps` | `/runs/${number}/laps?${string}` ? LapsAnswer :
  Path extends `/runs/${number}/stop` | `/runs/${number}/stop?${string}` ? RunData :
  Path extends `/deal` | `/deal?${string}` ? Dealt :
  Path extends `/inline` | `/inline?${string}` ? Inlined :
  Path extends `/rows` | `/rows?${string}` ? PastedJobs :
  Path extends `/runs` | `/runs?${string}` ? RunData :
  Path extends `/survey` | `/survey?${string}` ? SurveyData :
  Path extends `/validate` | `/validate?${string}` ? Validation :
  unknown;

/** What PUT answers, by the path with what follows it. */
export type PutAnswer<Path extends string> =
  Path extends `/documents/${string}` | `/documents/${string}?${string}` ? Saved :
  Path extends `/drafts/${string}` | `/drafts/${string}?${string}` ? KeptDraft :
  Path extends `/files/${string}` | `/files/${string}?${string}` ? Saved :
  unknown;

/** What a request may hold, by method. */
export interface Bodies {
  PATCH: Rename;
  POST: Placed | Survey | Deal | Rows | NewPlan | NewImprovement | NewLaps | NewSimulation | OtherLaps | Flip | NewDrive;
  PUT: Save | DraftBody;
}

/** What events hold, by their names. */
export interface Events {
  runs: RunList;
  run: RunData;
  progress: RunProgress;
  plan: PlanFound;
  deleted: RunNumber;
}
