/** A piece of a drawing: what is selected, to be put elsewhere, also into another tab of the studio. */

import { addRobots, robotsOf, stopsOf, withStops } from "../robots/fleet.js";
import { blockedOf, cellsOfRect, mapRect } from "./arrange.js";
import { withObstacles } from "./ground.js";
import {
  addVertex,
  asMapping,
  controlsOf,
  endsOf,
  freeVertexName,
  isNetwork,
  lanesOf,
  positionOf,
  withRoadmap,
  roadmapOf,
} from "./network.js";
import { AXES, placeOf, rounded, toDrawing, vertexOf } from "./places.js";
import { present } from "../given.js";
/** @import { Roadmap } from "../../../viz/page/assets/plan/roadmap.js" */
/** @import { Item, LaneData, Piece, Place, Point, PointMap, RobotData, ScenarioDocument } from "../types.js" */
/** @import { Editor } from "./editor.js" */

const FORMAT = "rightofway-piece/1";

/**
 * What is selected, with places of the site; a lane takes its ends along.
 * @param {Editor} editor
 * @returns {Piece}
 */
export function pieceOf(editor) {
  const { selection, document, hits, roadmap } = editor;
  /** @type {Piece} */
  const piece = { format: FORMAT, blocked: blockedOf(editor), robots: [] };
  for (const index of selection.of("robot")) {
    const { home } = hits.robots[index];
    if (home < 0) continue;
    const at = roadmap.toSite(roadmap.x[home], roadmap.y[home]).map(rounded);
    piece.robots.push({ at, robot: hits.robots[index].robot });
  }
  if (!isNetwork(document)) return piece;
  const { vertices, stations = {}, parking = [], charging = [] } = roadmapOf(document);
  const all = lanesOf(document);
  const chosen = new Set(selection.of("lane"));
  const names = new Set(selection.of("vertex").filter((name) => name in vertices));
  for (const index of chosen) if (all[index]) endsOf(all[index]).forEach((end) => names.add(end));
  /**
   * @param {string} name
   * @returns {boolean}
   */
  const isIn = (name) => names.has(name);
  const hasVertices = selection.of("vertex").length > 0;
  return {
    ...piece,
    vertices: Object.fromEntries([...names].map((name) => [name, vertices[name]])),
    lanes: all.filter(
      (lane, index) => chosen.has(index) || (hasVertices && endsOf(lane).every(isIn)),
    ),
    stations: Object.fromEntries(Object.entries(stations).filter(([, at]) => isIn(at))),
    parking: parking.filter(isIn),
    charging: charging.filter(isIn),
  };
}

/**
 * @param {Piece} piece
 * @returns {boolean}
 */
export const isEmpty = ({ blocked, robots, vertices = {} }) =>
  !blocked.length && !robots.length && !Object.keys(vertices).length;

/**
 * A piece as the clipboard has it, and back; null for any other text.
 * @param {Piece} piece
 * @returns {string}
 */
export const textOfPiece = (piece) => JSON.stringify(piece);

/**
 * @param {string} text
 * @returns {Piece | null}
 */
export function pieceOfText(text) {
  try {
    const piece = JSON.parse(text);
    return piece?.format === FORMAT && isWhole(piece) ? piece : null;
  } catch {
    return null;
  }
}

/**
 * @param {unknown} values
 * @param {number} count
 * @returns {boolean}
 */
const areNumbers = (values, count) =>
  Array.isArray(values) && values.length === count && values.every(Number.isFinite);

/**
 * Whether a piece has what is looked at before the library reads it.
 * @param {Piece} piece
 * @returns {boolean}
 */
function isWhole({ blocked, robots, vertices = {}, lanes = [] }) {
  return (
    Array.isArray(blocked) &&
    blocked.every((each) => areNumbers(each?.rect, 4)) &&
    Array.isArray(robots) &&
    robots.every((each) => areNumbers(each?.at, 2) && typeof each.robot === "object") &&
    Object.values(vertices).every((each) => areNumbers(each && positionOf(each), 2)) &&
    Array.isArray(lanes) &&
    lanes.every((lane) => endsOf(lane).every((end) => end in vertices))
  );
}

/**
 * The middle of a piece on the site.
 * @param {Piece} piece
 * @returns {Point}
 */
export function middleOf({ blocked, robots, vertices = {} }) {
  const corners = [
    ...blocked.flatMap(({ rect: [x, y, width, height] }) => [
      [x, y],
      [x + width, y + height],
    ]),
    ...robots.map(({ at }) => at),
    ...Object.values(vertices).map(positionOf),
  ];
  return AXES.map((axis) => {
    const values = corners.map((corner) => corner[axis]);
    return (Math.min(...values) + Math.max(...values)) / 2;
  });
}

/**
 * Put a piece into a document, shifted on the site: the document, and what is to be selected.
 * @param {Editor} editor
 * @param {ScenarioDocument} document
 * @param {Piece} piece
 * @param {Point} shift
 * @returns {{document: ScenarioDocument, items: Item[]}}
 */
export function withPiece(editor, document, piece, shift) {
  /** @type {Item[]} */
  const items = [];
  /**
   * @param {Point} at
   * @returns {Point}
   */
  const map = (at) => at.map((length, axis) => length + shift[axis]);
  let next = withBlocked(editor, document, piece.blocked, map, items);
  /** @type {Map<Place | undefined, string>} */
  const names = new Map();
  if (isNetwork(next) && piece.vertices) next = withVertices(next, piece, map, names, items);
  if (robotsOf(next)) next = withRobots(editor, next, piece.robots, map, names, items);
  return { document: next, items };
}

/**
 * @param {Editor} editor
 * @param {ScenarioDocument} document
 * @param {Piece["blocked"]} blocked
 * @param {PointMap} map
 * @param {Item[]} items
 * @returns {ScenarioDocument}
 */
function withBlocked({ roadmap, hits }, document, blocked, map, items) {
  const rects = blocked.map((each) => ({ ...each, rect: mapRect(each.rect, map) }));
  if (document.map.floor) {
    const known = document.map.floor.obstacles ?? [];
    rects.forEach((_, i) => items.push({ kind: "obstacle", id: known.length + i }));
    return rects.length ? withObstacles(document, [...known, ...rects]) : document;
  }
  if (!document.map.grid) return document;
  const grid = present(hits.ground);
  const cells = rects.flatMap(({ rect }) => cellsOfRect(grid, roadmap, rect));
  for (const cell of cells) items.push({ kind: "cell", id: cell.join() });
  return cells.length ? grid.block(document, cells) : document;
}

/**
 * @param {ScenarioDocument} document
 * @param {Piece} piece
 * @param {PointMap} map
 * @param {Map<Place | undefined, string>} names
 * @param {Item[]} items
 * @returns {ScenarioDocument}
 */
function withVertices(document, piece, map, names, items) {
  let next = document;
  for (const [name, vertex] of Object.entries(piece.vertices ?? {})) {
    const copy = name in roadmapOf(next).vertices ? freeVertexName(next) : name;
    names.set(name, copy);
    items.push({ kind: "vertex", id: copy });
    const more = Array.isArray(vertex) ? {} : vertex;
    next = addVertex(next, copy, map(positionOf(vertex)), more);
  }
  const roadmap = roadmapOf(next);
  /** @type {(lane: LaneData) => LaneData} */
  const moved = (lane) => {
    const [from, to] = endsOf(lane).map((end) => present(names.get(end)));
    const curve = controlsOf(lane).map((point) => map(point).map(rounded));
    if (Array.isArray(lane)) return lane.length > 2 ? [from, to, lane[2]] : [from, to];
    return { ...asMapping(lane), from, to, ...(curve.length && { curve }) };
  };
  const lanes = (piece.lanes ?? []).map(moved);
  const stations = { ...roadmap.stations };
  for (const [station, at] of Object.entries(piece.stations ?? {}))
    stations[freeStation(stations, station)] = present(names.get(at));
  const copied = (/** @type {string[] | undefined} */ all) =>
    (all ?? []).map((name) => present(names.get(name)));
  const parking = [...(roadmap.parking ?? []), ...copied(piece.parking)];
  const charging = [...(roadmap.charging ?? []), ...copied(piece.charging)];
  return withRoadmap(next, {
    edges: [...roadmap.edges, ...lanes],
    ...(Object.keys(stations).length && { stations }),
    ...(parking.length && { parking }),
    ...(charging.length && { charging }),
  });
}

/**
 * @param {Record<string, string>} stations
 * @param {string} name
 * @returns {string}
 */
function freeStation(stations, name) {
  if (!(name in stations)) return name;
  let number = 2;
  while (`${name}-${number}` in stations) number++;
  return `${name}-${number}`;
}

/**
 * @param {Editor} editor
 * @param {ScenarioDocument} document
 * @param {Piece["robots"]} robots
 * @param {PointMap} map
 * @param {Map<Place | undefined, string>} names
 * @param {Item[]} items
 * @returns {ScenarioDocument}
 */
function withRobots(editor, document, robots, map, names, items) {
  const { roadmap } = editor;
  const there = robotsOf(document) ?? [];
  const taken = new Set(there.map(({ home }) => vertexOf(home, roadmap)));
  const known = new Set(there.map(({ name }) => name));
  /**
   * @param {Place | undefined} at
   * @returns {Place | undefined}
   */
  const place = (at) => names.get(at) ?? at;
  /** @type {RobotData[]} */
  const news = [];
  for (const { at, robot } of robots) {
    const { name, ...rest } = robot;
    const [x, y] = toDrawing(roadmap, ...map(at));
    const vertex = freeNear(editor.vertexAt({ x, y }), taken, roadmap);
    const copied = names.get(robot.home); // its vertex is in the piece too
    if (vertex < 0 && !copied) continue;
    taken.add(vertex);
    const trip = withStops(
      { ...rest, home: copied ?? placeOf(vertex, roadmap, document) },
      stopsOf(robot).map((stop) => ({ ...stop, at: place(stop.at) })),
    );
    news.push(known.has(name) ? trip : { name, ...trip });
  }
  const first = there.length;
  news.forEach((_, i) => items.push({ kind: "robot", id: first + i }));
  return news.length ? addRobots(document, news) : document;
}

/**
 * The free vertex that is nearest to another one.
 * @param {number} vertex
 * @param {Set<number>} taken
 * @param {Roadmap} roadmap
 * @returns {number}
 */
function freeNear(vertex, taken, roadmap) {
  if (vertex < 0) return -1;
  const seen = new Set([vertex]);
  for (const at of seen) {
    if (!taken.has(at)) return at;
    for (const next of roadmap.next(at)) seen.add(next);
  }
  return -1;
}
