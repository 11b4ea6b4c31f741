/**
 * "1 robot", "1.5 robots".
 *
 * @param {number | string} number
 * @param {string} one
 * @param {string} many
 */
export function counted(number, one, many) {
  return `${number} ${String(number) === "1" ? one : many}`;
}
