import { counted } from "./plural.js";

/** @param {number} count */
const robots = (count) => counted(count, "robot", "robots");
/** @param {number} count */
const faults = (count) => counted(count, "fault", "faults");
/** @param {boolean} isHome */
const arrived = (isHome) => (isHome ? "home" : "done");

/** @typedef {typeof ENGLISH} Texts */

/** The texts of the viewer in English; where a text has values, it is a function of them. */
export const ENGLISH = {
  /** What stands in the markup. */
  markup: {
    details: "Details",
    made: "How this plan was made, and how good it is",
    link: "Copy link",
    linkAtLength: "Copy a link to this moment",
    picture: "Picture",
    pictureAtLength: "Save this moment as a picture",
    print: "Print",
    printAtLength: "Print this moment and a table of the robots",
    printFindings: "Print the map and all findings",
    language: "Language",
    map: "Map",
    timeHeld: "Time held",
    timeHeldAtLength: "How long robots hold each place, in all",
    states: "What the robots do now",
    mapView: "Map view",
    zoomIn: "Zoom in",
    zoomOut: "Zoom out",
    fit: "Fit the map",
    bottleneck: "Light the bottleneck",
    bottleneckAtLength: "Light the bottleneck: what keeps the period from being shorter",
    corridor: "Corridor of the diagram",
    corridorAtLength: "Corridor: the diagram along the way between two places",
    space: "What robots book",
    spaceAtLength:
      "Space: what each robot books now, the room that it needs, and how near the next one is",
    heat: "Heat map of use",
    heatAtLength: "Heat map: how long each vertex is held",
    time: "Time",
    show: "Show",
    plan: "Plan",
    planAtLength: "What was planned",
    floor: "Floor",
    floorAtLength: "What happened on the floor",
    both: "Both",
    bothAtLength: "What happened, and where the plan had it",
    loop: "Loop a period",
    speed: "Speed",
    keys: "Keys",
    back: "One tick back",
    play: "Play",
    playKey: "Play or pause (space)",
    forth: "One tick on",
    side: "Robots and decisions",
    robots: "Robots",
    decisions: "Decisions",
    faults: "Faults",
    compared: "Compared",
    findRobot: "Find a robot",
    sort: "Most delayed",
    sortAtLength: "Those that lose most time first",
    findPlace: "Find by robot or place",
    findDecision: "Find a decision",
    findFault: "Find a fault",
    findCompared: "Find a robot to compare",
    live: "Live",
    liveAtLength: "Show what robots do now",
    lost: "No connection to the control. What is shown is the last that is known; robots may do something else.",
    alarms: "Alarms",
    orders: "Orders to the robots",
    holdAll: "Hold all robots",
    goAll: "Let all robots go",
    holdOne: "Hold the robot",
    clearOne: "The robot is where it is shown",
    removeOne: "The robot is off the floor",
    placeOne: "The robot is on the floor again",
    orderAt: "Place",
    log: "Log",
    findTold: "Find in the log",
    yes: "Yes",
    cancel: "Cancel",
    close: "Close",
    level: "Level",
    findings: "Findings",
    findFinding: "Find a finding",
    findWord: "Find by place or word",
    spaceBar: "Space",
    shift: "Shift",
    home: "Home",
    end: "End",
    toTheMap: "to the map, arrows",
    keyPlay: "play or pause",
    keyStep: "one tick back or on",
    keyEvent: "to the last or next event (of the chosen robot)",
    keyEnds: "to the start, to the end",
    keyRate: "slower, faster",
    keyZoom: "zoom in, out, fit",
    keyPan: "pan",
    keyHeat: "heat map",
    keyCorridor: "diagram along a corridor: press its two ends",
    keySpace: "space: what robots book, and the room that they need",
    keyLoop: "play one period for ever",
    keyBottleneck: "light the bottleneck",
    keyMode: "plan, floor, or both",
    keyFind: "find a robot",
    keyEscape: "choose nothing",
  },

  /** The decimal point, and how both coordinates of a point are written, in one line. */

  point: ".",
  /** @type {(x: string, y: string) => string} */
  pair: (x, y) => `${x},\u00a0${y}`,

  /** Quantities without a unit. */

  /** @param {number | string} number */
  timeUnits: (number) => counted(number, "time unit", "time units"),
  /** @param {number | string} number */
  lengthUnits: (number) => counted(number, "length unit", "length units"),
  timeUnit: "time unit",
  /** @param {string} number */
  moment: (number) => `time ${number}`,

  /** Lists and small words. */
  and: "and",
  /** @param {number} count */
  more: (count) => `${count} more`,
  /** @param {number} count */
  andMore: (count) => `and ${count} more`,
  never: "never",
  none: "none",
  /** @param {string} moment */
  at: (moment) => `at ${moment}`,
  /** @param {string} from @param {string} to */
  fromTo: (from, to) => `${from} to ${to}`,
  robots,
  faults,

  /** What a robot does, in the order of phases.js. */
  activities: ["driving", "waiting", "working", "turning", "done", "held up", "broken down"],
  stuck: "stuck",
  byPlan: "by plan",

  /** The head of the page. */

  /** @param {string} one @param {string} other */
  twoTitles: (one, other) => `${one} and ${other}`,
  noPlan: "no plan exists",
  /** @param {number} count */
  doNotRun: (count) => `${faults(count)}: do not run this plan`,
  /** @param {string} title @param {number} count */
  doNotRunOther: (title, count) => `${title} has ${faults(count)}: do not run it`,
  /** @param {number} count @param {boolean} isHome */
  neverArrived: (count, isHome) => `${count} of them never ${arrived(isHome)}`,
  /** @param {number} count */
  stuckForEver: (count) => `${count} of them stuck for ever`,
  /** @param {number} count */
  someRepeat: (count) => `${count} of them known to repeat themselves`,
  /** @param {number} count */
  groupsRepeat: (count) => `in ${count} groups that repeat themselves`,
  /** @param {boolean} isHome */
  allAt: (isHome) => `All ${arrived(isHome)} at`,
  /** @param {boolean} isHome */
  allAtLength: (isHome) => `When the last robot is ${arrived(isHome)}`,
  /** @param {boolean} isHome */
  allWasAtLength: (isHome) => `When the last robot was ${arrived(isHome)}`,
  /** @param {boolean} isHome */
  allBothAtLength: (isHome) => `When the last robot is ${arrived(isHome)}, in both plans`,
  latest: "Latest",
  /** @param {boolean} isHome */
  latestAtLength: (isHome) => `The robot that is ${arrived(isHome)} last`,
  timeLost: "Time lost",
  timeLostAtLength: "How much later the robots arrive, all together, than if each drove alone",
  losesMost: "Loses most",
  losesMostAtLength: "The robot that loses most time to others",
  lost: { waiting: "waiting", detours: "detours", makingRoom: "making room" },
  earlier: "Earlier",
  /** @param {string} title */
  earlierAtLength: (title) => `Robots that arrive earlier in ${title}`,
  later: "Later",
  /** @param {string} title */
  laterAtLength: (title) => `Robots that arrive later in ${title}`,
  /** @param {boolean} isLargest */
  repeatsEvery: (isLargest) => `Repeats every${isLargest ? " (largest group)" : ""}`,
  repeatsEveryAtLength: "The period: the time after which all visits repeat",
  from: "From",
  fromAtLength: "The transient: how long it takes until everything repeats",
  lapsInThat: "Laps in that time",
  lapsInThatAtLength: "Laps that all robots together make in a period",
  late: "Late",
  /** @param {number} count @param {number} all */
  lateOf: (count, all) => `${count} of ${all}`,
  lateAtLength: "Robots that arrived later than planned, or never",
  latestBy: "Latest by",
  latestByAtLength: "The largest delay of a robot that arrived",
  /** @param {string} time */
  asPlanned: (time) => `${time}, as planned`,
  /** @param {string} time @param {string} planned */
  insteadOf: (time, planned) => `${time} instead of ${planned}`,

  /** How the plan was made. */

  planner: "Planner",
  method: "Method",
  proven: "Proven",
  flowtime: "flowtime",
  lowerBound: "lower bound",
  gap: "Gap",
  makespan: "makespan",
  tick: "Tick",
  /** @param {string} time */
  tickAtLength: (time) => `${time}, the step in which times are counted`,
  explanation: [
    "The flowtime is the sum of the times at which the robots are done. No plan has a flowtime below the lower " +
      "bound, which is proven: by the sum of the robots that drive alone, or by a search. The gap is how far the flowtime of this plan is above the lower bound.",
    "The makespan is the time at which the last robot is done.",
  ],

  /** The card of a robot, a decision or a fault. */
  chooseNothing: "Choose nothing",
  /** @param {string} title */
  inPlan: (title) => `In ${title}`,
  speed: "Speed",
  radius: "Radius",
  home: "Home",
  anotherWay: "Another way",
  trip: "Trip",
  closest: "Closest approaches",
  closestOfAll: "Closest approach:",
  /** @param {string} distance @param {string} needed */
  apart: (distance, needed) => `${distance} apart, ${needed} needed`,
  detours: "Detours",
  makingRoom: "Making room",
  waiting: "Waiting",
  alone: "Alone",
  /** @type {(isHome: boolean) => string} */
  doneAt: (isHome) => (isHome ? "Home at" : "Done at"),
  losesNothing: "It loses no time.",
  planned: "Planned",
  heldUp: "Held up",
  waits: "Waits",
  /** @param {string} time */
  inAll: (time) => `${time} in all`,
  breaksDown: "Breaks down",
  done: "Done",
  repeats: "Repeats",
  notShown: "not within what is shown",
  /** @param {number} laps @param {string} period @param {string} start */
  lapsEvery: (laps, period, start) =>
    `${counted(laps, "lap", "laps")} every ${period}, from ${start} on`,
  /** @param {string} time */
  works: (time) => `works ${time}`,
  /** @param {string} time */
  turns: (time) => `turns ${time}`,
  losesTime: "Loses time",
  whyNoneIsBetter: "Why no plan is better",
  inEveryPlan: "In every plan",
  inThisPlan: "in this plan",
  /** @param {string} kind */
  theFault: (kind) => `the fault (${kind})`,
  ifItWaits: "If it waits",

  /** How a robot is late. */
  /** @param {string} name @param {boolean} isBroken */
  stuckBehind: (name, isBroken) =>
    `never: stuck behind ${name}${isBroken ? ", which breaks down" : ""}`,
  lateness: {
    elsewhere: "another way",
    onTime: "on time",
    /** @param {string} time */
    late: (time) => `${time} late`,
    /** @param {string} time */
    early: (time) => `${time} early`,
  },

  /** A fleet that is driven. */
  driven: {
    isLive: "now",
    lookingBack: "looking back",
    recorded: "recorded",
    ended: "the control has ended",
    disconnected: "no connection; trying again",
    nothingTold: "Nothing has happened yet.",
    /** @param {string} names */
    waitsFor: (names) => `waits for ${names}`,
    held: "held by a person",
    off: "off the floor",
    waiting: "Waits",
    since: "Since",
    releasedTerm: "Released",
    horizon: "Planned next",
    nothing: "nothing",
    operator: "Operator",
    alarm: "Alarm",
    alarmed: "alarm",
    still: "not moving",
    unknown: "unknown",
    notYet: "to come",
    /** @param {string} name */
    holdOne: (name) => `Hold ${name}`,
    /** @param {string} name */
    goOne: (name) => `Let ${name} go`,
    /** @param {string} name */
    clearOne: (name) => `${name} is where it is shown`,
    /** @param {string} name */
    removeOne: (name) => `${name} is off the floor`,
    goAllAsked: "Let all robots go? Those that were held go on.",
    /** @param {string} name */
    clearAsked: (name) =>
      `Is ${name} at the place where it is shown? It goes on from there, and others rely on it.`,
    /** @param {string} name */
    removeAsked: (name) =>
      `Is ${name} off the floor? Others drive through the places that it held.`,
    /** @param {string} name */
    placeOne: (name) => `${name} is on the floor again`,
    /** @param {string} name */
    placeAsked: (name) =>
      `Where is ${name} on the floor again? Without a name of a place, where it says that it is.`,
    asked: "asked…",
    carriedOut: "carried out",
    /** @param {string} reason */
    refused: (reason) => `refused: ${reason}`,
  },

  /** Between plans. */
  compared: {
    /** @param {number} count */
    plans: (count) => counted(count, "plan", "plans"),
    /** @param {string} title */
    mapOf: (title) => `Map of ${title}`,
    /** @param {string} title */
    compareWith: (title) => `Compare the others with ${title}`,
    figures: {
      faults: "Faults",
      planner: "Planner",
      flowtime: "Flowtime",
      makespan: "Makespan",
      lower_bound: "Lower bound",
      gap: "Gap",
      seconds: "Planned in",
      seed: "Seed",
      robots: "Robots",
    },
    terms: {
      flowtime: "Flowtime: the sum of the times at which the robots are done",
      makespan: "Makespan: when the last robot is done",
      lower_bound: "Lower bound of the flowtime, as far as proven: no plan is below it",
      gap: "Gap: how far the flowtime is above the lower bound",
    },
    isBest: "the best",
    /** @param {string} title @param {string} base */
    changes: (title, base) => `${title} beside ${base}`,
    isMissing: "not there",
    whats: { map: "map", rules: "rules" },
    keys: {
      added: "added",
      removed: "removed",
      changed: "changed",
      closed: "closed",
      open: "open",
      home: "home",
      stops: "stops",
      work: "work",
      speed: "speed",
      radius: "radius",
      turn: "turn",
      ends: "ends",
      laps: "laps",
      type: "type",
      headway: "headway",
      clearance: "clearance",
    },
    /** @param {string} title */
    sortBy: (title) => `Sort by ${title}: largest change first`,
    sortByName: "Sort by name",
    firstAllAtLength: "The plan whose last robot arrives first",
    least: "Least flowtime",
    leastAtLength: "The plan with the smallest sum of the times of all robots",
  },
  /** @param {string} time */
  isEarlier: (time) => `${time} earlier`,
  /** @param {string} time */
  isLater: (time) => `${time} later`,
  same: "the same",
  /** @param {boolean} isHome @param {string} time */
  allArrived: (isHome, time) => `all ${arrived(isHome)} at ${time}`,

  /** Which robot goes first, and why. */
  noDecisionFits: "No decision fits that.",
  noDecisions:
    "This plan keeps no decisions: a search makes none. Choose a robot: its card lists its waits. The studio shows what follows if the other robot goes first.",
  noneNeeded: "No decision was needed: no robot loses time to another.",
  /** @param {string} name */
  rerouted: (name) => `${name} was sent another way`,

  noFaultFits: "No fault fits that.",
  noFaults: "The plan keeps every rule.",
  /** @param {number} count */
  findAmong: (count) => `Find among the first ${count}`,
  noRobotNamed: "No robot has that name.",

  /** The list of robots. */

  /** @param {boolean} isHome @param {string} moment @param {string} alone */
  doneAloneAt: (isHome, moment, alone) =>
    `${isHome ? "Home" : "Done"} at ${moment}, alone at ${alone}`,
  /** @param {number} number */
  lap: (number) => `lap ${number}`,

  /** Below the pointer. */

  /** @param {string} activity @param {string} place */
  doesTo: (activity, place) => `${activity} to ${place}`,
  /** @param {string} activity @param {string} place */
  doesIn: (activity, place) => `${activity} in ${place}`,
  /** @param {string} moment */
  since: (moment) => `since ${moment}`,
  /** @param {string} name */
  zone: (name) => `zone ${name}`,
  /** @param {string} name @param {string} robot */
  zoneHeldBy: (name, robot) => `zone ${name}, held by ${robot}`,
  /** @param {string} name */
  stays: (name) => `${name} stays`,
  /** @param {string} name @param {string} moment */
  until: (name, moment) => `${name} until ${moment}`,
  /** @param {string} name @param {string} moment */
  next: (name, moment) => `next ${name}, at ${moment}`,
  /** @param {string} time */
  heldFor: (time) => `held for ${time} in all`,
  /** @param {string} names */
  homeOf: (names) => `home of ${names}`,
  /** @param {string} names */
  stopOf: (names) => `stop of ${names}`,
  station: "station",
  /** @param {string} name */
  stationNamed: (name) => `station ${name}`,
  parking: "parking",
  charging: "charging",
  passed: "driven through only",
  closed: "closed",

  /** Around the map. */

  /** @param {number} count */
  vertices: (count) => `${count} vertices`,
  /** @param {string} what */
  mapOf: (what) => `Map with ${what}`,
  /** @param {string} speed */
  usualLimit: (speed) => `speed limit ${speed} without a sign`,

  /** Time and its diagram. */
  pause: "Pause",
  /** @param {string} time @param {string} all */
  of: (time, all) => [time, ` of ${all}`],
  /** @param {string} unit */
  rate: (unit) => `1 × plays 1 ${unit} of the plan in a second`,
  loopAtLength: "Play one period for ever",
  noLoop: "The plan ends before a whole period does",
  transient: "transient",
  /** @param {string} time */
  every: (time) => `every ${time}`,
  /** @param {string} time */
  period: (time) => [`period 1: ${time}`, "period 1", "1"],
  rows: {
    title: "Robots over time: lines drive, frames wait, blocks work or turn",
    floor: "Robots over time; red: held up, orange: waits for a late robot",
    /** @param {boolean} isEndOnly */
    grey: (isEndOnly) => `, grey: ${isEndOnly ? "done in " : ""}the plan`,
  },
  /** @param {number} count */
  census: (count) => `What the ${count} robots do over time`,
  /** @param {string} title */
  censusBeside: (title) => `${title}; the line: how many are out in the plan`,
  placeOverTime: "Place over time",
  /** @param {string} name @param {string} length */
  routeOf: (name, length) => `Route of ${name}, ${length}`,
  /** @param {string} from @param {string} to @param {string} length */
  wayBetween: (from, to, length) => `${from} to ${to}, ${length}`,
  signs: {
    /** @param {string} names */
    decision: (names) => `${names}, fields are bookings`,
    route: "slopes are speeds, fields bookings",
    fleet: "lines are robots, fields their bookings",
    floor: "stripes: held up, orange: waits for a late robot",
    thin: "thin lines: the plan",
  },
  corridorBegins: "Corridor: press the place on the map where it begins",
  /** @param {string} place */
  corridorEnds: (place) => `Corridor from ${place}: press the place where it ends`,

  /** To take along: links, pictures, paper. */
  copied: "Copied",
  copyThis: "Copy this link",
  /** @param {string} title @param {string} time */
  pictureName: (title, time) => `${title || "plan"} at ${time}`,
  /** @param {string} moment @param {string} end */
  mapAt: (moment, end) => `The map at ${moment} of ${end}.`,
  robot: "Robot",
  /** @param {number} count @param {string} what */
  andMoreThat: (count, what) => `and ${count} more, ${what}`,
  loseLess: "which lose less",
  differLess: "which differ less",
  /** @param {string} term @param {string} title */
  headOf: (term, title) => `${term}, ${title}`,

  /** An inspection. */
  noFindingFits: "No finding fits that.",
  noFindings: "Nothing was found that will hurt.",
  /** @param {number} count */
  readerNotes: (count) =>
    `${counted(count, "note", "notes")} of the reader: what was mended or left out`,
  severities: { error: "error", warning: "warning", note: "note" },
  findingKinds: {
    trip: "trip",
    trap: "trap",
    unreachable: "unreachable",
    "cut off": "cut off",
    "too near": "too near",
    crossing: "crossing",
    "through way": "through way",
    corridor: "corridor",
    bottleneck: "bottleneck",
  },
};
