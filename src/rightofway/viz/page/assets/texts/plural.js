/** "1 robot", "1.5 robots". */
export function counted(number, one, many) {
  return `${number} ${String(number) === "1" ? one : many}`;
}
