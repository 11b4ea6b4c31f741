/** The document that is edited: undo and redo, with a server that keeps every draft. */

import assert from "node:assert/strict";
import { test } from "node:test";
import { ScenarioStore } from "../../../src/rightofway/studio/assets/document.js";

const [FIRST, SECOND, THIRD] = [1, 2, 3].map((count) => ({
  map: { grid: ["."] },
  robots: Array.from({ length: count }, (_, i) => ({ name: `R${i + 1}` })),
}));

Object.assign(globalThis, {
  fetch: () => Promise.resolve(Response.json({ revision: "1", ok: true, faults: [] })),
  requestAnimationFrame: (/** @type {() => void} */ draw) => setTimeout(draw),
});

function opened() {
  const store = new ScenarioStore();
  store.open({ document: FIRST, path: "a.yaml", revision: "1" });
  return store;
}

test("an edit is undone and done again", () => {
  const store = opened();
  store.change(() => SECOND);
  store.change(() => THIRD);
  assert.equal(store.before, SECOND);
  store.undo();
  store.undo();
  assert.equal(store.document, FIRST);
  assert.deepEqual([store.canUndo, store.canRedo, store.isSaved], [false, true, true]);
  store.redo();
  assert.equal(store.document, SECOND);
});

test("an edit that changes nothing is no step, and a new one ends redo", () => {
  const store = opened();
  store.change((document) => document);
  assert.equal(store.canUndo, false);
  store.change(() => SECOND);
  store.undo();
  store.change(() => THIRD);
  assert.equal(store.canRedo, false);
});

test("one undo takes back an edit that belongs to the one before", () => {
  const store = opened();
  store.change(() => SECOND);
  store.change(() => THIRD, { isSame: true });
  store.undo();
  assert.equal(store.document, FIRST);
});

test("each event is told when it happens", () => {
  const store = opened();
  /** @type {string[]} */
  const told = [];
  for (const event of ["edit", "undo", "redo", "open"]) store.on(event, () => told.push(event));
  store.change(() => SECOND);
  store.undo();
  store.redo();
  assert.deepEqual(told, ["edit", "undo", "redo"]);
});
