/** Everything below a map on which a plan is played: signs, buttons, slider, diagram; and the card beside it. */

import { Bottleneck } from "../../../viz/page/assets/bottleneck.js";
import { Card } from "../../../viz/page/assets/card.js";
import { Diagram } from "../../../viz/page/assets/diagram.js";
import { writeMarkup } from "../../../viz/page/assets/language.js";
import { States } from "../../../viz/page/assets/states.js";
import { Transport } from "../../../viz/page/assets/transport.js";
import { Use } from "../../../viz/page/assets/use.js";
import { later } from "../given.js";
/** @import { MapView } from "../../../viz/page/assets/map_view.js" */
/** @import { Stage } from "../stage.js" */

/**
 * @param {string} path
 * @returns {string}
 */
const icon = (path) => `<svg viewBox="0 0 20 20" aria-hidden="true">${path}</svg>`;

const BELOW = `<ul id="states" class="states" data-label="states"></ul><div class="tools" role="toolbar" data-label="mapView">
<button type="button" id="bottleneck" data-label="bottleneck" data-title="bottleneckAtLength" aria-pressed="true" hidden>${icon('<path d="M5.5 2.500V6L9 10l-3.500 4v3.500M14.500 2.500V6L11 10l3.500 4v3.500M4.500 2.500h11M4.500 17.500h11"/>')}</button>
<button type="button" id="space" data-label="space" data-title="spaceAtLength" aria-pressed="false">${icon('<circle cx="6.5" cy="10" r="2.5"/><circle cx="6.5" cy="10" r="5" stroke-dasharray="2 2"/><path d="M11.5 10h6M15 7.5l2.5 2.5-2.5 2.5"/>')}</button>
<button type="button" id="heat" data-label="heat" data-title="heatAtLength" aria-pressed="false">${icon('<path d="M10 2.5c.6 3-3.800 4.800-3.800 8.600A4 4 0 0 0 10 15.500a4 4 0 0 0 3.800-4.400c0-1.700-.9-2.900-1.500-3.600-.2 1.200-.7 1.800-1.300 2.100.3-2.600-.2-5-1-7.100zM6 17.500h8"/>')}</button></div>`;

const TIME = `<h2 id="diagram-title"></h2><div class="bar"><div class="caption">
<output id="readout" class="readout" for="slider"></output><label class="speed"><span data-text="speed"></span> <select id="speed"></select></label></div>
<div class="transport"><div class="buttons">
<button type="button" id="back" data-label="back" data-title="back" data-key="←">${icon('<path d="M13.5 5 8 10l5.5 5M5.5 5v10"/>')}</button>
<button type="button" id="play" class="play" data-label="play" data-title="playKey">${icon('<path class="play-sign" d="M6.5 4v12l10-6z"/><path class="pause-sign" d="M5.5 4h3v12h-3zM11.5 4h3v12h-3z"/>')}</button>
<button type="button" id="forth" data-label="forth" data-title="forth" data-key="→">${icon('<path d="M6.5 5 12 10l-5.5 5M14.5 5v10"/>')}</button></div>
<input type="range" id="slider" min="0" step="any" value="0" data-label="time"></div></div>
<div class="diagram"><canvas id="diagram" role="img"></canvas><div id="needle" class="needle" aria-hidden="true"></div></div>`;

export class Player {
  /** @type {Diagram} */
  diagram = later();
  /** @type {Transport} */
  transport = later();
  /** @type {States} */
  states = later();
  observer = new ResizeObserver(() => this.stage.ask()); // of the diagram

  /** @param {Stage} stage */
  constructor(stage) {
    const { plan, clock, choice, motion, words: said, theme, below, time, card, root } = stage;
    this.stage = stage;
    this.plan = plan;
    this.clock = clock;
    this.choice = choice;
    this.motion = motion;
    this.words = said;
    this.theme = theme;
    this.below = below;
    this.card = card;
    below.innerHTML = BELOW;
    time.innerHTML = TIME;
    writeMarkup();
    this.use = new Use(plan);
    this.bottleneck = new Bottleneck(root, plan, clock, choice, theme, said);
  }

  /**
   * Begin to show, beside the view of the map.
   * @param {MapView} view
   * @returns {void}
   */
  begin(view) {
    const { plan, clock, choice, motion, words: said, theme } = this;
    const { root } = this.stage;
    this.diagram = new Diagram(root, plan, clock, choice, theme, said, this.use, this.bottleneck);
    this.transport = new Transport(root, plan, clock, said);
    this.states = new States(root, motion, choice);
    this.observer.observe(this.diagram.canvas);
    new Card(root, plan, clock, choice, said, null, view.space);
    this.card.hidden = true;
    /**
     * @param {string} id
     * @param {() => void} action
     * @returns {void}
     */
    const press = (id, action) => root.part(id).addEventListener("click", action);
    /**
     * @param {string} id
     * @param {boolean} isOn
     * @returns {void}
     */
    const shows = (id, isOn) => root.part(id).setAttribute("aria-pressed", String(isOn));
    press("heat", () => choice.toggleHeat());
    press("space", () => choice.toggleSpace());
    root.part("space").hidden = !plan.hasSpace;
    choice.on("space", () => shows("space", choice.space));
    choice.on("heat", () => {
      shows("heat", choice.heat);
      root.part("heat-legend").hidden = !choice.heat;
      const marks = [0, this.use.most].map((ticks) =>
        Object.assign(document.createElement("span"), { textContent: said.duration(ticks) }),
      );
      root.part("heat-scale").replaceChildren(...marks);
    });
  }

  end() {
    this.observer.disconnect();
    this.clock.playing = false;
  }

  repaint() {
    this.diagram.layer.stale = true;
  }

  paint() {
    this.diagram.paint();
    this.transport.refresh();
    this.states.refresh();
  }
}
