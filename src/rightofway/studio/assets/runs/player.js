/** Everything below a map on which a plan is played: signs, buttons, slider, diagram; and the card beside it. */

import { Bottleneck } from "../../../viz/page/assets/timetable/bottleneck.js";
import { JobCards } from "../../../viz/page/assets/jobs/job_cards.js";
import { Card } from "../../../viz/page/assets/lists/card.js";
import { Diagram } from "../../../viz/page/assets/timetable/diagram.js";
import { writeMarkup } from "../../../viz/page/assets/language/language.js";
import {
  DIAGRAM,
  READOUT,
  STATES,
  TRANSPORT,
  toolButtons,
} from "../../../viz/page/assets/player/markup.js";
import { States } from "../../../viz/page/assets/lists/states.js";
import { Transport } from "../../../viz/page/assets/player/transport.js";
import { Use } from "../../../viz/page/assets/plan/use.js";
import { later } from "../given.js";
/** @import { MapView } from "../../../viz/page/assets/map/map_view.js" */
/** @import { Stage } from "../stage.js" */

const BELOW = `${STATES}<div class="tools" role="toolbar" data-label="mapView">${toolButtons(["bottleneck", "space", "heat"])}</div>`;

const TIME = `<h2 id="diagram-title"></h2><div class="bar"><div class="caption">${READOUT}</div>${TRANSPORT}</div>${DIAGRAM}`;

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
    this.bottleneck = new Bottleneck(root, plan, clock, choice, theme);
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
    const jobs = plan.tours.length ? new JobCards(plan, clock, choice, said) : null;
    this.diagram.jobs = view.jobs;
    new Card(root, plan, clock, choice, said, null, view.space, null, jobs);
    this.card.hidden = true;
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
