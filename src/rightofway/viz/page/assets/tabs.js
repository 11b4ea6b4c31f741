"use strict";

/** Two lists in one place. */
class Tabs {
  constructor(counts, shown) {
    this.tabs = [...document.querySelectorAll("[role=tab]")];
    this.shown = shown;
    this.tabs.forEach((tab, index) => {
      tab.querySelector("b").textContent = counts[index];
      tab.addEventListener("click", () => this.show(index));
      tab.addEventListener("keydown", (event) => this.#key(event, index));
    });
  }

  show(chosen) {
    this.tabs.forEach((tab, index) => {
      tab.setAttribute("aria-selected", index === chosen);
      tab.tabIndex = index === chosen ? 0 : -1;
      document.getElementById(tab.getAttribute("aria-controls")).hidden = index !== chosen;
    });
    this.shown();
  }

  #key(event, index) {
    if (event.key !== "ArrowLeft" && event.key !== "ArrowRight") return;
    event.preventDefault();
    event.stopPropagation();
    const other = (index + 1) % this.tabs.length;
    this.show(other);
    this.tabs[other].focus();
  }
}
