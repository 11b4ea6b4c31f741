/** Roadmaps: vertices, lanes, stations, parking, zones and closures, as edits of a document. */

import { numberOf, rounded } from "./places.js";
import { present } from "../given.js";
/** @import { LaneData, LaneMapping, MapData, Place, Point, PointMap, RoadmapData, ScenarioDocument, VertexData, ZoneData } from "../types.js" */

/**
 * Whether the map is a roadmap that is in the document; squares of adaptive cells are none to draw.
 * @param {{map: MapData}} document
 * @returns {boolean}
 */
export const isNetwork = ({ map }) => Boolean(map?.roadmap && !map.roadmap.sides);

/**
 * @param {{map: MapData}} document
 * @returns {LaneData[]}
 */
export const lanesOf = (document) => roadmapOf(document).edges;

/**
 * The roadmap that is in a document.
 * @param {{map: MapData}} document
 * @returns {RoadmapData}
 */
export const roadmapOf = ({ map }) => present(map.roadmap);

/**
 * Both ends of a lane, however it is written.
 * @param {LaneData} lane
 * @returns {[string, string]}
 */
export const endsOf = (lane) => (Array.isArray(lane) ? [lane[0], lane[1]] : [lane.from, lane.to]);

/**
 * A lane as a mapping.
 * @param {LaneData} lane
 * @returns {LaneMapping}
 */
export function asMapping(lane) {
  if (!Array.isArray(lane)) return lane;
  const [from, to, length] = lane;
  return length === undefined ? { from, to } : { from, to, length };
}

/**
 * Where a vertex is on the site, however it is written.
 * @param {VertexData} vertex
 * @returns {Point}
 */
export const positionOf = (vertex) =>
  (Array.isArray(vertex) ? vertex : vertex.at).map((length) => numberOf(length));

/**
 * @param {ScenarioDocument} document
 * @param {Partial<RoadmapData>} change
 * @returns {ScenarioDocument}
 */
export const withRoadmap = (document, change) => ({
  ...document,
  map: { ...document.map, roadmap: { ...roadmapOf(document), ...change } },
});

/**
 * @template {object} T
 * @param {T} mapping
 * @param {keyof T} key
 * @returns {T}
 */
export const withoutKey = (mapping, key) =>
  /** @type {T} */ (Object.fromEntries(Object.entries(mapping).filter(([known]) => known !== key)));

/**
 * A name that no vertex has: V1, V2, ...
 * @param {{map: MapData}} document
 * @param {string[]} [more]
 * @returns {string}
 */
export function freeVertexName(document, more = []) {
  let number = Object.keys(roadmapOf(document).vertices).length + 1;
  while (`V${number}` in roadmapOf(document).vertices || more.includes(`V${number}`)) number++;
  return `V${number}`;
}

/**
 * Add a vertex at a place of the site, with what a vertex may have beside its place.
 * @param {ScenarioDocument} document
 * @param {string} name
 * @param {Point} position
 * @param {object & {at?: unknown}} [more]
 * @returns {ScenarioDocument}
 */
export function addVertex(document, name, position, { at: _, ...more } = {}) {
  const at = position.map(rounded);
  const vertex = Object.keys(more).length ? { at, ...more } : at;
  return withRoadmap(document, {
    vertices: { ...roadmapOf(document).vertices, [name]: vertex },
  });
}

/**
 * The control points of a lane that is a curve, on the site; none for a straight one.
 * @param {LaneData} lane
 * @returns {Point[]}
 */
export const controlsOf = (lane) =>
  (asMapping(lane).curve ?? []).map((point) => point.map((length) => numberOf(length)));

/**
 * Where a Bézier curve is over; its ends are the first and the last point.
 * @param {Point[]} points
 * @param {number} share
 * @returns {Point}
 */
export function bezierAt(points, share) {
  let left = points;
  while (left.length > 1)
    left = left
      .slice(1)
      .map(([x, y], i) => [
        left[i][0] + (x - left[i][0]) * share,
        left[i][1] + (y - left[i][1]) * share,
      ]);
  return left[0];
}

/**
 * Let a lane be a curve by its control points, or straight without any; it is as long as it is then.
 * @param {ScenarioDocument} document
 * @param {number} index
 * @param {Point[]} controls
 * @returns {ScenarioDocument}
 */
export function bendLane(document, index, controls) {
  /** @type {(lane: LaneData, each: number) => LaneData} */
  const bentAt = (lane, each) => {
    if (each !== index) return lane;
    const { curve, length, ...rest } = asMapping(lane);
    const isPlain = Object.keys(rest).length === 2;
    if (!controls.length) return isPlain ? endsOf(rest) : rest;
    return { ...rest, curve: controls.map((point) => point.map(rounded)) };
  };
  const edges = lanesOf(document).map(bentAt);
  return withRoadmap(document, { edges });
}

/**
 * A lane whose ends are mapped to other places of the site; its curve goes with them.
 * @param {LaneData} lane
 * @param {Point[]} places
 * @param {boolean[]} areMoved
 * @param {PointMap} map
 * @returns {LaneData}
 */
function carried(lane, [tail, head], [tailMoved, headMoved], map) {
  const curve = controlsOf(lane);
  if (!curve.length) return Array.isArray(lane) ? endsOf(lane) : withoutKey(lane, "length");
  /**
   * @param {Point} at
   * @param {boolean} isMoved
   * @returns {Point}
   */
  const shiftOf = (at, isMoved) => map(at).map((to, axis) => (isMoved ? to - at[axis] : 0));
  const [one, other] = [shiftOf(tail, tailMoved), shiftOf(head, headMoved)];
  const moved = curve.map((point, i) => {
    if (tailMoved && headMoved) return map(point).map(rounded);
    const share = (i + 1) / (curve.length + 1);
    return point.map((length, axis) =>
      rounded(length + one[axis] * (1 - share) + other[axis] * share),
    );
  });
  return { ...withoutKey(asMapping(lane), "length"), curve: moved };
}

/**
 * Map vertices to other places of the site; their lanes are as long as they are then.
 * @param {ScenarioDocument} document
 * @param {string[]} names
 * @param {PointMap} map
 * @returns {ScenarioDocument}
 */
export function mapVertices(document, names, map) {
  const moved = new Set(names);
  const known = roadmapOf(document).vertices;
  const vertices = Object.fromEntries(
    Object.entries(known).map(([name, vertex]) => {
      if (!moved.has(name)) return [name, vertex];
      const at = map(positionOf(vertex)).map(rounded);
      return [name, Array.isArray(vertex) ? at : { ...vertex, at }];
    }),
  );
  const edges = lanesOf(document).map((lane) => {
    const ends = endsOf(lane);
    const areMoved = ends.map((end) => moved.has(end));
    if (!areMoved.some(Boolean)) return lane;
    const places = ends.map((end) => positionOf(known[end]));
    return carried(lane, places, areMoved, map);
  });
  return withRoadmap(document, { vertices, edges });
}

/**
 * Put a vertex on a lane, which becomes two; halves of a curve are curves.
 * @param {ScenarioDocument} document
 * @param {number} index
 * @param {number} share
 * @param {string} name
 * @returns {ScenarioDocument}
 */
export function splitLane(document, index, share, name) {
  const lane = asMapping(lanesOf(document)[index]);
  const { from, to, length, curve, ...rest } = lane;
  const [tail, head] = [from, to].map((end) => positionOf(roadmapOf(document).vertices[end]));
  const [left, right] = halves([tail, ...controlsOf(lane), head], share);
  /**
   * @param {[string, string]} ends
   * @param {Point[]} points
   * @returns {LaneData}
   */
  const half = (ends, points) => {
    const inner = points.slice(1, -1).map((point) => point.map(rounded));
    const isPlain = !Object.keys(rest).length && !inner.length;
    return isPlain
      ? ends
      : {
          from: ends[0],
          to: ends[1],
          ...rest,
          ...(inner.length && { curve: inner }),
        };
  };
  const edges = lanesOf(document).flatMap((each, i) =>
    i === index ? [half([from, name], left), half([name, to], right)] : [each],
  );
  const zones = roadmapOf(document).zones?.map((zone) => ({
    ...zone,
    ...(zone.edges && { edges: zone.edges.flatMap((ends) => throughVertex(ends, from, to, name)) }),
  }));
  const closures = document.closures?.flatMap((closure) =>
    closure.edge
      ? throughVertex(closure.edge, from, to, name).map((edge) => ({ ...closure, edge }))
      : [closure],
  );
  const added = addVertex(document, name, left[left.length - 1]);
  return withRoadmap(
    { ...added, ...(closures && { closures }) },
    { edges, ...(zones && { zones }) },
  );
}

/**
 * Both ways from one end of a lane to the other, by the vertex that was put on it.
 * @template Name
 * @param {Name[]} ends
 * @param {Name} from
 * @param {Name} to
 * @param {Name} name
 * @returns {[Name, Name][]}
 */
function throughVertex([a, b], from, to, name) {
  const isLane = (a === from && b === to) || (a === to && b === from);
  return isLane
    ? [
        [a, name],
        [name, b],
      ]
    : [[a, b]];
}

/**
 * A Bézier curve as two, up to a share of it and from there on (de Casteljau).
 * @param {Point[]} points
 * @param {number} share
 * @returns {[Point[], Point[]]}
 */
function halves(points, share) {
  /** @type {[Point[], Point[]]} */
  const [left, right] = [[], []];
  for (let rest = points; rest.length;) {
    left.push(rest[0]);
    right.unshift(rest[rest.length - 1]);
    rest = rest
      .slice(1)
      .map(([x, y], i) => [
        rest[i][0] + (x - rest[i][0]) * share,
        rest[i][1] + (y - rest[i][1]) * share,
      ]);
  }
  return [left, right];
}

/**
 * Take vertices away, with their lanes, stations and what else is there.
 * @param {ScenarioDocument} document
 * @param {string[]} names
 * @returns {ScenarioDocument}
 */
export function removeVertices(document, names) {
  const gone = new Set(names);
  const { vertices, stations = {}, parking = [], charging = [], zones = [] } = roadmapOf(document);
  /**
   * @param {Place} name
   * @returns {boolean}
   */
  const isLeft = (name) => typeof name !== "string" || !gone.has(name);
  /** @type {Partial<RoadmapData>} */
  const change = {
    vertices: Object.fromEntries(Object.entries(vertices).filter(([name]) => isLeft(name))),
    edges: lanesOf(document).filter((lane) => endsOf(lane).every(isLeft)),
  };
  if (Object.keys(stations).length)
    change.stations = Object.fromEntries(
      Object.entries(stations).filter(([, name]) => isLeft(name)),
    );
  if (parking.length) change.parking = parking.filter(isLeft);
  if (charging.length) change.charging = charging.filter(isLeft);
  if (zones.length)
    change.zones = zones
      .map((zone) => thinned(zone, isLeft))
      .filter(({ vertices: v, edges: e }) => v?.length || e?.length);
  const next = withRoadmap(document, change);
  if (!document.closures) return next;
  return {
    ...next,
    closures: document.closures.filter(({ at, edge }) =>
      [at, ...(edge ?? [])].every((place) => place === undefined || isLeft(place)),
    ),
  };
}

/**
 * @param {ZoneData} zone
 * @param {(name: string) => boolean} isLeft
 * @returns {ZoneData}
 */
function thinned(zone, isLeft) {
  const kept = { ...zone };
  if (zone.vertices) kept.vertices = zone.vertices.filter(isLeft);
  if (zone.edges) kept.edges = zone.edges.filter((ends) => ends.every(isLeft));
  return kept;
}

/**
 * Give a vertex another name, wherever it is named.
 * @param {ScenarioDocument} document
 * @param {string} before
 * @param {string} after
 * @returns {ScenarioDocument}
 */
export function renameVertex(document, before, after) {
  const { vertices, stations, parking, charging, zones } = roadmapOf(document);
  if (!after || after in vertices) return document;
  /**
   * @template Name
   * @param {Name} name
   * @returns {Name | string}
   */
  const named = (name) => (name === before ? after : name);
  /** @type {Partial<RoadmapData>} */
  const change = {
    vertices: Object.fromEntries(
      Object.entries(vertices).map(([name, vertex]) => [named(name), vertex]),
    ),
    edges: lanesOf(document).map((lane) =>
      Array.isArray(lane)
        ? /** @type {LaneData} */ ([named(lane[0]), named(lane[1]), ...lane.slice(2)])
        : { ...lane, from: named(lane.from), to: named(lane.to) },
    ),
  };
  if (stations)
    change.stations = Object.fromEntries(
      Object.entries(stations).map(([station, name]) => [station, named(name)]),
    );
  if (parking) change.parking = parking.map(named);
  if (charging) change.charging = charging.map(named);
  if (zones)
    change.zones = zones.map((zone) => ({
      ...zone,
      ...(zone.vertices && { vertices: zone.vertices.map(named) }),
      ...(zone.edges && { edges: zone.edges.map((ends) => ends.map(named)) }),
    }));
  const robots = Array.isArray(document.robots)
    ? document.robots.map((robot) => ({
        ...robot,
        ...(robot.home === before && { home: after }),
        ...(robot.target === before && { target: after }),
        ...(robot.stops && {
          stops: robot.stops.map((stop) => ({ ...stop, at: named(stop.at) })),
        }),
      }))
    : document.robots;
  const closures = document.closures?.map((closure) => ({
    ...closure,
    ...(closure.at && { at: named(closure.at) }),
    ...(closure.edge && { edge: closure.edge.map(named) }),
  }));
  return {
    ...withRoadmap({ ...document, robots }, change),
    ...(closures && { closures }),
  };
}

/**
 * Add a lane; nothing changes where there is one already.
 * @param {ScenarioDocument} document
 * @param {string} from
 * @param {string} to
 * @param {boolean} isBothWays
 * @returns {ScenarioDocument}
 */
export function addLane(document, from, to, isBothWays) {
  /**
   * @param {string} a
   * @param {string} b
   * @returns {boolean}
   */
  const has = (a, b) =>
    lanesOf(document).some((lane) => {
      const [tail, head] = endsOf(lane);
      const isBoth = asMapping(lane).both_ways ?? true;
      return (tail === a && head === b) || (isBoth && tail === b && head === a);
    });
  if (from === to || has(from, to)) return document;
  return withRoadmap(document, {
    edges: [...lanesOf(document), isBothWays ? [from, to] : { from, to, both_ways: false }],
  });
}

/**
 * @param {ScenarioDocument} document
 * @param {number[]} indices
 * @returns {ScenarioDocument}
 */
export function removeLanes(document, indices) {
  const gone = new Set(indices);
  return withRoadmap(document, { edges: lanesOf(document).filter((_, index) => !gone.has(index)) });
}

/**
 * Set a key of some lanes; undefined takes it away.
 * @template {keyof LaneMapping} Key
 * @param {ScenarioDocument} document
 * @param {number[]} indices
 * @param {Key} key
 * @param {LaneMapping[Key]} value
 * @returns {ScenarioDocument}
 */
export function changeLanes(document, indices, key, value) {
  const chosen = new Set(indices);
  const edges = lanesOf(document).map((lane, index) => {
    if (!chosen.has(index)) return lane;
    const mapping = withoutKey(asMapping(lane), key);
    return value === undefined ? mapping : { ...mapping, [key]: value };
  });
  return withRoadmap(document, { edges });
}

/**
 * Let a vertex be a place to park or to charge at, or none any more.
 * @param {ScenarioDocument} document
 * @param {"parking" | "charging"} key
 * @param {string} name
 * @returns {ScenarioDocument}
 */
export function toggleUse(document, key, name) {
  const known = roadmapOf(document)[key] ?? [];
  return withRoadmap(document, {
    [key]: known.includes(name) ? known.filter((other) => other !== name) : [...known, name],
  });
}

/**
 * Whether robots only drive through a vertex.
 * @param {ScenarioDocument} document
 * @param {string} name
 */
export function isPassed(document, name) {
  const vertex = roadmapOf(document).vertices[name];
  return Boolean(vertex) && !Array.isArray(vertex) && vertex.pass === true;
}

/**
 * Let robots only drive through a vertex, or stop there again.
 * @param {ScenarioDocument} document
 * @param {string} name
 * @returns {ScenarioDocument}
 */
export function togglePass(document, name) {
  const { vertices } = roadmapOf(document);
  const vertex = vertices[name];
  const mapping = Array.isArray(vertex) ? { at: vertex } : vertex;
  const open = withoutKey(mapping, "pass");
  const isShort = Object.keys(open).length === 1;
  const changed = isPassed(document, name)
    ? isShort
      ? open.at
      : open
    : { ...mapping, pass: true };
  return withRoadmap(document, { vertices: { ...vertices, [name]: changed } });
}

/**
 * The station at a vertex gets a name; an empty one takes it away.
 * @param {ScenarioDocument} document
 * @param {string} vertex
 * @param {string} station
 * @returns {ScenarioDocument}
 */
export function nameStation(document, vertex, station) {
  const others = Object.entries(roadmapOf(document).stations ?? {}).filter(
    ([, at]) => at !== vertex,
  );
  return withRoadmap(document, {
    stations: Object.fromEntries(station ? [...others, [station, vertex]] : others),
  });
}

/**
 * A zone of what is selected holds one robot at a time.
 * @param {ScenarioDocument} document
 * @param {string[]} vertices
 * @param {number[]} lanes
 * @returns {ScenarioDocument}
 */
export function addZone(document, vertices, lanes) {
  const zones = roadmapOf(document).zones ?? [];
  /** @type {(index: number) => [string, string][]} */
  const waysOf = (index) => {
    const [tail, head] = endsOf(lanesOf(document)[index]);
    return asMapping(lanesOf(document)[index]).both_ways === false
      ? [[tail, head]]
      : [
          [tail, head],
          [head, tail],
        ];
  };
  const edges = lanes.flatMap(waysOf);
  return withRoadmap(document, {
    zones: [...zones, { name: `zone ${zones.length + 1}`, vertices, edges }],
  });
}

/**
 * @param {ScenarioDocument} document
 * @param {number} index
 * @returns {ScenarioDocument}
 */
export function removeZone(document, index) {
  return withRoadmap(document, {
    zones: roadmapOf(document).zones?.filter((_, each) => each !== index),
  });
}
