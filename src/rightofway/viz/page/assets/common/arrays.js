/**
 * Undo first differences: [3, 1, 2] is [3, 4, 6].
 *
 * @template {Int32Array | Float64Array} T
 * @param {readonly number[]} differences
 * @param {new (length: number) => T} Numbers
 */
export function fromDifferences(differences, Numbers) {
  const numbers = new Numbers(differences.length);
  let sum = 0;
  for (let i = 0; i < numbers.length; i++) numbers[i] = sum += differences[i];
  return numbers;
}

/**
 * The last of some items, of which there is at least one.
 *
 * @template T
 * @param {ArrayLike<T>} items
 */
export function lastOf(items) {
  return items[items.length - 1];
}

/**
 * The index of the point nearest to (x, y) and within `reach`, or -1.
 *
 * @param {ArrayLike<number>} xs
 * @param {ArrayLike<number>} ys
 * @param {number} x
 * @param {number} y
 * @param {number} reach
 */
export function nearest(xs, ys, x, y, reach) {
  let best = -1;
  let least = reach * reach;
  for (let i = 0; i < xs.length; i++) {
    const distance = (xs[i] - x) ** 2 + (ys[i] - y) ** 2;
    if (distance <= least) [best, least] = [i, distance];
  }
  return best;
}

/**
 * The index of the last of these increasing numbers that is at most `limit`; 0 if none is.
 *
 * @param {ArrayLike<number>} numbers
 * @param {number} limit
 */
export function lastAtMost(numbers, limit) {
  let [low, high] = [0, numbers.length - 1];
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if (numbers[middle] <= limit) low = middle;
    else high = middle - 1;
  }
  return low;
}

/**
 * First differences: [3, 4, 6] as [3, 1, 2].
 *
 * @param {readonly number[]} numbers
 */
export function toDifferences(numbers) {
  return numbers.map((number, i) => (i ? number - numbers[i - 1] : number));
}
