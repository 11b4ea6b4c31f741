/** Passes events of runs on to the functions that this page has registered for one run, or for all runs. */

import { get } from "./api.js";
import { connection } from "./connection.js";
import { hear, KnownRuns } from "./hear.js";
/** @import { Events } from "./api_types.js" */
/** @import { EventPair, Hearer, Tell } from "./types.js" */

const known = new KnownRuns();
/** @type {Map<number, Set<Hearer>>} */
const heard = new Map(); // the hearers of each run that is not over
/** @type {Hearer} */
let listener = {}; // hears of all runs
let isShared = "SharedWorker" in globalThis;
/** @type {EventSource | null} */
let stream = null; // of this page, where the browser shares none

/**
 * Hear of all runs, also those of other pages: `{ runs, run, deleted }` are functions; resolves when `runs`
 * has been called, with the list. A browser that cannot share a connection among its pages hears only
 * while a run of this page goes on.
 * @param {Hearer} hearer
 * @returns {Promise<void>}
 */
export async function listenToAll(hearer) {
  /** @type {Hearer} */
  listener = hearer;
  if (isShared) await connect();
  connection.on("back", () => void (isShared || hearAgain()));
  if (!isShared) return tell("runs", await get("/runs"));
  addEventListener("pageshow", ({ persisted }) => persisted && connect()); // it had been left
}

/**
 * Hear of a run until it is over: `{ run, progress, plan }` are functions.
 * @param {number} number
 * @param {Hearer} hearer
 * @returns {void}
 */
export function listen(number, hearer) {
  if (!heard.has(number)) heard.set(number, new Set());
  heard.get(number)?.add(hearer);
  if (!isShared) stream ??= hear(tell, lost);
  const run = known.byNumber?.get(number);
  if (run) tellHearers("run", run); // it may be over already
}

/**
 * Have what the worker hears; resolves when that is the list of runs, or nothing.
 * @returns {Promise<void>}
 */
function connect() {
  return new Promise((resolve) => {
    const worker = new SharedWorker(new URL("./stream.js", import.meta.url), { type: "module" });
    const doWithout = () => {
      isShared = false;
      if (heard.size) stream ??= hear(tell, lost);
      resolve();
    };
    worker.onerror = doWithout; // older browsers share no modules
    const { port } = worker;
    port.onmessage = ({ data: [name, data] }) => {
      if (name === "lost") return lost();
      if (name === "refused") return doWithout();
      tell(name, data);
      if (name === "runs") resolve();
    };
    addEventListener("pagehide", () => port.postMessage("bye"), { once: true });
  });
}

/** Without a shared connection: the stream of before may have ended for good. */
async function hearAgain() {
  stream?.close();
  stream = heard.size ? hear(tell, lost) : null;
  tell("runs", await get("/runs"));
}

const lost = () => void connection.ask();

/** @type {Tell} */
const tell = (...event) => {
  known.take(...event);
  const [name, data] = event;
  pass(listener, event);
  if (name === "runs") for (const run of data.runs) tellHearers("run", run);
  else tellHearers(...event);
};

/** @type {Tell} */
const tellHearers = (...event) => {
  const [name, data] = event;
  if (name === "runs") return;
  for (const hearer of heard.get(data.number) ?? []) pass(hearer, event);
  const isOver = name === "run" && !["queued", "running"].includes(data.state);
  if (isOver || name === "deleted") forget(data.number);
};

/**
 * Let somebody hear of an event.
 * @param {Hearer} hearer
 * @param {EventPair} event
 * @returns {void}
 */
function pass(hearer, [name, data]) {
  const told = /** @type {((data: Events[keyof Events]) => void) | undefined} */ (hearer[name]);
  told?.(data);
}

/**
 * @param {number} number
 * @returns {void}
 */
function forget(number) {
  heard.delete(number);
  if (heard.size) return;
  stream?.close();
  stream = null;
}
