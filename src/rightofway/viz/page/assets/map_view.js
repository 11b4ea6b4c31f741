"use strict";

/** The map: what does not move is painted once, robots at each frame. */
class MapView {
  constructor(canvas, plan, motion, ghosts, clock, choice, theme, words, use, bottleneck) {
    Object.assign(this, { canvas, plan, motion, clock, choice, words, use, bottleneck });
    this.context = canvas.getContext("2d");
    this.viewport = new Viewport(canvas, plan.roadmap);
    const base = new MapBase(plan, this.viewport, theme, choice, use, bottleneck);
    this.base = new Layer((context) => base.paint(context));
    this.robots = new MapRobots(plan, motion, ghosts, theme, choice);
    this.route = new MapRoute(plan, motion, theme, choice);
    this.hover = document.getElementById("hover");
    canvas.parentElement.style.setProperty("--ratio", plan.roadmap.width / plan.roadmap.height);
    canvas.setAttribute("aria-label", `Map with ${counted(plan.robots.length, "robot")}`);
    this.viewport.on("click", () => this.#click());
    this.viewport.on("hover", () => this.#tellWhatIsThere());
    choice.on("choice", () => this.#bringIntoSight());
    this.#listenToTools();
  }

  /** Paint a frame. */
  paint() {
    const size = fitCanvas(this.canvas);
    if (size.changed) this.viewport.resized();
    const { context } = this;
    context.setTransform(1, 0, 0, 1, 0, 0);
    context.clearRect(0, 0, this.canvas.width, this.canvas.height);
    this.base.drawOn(context, size);
    const { left, top, scale } = this.viewport;
    context.translate(left, top);
    context.scale(scale, scale);
    this.route.paint(context, scale);
    this.bottleneck.paintRobots(context, this.motion, scale);
    this.robots.paint(context, scale);
  }

  #click() {
    const { x, y } = this.viewport.pointer;
    const reach = Math.max(0.6, 14 / this.viewport.scale);
    this.choice.chooseRobot(nearest(this.motion.x, this.motion.y, x, y, reach));
  }

  #bringIntoSight() {
    const { robotIndex } = this.choice;
    if (robotIndex >= 0) this.viewport.show(this.motion.x[robotIndex], this.motion.y[robotIndex]);
  }

  #tellWhatIsThere() {
    const { x, y } = this.viewport.pointer;
    const vertex = this.plan.roadmap.near(x, y);
    this.hover.textContent = vertex < 0 ? "" : this.#about(vertex);
  }

  /** Name of a vertex, who is there, who comes next. */
  #about(vertex) {
    const now = this.clock.tick;
    const visits = this.use.visitsAt(vertex).sort(([one, a], [two, b]) => one.enter[a] - two.enter[b]);
    const here = visits.find(([robot, visit]) => robot.enter[visit] <= now && now < robot.leave(visit));
    const next = visits.find(([robot, visit]) => robot.enter[visit] > now);
    const parts = [this.words.vertex(vertex)];
    if (here) parts.push(`${here[0].name} ${this.#until(here[0].leave(here[1]))}`);
    if (next) parts.push(`${here ? "then " : ""}${next[0].name} from ${this.words.time(next[0].enter[next[1]])}`);
    if (this.choice.heat) parts.push(`held for ${this.words.time(this.use.held[vertex])}`);
    return parts.join(" · ");
  }

  #until(tick) {
    return tick === Infinity ? "stays" : `until ${this.words.time(tick)}`;
  }

  #listenToTools() {
    const press = (id, action) => document.getElementById(id).addEventListener("click", action);
    press("zoom-in", () => this.viewport.zoom(1.5));
    press("zoom-out", () => this.viewport.zoom(1 / 1.5));
    press("fit", () => this.viewport.fit());
    press("heat", () => this.choice.toggleHeat());
    this.choice.on("heat", () => this.#showHeat());
    this.choice.on("mode", () => this.#showHeat());
  }

  #showHeat() {
    document.getElementById("heat").setAttribute("aria-pressed", this.choice.heat);
    document.getElementById("heat-legend").hidden = !this.choice.heat;
    const marks = [0, this.use.most / 4, this.use.most]; // the colour goes with the square root
    const labels = marks.map((ticks) => element("span", {}, this.words.time(ticks)));
    document.getElementById("heat-scale").replaceChildren(...labels);
  }
}
