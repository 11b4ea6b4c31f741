/** Time runs, is stepped through, and comes again. */

import assert from "node:assert/strict";
import { test } from "node:test";
import { Choice } from "../../../src/rightofway/viz/page/assets/player/choice.js";
import { Clock } from "../../../src/rightofway/viz/page/assets/player/clock.js";
import { Plan } from "../../../src/rightofway/viz/page/assets/plan/plan.js";
import { made, planOf } from "../made.js";

/** The clock of the counter, which comes again after 10 from 6 on, in that loop. */
function looped(tick = 0) {
  const clock = new Clock(planOf("laps"));
  clock.seek(tick);
  clock.setLoop({ from: 6, to: 16 });
  return clock;
}

test("the first period is played for ever", () => {
  const clock = looped();
  clock.seek(15.5);
  clock.advance(1 / clock.rate); // one tick on
  assert.ok(Math.abs(clock.tick - 6.5) < 1e-9);
  clock.advance(25 / clock.rate);
  assert.ok(Math.abs(clock.tick - 11.5) < 1e-9);
});

test("the loop is entered from what comes before it and left by going beyond", () => {
  const clock = looped();
  clock.seek(2);
  clock.advance(3 / clock.rate);
  assert.deepEqual([clock.tick, clock.loop], [5, { from: 6, to: 16 }]);
  clock.seek(20);
  assert.deepEqual([clock.tick, clock.loop], [20, null]);
});

test("a clock that goes on in a loop keeps the time that has run", () => {
  const clock = looped(6);
  clock.advance(27 / clock.rate);
  assert.deepEqual([clock.tick, clock.running, clock.turns], [13, 33, 2]);
  clock.setLoop({ from: 11, to: 31 }); // of another group: 33 is 13 there, once round
  assert.deepEqual([clock.tick, clock.running], [13, 33]);
});

test("time stops at the end of the plan and starts again from there", () => {
  const clock = new Clock(planOf("door"));
  clock.seek(9.9);
  clock.play();
  clock.advance(100);
  assert.deepEqual([clock.tick, clock.playing], [10, false]);
  clock.play();
  assert.deepEqual([clock.tick, clock.playing], [0, true]);
});

test("events are those of the robot chosen", () => {
  const plan = planOf("loop");
  const [clock, choice] = [new Clock(plan), new Choice(plan)];
  choice.chooseRobot(0);
  clock.seek(4);
  // the cart drives at 0 and 2, works from 4, turns from 8, waits from 10, drives from 11 and 14
  const seen = [1, 1, 1, 1, -1].map((by) => {
    clock.stepEvent(by, choice.robot);
    return clock.tick;
  });
  assert.deepEqual(seen, [8, 10, 11, 14, 11]);
});

test("the clock runs over the longer of plan and floor", () => {
  assert.equal(new Clock(planOf("late")).end, 41); // the plan ends at 41, its robots at 21 or never
  const raw = made("late");
  assert.ok(raw.floor);
  raw.floor.end = 57;
  assert.equal(new Clock(new Plan(raw)).end, 57);
});

test("laps are shown until the first robot makes no more", () => {
  assert.equal(new Clock(planOf("laps")).end, 36); // R1 comes home at 36 and stays there
});
