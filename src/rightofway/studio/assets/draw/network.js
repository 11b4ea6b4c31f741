/** Roadmaps: vertices, lanes, stations, parking, zones and closures, as edits of a document. */

import { numberOf, rounded } from "./places.js";

/** Whether the map is a roadmap that is in the document; squares of adaptive cells are none to draw. */
export const isNetwork = ({ map }) => Boolean(map?.roadmap && !map.roadmap.sides);

export const lanesOf = ({ map }) => map.roadmap.edges;

/** Both ends of a lane, however it is written. */
export const endsOf = (lane) => (Array.isArray(lane) ? lane.slice(0, 2) : [lane.from, lane.to]);

/** A lane as a mapping. */
export function asMapping(lane) {
  if (!Array.isArray(lane)) return lane;
  const [from, to, length] = lane;
  return length === undefined ? { from, to } : { from, to, length };
}

/** Where a vertex is on the site, however it is written. */
export const positionOf = (vertex) =>
  (Array.isArray(vertex) ? vertex : vertex.at).map((length) => numberOf(length));

export const withRoadmap = (document, change) => ({
  ...document,
  map: { ...document.map, roadmap: { ...document.map.roadmap, ...change } },
});

export const withoutKey = (mapping, key) =>
  Object.fromEntries(Object.entries(mapping).filter(([known]) => known !== key));

/** A name that no vertex has: V1, V2, ... */
export function freeVertexName({ map }, more = []) {
  let number = Object.keys(map.roadmap.vertices).length + 1;
  while (`V${number}` in map.roadmap.vertices || more.includes(`V${number}`)) number++;
  return `V${number}`;
}

/** Add a vertex at a place of the site, with what a vertex may have beside its place. */
export function addVertex(document, name, position, { at: _, ...more } = {}) {
  const at = position.map(rounded);
  const vertex = Object.keys(more).length ? { at, ...more } : at;
  return withRoadmap(document, {
    vertices: { ...document.map.roadmap.vertices, [name]: vertex },
  });
}

/** The control points of a lane that is a curve, on the site; none for a straight one. */
export const controlsOf = (lane) =>
  (asMapping(lane).curve ?? []).map((point) => point.map((length) => numberOf(length)));

/** Where a Bézier curve is over; its ends are the first and the last point. */
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

/** Let a lane be a curve by its control points, or straight without any; it is as long as it is then. */
export function bendLane(document, index, controls) {
  const edges = lanesOf(document).map((lane, each) => {
    if (each !== index) return lane;
    const { curve, length, ...rest } = asMapping(lane);
    const isPlain = Object.keys(rest).length === 2;
    if (!controls.length) return isPlain ? [rest.from, rest.to] : rest;
    return { ...rest, curve: controls.map((point) => point.map(rounded)) };
  });
  return withRoadmap(document, { edges });
}

/** A lane whose ends are mapped to other places of the site; its curve goes with them. */
function carried(lane, [tail, head], [tailMoved, headMoved], map) {
  const curve = controlsOf(lane);
  if (!curve.length) return Array.isArray(lane) ? lane.slice(0, 2) : withoutKey(lane, "length");
  const shiftOf = (at, isMoved) => map(at).map((to, axis) => (isMoved ? to - at[axis] : 0));
  const [one, other] = [shiftOf(tail, tailMoved), shiftOf(head, headMoved)];
  const moved = curve.map((point, i) => {
    if (tailMoved && headMoved) return map(point).map(rounded);
    const share = (i + 1) / (curve.length + 1);
    return point.map((length, axis) =>
      rounded(length + one[axis] * (1 - share) + other[axis] * share),
    );
  });
  return { ...withoutKey(lane, "length"), curve: moved };
}

/** Map vertices to other places of the site; their lanes are as long as they are then. */
export function mapVertices(document, names, map) {
  const moved = new Set(names);
  const known = document.map.roadmap.vertices;
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

/** Put a vertex on a lane, which becomes two; halves of a curve are curves. */
export function splitLane(document, index, share, name) {
  const lane = asMapping(lanesOf(document)[index]);
  const { from, to, length, curve, ...rest } = lane;
  const [tail, head] = [from, to].map((end) => positionOf(document.map.roadmap.vertices[end]));
  const [left, right] = halves([tail, ...controlsOf(lane), head], share);
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
  const zones = document.map.roadmap.zones?.map((zone) => ({
    ...zone,
    ...(zone.edges && { edges: zone.edges.flatMap((ends) => throughVertex(ends, from, to, name)) }),
  }));
  const closures = document.closures?.flatMap((closure) =>
    closure.edge
      ? throughVertex(closure.edge, from, to, name).map((edge) => ({ ...closure, edge }))
      : [closure],
  );
  const added = addVertex(document, name, left.at(-1));
  return withRoadmap(
    { ...added, ...(closures && { closures }) },
    { edges, ...(zones && { zones }) },
  );
}

/** Both ways from one end of a lane to the other, by the vertex that was put on it. */
function throughVertex([a, b], from, to, name) {
  const isLane = (a === from && b === to) || (a === to && b === from);
  return isLane
    ? [
        [a, name],
        [name, b],
      ]
    : [[a, b]];
}

/** A Bézier curve as two, up to a share of it and from there on (de Casteljau). */
function halves(points, share) {
  const [left, right] = [[], []];
  for (let rest = points; rest.length;) {
    left.push(rest[0]);
    right.unshift(rest.at(-1));
    rest = rest
      .slice(1)
      .map(([x, y], i) => [
        rest[i][0] + (x - rest[i][0]) * share,
        rest[i][1] + (y - rest[i][1]) * share,
      ]);
  }
  return [left, right];
}

/** Take vertices away, with their lanes, stations and what else is there. */
export function removeVertices(document, names) {
  const gone = new Set(names);
  const { vertices, stations = {}, parking = [], charging = [], zones = [] } = document.map.roadmap;
  const isLeft = (name) => !gone.has(name);
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

function thinned(zone, isLeft) {
  const kept = { ...zone };
  if (zone.vertices) kept.vertices = zone.vertices.filter(isLeft);
  if (zone.edges) kept.edges = zone.edges.filter((ends) => ends.every(isLeft));
  return kept;
}

/** Give a vertex another name, wherever it is named. */
export function renameVertex(document, before, after) {
  const { vertices, stations, parking, charging, zones } = document.map.roadmap;
  if (!after || after in vertices) return document;
  const named = (name) => (name === before ? after : name);
  const change = {
    vertices: Object.fromEntries(
      Object.entries(vertices).map(([name, vertex]) => [named(name), vertex]),
    ),
    edges: lanesOf(document).map((lane) =>
      Array.isArray(lane)
        ? [named(lane[0]), named(lane[1]), ...lane.slice(2)]
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

/** Add a lane; nothing changes where there is one already. */
export function addLane(document, from, to, isBothWays) {
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

export function removeLanes(document, indices) {
  const gone = new Set(indices);
  return withRoadmap(document, { edges: lanesOf(document).filter((_, index) => !gone.has(index)) });
}

/** Set a key of some lanes; undefined takes it away. */
export function changeLanes(document, indices, key, value) {
  const chosen = new Set(indices);
  const edges = lanesOf(document).map((lane, index) => {
    if (!chosen.has(index)) return lane;
    const mapping = withoutKey(asMapping(lane), key);
    return value === undefined ? mapping : { ...mapping, [key]: value };
  });
  return withRoadmap(document, { edges });
}

/** Let a vertex be a place to park or to charge at, or none any more. */
export function toggleUse(document, key, name) {
  const known = document.map.roadmap[key] ?? [];
  return withRoadmap(document, {
    [key]: known.includes(name) ? known.filter((other) => other !== name) : [...known, name],
  });
}

/** The station at a vertex gets a name; an empty one takes it away. */
export function nameStation(document, vertex, station) {
  const others = Object.entries(document.map.roadmap.stations ?? {}).filter(
    ([, at]) => at !== vertex,
  );
  return withRoadmap(document, {
    stations: Object.fromEntries(station ? [...others, [station, vertex]] : others),
  });
}

/** A zone of what is selected holds one robot at a time. */
export function addZone(document, vertices, lanes) {
  const zones = document.map.roadmap.zones ?? [];
  const edges = lanes.flatMap((index) => {
    const [tail, head] = endsOf(lanesOf(document)[index]);
    return asMapping(lanesOf(document)[index]).both_ways === false
      ? [[tail, head]]
      : [
          [tail, head],
          [head, tail],
        ];
  });
  return withRoadmap(document, {
    zones: [...zones, { name: `zone ${zones.length + 1}`, vertices, edges }],
  });
}

export function removeZone(document, index) {
  return withRoadmap(document, {
    zones: document.map.roadmap.zones.filter((_, each) => each !== index),
  });
}
