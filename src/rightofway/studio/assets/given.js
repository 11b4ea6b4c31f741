/** Values that are there when they are read, though their types cannot say so. */

/**
 * The value of a field that is filled before anything reads it, by its own type: of a document before
 * one is open, of a map before one is drawn.
 * @template T
 * @returns {T}
 */
export const later = () => /** @type {any} */ (null); // a cast, for `null` is no T

/**
 * A value that is not missing here.
 * @template T
 * @param {T} value
 * @returns {NonNullable<T>}
 */
export function present(value) {
  if (value === null || value === undefined) throw new TypeError("a value is missing");
  return value;
}
