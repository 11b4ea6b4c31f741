/** What is selected, moved, turned and mirrored where it is: a document with other positions. */

import { changeRobots, withStopAt } from "../robots/fleet.js";
import { withObstacles } from "./ground.js";
import { endsOf, lanesOf, mapVertices, positionOf } from "./network.js";
import { numberOf, placeOf, rounded, toDrawing } from "./places.js";

/** The rectangles of the site that the selected obstacles and blocked cells cover, with their names. */
export function blockedOf({ selection, document, hits, roadmap }) {
  const known = document.map.floor?.obstacles ?? [];
  return [
    ...selection
      .of("obstacle")
      .filter((index) => known[index])
      .map((index) => ({ ...known[index], rect: known[index].rect.map((one) => numberOf(one)) })),
    ...selection
      .of("cell")
      .map((id) => ({ rect: siteRect(roadmap, hits.ground.boxOf(id.split(",").map(Number))) })),
  ];
}

/** A rectangle of the drawing (left, top, width, height) on the site: least x and y, width, height. */
function siteRect(roadmap, [left, top, width, height]) {
  return rectOf(roadmap.toSite(left, top), roadmap.toSite(left + width, top + height));
}

const rectOf = (one, other) =>
  [
    Math.min(one[0], other[0]),
    Math.min(one[1], other[1]),
    Math.abs(one[0] - other[0]),
    Math.abs(one[1] - other[1]),
  ].map(rounded);

/** A rectangle whose corners are mapped to other places of the site. */
export const mapRect = ([x, y, width, height], map) =>
  rectOf(map([x, y]), map([x + width, y + height]));

/** The cells of a grid that a rectangle of the site covers. */
export function cellsOfRect(ground, roadmap, [x, y, width, height]) {
  const one = toDrawing(roadmap, x, y);
  const other = toDrawing(roadmap, x + width, y + height);
  const [left, right, top, bottom] = [
    Math.round(Math.min(one[0], other[0]) + 0.5),
    Math.round(Math.max(one[0], other[0]) - 0.5),
    Math.round(Math.min(one[1], other[1]) + 0.5),
    Math.round(Math.max(one[1], other[1]) - 0.5),
  ];
  const cells = [];
  for (let row = top; row <= bottom; row++)
    for (let column = left; column <= right; column++)
      if (ground.holds([column, row])) cells.push([column, row]);
  return cells;
}

/** The vertices that go with what is selected: those themselves, and both ends of lanes. */
function verticesOf({ selection, document }) {
  const known = document.map.roadmap?.vertices ?? {};
  const ends = selection.of("lane").flatMap((index) => {
    const lane = lanesOf(document)[index];
    return lane ? endsOf(lane) : [];
  });
  return [...new Set([...selection.of("vertex"), ...ends])].filter((name) => name in known);
}

/** The rectangle of the site round all that is selected: least x and y, width, height; null for nothing. */
export function boundsOf(editor) {
  const { selection, document, hits, roadmap } = editor;
  const corners = blockedOf(editor).flatMap(({ rect: [x, y, width, height] }) => [
    [x, y],
    [x + width, y + height],
  ]);
  for (const name of verticesOf(editor))
    corners.push(positionOf(document.map.roadmap.vertices[name]));
  for (const { kind, id } of selection.items) {
    const vertex = kind === "robot" || kind === "stop" ? hits.vertexOf({ kind, id }) : -1;
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
 */
export function arranged(editor, document, map, lost = []) {
  const { selection, hits, roadmap } = editor;
  const [robots, stops, obstacles, cells] = ["robot", "stop", "obstacle", "cell"].map((kind) =>
    selection.of(kind),
  );
  const vertices = verticesOf(editor);
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
      next.map.floor.obstacles.map((each, index) =>
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
    const { ground } = hits;
    next = ground.block(
      ground.free(
        next,
        cells.map((id) => id.split(",").map(Number)),
      ),
      there,
    );
  }
  return next;
}

/** Where the selected cells of a grid come to lie. */
export function movedCells({ selection, hits, roadmap }, map) {
  return selection
    .of("cell")
    .flatMap((id) =>
      cellsOfRect(
        hits.ground,
        roadmap,
        mapRect(siteRect(roadmap, hits.ground.boxOf(id.split(",").map(Number))), map),
      ),
    );
}

/** A quarter turn to the right, or the mirror image from left to right or upside down, as it is seen. */
export function turnOf(editor, kind) {
  const [x, y, width, height] = boundsOf(editor);
  const { roadmap, ground } = editor;
  const step = (ground?.side ?? 0) * roadmap.unit;
  const isOdd = step > 0 && Math.round((width + height) / step) % 2 === 1;
  const [atX, atY] = [x + width / 2 + (isOdd && kind === "turn" ? step / 2 : 0), y + height / 2];
  const hand = roadmap.frame.yUp ? 1 : -1;
  return {
    turn: ([px, py]) => [atX + hand * (py - atY), atY - hand * (px - atX)],
    mirror: ([px, py]) => [2 * atX - px, py],
    flip: ([px, py]) => [px, 2 * atY - py],
  }[kind];
}
