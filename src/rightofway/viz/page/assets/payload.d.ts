// Generated from viz/page/schema.py: change it there, then run `just types-refresh`.

export type AlarmRow = [number, number, "alarm", string, PhraseData | null];

/** A picture under the map; without ``href`` for a page that has the picture itself. */
export interface BackgroundData {
  x: number;
  y: number;
  width: number;
  height: number;
  turn?: number;
  href?: string;
  opacity: number;
}

/** For each figure, the places of the plans with the smallest one. */
export interface BestData {
  flowtime: number[];
  makespan: number[];
  gap: number[];
  seconds: number[];
}

/** Something in which a scenario differs from another one; see `Change`. */
export interface ChangeData {
  subject: PhraseData;
  robots: string[];
  jobs: string[];
  key: string;
  before: PhraseData;
  after: PhraseData;
  text: string;
}

export type ChargeRow = [number, number, "charge", number];

/** Places that are too near: pairs of lanes, a vertex and a lane, pairs of vertices. */
export interface CloseData {
  crossings?: [number, number, number, number][];
  beside?: [number, number, number][];
  vertices?: [number, number][];
}

export interface ClosureData {
  vertices: number[];
  from: number;
  until: number | null;
  radius: number | null;
  text: PhraseData;
}

/** Costs of a plan in the ticks of a comparison, and its scenario's changes. */
export interface ComparedPlan {
  planner: string;
  seed: number;
  seconds: number | null;
  flowtime: number;
  makespan: number;
  lower_bound: number;
  alone: number;
  gap: number | null;
  robots: number;
  faults: number;
  text: FiguresText;
  changes: ChangeData[];
}

/** When a robot completes in each plan; null where it is not there. */
export interface ComparedRobot {
  name: string;
  completion: (number | null)[];
}

/** A comparison of plans. */
export interface ComparisonData {
  tick: [number, number];
  units: UnitsData;
  scales: number[];
  plans: ComparedPlan[];
  best: BestData;
  robots: ComparedRobot[];
}

/** Which of two robots got the right of way, and why; see `Decision`. Texts are by index. ``figures`` has the measure, then its values if the first and if the other robot waits. */
export interface DecisionData {
  head: number;
  detail: number;
  story: number;
  reason: number;
  tick: number;
  kind: "vertex" | "head-on" | "following" | "crossing";
  vertices: number[];
  robots: [number, number];
  waits: number;
  waitsAt: number;
  ticks: number;
  level: "node" | "robot" | "settled" | "priority" | "only";
  figures: [number, number, number][];
}

/** The executed track of a robot; ``vertices`` is there where they are not as planned. */
export interface DrivenData {
  stages: StageRow[];
  turns?: TurnRow[];
  vertices?: number[];
  enter: number[];
  drive: number[];
  still: [number, number | null][];
  completion: number | null;
}

/** Events since the frame before; ``begins`` where there are none before. ``ends`` is there where it differs from that of the frame before. */
export interface DrivenFrame {
  number: number;
  now: number;
  runs: boolean;
  begins: boolean;
  rows: DrivenRow[];
  ends?: EndsData | null;
}

export type DrivenRow = RouteRow | VisitRow | HoldRow | TaskRow | ChargeRow | SaysRow | AlarmRow | SeenRow;

export type EndRow = [string, number, number | null, number | null, number | null, number | null, number | null, boolean];

/** Planned ends next to actual or expected ones, the latest first: of jobs, or of all robots. ``robots`` has a row for each robot, and none in a plan without jobs. */
export interface EndsData {
  hasJobs: boolean;
  all: PunctualityRow;
  robots: PunctualityRow[];
  rows: EndRow[];
}

/** A place where the plan breaks a rule, or a reason why there is no plan; texts by index. */
export interface FaultData {
  kind: string;
  name: number;
  reason: number;
  remedy: number;
  tick: number;
  robots: number[];
  vertices: number[];
}

/** Numbers of faults of each kind, by the index of its name, and the first faults. */
export interface FaultsData {
  count: number;
  kinds: [number, number][];
  listed: FaultData[];
}

/** A fleet that is driven: its events, and the address of further ones, if there are any. ``stream`` is the address of frames; ``orders`` that to which orders of people are sent. */
export interface FeedData {
  frame: DrivenFrame;
  stream?: string;
  orders?: string;
}

/** Figures as people read them. */
export interface FiguresText {
  flowtime: PhraseData;
  makespan: PhraseData;
  lower_bound: PhraseData;
  alone: PhraseData;
  gap: PhraseData;
  seconds: PhraseData;
}

/** A problem of a site. */
export interface FindingData {
  severity: "error" | "warning" | "note";
  kind: string;
  fact: PhraseData;
  remedy: PhraseData;
  vertices: number[];
  robots: number[];
}

/** An execution of the plan. */
export interface FloorData {
  end: number;
  robots: DrivenData[];
  losses: LossRow[];
}

/** Robots that lose time in every plan, and where they would meet; texts are by index. ``tick`` is when the last of them is there in this plan; 0 where none comes there. */
export interface ForcedLossData {
  head: number;
  text: number;
  robots: number[];
  vertices: number[];
  tick: number;
}

/** The position of (0, 0) of the drawing on the site, and the length of its unit there. */
export interface FrameData {
  x: number;
  y: number;
  yUp: boolean;
  unit: number;
  yaw?: number;
}

/** A map of cells. */
export interface GridData {
  width: number;
  height: number;
  frame: FrameData;
  limits?: [string, number[]][];
  passed?: number[];
  zones?: [string, number[], [number, number][]][];
  stations?: [string, number][];
  parking?: number[];
  charging?: number[];
  background?: BackgroundData;
  rows: string[];
  obstacles?: ObstacleRow[];
}

export type HoldRow = [number, number, "hold" | "off", boolean];

/** Input of the page of an inspection. */
export interface InspectionPayload {
  title: string;
  description: PhraseData;
  notes: PhraseData[];
  names: Record<string, PhraseData>;
  headings: Record<string, PhraseData>;
  levels: LevelData[];
}

export type JobCostRow = [number, number | null];

/** A job: its stops, who does it, or why nobody does. ``times`` has begin, end, service time, and how late it is; the reason is by the index of its text. ``costs`` has the robots that may do it, those of least cost first. */
export interface JobData {
  name: string;
  stops: JobStopRow[];
  robot?: number;
  times?: [number, number, number, number];
  reason?: number;
  due?: number;
  costs?: JobCostRow[];
}

export type JobStopRow = [number, number, number, number];

/** A site that was inspected; its name is empty where there is only one. */
export interface LevelData {
  title?: string;
  units: UnitsData;
  tick: [number, number];
  clearance?: number;
  map: MapData;
  robots: RobotData[];
  closures?: ClosureData[];
  name: string;
  sentences: PhraseData[];
  findings: FindingData[];
}

export type LossRow = [number, number, number | null, number, number, number, number | null, number, number, number, number];

export type MapData = GridData | NetworkData;

/** The costs of the plan. */
export interface MetricsData {
  flowtime: number;
  makespan: number;
  lowerBound: number;
}

/** A map of vertices and lanes; tails and heads are first differences. A curve has tail, head, and the points between them as x, y, x, y, …; joints are the vertices between the pieces of each split lane. */
export interface NetworkData {
  width: number;
  height: number;
  frame: FrameData;
  limits?: [string, number[]][];
  passed?: number[];
  zones?: [string, number[], [number, number][]][];
  stations?: [string, number][];
  parking?: number[];
  charging?: number[];
  background?: BackgroundData;
  names: string[];
  points: number[];
  tails: number[];
  heads: number[];
  lengths: number[];
  sides?: number[];
  joints?: number[][];
  curves?: number[][];
  close?: CloseData;
}

export type ObstacleRow = [string, number, number, number, number];

/** A plan that another one is compared with; its map is that of the other one, or its own. */
export interface OtherPlan {
  title: string;
  phrases: PhraseEntry[];
  units: UnitsData;
  tick: [number, number];
  end: number;
  headway: number;
  booksAhead: boolean;
  line: [number, number][];
  robots: RobotData[];
  losses: LossRow[];
  faults: FaultsData;
  planner: PlannerData;
  decisions: DecisionData[];
  reroutes: RerouteData[];
  forcedLosses?: ForcedLossData[];
  metrics: MetricsData;
  steady?: SteadyData[];
  laps?: number[];
  closures?: ClosureData[];
  clearance?: number;
  floor?: FloorData;
  noPlan?: true;
  places?: [number, number][];
  work?: WorkData;
  shift?: ShiftData;
  map?: MapData;
}

/** Input of the page of a plan. */
export interface Payload {
  title: string;
  phrases: PhraseEntry[];
  units: UnitsData;
  tick: [number, number];
  end: number;
  headway: number;
  booksAhead: boolean;
  line: [number, number][];
  robots: RobotData[];
  losses: LossRow[];
  faults: FaultsData;
  planner: PlannerData;
  decisions: DecisionData[];
  reroutes: RerouteData[];
  forcedLosses?: ForcedLossData[];
  metrics: MetricsData;
  steady?: SteadyData[];
  laps?: number[];
  closures?: ClosureData[];
  clearance?: number;
  floor?: FloorData;
  noPlan?: true;
  places?: [number, number][];
  work?: WorkData;
  shift?: ShiftData;
  map: MapData;
  driven?: FeedData;
  others?: OtherPlan[];
  comparison?: ComparisonData;
}

export type PhraseData = string | [string, Record<string, PhraseData>];

export type PhraseEntry = string | number[];

/** How the plan came about: the planner, its actions or gains, its proof. */
export interface PlannerData {
  name: string;
  method: PhraseData;
  proven?: PhraseData;
}

export type PunctualityRow = [number, number, number, number | null];

/** A robot that was rerouted. */
export interface RerouteData {
  robot: number;
  because: PhraseData;
}

/** A robot and its track; ``vertices`` and ``enter`` are first differences. ``begins`` has for each stage when its work begins at the earliest, ``charges`` the stages that are charges. A robot that ``idles`` has nothing to do where it stays at home. */
export interface RobotData {
  name: string;
  colour: string;
  speed: string;
  radius?: number;
  completion: number;
  alone: number;
  lost: [number, number, number];
  vertices: number[];
  enter: number[];
  drive: number | number[];
  stages: StageRow[];
  begins?: number[];
  charges?: number[];
  turns?: TurnRow[];
  stands?: true;
  idles?: true;
  index?: number;
}

export type RoundRow = [number, number, number, number, number];

export type RouteRow = [number, number, "route", number, number[]];

export type SaysRow = [number, number, "says", "work" | "drive" | "wait" | "end" | "news" | "alarm", PhraseData, number[]];

export type SeenRow = [number, number, "seen", string, string];

/** A shift, whose plan is all that robots have done. ``known`` has for each job when it became known, ``waits`` for each robot the others that it waited for and ticks, the longest first; ``bottlenecks`` the same of vertices. ``service`` has median, 95th percentile and maximum. Texts of the reasons of jobs, of rounds, and of what happened are by index. */
export interface ShiftData {
  until: number;
  done: number;
  late: number;
  underWay: number;
  unserved: [number, number][];
  service?: [number, number, number];
  slices: SliceRow[];
  known: number[];
  robots: UseRow[];
  waits: [number, number][][];
  bottlenecks: [number, number][];
  rounds: RoundRow[];
  told: [number, number][];
  happened: [number, number][];
}

export type SliceRow = [number, number, number, number | null, number | null];

export type StageRow = [number, number, number, number];

/** Robots that repeat themselves together; critical visits are pairs of robot and visit. The bottleneck has two texts: in short, and its steps. */
export interface SteadyData {
  robots: number[];
  start: number;
  period: number;
  until: number;
  critical: [number, number][];
  bottleneck?: [number, number];
}

export type TaskRow = [number, number, "task", PhraseData];

/** An item of a robot's tour; ``load`` is that at its begin. ``charges`` has ticks and states of charge, which change evenly between them. */
export interface TourData {
  items: TourRow[];
  load: number;
  capacity: number;
  reserve?: number;
  charges?: [number, number][];
}

export type TourRow = [number, number, number, number, number, number];

export type TurnRow = [number, number];

/** The names of the units, null where the scenario names none; the instant of time 0. */
export interface UnitsData {
  length: string | null;
  time: string | null;
  start?: string;
}

export type UseRow = [number, number, number, number, number, number];

export type VisitRow = [number, number, "arrived" | "released" | "done", number];

/** The jobs of a plan, and a tour for each robot. */
export interface WorkData {
  jobs: JobData[];
  tours: TourData[];
}
