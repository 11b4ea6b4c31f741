/**
 * A shared worker: one connection that hears of all runs, for all pages of a browser. A browser has six
 * connections to a server, so the seventh page with one of its own would wait for ever.
 */

import { hear, ToldRuns } from "./hear.js";

const pages = new Set();
let told = new ToldRuns();
let stream = null;

function tell(name, data) {
  told.take(name, data);
  for (const page of pages) page.postMessage([name, data]);
}

function refused() {
  [told, stream] = [new ToldRuns(), null]; // the next page tries again
  for (const page of pages) page.postMessage(["refused"]);
}

self.onconnect = ({ ports: [page] }) => {
  pages.add(page);
  page.onmessage = () => pages.delete(page); // it is being left
  stream ??= hear(tell, refused);
  if (told.byNumber) page.postMessage(["runs", { runs: [...told.byNumber.values()] }]);
};
