/** What an editor shows above the map: what is selected, and what the library says about places. */

import { ring } from "../../../viz/page/assets/drawing/shapes.js";
import { arrow, paintStops } from "../../../viz/page/assets/jobs/job_marks.js";
import { itemOf } from "../fault_place.js";
import { cellOf } from "./ground.js";
import { present } from "../given.js";
/** @import { Roadmap } from "../../../viz/page/assets/plan/roadmap.js" */
/** @import { Theme } from "../../../viz/page/assets/drawing/theme.js" */
/** @import { JobHit, Point, RobotHit } from "../types.js" */
/** @import { Editor } from "./editor.js" */

const MOST_SIGNS = 300;
const MOST_OF_ONE = 8; // places of a finding; more of them say nothing of where it hurts
/** @type {Record<string, string>} */
const SIGNS = { error: "✕", warning: "!", fault: "✕" };

/**
 * Rings round what is selected, boxes round obstacles, bands along lanes.
 * @param {CanvasRenderingContext2D} context
 * @param {Editor} editor
 * @param {number} scale
 * @returns {void}
 */
export function paintSelection(context, editor, scale) {
  const { hits, selection, roadmap, stage } = editor;
  context.strokeStyle = stage.theme.ink;
  for (const item of selection.items) {
    context.lineWidth = 2 / scale;
    const vertex = hits.vertexOf(item);
    if (vertex >= 0)
      ring(context, roadmap.x[vertex], roadmap.y[vertex], radiusAt(roadmap, vertex, scale));
    else if (item.kind === "cell")
      context.strokeRect(...present(hits.ground).boxOf(cellOf(item.id)));
    else if (item.kind === "obstacle" && hits.obstacles[item.id])
      context.strokeRect(...hits.obstacles[item.id]);
    else if (item.kind === "lane" && hits.lanes[item.id])
      band(context, hits.lanes[item.id].points, 5 / scale);
    if (item.kind === "job" && hits.jobs[item.id])
      paintStops(context, stage.theme, placesOf(hits.jobs[item.id], roadmap), scale);
    if (item.kind === "robot" && vertex >= 0) route(context, roadmap, hits.robots[item.id], scale);
  }
}

const MOST_JOBS = 200; // whose ways are drawn; those of more cover the map

/**
 * The ways of all jobs, thin.
 * @param {CanvasRenderingContext2D} context
 * @param {Editor} editor
 * @param {number} scale
 * @returns {void}
 */
export function paintJobs(context, { hits, roadmap, stage }, scale) {
  if (hits.jobs.length > MOST_JOBS) return;
  context.strokeStyle = stage.theme.muted;
  context.lineWidth = 1.25 / scale;
  for (const job of hits.jobs) {
    const places = placesOf(job, roadmap);
    places.slice(1).forEach((to, i) => arrow(context, places[i], to, scale));
    for (const { x, y } of places) {
      ring(context, x, y, 4 / scale);
      context.stroke();
    }
  }
}

/**
 * Where the stops of a job are in the drawing, as far as the map has them.
 * @param {JobHit} job
 * @param {Roadmap} roadmap
 */
const placesOf = ({ stops }, { x, y }) =>
  stops.filter((vertex) => vertex >= 0).map((vertex) => ({ x: x[vertex], y: y[vertex] }));

/**
 * Signs at the places of faults and findings; a tip says which, and the list has the words.
 * @param {CanvasRenderingContext2D} context
 * @param {Editor} editor
 * @param {number} scale
 * @returns {void}
 */
export function paintFaults(context, { store, hits, roadmap, stage }, scale) {
  /** @type {[number, string][]} */
  const signs = [];
  for (const fault of store.faults) {
    const robot = hits.robots[itemOf(fault, "robots")];
    if (robot) {
      const { home, stops } = robot;
      signs.push([home >= 0 ? home : (stops.find((stop) => stop >= 0) ?? -1), "fault"]);
    }
    const lane = hits.lanes[itemOf(fault, "map", "roadmap", "edges")];
    context.strokeStyle = stage.theme.held;
    if (lane) band(context, lane.points, 4 / scale);
    const box = hits.obstacles[itemOf(fault, "map", "floor", "obstacles")];
    context.lineWidth = 2.5 / scale;
    if (box) context.strokeRect(...box);
  }
  for (const { severity, vertices } of store.survey.findings) {
    if (SIGNS[severity] && vertices.length <= MOST_OF_ONE)
      for (const name of vertices) signs.push([roadmap.vertexNamed(name), severity]);
  }
  const marked = new Set();
  for (const [vertex, kind] of signs.slice(0, MOST_SIGNS)) {
    if (vertex < 0 || marked.has(vertex)) continue;
    marked.add(vertex);
    sign(context, roadmap, vertex, kind, stage.theme, scale);
  }
}

/**
 * A small disc with a sign, at the upper right of a place.
 * @param {CanvasRenderingContext2D} context
 * @param {Roadmap} roadmap
 * @param {number} vertex
 * @param {string} kind
 * @param {Theme} theme
 * @param {number} scale
 * @returns {void}
 */
function sign(context, { x, y }, vertex, kind, theme, scale) {
  context.save();
  context.translate(x[vertex], y[vertex]);
  context.scale(1 / scale, 1 / scale);
  const reach = Math.min(Math.max(scale * 0.36, 5), 18);
  context.fillStyle = kind === "warning" ? theme.wait : theme.held;
  context.beginPath();
  context.arc(reach, -reach, 7, 0, 2 * Math.PI);
  context.fill();
  context.fillStyle = theme.paper;
  context.font = theme.font(11, 700);
  context.textAlign = "center";
  context.textBaseline = "middle";
  context.fillText(SIGNS[kind], reach, -reach + 0.5);
  context.restore();
}

/**
 * From the home of a robot to its stops, dashed.
 * @param {CanvasRenderingContext2D} context
 * @param {Roadmap} roadmap
 * @param {RobotHit} robot
 * @param {number} scale
 * @returns {void}
 */
function route(context, { x, y }, { home, stops }, scale) {
  const places = [home, ...stops].filter((vertex) => vertex >= 0);
  context.lineWidth = 1.5 / scale;
  context.setLineDash([4 / scale, 4 / scale]);
  context.beginPath();
  for (const vertex of places) context.lineTo(x[vertex], y[vertex]);
  context.stroke();
  context.setLineDash([]);
}

/**
 * A trip that is being placed: a ring at its home, dashed to its stops; points of the drawing.
 * @param {CanvasRenderingContext2D} context
 * @param {Editor} editor
 * @param {number} scale
 * @param {Point[]} points
 * @returns {void}
 */
export function paintTrip(context, { roadmap, stage: { theme } }, scale, points) {
  context.strokeStyle = theme.ink;
  context.lineWidth = 2 / scale;
  ring(context, ...points[0], roadmap.hasCells ? 0.35 : 11 / scale);
  context.setLineDash([5 / scale, 4 / scale]);
  context.beginPath();
  for (const point of points) context.lineTo(...point);
  context.stroke();
  context.setLineDash([]);
}

/**
 * A line along a lane.
 * @param {CanvasRenderingContext2D} context
 * @param {Point[]} points
 * @param {number} width
 * @returns {void}
 */
function band(context, points, width) {
  context.lineWidth = width;
  context.beginPath();
  for (const [x, y] of points) context.lineTo(x, y);
  context.stroke();
}

/**
 * The radius of a ring round a vertex, or within its cell.
 * @param {Roadmap} roadmap
 * @param {number} vertex
 * @param {number} scale
 * @returns {number}
 */
export function radiusAt(roadmap, vertex, scale) {
  return roadmap.hasCells ? Math.max(0.5 * (roadmap.sides?.[vertex] ?? 1), 9 / scale) : 13 / scale;
}
