import { Bottleneck } from "../timetable/bottleneck.js";
import { Choice } from "../player/choice.js";
import { Follower } from "../player/clock.js";
import { Compared } from "./compared.js";
import { ComparedRobots } from "./compared_robots.js";
import { ComparedTable } from "./compared_table.js";
import { Diagram } from "../timetable/diagram.js";
import { element } from "../common/dom.js";
import { connectFind } from "../lists/find.js";
import { texts } from "../language/language.js";
import { MapView } from "../map/map_view.js";
import { Motion } from "../plan/motion.js";
import { Use } from "../plan/use.js";
import { Words } from "../language/words.js";

/** @import { Root } from "../common/root.js" */
/** @import { Clock } from "../player/clock.js" */
/** @import { Plan } from "../plan/plan.js" */
/** @import { Roadmap } from "../plan/roadmap.js" */
/** @import { Robot } from "../plan/robot.js" */
/** @import { Theme } from "../drawing/theme.js" */

const LEAST_MAP = 150; // pixels that a map is wide, so that one can read its title
const AROUND = 80; // pixels above and below a map: its title, the scale bar

/**
 * Other plans beside the first one: each with a map and a diagram of its own, all with one clock and one
 * choice; what plans cost, and what each robot gains or loses.
 */
export class Comparison {
  /**
   * @param {Root} root
   * @param {Plan} plan
   * @param {Clock} clock
   * @param {Choice} choice
   * @param {Theme} theme
   * @param {MapView} mapView
   * @param {Diagram} diagram
   */
  constructor(root, plan, clock, choice, theme, mapView, diagram) {
    this.root = root;
    this.plan = plan;
    this.clock = clock;
    this.choice = choice;
    this.theme = theme;
    const { others, comparison } = plan;
    if (!comparison) throw new Error("comparison: this plan is compared with none (give others)");
    this.plans = [plan, ...others];
    this.compared = new Compared(
      comparison,
      this.plans.map(({ title }) => title),
    );
    root.element.classList.add("compared");
    this.maps = root.all(".maps", HTMLElement)[0];
    root.element.style.setProperty("--plans", String(this.plans.length));
    this.#title(root.part("map-title"), plan);
    this.stack = this.#stack(diagram);
    this.beside = others.map((other, i) =>
      this.#beside(other, comparison.scales[i + 1] / comparison.scales[0], diagram),
    );
    this.#linkViews([mapView, ...this.beside.map(({ view }) => view)]);
    this.#linkChoices();
    this.robots = this.#listRobots();
    diagram.hasLabels = false;
    for (const each of this.diagrams.slice(0, -1)) each.hasLabels = false;
    theme.on("theme", () => this.repaint());
  }

  /** The maps of the other plans. */
  get views() {
    return this.beside.map(({ view }) => view);
  }

  /** Their diagrams. */
  get diagrams() {
    return this.beside.map(({ diagram }) => diagram);
  }

  /** As many columns as make the maps largest. */
  layOut() {
    const { clientWidth: width, clientHeight: height } = this.maps;
    const { roadmap } = this.plan;
    /** @param {number} columns */
    const scale = (columns) =>
      Math.min(
        width / columns / roadmap.width,
        (height / Math.ceil(this.plans.length / columns) - AROUND) / roadmap.height,
      );
    const columns = this.plans.map((_, i) => i + 1).filter((each) => width >= each * LEAST_MAP);
    const best = columns.reduce((most, each) => (scale(each) > scale(most) ? each : most), 1);
    this.maps.style.setProperty("--columns", String(best));
  }

  /** Paint a frame. */
  paint() {
    for (const { motion, clock, view, diagram } of this.beside) {
      motion.moveTo(clock.tick);
      view.paint();
      diagram.paint();
    }
  }

  /** Paint again what does not move. */
  repaint() {
    for (const { view, diagram } of this.beside) view.base.stale = diagram.layer.stale = true;
  }

  refresh() {
    this.robots.list.refresh();
  }

  /**
   * How a robot of the first plan fares in each other plan: title and "6 s earlier".
   *
   * @param {{ name: string }} options
   * @returns {[string, string][]}
   */
  changesOf({ name }) {
    const robot = this.compared.robots.find((each) => each.name === name);
    return this.beside.map(({ plan }, i) => {
      const [before, after] = [robot?.completion[0] ?? null, robot?.completion[i + 1] ?? null];
      if (before === null || after === null) return [plan.title, texts.compared.isMissing];
      const time = this.compared.time(Math.abs(after - before));
      if (after === before) return [plan.title, texts.same];
      return [plan.title, after < before ? texts.isEarlier({ time }) : texts.isLater({ time })];
    });
  }

  /**
   * Another plan: its map, its diagram, and what they are moved by.
   *
   * @param {Plan} plan
   * @param {number} scale
   * @param {Diagram} options
   */
  #beside(plan, scale, { axis }) {
    const { theme } = this;
    const clock = new Follower(this.clock, 1 / scale);
    const choice = new Choice(plan);
    const [motion, words, use] = [new Motion(choice), new Words(plan), new Use(choice)];
    const bottleneck = new Bottleneck(this.root, plan, clock, choice, theme);
    const title = element("h2", { className: "map-title" });
    const canvas = element("canvas", { tabIndex: 0 });
    canvas.setAttribute("role", "img");
    const tip = element("div", { className: "hover", hidden: true });
    const section = element("section", { className: "map other" }, title, canvas, tip);
    section.setAttribute("aria-label", texts.compared.mapOf({ title: plan.title }));
    this.maps.append(section);
    this.#title(title, plan);
    const ghosts = new Motion({ robots: plan.planned, roadmap: plan.roadmap });
    const view = new MapView(canvas, plan, theme, {
      motion,
      ghosts,
      clock,
      choice,
      words,
      use,
      bottleneck,
    });
    const diagram = new Diagram(this.root, plan, clock, choice, theme, words, use, bottleneck, {
      canvas: this.#row(plan),
      axis,
    });
    return { plan, clock, choice, motion, words, view, diagram };
  }

  /**
   * Diagrams below each other: the first plan's is there already, and has the labels of the axis last.
   *
   * @param {Diagram} diagram
   */
  #stack(diagram) {
    const box = diagram.canvas.parentElement ?? this.root.element;
    const stack = element("div", { className: "stack" });
    box.classList.add("stacked");
    box.prepend(stack);
    const figure = element("figure", {}, this.#caption(this.plan), diagram.canvas);
    stack.append(figure);
    return stack;
  }

  /** @param {Plan} plan */
  #row(plan) {
    const canvas = element("canvas");
    canvas.setAttribute("role", "img");
    this.stack.append(element("figure", {}, this.#caption(plan), canvas));
    return canvas;
  }

  /** @param {{ title: string }} options */
  #caption({ title }) {
    return element("figcaption", { className: "name" }, title);
  }

  /** One choice holds for all plans: by the names of robots. */
  #linkChoices() {
    const { choice } = this;
    /** @param {Choice} options */
    const nameOf = ({ robot }) => robot?.name;
    for (const { plan, choice: other } of this.beside) {
      /**
       * @param {Choice} from
       * @param {Choice} to
       * @param {readonly Robot[]} robots
       */
      const follow = (from, to, robots) => {
        if (nameOf(from) === nameOf(to)) return;
        const index = robots.findIndex(({ name }) => name === nameOf(from));
        if (index !== to.robotIndex) to.chooseRobot(index);
      };
      choice.on("choice", () => follow(choice, other, plan.robots));
      other.on("choice", () => {
        if (other.robot) follow(other, choice, this.plan.robots);
        else if (choice.robot && plan.robots.some(({ name }) => name === nameOf(choice)))
          choice.chooseNothing();
      });
      choice.on("heat", () => other.heat !== choice.heat && other.toggleHeat());
      choice.on("space", () => other.space !== choice.space && other.toggleSpace());
      for (const event of ["choice", "heat", "space"])
        other.on(event, () => {
          this.repaint();
          this.clock.tell("tick"); // also where nothing changes in the first plan
        });
    }
  }

  /**
   * Maps of one size show the same part.
   *
   * @param {MapView[]} views
   */
  #linkViews(views) {
    /** @param {{ roadmap: Roadmap }} options */
    const size = ({ roadmap: { width, height, unit } }) => `${width} ${height} ${unit}`;
    for (const view of views) {
      const followers = views.filter((other) => other !== view && size(other) === size(view));
      view.viewport.on("view", () => {
        const { left, top, scale, fitted } = view.viewport;
        view.base.stale = true;
        for (const other of followers) {
          Object.assign(other.viewport, { left, top, scale, fitted });
          other.base.stale = true;
        }
        this.clock.tell("tick");
      });
    }
  }

  /**
   * @param {HTMLElement} heading
   * @param {Plan} plan
   */
  #title(heading, plan) {
    const { title, metrics, endsAtHome, faultCount } = plan;
    const words = new Words(plan);
    const outcome = faultCount
      ? element("span", { className: "wrong" }, texts.faults({ count: faultCount }))
      : element(
          "span",
          {},
          texts.allArrived({ isHome: endsAtHome, time: words.time(metrics.makespan) }),
        );
    heading.hidden = false;
    heading.replaceChildren(element("b", { className: "name" }, title), outcome);
  }

  #listRobots() {
    const { choice, compared, plans } = this;
    const colours = new Map(
      plans.flatMap(({ planned }) => planned.map(({ name, colour }) => [name, colour])),
    );
    new ComparedTable(compared, this.root.part("compared-figures"));
    const robots = new ComparedRobots(compared, this.root.part("compared-robots"), {
      choose: (name) => this.#choose(name),
      colourOf: (name) => colours.get(name) ?? "",
    });
    const find = this.root.part("find-compared", HTMLInputElement);
    connectFind(find, robots.list, () => robots.find(find.value));
    choice.on("choice", () => choice.robot && robots.setChosen(choice.robot.name));
    return robots;
  }

  /**
   * Choose a robot wherever it is.
   *
   * @param {string} name
   */
  #choose(name) {
    /** @param {Plan} plan */
    const indexIn = (plan) => plan.robots.findIndex((robot) => robot.name === name);
    this.choice.chooseRobot(indexIn(this.plan));
    for (const { plan, choice } of this.beside) choice.chooseRobot(indexIn(plan));
    this.robots.setChosen(name);
  }
}
