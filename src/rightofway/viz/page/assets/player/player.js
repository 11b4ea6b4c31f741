import { Bottleneck } from "../timetable/bottleneck.js";
import { Card } from "../lists/card.js";
import { Choice } from "./choice.js";
import { Clock } from "./clock.js";
import { Comparison } from "../figures/comparison.js";
import { hasNoReasons, makeDecisionList } from "../lists/decision_list.js";
import { DeepLink } from "./deep_link.js";
import { Diagram } from "../timetable/diagram.js";
import { makeFaultList } from "../lists/fault_list.js";
import { FrameLoop } from "./frame_loop.js";
import { listenToKeys } from "./keys.js";
import {
  askedLanguage,
  learn,
  offerLanguages,
  setLanguage,
  writeMarkup,
} from "../language/language.js";
import { Loop } from "./loop.js";
import { MapView } from "../map/map_view.js";
import { ModeSwitch } from "./mode_switch.js";
import { Motion } from "../plan/motion.js";
import { makeMarkup } from "./markup.js";
import { Paper } from "./paper.js";
import { Plan } from "../plan/plan.js";
import { RobotList } from "../lists/robot_list.js";
import { Root } from "../common/root.js";
import { Share } from "./share.js";
import { States } from "../lists/states.js";
import { Summary } from "../figures/summary.js";
import { Tabs } from "./tabs.js";
import { Theme } from "../drawing/theme.js";
import { Transport } from "./transport.js";
import { Use } from "../plan/use.js";
import { Words } from "../language/words.js";

/** @import { WithTexts } from "../language/language.js" */
/** @import { Payload } from "../payload.d.ts" */

/** @typedef {{ destroy(): void }} PlayerHandle Ends a player, and takes away all that it has made. */

/**
 * Play a plan in an element, which the player fills; any number of them in a page.
 *
 * @param {HTMLElement} element `document.body` where the player is the page
 * @param {Payload & WithTexts} payload what `make_payload` returns, and texts
 * @param {typeof import("../live/watching.js").WATCHING | null} [watching] for a fleet that is driven
 * @param {typeof import("../jobs/working.js").WORKING | null} [working] for a plan with jobs, or a shift
 * @returns {PlayerHandle}
 */
export function createPlayer(element, payload, watching = null, working = null) {
  const root = new Root(element);
  const jobs = payload.work ? working : null;
  root.fill(makeMarkup(jobs ?? undefined, watching?.markup));
  learn(payload.texts);
  setLanguage(askedLanguage(root.isPart), root.top);
  writeMarkup(element);
  offerLanguages(root.part("language", HTMLSelectElement));

  const plan = new Plan(payload);
  if (payload.shift && jobs?.Shift) plan.shift = new jobs.Shift(payload.shift, plan.jobs);
  if (watching) plan.beDriven(new watching.Driven(payload.robots, plan.planned));
  const { driven } = plan;
  const words = new Words(plan);
  const theme = new Theme(root);
  const choice = new Choice(plan);
  const clock = new Clock(plan, choice);
  const motion = new Motion(choice);
  const ghosts = new Motion({ robots: plan.planned, roadmap: plan.roadmap }); // as planned, whatever is shown
  const use = new Use(choice);
  const bottleneck = new Bottleneck(root, plan, clock, choice, theme);

  const jobMarks = jobs && new jobs.JobMarks(plan, theme, choice, clock);
  const mapView = new MapView(root.part("map", HTMLCanvasElement), plan, theme, {
    motion,
    ghosts,
    clock,
    choice,
    words,
    use,
    bottleneck,
    tools: root,
    released:
      watching && driven
        ? (sizes) => new watching.MapReleased(plan, driven, motion, sizes, choice)
        : null,
    jobs: jobMarks,
  });
  const diagram = new Diagram(root, plan, clock, choice, theme, words, use, bottleneck);
  diagram.jobs = jobMarks;
  const transport = new Transport(root, plan, clock, words);
  const loop = new Loop(root, plan, clock, choice);
  const modeSwitch = new ModeSwitch(root, plan, choice);
  const states = new States(root, motion, choice, Boolean(plan.shift));
  const comparison =
    plan.comparison && new Comparison(root, plan, clock, choice, theme, mapView, diagram);
  const live =
    watching && driven && new watching.Live(root, plan, driven, clock, choice, words, theme);
  const jobCards = jobs && new jobs.JobCards(plan, clock, choice, words);
  const { space } = mapView;
  const card = new Card(root, plan, clock, choice, words, comparison, space, live, jobCards); // before the lists, whose height depends on it
  const robotList = new RobotList(root, plan, motion, clock, choice, words, live);
  const jobList = jobs && jobs.makeJobList(root, plan, clock, choice, words);
  const shiftViews =
    plan.shift && jobs?.ShiftViews
      ? new jobs.ShiftViews(root, plan, clock, choice, theme, words, diagram)
      : null;
  const decisionList = makeDecisionList(root, plan, clock, choice, words);
  const faultList = makeFaultList(root, plan, clock, choice, words);
  const tabs = new Tabs(
    root,
    {
      robots: plan.robots.length,
      jobs: plan.shift ? plan.shift.countKnown(0) : plan.jobs.length,
      shift: shiftViews && "",
      rounds: plan.shift && plan.shift.raw.rounds.length,
      decisions:
        plan.shift || (live && hasNoReasons(plan))
          ? null
          : hasNoReasons(plan)
            ? "–"
            : decisionList.items.length,
      faults: plan.faultCount || null,
      compared: comparison && comparison.plans.length,
      ends: live && live.punctuality.lateCount,
      log: plan.driven && plan.driven.story.length,
    },
    () => {
      robotList.refresh();
      jobList?.refresh();
      shiftViews?.refresh();
      decisionList.refresh();
      faultList.refresh();
      comparison?.refresh();
      live?.refreshLists();
    },
  );
  const deepLink = new DeepLink(root, plan, clock, choice);
  new Summary(root, plan, choice, words, comparison, jobCards);
  new Share(
    root,
    plan,
    clock,
    [mapView, ...(comparison?.views ?? [])],
    [diagram, ...(comparison?.diagrams ?? [])],
    theme,
    words,
    deepLink,
  );
  new Paper(root, plan, clock, theme, words, comparison, () => frames.paint(performance.now()));
  layOut();
  root.listen(window, "resize", layOut);
  for (const caption of root.all(".caption", HTMLElement))
    caption.classList.toggle("full", Boolean(plan.happened || plan.steady));
  for (const row of root.all(".help .repeats", HTMLElement)) row.hidden = !plan.steady;
  for (const row of root.all(".help .floor", HTMLElement)) row.hidden = !plan.happened;
  for (const row of root.all(".help .sized", HTMLElement)) row.hidden = !plan.hasSpace;
  listenToKeys(root, clock, choice, mapView.viewport, modeSwitch, loop);

  let written = NaN; // the tick that words are about
  const frames = new FrameLoop(
    clock,
    (paint) => root.ask(paint),
    () => {
      const { running } = clock;
      const { steady } = plan;
      // in a loop each group of robots has a period of its own
      const own =
        clock.loop && steady && ((/** @type {number} */ index) => steady.tickOf(index, running));
      motion.moveTo(clock.tick, own);
      if (choice.ghosts) ghosts.moveTo(clock.tick);
      mapView.paint();
      comparison?.paint();
      diagram.paint();
      transport.refresh();
      if (written === clock.wholeTick) return; // words change only when a tick is over, or by a choice
      written = clock.wholeTick;
      states.refresh();
      robotList.refresh();
      if (shiftViews) jobList?.refresh();
      live?.refresh();
      if (live) card.refresh();
    },
  );

  /** Put the diagram beside the map where the map is much larger so than above the diagram. */
  function layOut() {
    if (comparison) {
      comparison.layOut();
      return;
    }
    const { width, height } = plan.roadmap;
    const pane = 0.73 * innerWidth;
    const above = Math.min(pane / width, (0.73 * innerHeight - 200) / height);
    const beside = Math.min(pane / 2 / width, (innerHeight - 150) / height);
    element.classList.toggle("high", !root.isPart && beside > 1.25 * above);
  }

  /** Paint again what does not move. */
  function repaintAll() {
    mapView.base.stale = true;
    diagram.layer.stale = true;
    comparison?.repaint();
    frames.ask();
  }

  clock.on("tick", () => frames.ask());
  clock.on("playing", () => frames.ask());
  choice.on("choice", repaintAll);
  choice.on("heat", repaintAll);
  choice.on("bottleneck", repaintAll);
  choice.on("corridor", repaintAll);
  choice.on("space", repaintAll);
  clock.on("loop", repaintAll);
  for (const event of ["mode", "fleet"])
    choice.on(event, () => {
      written = NaN;
      repaintAll();
    });
  theme.on("theme", repaintAll);
  mapView.viewport.on("view", () => {
    mapView.base.stale = true;
    frames.ask();
  });
  root.observe(mapView.canvas, () => frames.ask());
  root.observe(diagram.canvas, () => frames.ask());

  const linked = deepLink.read();
  mapView.viewport.fit();
  if (plan.faultCount) tabs.show("faults");
  else if (comparison) tabs.show("compared");
  else if (shiftViews) tabs.show("shift");
  if (plan.noPlan && !linked) choice.chooseFault(0);
  frames.ask();
  if (
    !linked &&
    !plan.feed?.stream &&
    !plan.faultCount &&
    !root.isEmbedded &&
    !matchMedia("(prefers-reduced-motion: reduce)").matches
  )
    clock.play();

  return {
    destroy() {
      clock.pause();
      root.destroy();
      element.classList.remove("high", "compared", "faulty");
    },
  };
}
