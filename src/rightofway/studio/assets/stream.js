/**
 * A shared worker: one connection that hears of all runs, for all pages of a browser. A browser has six
 * connections to a server, so the seventh page with one of its own would wait for ever.
 */

import { hear } from "./hear.js";

const pages = new Set();
let runs = null; // as far as events have told, by number; null before the first one
let stream = null;

const TAKE = {
  runs: (told) => (runs = new Map(told.runs.map((run) => [run.number, run]))),
  run: (run) => runs.set(run.number, run),
  plan: ({ number, figures }) => runs.set(number, { ...runs.get(number), figures, has_plan: true }),
  deleted: ({ number }) => runs.delete(number),
};

function tell(name, data) {
  TAKE[name]?.(data);
  for (const page of pages) page.postMessage([name, data]);
}

function refused() {
  runs = stream = null; // the next page tries again
  for (const page of pages) page.postMessage(["refused"]);
}

self.onconnect = ({ ports: [page] }) => {
  pages.add(page);
  page.onmessage = () => pages.delete(page); // it is being left
  stream ??= hear(tell, refused);
  if (runs) page.postMessage(["runs", { runs: [...runs.values()] }]); // no event comes between
};
