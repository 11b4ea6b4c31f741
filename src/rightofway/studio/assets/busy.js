/** Whether the page still works on what was done last: the map is `aria-busy` meanwhile. */

let count = 0; // requests without an answer, and frames that are not painted yet
/** @type {Element | null} */
let shown = null; // the element that says so

const write = () => shown?.setAttribute("aria-busy", String(count > 0));

/** Say it of an element from now on. @param {Element} element */
export function showBusyOn(element) {
  shown = element;
  write();
}

export function beginWork() {
  count++;
  write();
}

/** What an answer leads to begins within the same frame: then the page is busy without a pause. */
export function endWork() {
  requestAnimationFrame(() =>
    setTimeout(() => {
      count--;
      write();
    }),
  );
}

/** Work until a promise is settled. @template T @param {Promise<T>} work @returns {Promise<T>} */
export function whileBusy(work) {
  beginWork();
  return work.finally(endWork);
}
