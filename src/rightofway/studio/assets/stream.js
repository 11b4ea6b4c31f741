/**
 * A shared worker: one connection that hears of all runs, for all pages of a browser. A browser has six
 * connections to a server, so the seventh page with one of its own would wait for ever.
 */

import { hear, KnownRuns } from "./hear.js";
/** @import { Tell } from "./types.js" */

/** @type {Set<MessagePort>} */
const pages = new Set();
let known = new KnownRuns();
/** @type {EventSource | null} */
let stream = null;

/** @type {Tell} */
const tell = (...event) => {
  known.take(...event);
  for (const page of pages) page.postMessage(event);
};

function lost() {
  for (const page of pages) page.postMessage(["lost"]);
}

function refused() {
  [known, stream] = [new KnownRuns(), null]; // the next page tries again
  for (const page of pages) page.postMessage(["refused"]);
}

/** @type {(event: MessageEvent) => void} */
const connected = ({ ports: [page] }) => {
  pages.add(page);
  page.onmessage = () => pages.delete(page); // it is being left
  stream ??= hear(tell, lost, refused);
  if (known.byNumber) page.postMessage(["runs", { runs: [...known.byNumber.values()] }]);
};
Object.assign(self, { onconnect: connected }); // of a shared worker, which `self` is here
