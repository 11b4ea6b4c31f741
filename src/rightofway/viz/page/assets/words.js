import { BROKEN } from "./phases.js";
import { FOLLOWS, MAKES_ROOM } from "./robot.js";

export const ACTIVITY_WORDS = [
  "driving",
  "waiting",
  "working",
  "turning",
  "done",
  "held up",
  "broken down",
];

/** "R1, R2 and R3"; the first few of many. */
export function several(names) {
  if (names.length > 4) return `${names.slice(0, 3).join(", ")} and ${names.length - 3} more`;
  return names.length > 1 ? `${names.slice(0, -1).join(", ")} and ${names.at(-1)}` : names[0];
}

/** Whether both choices of a decision cost the same. */
function isTie({ level, completionSums }) {
  return level === "robot" && completionSums !== null && completionSums[0] === completionSums[1];
}

const EQUAL_CONFLICTS = "either choice leaves as many conflicts in the whole system";

/** A length without the noise of floating point. */
function rounded(length) {
  return Number(length.toPrecision(9));
}

export function upperFirst(text) {
  return text[0].toUpperCase() + text.slice(1);
}

/** Durations as people write them, names, and sentences made of them. */
export class Words {
  constructor(plan) {
    this.plan = plan;
  }

  robot(index) {
    return this.plan.robots[index].name;
  }

  vertex(vertex) {
    return this.plan.roadmap.name(vertex);
  }

  /** A time where there is little room: "6 min 23 s"; a bare number where no unit is known. */
  time(ticks) {
    return this.plan.quantities.short(ticks);
  }

  /** How long something lasts, in a sentence: "6 min 23 s", "2 time units". */
  duration(ticks) {
    return this.plan.quantities.duration(ticks);
  }

  /** A point in time, in a sentence: "6 min 23 s", "time 2". */
  moment(ticks) {
    return this.plan.quantities.moment(ticks);
  }

  /** A share in per cent, with as many places as help. */
  percent(share) {
    const percent = 100 * share;
    return `${percent && percent < 9.95 ? percent.toFixed(1) : Math.round(percent)} %`;
  }

  /** How a robot loses time, and on the floor how much more than planned. */
  loss(loss, robot) {
    const more = robot.planned ? robot.unplanned(loss) : 0;
    return more > 0
      ? `${this.#loss(loss)}, ${this.time(more)} more than planned`
      : this.#loss(loss);
  }

  /** How far two robots are apart, and how far they have to be: "0.95 m apart, 0.9 m needed". */
  apart({ distance, room }) {
    const { quantities } = this.plan;
    return `${quantities.length(rounded(distance))} apart, ${quantities.length(rounded(room))} needed`;
  }

  /** When a place is closed. */
  closure({ from, until, vertices }) {
    const what =
      vertices.length > 1
        ? `${this.vertex(vertices[0])} to ${this.vertex(vertices.at(-1))} closed`
        : "closed";
    return `${what} from ${this.moment(from)} ${until === Infinity ? "on" : `until ${this.moment(until)}`}`;
  }

  /** Why a robot never gets on. */
  stuck(behind) {
    if (!behind) return "never";
    return `never: stuck behind ${behind.name}${behind.ending === BROKEN ? ", which breaks down" : ""}`;
  }

  #loss({ kind, forRobot, vertex, until, towards, freed, ticks }) {
    const [here, lasts] = [this.vertex(vertex), this.duration(ticks)];
    const other = forRobot === null ? null : this.robot(forRobot);
    if (kind === MAKES_ROOM)
      return `leaves ${here}${other ? ` to make room for ${other}` : ""} and comes back, loses ${lasts}`;
    if (kind === FOLLOWS)
      return `follows ${other} from ${here} to ${this.vertex(until)}, loses ${lasts}`;
    if (other === null) return `waits ${lasts} in ${here}, though no robot is in its way`;
    const ahead = freed === towards ? "" : ", further on its way";
    return `waits ${lasts} in ${here} for ${other} to leave ${this.vertex(freed)}${ahead}`;
  }

  /** How late a robot is. */
  lateness(ticks) {
    if (ticks === null) return "another way";
    if (!ticks) return "on time";
    return ticks > 0 ? `${this.time(ticks)} late` : `${this.time(-ticks)} early`;
  }

  /** What keeps a group from repeating itself sooner, in a line. */
  bottleneck({ circuit, period }) {
    const names = [...new Set(circuit.map(({ robot }) => robot.name))];
    const alone = names.length === 1 ? " alone, which waits for no robot" : "";
    return `Bottleneck: ${several(names)}${alone}, ${this.time(period)} a period`;
  }

  /** The same with its places. */
  bottleneckAtLength(group) {
    const steps = group.circuit.map(
      ({ robot, vertex }) => `${robot.name} in ${this.vertex(vertex)}`,
    );
    return (
      `${this.bottleneck(group)}. Each of these visits begins as soon as the one before allows, ` +
      `the first again a period later: ${steps.join(", ")}`
    );
  }

  /** What is wrong, in a sentence. */
  fault({ kind, robots, vertices, reason }) {
    if (reason) return reason.replace(/ \([^()]*\)$/, "");
    const names = robots.map((robot) => this.robot(robot));
    const places = vertices.map((vertex) => this.vertex(vertex));
    const [who, where] = [several(names), several(places) ?? "a place that is not on the map"];
    switch (kind) {
      case "vertex conflict":
        return `${who} are both in ${where}`;
      case "too close":
        return `${who} come nearer than their sizes allow, ${where}`;
      case "space conflict":
        return `${who} book places that are too near to each other, ${where}`;
      case "zone conflict":
        return `${who} are both in one zone, ${where}`;
      case "headway":
        return `${who} come to ${where} too soon after each other`;
      case "swap conflict":
        return `${who} drive through each other between ${where}`;
      case "rotation":
        return `${who} move round ${where} all at once`;
      case "jump":
        return `${who} jumps from ${places[0]} to ${places[1] ?? "nowhere"}`;
      case "too fast":
        return `${who} drives from ${places[0]} to ${places[1]} faster than it can`;
      case "turn cut short":
        return `${who} turns at ${places[0]} faster than it can`;
      case "work cut short":
        return `${who} leaves ${where} before its work there is done`;
      case "stop missed":
        return `${who} does not come to its stop ${where}`;
      case "wrong home":
        return `${who} does not start at its home: it starts in ${where}`;
      case "wrong end":
        return `${who} does not end where its trip ends: it ends in ${where}`;
      case "backwards":
        return `${who} leaves ${where} before it comes there`;
      default:
        return `${who}: ${kind}, ${where}`;
    }
  }

  /** What would be right, in a sentence. */
  remedy({ kind, reason }) {
    const [, advice] = reason?.match(/ \(([^()]*)\)$/) ?? [];
    if (advice) return `${advice[0].toUpperCase()}${advice.slice(1)}.`;
    return (
      {
        "vertex conflict": "A place holds one robot: let one come when the other has left.",
        headway: "Let the second robot come later: the rules ask for a headway.",
        "swap conflict":
          "Two robots cannot exchange their places: let one wait aside until the other is by.",
        rotation: "The rules forbid rotations: let one wait until its place is empty.",
        jump: "No way joins these two places.",
        "too fast": "Let the drive take as long as the robot needs.",
        "turn cut short": "Let it stay until it has turned.",
        "work cut short": "Let it stay until its work and turning are done.",
        "stop missed": "Let it visit its stops in their order.",
        "wrong home": "Let it start at its home at time 0.",
        "wrong end": "Let it end where its trip ends.",
      }[kind] ?? ""
    );
  }

  /** Where two robots would have met. */
  place(decision) {
    const names = decision.vertices.map((vertex) => this.vertex(vertex));
    return names.length === 1 ? names[0] : `${names[0]} to ${names.at(-1)}`;
  }

  /** The robot that goes first. */
  first(decision) {
    return decision.robots[0] === decision.waits ? decision.robots[1] : decision.robots[0];
  }

  /** Who waits for whom, in a line. */
  decision(decision) {
    const [waits, first] = [this.robot(decision.waits), this.robot(this.first(decision))];
    switch (decision.kind) {
      case "head-on":
        return `${waits} waits for ${first}, head-on, ${this.place(decision)}`;
      case "following":
        return `${waits} follows ${first}, ${this.place(decision)}`;
      default:
        return `${waits} waits for ${first}, ${this.place(decision)}`;
    }
  }

  /** What the robot that waits loses by a decision, in few words. */
  cost(decision) {
    return decision.ticks ? `${this.duration(decision.ticks)} later` : "no time lost";
  }

  /** Why a decision was taken, in few words. */
  why(decision) {
    if (isTie(decision)) return "a tie: either choice costs the same";
    return {
      node: "fewer conflicts left",
      robot: "both done sooner in all",
      settled: "the other one is settled",
      priority: "by priority",
      only: "the only way",
    }[decision.level];
  }

  /** The same in whole sentences. */
  decisionAtLength(decision) {
    const [i, j] = decision.robots.map((robot) => this.robot(robot));
    const meeting = this.#meeting(decision, i, j);
    const waits = this.robot(decision.waits);
    const how = decision.ticks
      ? `waits ${this.duration(decision.ticks)} in ${this.vertex(decision.waitsAt)}`
      : `gives way in ${this.vertex(decision.waitsAt)}, at no loss`;
    return `${meeting} ${waits} ${how} and lets ${this.robot(this.first(decision))} go first.`;
  }

  #meeting(decision, i, j) {
    const place = this.place(decision);
    switch (decision.kind) {
      case "head-on":
        return `${i} and ${j} would have met head-on on the way from ${place}.`;
      case "following":
        return `${i} and ${j} go the same way from ${place} and cannot overtake.`;
      case "crossing":
        return `${i} and ${j} would have come too near to each other: ${this.robot(this.first(decision))} drives from ${place}.`;
      default:
        return `${i} and ${j} would both have been in ${place}.`;
    }
  }

  /** Why that one waits. */
  reason(decision) {
    const waits = this.robot(decision.waits);
    const first = this.robot(this.first(decision));
    switch (decision.level) {
      case "node":
        return `${waits} waits because that leaves fewer conflicts in the whole system.`;
      case "settled":
        return `${first} cannot wait: it would then meet robots that are settled already.`;
      case "priority":
        return `${waits} waits because ${first} has the higher priority.`;
      case "only":
        return `${first} cannot wait: that was impossible.`;
      default:
        return isTie(decision)
          ? `A tie: ${EQUAL_CONFLICTS}, and the completion times add up to the same. Then the first of the two waits.`
          : `${upperFirst(EQUAL_CONFLICTS)}, so the smaller sum of completion times decides.`;
    }
  }

  /** What both choices lead to: a label, and a figure for each robot if it is the one that waits. */
  figures(decision) {
    const rows = [];
    if (decision.conflictsLeft.some((count) => count !== null)) {
      rows.push([
        "Conflicts left",
        ...decision.conflictsLeft.map((count) => count ?? "impossible"),
      ]);
    }
    if (decision.completionSums) {
      const sums = decision.completionSums.map((sum) => (sum === null ? "no way" : this.time(sum)));
      rows.push(["Sum of completion times", ...sums]);
    }
    return rows;
  }
}
