import { element } from "../common/dom.js";
import { texts } from "../language/language.js";
import { VirtualList } from "../lists/virtual_list.js";

/** @import { Compared } from "./compared.js" */
/** @import { ComparedRobot } from "../payload.d.ts" */

/** Which robots gain and lose against the base, with a bar for each plan; a press on a head sorts by it. */
export class ComparedRobots {
  /**
   * `choose` is called with the name of the robot that is pressed; `colourOf` returns its colour.
   *
   * @param {Compared} compared
   * @param {HTMLElement} box
   * @param {{ choose: (name: string) => void, colourOf: (name: string) => string }} options
   */
  constructor(compared, box, { choose, colourOf }) {
    this.compared = compared;
    this.box = box;
    this.colourOf = colourOf;
    this.search = "";
    this.most = 1; // the largest change of a robot [ticks]
    /** @type {number | null} */
    this.place = null; // the plan that the robots are sorted by; null for the largest change, -1 for the name
    this.head = element("div", { className: "compared-head" });
    const list = element("div", {
      className: "list",
      id: "compared-list",
      tabIndex: 0,
    });
    list.setAttribute("role", "listbox");
    list.setAttribute("aria-label", texts.compared.figures.robots);
    const sheet = element("div", { className: "compared-sheet" }, this.head, list);
    sheet.style.setProperty("--plans", String(compared.plans.length));
    box.replaceChildren(sheet);
    this.list = new VirtualList(list, {
      rowHeight: 30,
      className: "compared-row",
      none: texts.noRobotNamed,
      fill: (row, robot) => this.#fill(row, robot),
      choose: ({ name }) => choose(name),
    });
    box.addEventListener("scroll", () => {
      sheet.style.setProperty("--scrolled", `${box.scrollLeft}px`); // names of robots stay in sight
    });
    compared.on("base", () => this.refresh());
    this.refresh();
  }

  /** Sort and write again. */
  refresh() {
    const { compared } = this;
    if (this.place === compared.base) this.place = null;
    this.most = Math.max(...compared.robots.map((robot) => compared.largest(robot)), 1);
    this.#writeHead();
    this.list.setItems(compared.sorted(this.search, this.place));
  }

  /** @param {string} search */
  find(search) {
    this.search = search;
    this.refresh();
  }

  /** @param {string} name */
  setChosen(name) {
    this.list.setChosen(this.compared.robots.find((robot) => robot.name === name) ?? null);
  }

  /** The columns: the robot, its time in the base, its change in each other plan. */
  #writeHead() {
    const { compared } = this;
    /**
     * @param {number} place
     * @param {string} text
     * @param {string} title
     * @param {boolean} isPressed
     */
    const sorts = (place, text, title, isPressed) => {
      const button = element("button", { type: "button", className: "quiet name", title }, text);
      button.setAttribute("aria-pressed", String(isPressed));
      button.addEventListener("click", () => {
        this.place = place;
        this.refresh();
      });
      return button;
    };
    const { title } = compared.plans[compared.base];
    this.head.replaceChildren(
      sorts(-1, texts.robot, texts.compared.sortByName, this.place === -1),
      element("span", { className: "name base", title }, title),
      ...compared.others.map((place) => {
        const { title: other } = compared.plans[place];
        const isPressed =
          this.place === place || (compared.others.length === 1 && this.place === null);
        return sorts(place, other, texts.compared.sortBy({ title: other }), isPressed);
      }),
    );
  }

  /**
   * @param {HTMLElement & { written?: string, filled?: ComparedRobot }} row
   * @param {ComparedRobot} robot
   */
  #fill(row, robot) {
    const { compared } = this;
    const written = `${robot.name} ${compared.base}`;
    if (row.written === written && row.filled === robot) return;
    Object.assign(row, { written, filled: robot });
    const before = robot.completion[compared.base];
    const said = compared.others.map(
      (place) => `${compared.plans[place].title} ${this.#inWords(robot, place)}`,
    );
    const { title } = compared.plans[compared.base];
    const time = before === null ? texts.compared.isMissing : compared.time(before);
    row.setAttribute("aria-label", [`${robot.name}: ${title} ${time}`, ...said].join(", "));
    const dot = element("span", { className: "swatch" });
    dot.style.setProperty("--robot", this.colourOf(robot.name));
    row.replaceChildren(
      element(
        "span",
        { className: "robot" },
        dot,
        element("span", { className: "name" }, robot.name),
      ),
      element("span", { className: "base" }, before === null ? "–" : compared.time(before)),
      ...compared.others.map((place) => this.#change(robot, place)),
    );
  }

  /**
   * @param {ComparedRobot} robot
   * @param {number} place
   */
  #change(robot, place) {
    const { compared } = this;
    const by = compared.change(robot, place);
    const way = by < 0 ? "gain" : by > 0 ? "lose" : "equal";
    const bar = element("span", { className: "amount" });
    bar.style.setProperty("--by", String(Math.abs(by || 0) / this.most));
    const after = robot.completion[place];
    const cell = element(
      "span",
      { className: `by ${way}` },
      bar,
      element("span", {}, compared.signed(by)),
    );
    cell.title = `${compared.plans[place].title}: ${this.#inWords(robot, place)}${after === null ? "" : ` (${compared.time(after)})`}`;
    return cell;
  }

  /**
   * @param {ComparedRobot} robot
   * @param {number} place
   */
  #inWords(robot, place) {
    const { compared } = this;
    const by = compared.change(robot, place);
    if (Number.isNaN(by)) return texts.compared.isMissing;
    if (!by) return texts.same;
    const time = compared.time(Math.abs(by));
    return by < 0 ? texts.isEarlier({ time }) : texts.isLater({ time });
  }
}
