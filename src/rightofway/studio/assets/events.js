/** Passes events of runs on to the functions that this page has registered for one run, or for all runs. */

import { get } from "./api.js";
import { hear, KnownRuns } from "./hear.js";

const known = new KnownRuns();
const heard = new Map(); // the hearers of each run that is not over
let listener = {}; // hears of all runs
let isShared = "SharedWorker" in globalThis;
let stream = null; // of this page, where the browser shares none

/**
 * Hear of all runs, also those of other pages: `{ runs, run, deleted }` are functions; resolves when `runs`
 * has been called, with the list. A browser that cannot share a connection among its pages hears only
 * while a run of this page goes on.
 */
export async function listenToAll(hearer) {
  listener = hearer;
  if (isShared) await connect();
  if (!isShared) return tell("runs", await get("/runs"));
  addEventListener("pageshow", ({ persisted }) => persisted && connect()); // it had been left
}

/** Hear of a run until it is over: `{ run, progress, plan }` are functions. */
export function listen(number, hearer) {
  if (!heard.has(number)) heard.set(number, new Set());
  heard.get(number).add(hearer);
  if (!isShared) stream ??= hear(tell);
  const run = known.byNumber?.get(number);
  if (run) tellHearers("run", run); // it may be over already
}

/** Have what the worker hears; resolves when that is the list of runs, or nothing. */
function connect() {
  return new Promise((resolve) => {
    const worker = new SharedWorker(new URL("./stream.js", import.meta.url), { type: "module" });
    const doWithout = () => {
      isShared = false;
      if (heard.size) stream ??= hear(tell);
      resolve();
    };
    worker.onerror = doWithout; // older browsers share no modules
    const { port } = worker;
    port.onmessage = ({ data: [name, data] }) => {
      if (name === "refused") return doWithout();
      tell(name, data);
      if (name === "runs") resolve();
    };
    addEventListener("pagehide", () => port.postMessage("bye"), { once: true });
  });
}

function tell(name, data) {
  known.take(name, data);
  listener[name]?.(data);
  if (name === "runs") for (const run of data.runs) tellHearers("run", run);
  else tellHearers(name, data);
}

function tellHearers(name, data) {
  for (const hearer of heard.get(data.number) ?? []) hearer[name]?.(data);
  const isOver = name === "run" && !["queued", "running"].includes(data.state);
  if (isOver || name === "deleted") forget(data.number);
}

function forget(number) {
  heard.delete(number);
  if (heard.size) return;
  stream?.close();
  stream = null;
}
