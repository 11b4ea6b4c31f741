/** A map that is drawn, and a plan that is played on it, by the modules of the viewer. */

import { Choice } from "./viewer/choice.js";
import { Clock } from "./viewer/clock.js";
import { MapView } from "./viewer/map_view.js";
import { Motion } from "./viewer/motion.js";
import { Plan } from "./viewer/plan.js";
import { Theme } from "./viewer/theme.js";

export class Stage {
  /** All that is in `holder` is of the stage. */
  constructor(holder) {
    this.holder = holder;
    this.theme = new Theme();
    this.asked = false;
    this.theme.on("theme", () => this.repaint());
    new ResizeObserver(() => this.ask()).observe(holder);
  }

  /** Show a payload of the viewer; the moment and the view stay what they are where the map does. */
  show(payload) {
    const { clock: before, view: old } = this;
    const plan = new Plan(payload);
    const clock = new Clock(plan);
    const [choice, motion] = [new Choice(plan), new Motion(plan)];
    const ghosts = new Motion({ robots: plan.planned, roadmap: plan.roadmap });
    const view = new MapView(this.#freshCanvas(), plan, this.theme, { motion, ghosts, clock, choice });
    Object.assign(this, { plan, clock, choice, motion, view });
    view.viewport.fit();
    if (old && !old.viewport.fitted && old.roadmap.width === plan.roadmap.width && old.roadmap.height === plan.roadmap.height) {
      const { left, top, scale } = old.viewport;
      Object.assign(view.viewport, { left, top, scale, fitted: false });
    }
    for (const event of ["tick", "playing"]) clock.on(event, () => this.ask());
    choice.on("choice", () => this.repaint());
    view.viewport.on("view", () => this.repaint());
    if (before) clock.seek(Math.min(before.tick, clock.end));
    if (before?.playing) clock.play();
    this.repaint();
  }

  /** The viewer listens to its canvas for ever, so each map has one of its own. */
  #freshCanvas() {
    const canvas = Object.assign(document.createElement("canvas"), { tabIndex: 0, role: "img" });
    const hover = Object.assign(document.createElement("div"), { className: "hover", hidden: true });
    hover.ariaLive = "off";
    this.holder.replaceChildren(canvas, hover);
    return canvas;
  }

  /** Paint again what does not move, too. */
  repaint() {
    if (this.view) this.view.base.stale = true;
    this.ask();
  }

  /** Have a frame painted soon; while nothing changes, none is. */
  ask() {
    if (this.asked || !this.view) return;
    this.asked = true;
    requestAnimationFrame((now) => this.#paint(now));
  }

  #paint(now) {
    const { clock, motion, view } = this;
    this.asked = false;
    if (clock.playing) clock.advance(this.last ? Math.min(now - this.last, 100) / 1000 : 0);
    this.last = clock.playing ? now : 0;
    motion.moveTo(clock.tick);
    view.paint();
    if (clock.playing) this.ask();
  }
}
