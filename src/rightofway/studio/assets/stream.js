/**
 * A shared worker: one connection that hears of all runs, for all pages of a browser. A browser has six
 * connections to a server, so the seventh page with one of its own would wait for ever.
 */

import { hear, KnownRuns } from "./hear.js";

const pages = new Set();
let known = new KnownRuns();
let stream = null;

function tell(name, data) {
  known.take(name, data);
  for (const page of pages) page.postMessage([name, data]);
}

function refused() {
  [known, stream] = [new KnownRuns(), null]; // the next page tries again
  for (const page of pages) page.postMessage(["refused"]);
}

self.onconnect = ({ ports: [page] }) => {
  pages.add(page);
  page.onmessage = () => pages.delete(page); // it is being left
  stream ??= hear(tell, refused);
  if (known.byNumber) page.postMessage(["runs", { runs: [...known.byNumber.values()] }]);
};
