/** Work on what is the latest. */

import assert from "node:assert/strict";
import { test } from "node:test";
import { Latest } from "../../../src/rightofway/studio/assets/latest.js";

test("any number of requests during a round make one more round", async () => {
  let rounds = 0;
  /** @type {(value?: unknown) => void} */
  let end = () => {};
  const first = new Promise((resolve) => (end = resolve));
  const work = new Latest(async () => {
    rounds++;
    if (rounds === 1) await first;
  });
  for (let i = 0; i < 5; i++) work.ask();
  assert.equal(rounds, 1);
  end();
  await work.idle();
  assert.equal(rounds, 2); // four requests came during the first round
  work.ask();
  await work.idle();
  assert.equal(rounds, 3);
});
