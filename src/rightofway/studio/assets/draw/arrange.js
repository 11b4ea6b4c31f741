/** What is selected, moved, turned and mirrored where it is: a document with other positions. */

import { changeRobots, withStopAt } from "../robots/fleet.js";
import { cellOf, obstaclesOf, withObstacles } from "./ground.js";
import { endsOf, lanesOf, mapVertices, positionOf, roadmapOf } from "./network.js";
import { numberOf, placeOf, rounded, toDrawing } from "./places.js";
import { present } from "../given.js";
/** @import { Roadmap } from "../../../viz/page/assets/plan/roadmap.js" */
/** @import { Cell, Ground, Piece, Point, PointMap, Rect, ScenarioDocument, Turn } from "../types.js" */
/** @import { Editor } from "./editor.js" */

/**
 * The rectangles of the site that the selected obstacles and blocked cells cover, with their names.
 * @param {Editor} editor
 * @returns {Piece["blocked"]}
 */
export function blockedOf({ selection, document, hits, roadmap }) {
  const known = document.map.floor?.obstacles ?? [];
  return [
    ...selection
      .of("obstacle")
      .filter((index) => known[index])
      .map((index) => ({ ...known[index], rect: known[index].rect.map((one) => numberOf(one)) })),
    ...selection
      .of("cell")
      .map((id) => ({ rect: siteRect(roadmap, present(hits.ground).boxOf(cellOf(id))) })),
  ];
}

/**
 * A rectangle of the drawing (left, top, width, height) on the site: least x and y, width, height.
 * @param {Roadmap} roadmap
 * @param {Rect} box
 * @returns {Rect}
 */
function siteRect(roadmap, [left, top, width, height]) {
  return rectOf(roadmap.toSite(left, top), roadmap.toSite(left + width, top + height));
}

/**
 * @param {Point} one
 * @param {Point} other
 * @returns {Rect}
 */
const rectOf = (one, other) => [
  rounded(Math.min(one[0], other[0])),
  rounded(Math.min(one[1], other[1])),
  rounded(Math.abs(one[0] - other[0])),
  rounded(Math.abs(one[1] - other[1])),
];

/**
 * A rectangle whose corners are mapped to other places of the site.
 * @param {Rect} rect
 * @param {PointMap} map
 * @returns {Rect}
 */
export const mapRect = ([x, y, width, height], map) =>
  rectOf(map([x, y]), map([x + width, y + height]));

/**
 * The cells of a grid that a rectangle of the site covers.
 * @param {Ground} ground
 * @param {Roadmap} roadmap
 * @param {Rect} rect
 * @returns {Cell[]}
 */
export function cellsOfRect(ground, roadmap, [x, y, width, height]) {
  const one = toDrawing(roadmap, x, y);
  const other = toDrawing(roadmap, x + width, y + height);
  const [left, right, top, bottom] = [
    Math.round(Math.min(one[0], other[0]) + 0.5),
    Math.round(Math.max(one[0], other[0]) - 0.5),
    Math.round(Math.min(one[1], other[1]) + 0.5),
    Math.round(Math.max(one[1], other[1]) - 0.5),
  ];
  /** @type {Cell[]} */
  const cells = [];
  for (let row = top; row <= bottom; row++)
    for (let column = left; column <= right; column++)
      if (ground.holds([column, row])) cells.push([column, row]);
  return cells;
}

/**
 * The vertices that go with what is selected: those themselves, and both ends of lanes.
 * @param {Editor} editor
 * @returns {string[]}
 */
function verticesOf({ selection, document }) {
  const known = document.map.roadmap?.vertices ?? {};
  const ends = selection.of("lane").flatMap((index) => {
    const lane = lanesOf(document)[index];
    return lane ? endsOf(lane) : [];
  });
  return [...new Set([...selection.of("vertex"), ...ends])].filter((name) => name in known);
}

/**
 * The rectangle of the site round all that is selected: least x and y, width, height; null for nothing.
 * @param {Editor} editor
 * @returns {Rect | null}
 */
export function boundsOf(editor) {
  const { selection, document, hits, roadmap } = editor;
  /** @type {Point[]} */
  const corners = blockedOf(editor).flatMap(({ rect: [x, y, width, height] }) => [
    [x, y],
    [x + width, y + height],
  ]);
  for (const name of verticesOf(editor))
    corners.push(positionOf(roadmapOf(document).vertices[name]));
  for (const item of selection.items) {
    const vertex = item.kind === "robot" || item.kind === "stop" ? hits.vertexOf(item) : -1;
    if (vertex >= 0) corners.push(roadmap.toSite(roadmap.x[vertex], roadmap.y[vertex]));
  }
  if (!corners.length) return null;
  const [xs, ys] = [0, 1].map((axis) => corners.map((corner) => corner[axis]));
  const [left, low] = [Math.min(...xs), Math.min(...ys)];
  return [left, low, Math.max(...xs) - left, Math.max(...ys) - low];
}

/**
 * The document with all that is selected at the places of the site that a function gives; `lost` takes
 * what would stand where no robot can.
 * @param {Editor} editor
 * @param {ScenarioDocument} document
 * @param {PointMap} map
 * @param {number[]} [lost]
 * @returns {ScenarioDocument}
 */
export function arranged(editor, document, map, lost = []) {
  const { selection, hits, roadmap } = editor;
  const [robots, stops] = [selection.of("robot"), selection.of("stop")];
  const [obstacles, cells] = [selection.of("obstacle"), selection.of("cell")];
  const vertices = verticesOf(editor);
  /**
   * @param {number} vertex
   * @returns {number}
   */
  const moved = (vertex) => {
    const [x, y] = toDrawing(roadmap, ...map(roadmap.toSite(roadmap.x[vertex], roadmap.y[vertex])));
    const at = editor.vertexAt({ x, y });
    if (at < 0) lost.push(vertex);
    return at;
  };
  let next = document;
  if (robots.length)
    next = changeRobots(next, robots, (robot, index) => {
      const at = moved(hits.robots[index].home);
      return at < 0 ? robot : { ...robot, home: placeOf(at, roadmap, document) };
    });
  for (const id of stops) {
    const [index, number] = id.split("/").map(Number);
    const at = moved(hits.robots[index].stops[number]);
    if (at < 0) continue;
    next = changeRobots(next, [index], (robot) =>
      withStopAt(robot, number, placeOf(at, roadmap, document)),
    );
  }
  if (vertices.length) next = mapVertices(next, vertices, map);
  if (obstacles.length) {
    const chosen = new Set(obstacles);
    next = withObstacles(
      next,
      obstaclesOf(next).map((each, index) =>
        chosen.has(index)
          ? {
              ...each,
              rect: mapRect(
                each.rect.map((one) => numberOf(one)),
                map,
              ),
            }
          : each,
      ),
    );
  }
  if (cells.length) {
    const there = movedCells(editor, map);
    const ground = present(hits.ground);
    next = ground.block(ground.free(next, cells.map(cellOf)), there);
  }
  return next;
}

/**
 * Where the selected cells of a grid come to lie.
 * @param {Editor} editor
 * @param {PointMap} map
 * @returns {Cell[]}
 */
export function movedCells({ selection, hits, roadmap }, map) {
  return selection.of("cell").flatMap((id) => {
    const ground = present(hits.ground);
    const box = siteRect(roadmap, ground.boxOf(cellOf(id)));
    return cellsOfRect(ground, roadmap, mapRect(box, map));
  });
}

/**
 * A quarter turn to the right, or the mirror image from left to right or upside down, as it is seen.
 * @param {Editor} editor
 * @param {Turn} kind
 * @returns {PointMap}
 */
export function turnOf(editor, kind) {
  const [x, y, width, height] = present(boundsOf(editor));
  const { roadmap, ground } = editor;
  const step = (ground?.side ?? 0) * roadmap.unit;
  const isOdd = step > 0 && Math.round((width + height) / step) % 2 === 1;
  const [atX, atY] = [x + width / 2 + (isOdd && kind === "turn" ? step / 2 : 0), y + height / 2];
  const hand = roadmap.frame.yUp ? 1 : -1;
  /** @type {Record<Turn, PointMap>} */
  const maps = {
    turn: ([px, py]) => [atX + hand * (py - atY), atY - hand * (px - atX)],
    mirror: ([px, py]) => [2 * atX - px, py],
    flip: ([px, py]) => [px, 2 * atY - py],
  };
  return maps[kind];
}
