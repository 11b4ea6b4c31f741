/**
 * A search field over a list: typing filters, Enter takes the first match, arrow keys move on in the list.
 *
 * @param {HTMLInputElement} field
 * @param {{ chooseFirst(): void, step(by: number): void }} list
 * @param {() => void} filter
 */
export function connectFind(field, list, filter) {
  field.addEventListener("input", filter);
  field.addEventListener("keydown", (event) => {
    if (event.key === "Enter") list.chooseFirst();
    else if (event.key === "ArrowDown" || event.key === "ArrowUp")
      list.step(event.key === "ArrowDown" ? 1 : -1);
    else if (event.key === "Escape" && field.value) {
      field.value = "";
      filter();
    } else return;
    event.preventDefault();
    event.stopPropagation();
  });
}

/**
 * Whether a text has all words of a search, in any order.
 *
 * @param {string} text
 * @param {string} search
 */
export function matches(text, search) {
  const whole = text.toLowerCase();
  return search
    .trim()
    .toLowerCase()
    .split(/\s+/)
    .every((word) => whole.includes(word));
}
