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

const withRoadmap = (document, change) => ({
  ...document,
  map: { ...document.map, roadmap: { ...document.map.roadmap, ...change } },
});

const withoutKey = (mapping, key) =>
  Object.fromEntries(Object.entries(mapping).filter(([known]) => known !== key));

/** A name that no vertex has: V1, V2, ... */
export function freeVertexName({ map }, more = []) {
  let number = Object.keys(map.roadmap.vertices).length + 1;
  while (`V${number}` in map.roadmap.vertices || more.includes(`V${number}`)) number++;
  return `V${number}`;
}

export function addVertex(document, name, position) {
  return withRoadmap(document, {
    vertices: { ...document.map.roadmap.vertices, [name]: position.map(rounded) },
  });
}

/** Move vertices by a distance of the site; their lanes are as long as they are then. */
export function moveVertices(document, names, [right, up]) {
  const moved = new Set(names);
  const vertices = Object.fromEntries(
    Object.entries(document.map.roadmap.vertices).map(([name, vertex]) => {
      if (!moved.has(name)) return [name, vertex];
      const at = positionOf(vertex).map((length, i) => rounded(length + [right, up][i]));
      return [name, Array.isArray(vertex) ? at : { ...vertex, at }];
    }),
  );
  const edges = lanesOf(document).map((lane) => {
    if (!endsOf(lane).some((end) => moved.has(end))) return lane;
    return Array.isArray(lane) ? lane.slice(0, 2) : withoutKey(lane, "length");
  });
  return withRoadmap(document, { vertices, edges });
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
        ...(robot.stops && { stops: robot.stops.map((stop) => ({ ...stop, at: named(stop.at) })) }),
      }))
    : document.robots;
  const closures = document.closures?.map((closure) => ({
    ...closure,
    ...(closure.at && { at: named(closure.at) }),
    ...(closure.edge && { edge: closure.edge.map(named) }),
  }));
  return { ...withRoadmap({ ...document, robots }, change), ...(closures && { closures }) };
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

/** Close a place or a lane; the closure of the same one is lifted instead. */
export function toggleClosure(document, closure) {
  const closures = document.closures ?? [];
  const isSame = (other) =>
    JSON.stringify([other.at, other.edge]) === JSON.stringify([closure.at, closure.edge]);
  const rest = closures.filter((other) => !isSame(other));
  if (rest.length === closures.length) return { ...document, closures: [...closures, closure] };
  if (rest.length) return { ...document, closures: rest };
  return withoutKey(document, "closures");
}
