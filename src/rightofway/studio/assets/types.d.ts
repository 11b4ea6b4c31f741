/** Types that modules of the studio share: documents as they are written, and what is on their map. */

import type {
  PhraseData,
  ComparisonData,
  Payload,
  RobotData as PlayedRobot,
} from "../../viz/page/assets/payload.js";
import type { Fraction } from "../../viz/page/assets/language/quantities.js";
import type { Roadmap } from "../../viz/page/assets/plan/roadmap.js";
import type { Theme } from "../../viz/page/assets/drawing/theme.js";
import type { Events, DocumentFault, NewPlan, RunData } from "./api_types.js";
import type { PickTool } from "./draw/backdrop.js";
import type { SelectTool } from "./draw/select_tool.js";
import type { ParameterCurve } from "./runs/parameter_curve.js";
import type { ATTRIBUTES } from "./robots/attributes.js";
import type { RobotTool } from "./robots/tool.js";
import type { Studio } from "./studio.js";
import type { PageEvent } from "./vendor/htm-preact.js";

declare global {
  interface Array<T> {
    /** As the library has it, but a pair stays a pair: points are mapped coordinate by coordinate. */
    map<U>(
      each: (value: T, index: number, array: T[]) => U,
      thisArg?: unknown,
    ): { [K in keyof this]: U };
  }
}

/** What components are given. */
export interface Props {
  studio: Studio;
}

/** A number of a document; a fraction, or what is no number at all, is text. */
export type Numeral = number | string;

/** A place or a size as a document writes it. */
export type Pair = [Numeral, Numeral];

/** A rectangle as a document writes it: least x and y, width, height. */
export type Rectangle = [Numeral, Numeral, Numeral, Numeral];

export type Point = [number, number];

/** Column and row. */
export type Cell = [number, number];

/** Left, top, width, height in the drawing; least x and y, width, height on the site. */
export type Rect = [number, number, number, number];

/** A point of the site, mapped to another one. */
export type PointMap = (at: Point) => Point;

/** A line from one point of the site to another one. */
export type Guide = [Point, Point];

/** How far something goes on the site, and what it is in line with then. */
export interface Shift {
  shift: Point;
  guides: Guide[];
}

/** A place as a document names it: a vertex or a station, a cell by row and column, a point. */
export type Place = string | number | Pair | { x: Numeral; y: Numeral };

export interface Stop {
  at?: Place;
  work?: Numeral;
  actions?: unknown;
}

/** What a robot has beside its name and its trip. */
type Attributes = {
  [K in keyof typeof ATTRIBUTES]?: (typeof ATTRIBUTES)[K]["isText"] extends true ? string : Numeral;
};

/** Where a robot begins, and what it has done. */
export interface StartData {
  at?: Place;
  ready?: Numeral;
  heading?: Numeral;
  soc?: Numeral;
  begun?: Record<string, number>;
}

export interface JobStop extends Stop {
  load?: Numeral;
  earliest?: Numeral;
  latest?: Numeral;
}

export interface JobData {
  name?: string;
  at?: Place;
  work?: Numeral;
  pickup?: Place;
  dropoff?: Place;
  pickup_work?: Numeral;
  dropoff_work?: Numeral;
  load?: Numeral;
  stops?: JobStop[];
  earliest?: Numeral;
  latest?: Numeral;
  due?: Numeral;
  weight?: Numeral;
  types?: string[];
  robot?: string;
  after?: string[];
}

export interface BatteryData {
  drive?: Numeral;
  on?: Numeral;
  work?: Numeral;
  charge?: Numeral;
  reserve?: Numeral;
}

export interface RobotData extends Attributes {
  name?: string;
  capacity?: Numeral;
  battery?: string;
  charging?: Place[];
  start?: StartData;
  home?: Place;
  target?: Place;
  work?: Numeral;
  actions?: unknown;
  stops?: Stop[];
}

export interface ClosureData {
  at?: Place;
  edge?: Place[];
  from?: Numeral;
  until?: Numeral;
  radius?: Numeral;
}

/** A lane as a mapping; or as a list, its ends first. */
export interface LaneMapping {
  from: string;
  to: string;
  length?: Numeral;
  curve?: Pair[];
  both_ways?: boolean;
  max_speed?: Numeral;
}
export type LaneData = LaneMapping | [string, string, Numeral?];

/** A vertex by its place, or as a mapping with what else is known of it. */
export type VertexData = Pair | { at: Pair; pass?: boolean };

export interface ZoneData {
  name: string;
  vertices?: string[];
  edges?: [string, string][];
}

export interface RoadmapData {
  vertices: Record<string, VertexData>;
  edges: LaneData[];
  stations?: Record<string, string>;
  parking?: string[];
  charging?: string[];
  zones?: ZoneData[];
  sides?: unknown;
}

export interface ObstacleData {
  rect: Rectangle;
  name?: string;
}

export interface FloorData {
  size: Pair;
  obstacles?: ObstacleData[];
}

export interface PictureData {
  file: string;
  scale?: Numeral;
  origin?: Pair;
  opacity?: Numeral;
}

export interface MapData {
  grid?: string | string[];
  floor?: FloorData;
  roadmap?: RoadmapData;
  layout?: string;
  file?: string;
  picture?: PictureData;
  cell_size?: Numeral;
  smallest?: Numeral;
  spacing?: Numeral;
  y?: string;
}

export interface RulesData {
  walls?: string;
  headway?: Numeral;
  turn?: Numeral;
  return?: string;
}

/** A scenario as in its file; what else a file may hold is kept as it is. */
export interface ScenarioDocument {
  format?: string;
  map: MapData;
  robots: RobotData[] | { table: string } | { scen: string };
  units?: { length?: string; time?: string };
  rules?: string | RulesData;
  closures?: ClosureData[];
  jobs?: JobData[] | { table: string };
  batteries?: Record<string, BatteryData>;
  charging?: Place[];
}

/** A list of a document whose items are rows of a table, and one of them. */
export type ListName = "robots" | "jobs";
export type RowData = any;

export type Edit = (document: ScenarioDocument) => ScenarioDocument;

/** What the map shows of a document, as the library has drawn it. */
export type SitePayload = Omit<Payload, "robots"> & {
  robots: (PlayedRobot & { index?: number })[];
};

/** Figures of plans that are compared. */
export type ComparisonPayload = ComparisonData;

/** A run, with what this page knows of it. */
export interface LiveRun extends RunData {
  bound?: number;
  since?: number;
  round?: PhraseData; // the latest round of planning jobs
}

/** A point of the drawing; where it comes from a pointer, with keys that were held. */
export interface DrawingPoint {
  x: number;
  y: number;
  screen?: { x: number; y: number };
  isMore?: boolean;
  isFree?: boolean;
  isCopy?: boolean;
  isTouch?: boolean;
}

/** A point of the drawing that a pointer is at, on the screen too [pixels]. */
export interface PointedAt extends DrawingPoint {
  screen: { x: number; y: number };
}

/** Identifiers by kind: a robot, obstacle or lane has its index, others have a name. */
export interface Ids {
  robot: number;
  job: number;
  obstacle: number;
  lane: number;
  stop: string;
  vertex: string;
  cell: string;
}

/** Something of the document on the map. */
export type Item = { [Kind in keyof Ids]: { kind: Kind; id: Ids[Kind] } }[keyof Ids];

/** A robot of the document, with vertices of the map; -1 for none. */
export interface RobotHit {
  index: number;
  robot: RobotData;
  home: number;
  stops: number[];
}

/** A job of the document, with the vertices of its stops; -1 for none. */
export interface JobHit {
  index: number;
  job: JobData;
  stops: number[];
}

/** A lane as it is drawn. */
export interface LaneLine {
  ends: number[];
  points: Point[];
}

/** Cells of a map that can be blocked and freed. */
export interface Ground {
  columns: number;
  rows: number;
  side: number;
  cellAt(x: number, y: number): Cell;
  holds(cell: Cell): boolean;
  boxOf(from: Cell, to?: Cell): Rect;
  block(document: ScenarioDocument, cells: Cell[]): ScenarioDocument;
  free(document: ScenarioDocument, cells: Cell[]): ScenarioDocument;
  isBlocked(document: ScenarioDocument, cell: Cell): boolean;
}

/** What is drawn with. */
export interface Tool {
  isDrawn: boolean;
  readonly isBusy: boolean;
  readonly measure?: string;
  readonly frees?: boolean;
  press(point: DrawingPoint): void;
  drag(point: DrawingPoint): void;
  hover(point: DrawingPoint): void;
  release(point: DrawingPoint): void;
  leave?(): void;
  cancel(): void;
  paint(context: CanvasRenderingContext2D, theme: Theme, scale: number): void;
}

export interface ToolMap extends Omit<Map<string, Tool>, "get"> {
  get(name: "select"): SelectTool;
  get(name: "robot"): RobotTool;
  get(name: "pick"): PickTool;
  get(name: string): Tool;
}

/** What is selected, to be put elsewhere: places are on the site. */
export interface Piece {
  format: string;
  blocked: { rect: Rect; name?: string }[];
  robots: { at: Point; robot: RobotData }[];
  vertices?: Record<string, VertexData>;
  lanes?: LaneData[];
  stations?: Record<string, string>;
  parking?: string[];
  charging?: string[];
}

/** A table of items of the document: its list, its columns, how its rows are read. */
export interface SheetTable {
  list: ListName;
  kind: "robot" | "job";
  columns: Column[];
  columnOf(fault: Pick<DocumentFault, "path">): string;
  unitOf(column: Pick<Column, "key">, units: { length?: string; time?: string }): string;
  newRow(texts: { newRow: string; newJob: string }): string;
  /** Reads rows with headings, and returns the edit that adds them. */
  read?: (text: string) => Promise<Edit>;
}

/** A cell of the table of robots, and several from one to another. */
export interface SheetCell {
  row: number;
  column: number;
}
export interface Block {
  top: number;
  bottom: number;
  left: number;
  right: number;
}

/** A column of the table of robots. */
export interface Column {
  key: string;
  /** Title, hint, and what holds where a cell is empty. */
  words(texts: {
    columns: Record<string, string[]>;
    jobColumns: Record<string, string[]>;
  }): readonly string[];
  text(item: RowData): string;
  value?: (item: RowData) => number;
  set(item: RowData, text: string): RowData;
}

/** A cause of delay: its kind, and what its fields hold. */
export interface Cause {
  kind: string;
  values: string[];
}

/** A document as the start page shows it. */
export interface CardData {
  source: string;
  name: string;
  revision: string | number;
  title: string;
  note?: string;
}

/** A document that is opened: where it is from and what is done first. */
export interface Found {
  document: ScenarioDocument;
  folder?: string;
  path?: string;
  revision?: string | null;
  draft?: string;
  origin?: [string, string] | null;
  known?: string;
  notes?: PhraseData[];
  suggested?: string;
  tool?: string;
}

/** A file that was dropped or chosen; one of a folder has its path. */
export type DroppedFile = File & { path?: string };

export type Tab = "map" | "robots" | "jobs" | "plan";

/** What is refused, and the place in the document that it is about. */
export type Complaint = Pick<DocumentFault, "place" | "message"> & Partial<DocumentFault>;

/** How to search, as the fields of the form have it. */
export interface SearchForm {
  planner: string;
  options: Record<string, string | number>;
  time_limit: number | string;
  seed: number | string;
}

/** The settings of a search as a request has them. */
export type SearchSettings = Required<Pick<NewPlan, "planner" | "options" | "time_limit" | "seed">>;

/** Elements that the map and the player are shown in. */
export interface StageElements {
  holder: HTMLElement;
  below: HTMLElement;
  time: HTMLElement;
  card: HTMLElement;
}

/** Functions that hear of events of runs; of all runs, or of one. */
export type Hearer = { [Name in keyof Events]?: (data: Events[Name]) => void };
export type EventPair = { [Name in keyof Events]: [Name, Events[Name]] }[keyof Events];
export type Tell = (...event: EventPair) => void;

/** A function that hears of an event of an element. */
export type Handler = (event: PageEvent) => void;

export type Turn = "turn" | "mirror" | "flip";

export type TimeKey = "from" | "until";

/** The lane that has handles, on the site. */
export interface HandledLane {
  index: number;
  tail: Point;
  head: Point;
  controls: Point[];
}

/** The middle of two fingers, and how far they are apart [pixels]. */
export interface Span {
  x: number;
  y: number;
  length: number;
}

/** Where a moment [s] and a flowtime [ticks] are in the drawing of a curve. */
export interface Axes {
  x: (at: number) => number;
  y: (flowtime: number) => number;
}

/** The period over some values of a parameter. */
export interface ParameterPiece {
  from: Fraction;
  to: Fraction;
  fixed: Fraction;
  slope: Fraction;
  circuit: number;
}

/** A step of the critical circle, with its time; several laps of one robot are one step. */
/** Laps in a new order: asked for, reached, or why not. */
export interface OtherOrder {
  isAsked?: boolean;
  period?: Fraction;
  laps?: number;
  why?: string;
}

/** A slider that was moved, and where to. */
export interface Moved {
  curve: ParameterCurve;
  position: number;
}
