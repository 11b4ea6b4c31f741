// Generated from model/robot.py and texts/en.json: change it there, then run `just types-refresh`.

/** Attributes of a robot other than its name and its trip, by key. */
export const ATTRIBUTES = /** @type {const} */ ({
  speed: {
    isText: false,
    title: "title of speed",
    hint: "hint of speed",
    usual: "1",
  },
  radius: {
    isText: false,
    title: "title of radius",
    hint: "hint of radius",
    usual: "–",
  },
  type: {
    isText: true,
    title: "title of type",
    hint: "hint of type",
    usual: "–",
  },
  turn: {
    isText: false,
    title: "title of turn",
    hint: "hint of turn",
    usual: "–",
  },
  return: {
    isText: true,
    title: "title of return",
    hint: "hint of return",
    usual: "–",
  },
  laps: {
    isText: false,
    title: "title of laps",
    hint: "hint of laps",
    usual: "–",
  },
  turn_rate: {
    isText: false,
    title: "title of turn_rate",
    hint: "hint of turn_rate",
    usual: "–",
  },
  weight: {
    isText: false,
    title: "title of weight",
    hint: "hint of weight",
    usual: "1",
  },
});
