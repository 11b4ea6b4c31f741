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
} from "./network.js";
import { placeOf, rounded, toDrawing, vertexOf } from "./places.js";

const FORMAT = "rightofway-piece/1";

/** What is selected, with places of the site; a lane takes its ends along. */
export function pieceOf(editor) {
  const { selection, document, hits, roadmap } = editor;
  const piece = { format: FORMAT, blocked: blockedOf(editor), robots: [] };
  for (const index of selection.of("robot")) {
    const { home } = hits.robots[index];
    if (home < 0) continue;
    const at = roadmap.toSite(roadmap.x[home], roadmap.y[home]).map(rounded);
    piece.robots.push({ at, robot: robotsOf(document)[index] });
  }
  if (!isNetwork(document)) return piece;
  const { vertices, stations = {}, parking = [], charging = [] } = document.map.roadmap;
  const all = lanesOf(document);
  const chosen = new Set(selection.of("lane"));
  const names = new Set(selection.of("vertex").filter((name) => name in vertices));
  for (const index of chosen) if (all[index]) endsOf(all[index]).forEach((end) => names.add(end));
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

export const isEmpty = ({ blocked, robots, vertices = {} }) =>
  !blocked.length && !robots.length && !Object.keys(vertices).length;

/** A piece as the clipboard has it, and back; null for any other text. */
export const textOfPiece = (piece) => JSON.stringify(piece);

export function pieceOfText(text) {
  try {
    const piece = JSON.parse(text);
    return piece?.format === FORMAT && isWhole(piece) ? piece : null;
  } catch {
    return null;
  }
}

const areNumbers = (values, count) =>
  Array.isArray(values) && values.length === count && values.every(Number.isFinite);

/** Whether a piece has what is looked at before the library reads it. */
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

/** The middle of a piece on the site. */
export function middleOf({ blocked, robots, vertices = {} }) {
  const corners = [
    ...blocked.flatMap(({ rect: [x, y, width, height] }) => [
      [x, y],
      [x + width, y + height],
    ]),
    ...robots.map(({ at }) => at),
    ...Object.values(vertices).map(positionOf),
  ];
  return [0, 1].map((axis) => {
    const values = corners.map((corner) => corner[axis]);
    return (Math.min(...values) + Math.max(...values)) / 2;
  });
}

/** Put a piece into a document, shifted on the site: the document, and what is to be selected. */
export function withPiece(editor, document, piece, shift) {
  const items = [];
  const map = (at) => at.map((length, axis) => length + shift[axis]);
  let next = withBlocked(editor, document, piece.blocked, map, items);
  const names = new Map();
  if (isNetwork(next) && piece.vertices) next = withVertices(next, piece, map, names, items);
  if (robotsOf(next)) next = withRobots(editor, next, piece.robots, map, names, items);
  return { document: next, items };
}

function withBlocked({ ground, roadmap, hits }, document, blocked, map, items) {
  const rects = blocked.map((each) => ({ ...each, rect: mapRect(each.rect, map) }));
  if (document.map.floor) {
    const known = document.map.floor.obstacles ?? [];
    rects.forEach((_, i) => items.push({ kind: "obstacle", id: known.length + i }));
    return rects.length ? withObstacles(document, [...known, ...rects]) : document;
  }
  if (!document.map.grid) return document;
  const cells = rects.flatMap(({ rect }) => cellsOfRect(hits.ground, roadmap, rect));
  items.push(...cells.map((cell) => ({ kind: "cell", id: cell.join() })));
  return cells.length ? ground.block(document, cells) : document;
}

function withVertices(document, piece, map, names, items) {
  let next = document;
  for (const [name, vertex] of Object.entries(piece.vertices)) {
    const copy = name in next.map.roadmap.vertices ? freeVertexName(next) : name;
    names.set(name, copy);
    items.push({ kind: "vertex", id: copy });
    const more = Array.isArray(vertex) ? {} : vertex;
    next = addVertex(next, copy, map(positionOf(vertex)), more);
  }
  const roadmap = next.map.roadmap;
  const lanes = piece.lanes.map((lane) => {
    const [from, to] = endsOf(lane).map((end) => names.get(end));
    const curve = controlsOf(lane).map((point) => map(point).map(rounded));
    if (Array.isArray(lane)) return [from, to, ...lane.slice(2)];
    return { ...asMapping(lane), from, to, ...(curve.length && { curve }) };
  });
  const stations = { ...roadmap.stations };
  for (const [station, at] of Object.entries(piece.stations ?? {}))
    stations[freeStation(stations, station)] = names.get(at);
  const [parking, charging] = ["parking", "charging"].map((key) => [
    ...(roadmap[key] ?? []),
    ...(piece[key] ?? []).map((name) => names.get(name)),
  ]);
  return withRoadmap(next, {
    edges: [...roadmap.edges, ...lanes],
    ...(Object.keys(stations).length && { stations }),
    ...(parking.length && { parking }),
    ...(charging.length && { charging }),
  });
}

function freeStation(stations, name) {
  if (!(name in stations)) return name;
  let number = 2;
  while (`${name}-${number}` in stations) number++;
  return `${name}-${number}`;
}

function withRobots(editor, document, robots, map, names, items) {
  const { roadmap } = editor;
  const taken = new Set(robotsOf(document).map(({ home }) => vertexOf(home, roadmap)));
  const known = new Set(robotsOf(document).map(({ name }) => name));
  const place = (at) => names.get(at) ?? at;
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
  const first = robotsOf(document).length;
  news.forEach((_, i) => items.push({ kind: "robot", id: first + i }));
  return news.length ? addRobots(document, news) : document;
}

/** The free vertex that is nearest to another one. */
function freeNear(vertex, taken, roadmap) {
  if (vertex < 0) return -1;
  const seen = new Set([vertex]);
  for (const at of seen) {
    if (!taken.has(at)) return at;
    for (const next of roadmap.next(at)) seen.add(next);
  }
  return -1;
}
