/** @import { TourData } from "../payload.d.ts" */

/**
 * The state of charge of a fleet at even distances over time: the mean, and the lowest one.
 *
 * @param {readonly TourData[]} tours
 * @param {number} end of the time
 * @param {number} samples
 */
export function fleetBattery(tours, end, samples) {
  const mean = new Float64Array(samples + 1);
  const lowest = new Float64Array(samples + 1).fill(Infinity);
  let robots = 0;
  for (const { charges = [] } of tours) {
    if (!charges.length) continue;
    robots++;
    let next = 0; // the first point behind the sample
    for (let i = 0; i <= samples; i++) {
      const tick = (i / samples) * end;
      while (next < charges.length && charges[next][0] <= tick) next++;
      const share = shareBetween(charges[next - 1], charges[next], tick);
      mean[i] += share;
      lowest[i] = Math.min(lowest[i], share);
    }
  }
  for (let i = 0; i <= samples; i++) mean[i] /= Math.max(robots, 1);
  return { mean, lowest };
}

/**
 * Between two points the charge changes evenly; beyond the first and the last one it stays.
 *
 * @param {[number, number] | undefined} before
 * @param {[number, number] | undefined} after
 * @param {number} tick
 */
function shareBetween(before, after, tick) {
  if (!before || !after) return (before ?? after ?? [0, 0])[1];
  const part = (tick - before[0]) / (after[0] - before[0]);
  return before[1] + part * (after[1] - before[1]);
}
