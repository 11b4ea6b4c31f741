import { all } from "../common/dom.js";
/** @import { Root } from "../common/root.js" */

/** Several lists in one place; those without items may be left out. */
export class Tabs {
  /**
   * @param {Root} root
   * @param {Record<string, number | string | null | undefined>} counts of each list, null where it is left out
   * @param {() => void} shown
   */
  constructor(root, counts, shown) {
    this.root = root;
    this.tabs = root.all("[role=tab]", HTMLElement);
    this.panels = root.all("[role=tabpanel]", HTMLElement);
    this.shown = shown;
    this.names = this.tabs.map(({ id }) => id.replace(/^tab-|-\d+$/g, ""));
    this.tabs.forEach((tab, index) => {
      const count = counts[this.names[index]] ?? null;
      for (const place of all("b", HTMLElement, tab)) place.textContent = String(count ?? "");
      tab.hidden = count === null;
      tab.addEventListener("click", () => this.#show(index));
      tab.addEventListener("keydown", (event) => this.#key(event, index));
    });
  }

  /** @param {string} name */
  show(name) {
    this.#show(this.names.indexOf(name));
  }

  /** @param {number} chosen */
  #show(chosen) {
    this.tabs.forEach((tab, index) => {
      tab.setAttribute("aria-selected", String(index === chosen));
      tab.tabIndex = index === chosen ? 0 : -1;
      if (index === chosen) scrollToEnd(tab);
      this.panels[index].hidden = index !== chosen;
    });
    this.shown();
  }

  /**
   * @param {KeyboardEvent} event
   * @param {number} index
   */
  #key(event, index) {
    if (event.key !== "ArrowLeft" && event.key !== "ArrowRight") return;
    event.preventDefault();
    event.stopPropagation();
    const shown = this.tabs.filter((tab) => !tab.hidden);
    const by = event.key === "ArrowRight" ? 1 : shown.length - 1;
    const other = shown[(shown.indexOf(this.tabs[index]) + by) % shown.length];
    this.#show(this.tabs.indexOf(other));
    other.focus();
  }
}

/**
 * Bring a tab into sight in the row of all tabs.
 *
 * @param {HTMLElement} tab
 */
function scrollToEnd(tab) {
  const row = tab.parentElement;
  if (row) row.scrollLeft = tab.offsetLeft + tab.offsetWidth - row.clientWidth;
}
