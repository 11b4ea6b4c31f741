/** Several lists in one place; those without items may be left out. */
export class Tabs {
  constructor(counts, shown) {
    this.tabs = [...document.querySelectorAll("[role=tab]")];
    this.shown = shown;
    this.tabs.forEach((tab, index) => {
      tab.querySelector("b").textContent = counts[index];
      tab.hidden = counts[index] === null;
      tab.addEventListener("click", () => this.show(index));
      tab.addEventListener("keydown", (event) => this.#key(event, index));
    });
  }

  show(chosen) {
    this.tabs.forEach((tab, index) => {
      tab.setAttribute("aria-selected", index === chosen);
      tab.tabIndex = index === chosen ? 0 : -1;
      if (index === chosen)
        tab.parentElement.scrollLeft =
          tab.offsetLeft + tab.offsetWidth - tab.parentElement.clientWidth;
      document.getElementById(tab.getAttribute("aria-controls")).hidden = index !== chosen;
    });
    this.shown();
  }

  #key(event, index) {
    if (event.key !== "ArrowLeft" && event.key !== "ArrowRight") return;
    event.preventDefault();
    event.stopPropagation();
    const shown = this.tabs.filter((tab) => !tab.hidden);
    const by = event.key === "ArrowRight" ? 1 : shown.length - 1;
    const other = shown[(shown.indexOf(this.tabs[index]) + by) % shown.length];
    this.show(this.tabs.indexOf(other));
    other.focus();
  }
}
