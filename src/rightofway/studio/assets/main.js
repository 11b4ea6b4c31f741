/** The page: a head, tools at the left, the map in the middle, what is said about it at the right. */

import { html, render, useEffect, useReducer, useRef, useState } from "./vendor/htm-preact.js";
import { showBusyOn } from "./busy.js";
import { Elsewhere } from "./elsewhere.js";
import { Header } from "./header.js";
import { Help } from "./help.js";
import { listenToKeys } from "./keys.js";
import { Notice } from "./notices.js";
import { ContextMenu } from "./draw/context_menu.js";
import { MapPanel } from "./draw/panel.js";
import { PlanPanel } from "./runs/panel.js";
import { Rail } from "./draw/rail.js";
import { JobPanel } from "./jobs/panel.js";
import { RobotPanel } from "./robots/panel.js";
import { droppedFiles } from "./shelf.js";
import { SideEdge } from "./side_width.js";
import { Start } from "./start.js";
import { Status } from "./status.js";
import { Studio, TABS } from "./studio.js";
import { words } from "./words.js";
/** @import { Props, Tab } from "./types.js" */

/** @type {Record<string, number>} */
const STEPS = { ArrowRight: 1, ArrowLeft: -1 };

const PANELS = { map: MapPanel, robots: RobotPanel, jobs: JobPanel, plan: PlanPanel };

function App() {
  const [studio, setStudio] = useState(/** @type {Studio | null} */ (null));
  const [, refresh] = useReducer((/** @type {number} */ count) => count + 1, 0);
  const [holder, below, time, card] = [useRef(null), useRef(null), useRef(null), useRef(null)];
  useEffect(() => {
    const made = new Studio({
      holder: holder.current,
      below: below.current,
      time: time.current,
      card: card.current,
    });
    showBusyOn(holder.current);
    made.on("change", () => refresh(null));
    listenToKeys(made);
    listenToDrops(made);
    setStudio(made);
    made.begin();
  }, []);
  const isStarting = !studio || studio.isStarting;
  const tab = studio?.tab ?? "map";
  return html`
    ${studio && html`<${Header} studio=${studio} />`}
    <main hidden=${isStarting}>
    ${studio && !isStarting && html`<${Rail} studio=${studio} />`}
    <section class="map" aria-label=${words.map}><div class="holder" ref=${holder}></div></section>
    <div class="below" ref=${below} hidden=${!studio?.stage.isPlan}></div>
    <section class="time" aria-label=${words.time} ref=${time} hidden=${!studio?.stage.isPlan}></section>
    ${studio && !isStarting && html`<${Status} studio=${studio} />`}
    </main>
    <aside class="side" aria-label=${words.side} hidden=${isStarting}>
      <${SideEdge} />
      ${studio && html`<${Tabs} studio=${studio} />`}
      <section id="card" class="card" aria-live="polite" ref=${card} hidden></section>
      <div class="panel" role="tabpanel" id="panel" aria-labelledby=${`tab-${tab}`}>
        ${studio && !isStarting && html`<${PANELS[tab]} studio=${studio} />`}
      </div>
    </aside>
    ${studio && isStarting && html`<${Start} studio=${studio} />`}
    ${studio && html`<${Notice} notices=${studio.notices} />`}
    ${studio && !isStarting && studio.store.elsewhere && html`<${Elsewhere} studio=${studio} />`}
    ${studio?.editor.menu && html`<${ContextMenu} studio=${studio} />`}
    ${studio?.isHelping && html`<${Help} studio=${studio} />`}`;
}

/**
 * What there is to do, in the order in which one does it.
 * @param {Props} props
 */
function Tabs({ studio }) {
  const { store, runs } = studio;
  const { robots, jobs } = store.document ?? {};
  const isShown = runs.payload !== null;
  const counts = {
    map:
      store.faults.length +
        store.survey.findings.filter(({ severity }) => severity !== "note").length || "",
    robots: Array.isArray(robots) ? robots.length : "",
    jobs: Array.isArray(jobs) ? jobs.length : "",
    plan: isShown ? `${words.number} ${runs.shown}` : "",
  };
  /**
   * @param {Tab} tab
   * @returns {void}
   */
  const go = (tab) => {
    studio.showTab(tab);
    document.getElementById(`tab-${tab}`)?.focus();
  };
  /**
   * @param {KeyboardEvent} event
   * @returns {void}
   */
  const key = (event) => {
    const step = STEPS[event.key];
    if (step) go(TABS[(TABS.indexOf(studio.tab) + step + TABS.length) % TABS.length]);
  };
  return html`
    <div class="tabs" role="tablist" onKeyDown=${key}>${TABS.map(
      (tab) => html`
      <button type="button" role="tab" id=${`tab-${tab}`} aria-controls="panel" aria-selected=${String(studio.tab === tab)}
        tabIndex=${studio.tab === tab ? 0 : -1} onClick=${() => studio.showTab(tab)}>${words.tabs[tab]} <b>${counts[tab]}</b></button>`,
    )}
    </div>`;
}

/**
 * Files can be dropped anywhere.
 * @param {Studio} studio
 * @returns {void}
 */
function listenToDrops(studio) {
  const { body } = document;
  document.addEventListener("dragover", (event) => {
    event.preventDefault();
    body.classList.add("dropping");
  });
  /** @type {(event: DragEvent) => void} */
  const leave = ({ relatedTarget }) => {
    if (!relatedTarget) body.classList.remove("dropping");
  };
  document.addEventListener("dragleave", leave);
  document.addEventListener("drop", leave);
  document.addEventListener("drop", (event) => {
    event.preventDefault();
    const { dataTransfer } = event;
    if (dataTransfer?.files.length)
      studio.attempt(async () => studio.shelf.take(await droppedFiles(dataTransfer)));
  });
}

render(html`<${App} />`, document.body);
