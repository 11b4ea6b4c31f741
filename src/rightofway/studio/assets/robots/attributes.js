// Generated from model/robot.py and texts/en.json: change it there, then run `just types-refresh`.

/** What a robot has beside its name and its trip, by its key in files. */
export const ATTRIBUTES = /** @type {const} */ ({
  speed: {
    isText: false,
    title: "Speed",
    hint: "Length units per time unit",
    usual: "1",
  },
  radius: {
    isText: false,
    title: "Radius",
    hint: "Radius of the circle that it needs",
    usual: "–",
  },
  type: {
    isText: true,
    title: "Type",
    hint: "Name of its type; lanes may be barred for types",
    usual: "–",
  },
  turn: {
    isText: false,
    title: "Turn",
    hint: "Time to turn at a stop, or cell",
    usual: "–",
  },
  return: {
    isText: true,
    title: "Return",
    hint: "home, or none: it stays at its last stop",
    usual: "–",
  },
  laps: {
    isText: false,
    title: "Laps",
    hint: "How often it makes its round trip",
    usual: "–",
  },
  turn_rate: {
    isText: false,
    title: "Turn rate",
    hint: "How fast it turns on the spot, in degrees per time unit",
    usual: "–",
  },
  weight: {
    isText: false,
    title: "Weight",
    hint: "How much its completion time counts beside the others",
    usual: "1",
  },
});
