"use strict";

const plan = new Plan(JSON.parse(document.getElementById("plan").textContent));
const words = new Words(plan);
const theme = new Theme();
const clock = new Clock(plan);
const choice = new Choice(plan);
const motion = new Motion(plan);
const use = new Use(plan);

const mapView = new MapView(document.getElementById("map"), plan, motion, clock, choice, theme, words, use);
const diagram = new Diagram(plan, clock, choice, theme, words, use);
const transport = new Transport(plan, clock, words);
const states = new States(motion);
const card = new Card(plan, clock, choice, words); // before the lists, whose height depends on it
const robotList = new RobotList(plan, motion, choice, words);
const decisionList = new DecisionList(plan, clock, choice, words);
const tabs = new Tabs([plan.robots.length, decisionList.items.length], () => {
  robotList.refresh();
  decisionList.refresh();
});
const deepLink = new DeepLink(plan, clock, choice);
showSummary(plan, words);
listenToKeys(clock, choice, mapView.viewport);

const frames = {
  count: 0,
  last: 0,
  asked: false,

  /** Have a frame painted soon; while nothing changes, none is. */
  ask() {
    if (this.asked) return;
    this.asked = true;
    requestAnimationFrame((now) => this.paint(now));
  },

  paint(now) {
    this.asked = false;
    if (clock.playing) clock.advance(this.last ? Math.min(now - this.last, 100) / 1000 : 0);
    this.last = clock.playing ? now : 0;
    motion.moveTo(clock.tick);
    mapView.paint();
    diagram.paint();
    transport.refresh();
    this.refreshWords();
    this.count++;
    if (clock.playing) this.ask();
  },

  /** Words change only when a tick is over, or the choice is another one. */
  refreshWords() {
    if (this.told === clock.wholeTick) return;
    this.told = clock.wholeTick;
    states.refresh();
    robotList.refresh();
  },
};

/** Paint again what does not move. */
function repaintAll() {
  mapView.base.stale = true;
  diagram.layer.stale = true;
  frames.ask();
}

clock.on("tick", () => frames.ask());
clock.on("playing", () => frames.ask());
choice.on("choice", repaintAll);
choice.on("heat", repaintAll);
theme.on("theme", repaintAll);
mapView.viewport.on("view", () => {
  mapView.base.stale = true;
  frames.ask();
});
new ResizeObserver(() => frames.ask()).observe(mapView.canvas);
new ResizeObserver(() => frames.ask()).observe(diagram.canvas);

const linked = deepLink.read();
mapView.viewport.fit();
frames.ask();
if (!linked && !EMBEDDED && !matchMedia("(prefers-reduced-motion: reduce)").matches) clock.play();
