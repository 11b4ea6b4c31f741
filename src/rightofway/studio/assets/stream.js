/**
 * A shared worker: one connection that hears of all runs, for all pages of a browser. A browser has six
 * connections to a server, so the seventh page with one of its own would wait for ever.
 */

import { hear } from "./hear.js";

const pages = new Set();

hear((...event) => {
  for (const page of pages) page.postMessage(event);
});

self.onconnect = ({ ports: [page] }) => {
  pages.add(page);
  page.onmessage = () => pages.delete(page); // it is being left
};
