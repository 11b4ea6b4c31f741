/** The parts that a player makes in its element; `data-…` are keys of texts, see `writeMarkup`. */

/** What is below the pointer. */
const HOVER = `<div id="hover" class="hover" aria-live="off" hidden></div>`;

/** What lies on a map: legends, and what is below the pointer. */
export const LEGENDS = `
  <div class="legends">
    <div id="heat-legend" class="heat-legend" hidden>
      <span data-text="timeHeld" data-title="timeHeldAtLength"></span><span id="heat-scale" class="scale"></span>
    </div>
    <div id="space-legend" class="space-legend" hidden></div>
    <div id="bottleneck-legend" class="lit-legend" hidden><span class="lit"></span><span class="name"></span></div>
  </div>
  ${HOVER}
`;

/** What robots do now. */
export const STATES = `<ul id="states" class="states" data-label="states"></ul>`;

/** The moment that is shown, and how fast it plays. */
export const READOUT = `
    <output id="readout" class="readout" for="slider"></output>
    <label class="speed"><span data-text="speed"></span> <select id="speed"></select></label>
`;

/** Buttons and slider of time. */
export const TRANSPORT = `
  <div class="transport">
    <div class="buttons">
      <button type="button" id="back" data-label="back" data-title="back" data-key="←"><svg viewBox="0 0 20 20"><path d="M13.5 5 8 10l5.5 5M5.5 5v10"/></svg></button>
      <button type="button" id="play" class="play" data-label="play" data-title="playKey"><svg viewBox="0 0 20 20"><path class="play-sign" d="M6.5 4v12l10-6z"/><path class="pause-sign" d="M5.5 4h3v12h-3zM11.5 4h3v12h-3z"/></svg></button>
      <button type="button" id="forth" data-label="forth" data-title="forth" data-key="→"><svg viewBox="0 0 20 20"><path d="M6.5 5 12 10l-5.5 5M14.5 5v10"/></svg></button>
    </div>
    <input type="range" id="slider" min="0" step="any" value="0" data-label="time">
  </div>
`;

export const DIAGRAM = `
  <div class="diagram">
    <canvas id="diagram" role="img"></canvas>
    <div id="needle" class="needle" aria-hidden="true"></div>
  </div>
`;

/**
 * The tools of a map: attributes, the key of a page, the picture.
 *
 * @type {Record<string, [attributes: string, key: string, picture: string]>}
 */
const TOOLS = {
  "zoom-in": [
    'class="zoom" data-label="zoomIn" data-title="zoomIn"',
    "+",
    '<path d="M10 4.5v11M4.5 10h11"/>',
  ],
  "zoom-out": [
    'class="zoom" data-label="zoomOut" data-title="zoomOut"',
    "−",
    '<path d="M4.5 10h11"/>',
  ],
  fit: [
    'data-label="fit" data-title="fit"',
    "0",
    '<path d="M4 7.5V4h3.5M12.5 4H16v3.5M16 12.5V16h-3.5M7.5 16H4v-3.5"/>',
  ],
  bottleneck: [
    'aria-pressed="true" data-label="bottleneck" data-title="bottleneckAtLength"',
    "B",
    '<path d="M5.5 2.5V6L9 10l-3.500 4v3.500M14.5 2.5V6L11 10l3.500 4v3.500M4.5 2.5h11M4.5 17.5h11"/>',
  ],
  corridor: [
    'aria-pressed="false" data-label="corridor" data-title="corridorAtLength"',
    "C",
    '<circle cx="5" cy="15" r="2"/><circle cx="15" cy="5" r="2"/><path d="M5 13V8.500a3 3 0 0 1 3-3h5"/>',
  ],
  space: [
    'aria-pressed="false" data-label="space" data-title="spaceAtLength" hidden',
    "S",
    '<circle cx="6.500" cy="10" r="2.500"/><circle cx="6.500" cy="10" r="5" stroke-dasharray="2 2"/><path d="M11.500 10h6M15 7.500l2.500 2.500-2.500 2.500"/>',
  ],
  heat: [
    'aria-pressed="false" data-label="heat" data-title="heatAtLength"',
    "H",
    '<path d="M10 2.5c.6 3-3.800 4.800-3.800 8.600A4 4 0 0 0 10 15.5a4 4 0 0 0 3.800-4.400c0-1.700-.9-2.900-1.5-3.600-.2 1.200-.7 1.800-1.300 2.100.3-2.600-.2-5-1-7.100zM6 17.5h8"/>',
  ],
};

/**
 * Buttons of tools.
 *
 * @param {string[]} names
 * @param {{ withKeys?: boolean }} [options] whether their titles name the keys of a page
 */
export function toolButtons(names, { withKeys = false } = {}) {
  return names
    .map((name) => {
      const [attributes, key, picture] = TOOLS[name];
      const keyed = withKeys ? ` data-key="${key}"` : "";
      return `<button type="button" id="${name}" ${attributes}${keyed}><svg viewBox="0 0 20 20" aria-hidden="true">${picture}</svg></button>`;
    })
    .join("\n");
}

/**
 * The head of a page: its title, figures, and what one does with the whole page.
 *
 * @param {string} actions
 * @param {string} print the text that says what comes on paper
 */
const head = (actions, print) => `
<header class="summary">
  <h1 id="headline"></h1>
  <dl id="figures"></dl>
  <div class="actions">
    ${actions}
    <button type="button" id="print" class="quiet" data-text="print" data-title="${print}"></button>
    <select id="language" data-label="language"></select>
  </div>
</header>
`;

const CANVAS = `<canvas id="map" tabindex="0" role="img" aria-describedby="hover"></canvas>`;

/**
 * What stands below a map, and the tools that act on it.
 *
 * @param {string} left
 * @param {string[]} tools
 */
const below = (left, tools) => `
<div class="below">
  ${left}
  <div class="tools" role="toolbar" data-label="mapView">
    ${toolButtons(tools, { withKeys: true })}
  </div>
</div>
`;

const CARD = `<section id="card" class="card" aria-live="polite" hidden></section>`;

/**
 * A field that finds something in a list, and the list.
 *
 * @param {{ item: string, label: string, hint: string, find: string, key?: string, more?: string }} options
 */
export const foundList = ({ item, label, hint, find, key, more = "" }) => `
    <div class="find">
      <input type="search" id="find-${item}" data-hint="${hint}"${key ? ` data-key="${key}"` : ""} data-label="${find}" autocomplete="off" spellcheck="false">
      ${more}
    </div>
    <div id="${item}-list" class="list" role="listbox" tabindex="0" data-label="${label}"></div>
`;

/**
 * All of a player.
 *
 * @param {{ tab: string, panel: string }} [jobs] of the list of jobs
 * @param {typeof import("../live/live_markup.js").LIVE_MARKUP} [live] of a fleet that is driven
 */
export const makeMarkup = (
  { tab, panel } = { tab: "", panel: "" },
  live = { bar: "", aside: "", tab: "", panel: "", dialog: "" },
) => `
${head(
  `<button type="button" id="about-open" class="quiet" data-text="details" data-title="made"></button>
    <button type="button" id="copy-link" class="quiet" aria-live="polite" data-text="link" data-title="linkAtLength"></button>
    <button type="button" id="save-picture" class="quiet" data-text="picture" data-title="pictureAtLength"></button>`,
  "printAtLength",
)}
<main>
<div class="maps">
<section class="map" data-label="map">
  <h2 id="map-title" class="map-title" hidden></h2>
  ${CANVAS}
${LEGENDS}</section>
</div>
${below(STATES, ["zoom-in", "zoom-out", "fit", "bottleneck", "corridor", "space", "heat"])}

<section class="time" data-label="time">
  <h2 id="diagram-title"></h2>
  <div class="bar">
  <div class="caption">
    <fieldset id="mode" class="mode" hidden>
      <legend data-text="show"></legend>
      <label data-title="planAtLength" data-key="F"><input type="radio" name="mode" value="plan"><span data-text="plan"></span></label>
      <label data-title="floorAtLength" data-key="F"><input type="radio" name="mode" value="floor"><span data-text="floor"></span></label>
      <label data-title="bothAtLength" data-key="F"><input type="radio" name="mode" value="both"><span data-text="both"></span></label>
    </fieldset>
    ${live.bar}<button type="button" id="loop" class="quiet loop" aria-pressed="false" hidden><svg viewBox="0 0 20 20"><path d="M15.5 7A6.2 6.2 0 1 0 16 11.5M15.8 3.5V7.2H12"/></svg><span data-text="loop"></span></button>
    ${READOUT}
    <button type="button" id="help-open" class="quiet help-open" data-label="keys" data-title="keys" data-key="?">?</button>
  </div>
  ${TRANSPORT}
  </div>
  ${DIAGRAM}
</section>

</main>

<aside class="side" data-label="side">
${live.aside}  ${CARD}
  <div class="tabs" role="tablist">
    <button type="button" role="tab" id="tab-robots" aria-controls="robots" aria-selected="true"><span data-text="robots"></span> <b></b></button>${tab}
    <button type="button" role="tab" id="tab-decisions" aria-controls="decisions" aria-selected="false" tabindex="-1"><span data-text="decisions"></span> <b></b></button>
    <button type="button" role="tab" id="tab-faults" class="tab-faults" aria-controls="faults" aria-selected="false" tabindex="-1"><span data-text="faults"></span> <b></b></button>
    <button type="button" role="tab" id="tab-compared" aria-controls="compared" aria-selected="false" tabindex="-1"><span data-text="compared"></span> <b></b></button>${live.tab}
  </div>
  <div class="panel" id="robots" role="tabpanel" aria-labelledby="tab-robots">
    ${foundList({
      item: "robot",
      label: "robots",
      hint: "findRobot",
      find: "findRobot",
      more: `<button type="button" id="sort" class="quiet" aria-pressed="false" data-text="sort" data-title="sortAtLength"></button>`,
    })}
  </div>${panel}
  <div class="panel" id="decisions" role="tabpanel" aria-labelledby="tab-decisions" hidden>
    ${foundList({ item: "decision", label: "decisions", hint: "findPlace", find: "findDecision" })}
  </div>
  <div class="panel" id="faults" role="tabpanel" aria-labelledby="tab-faults" hidden>
    ${foundList({ item: "fault", label: "faults", hint: "findPlace", find: "findFault" })}
  </div>
  <div class="panel" id="compared" role="tabpanel" aria-labelledby="tab-compared" hidden>
    <div id="compared-figures" class="compared-wide figures-pane"></div>
    <div class="find">
      <input type="search" id="find-compared" data-hint="findRobot" data-label="findCompared" autocomplete="off" spellcheck="false">
    </div>
    <div id="compared-robots" class="compared-wide robots-pane"></div>
  </div>${live.panel}
</aside>

<section class="paper" aria-hidden="true">
  <p id="paper-moment"></p>
  <table id="paper-robots"></table>
</section>

<dialog id="about" class="about" data-label="details">
  <h2 data-text="made"></h2>
  <div id="made"></div>
  <form method="dialog"><button type="submit" data-text="close"></button></form>
</dialog>

${live.dialog}<dialog id="help" class="help" data-label="keys">
  <h2 data-text="keys"></h2>
  <dl>
    <dt><kbd data-text="spaceBar"></kbd></dt><dd data-text="keyPlay"></dd>
    <dt><kbd>←</kbd> <kbd>→</kbd></dt><dd data-text="keyStep"></dd>
    <dt><kbd data-text="shift"></kbd> <kbd>←</kbd> <kbd>→</kbd></dt><dd data-text="keyEvent"></dd>
    <dt><kbd data-text="home"></kbd> <kbd data-text="end"></kbd></dt><dd data-text="keyEnds"></dd>
    <dt><kbd>[</kbd> <kbd>]</kbd></dt><dd data-text="keyRate"></dd>
    <dt><kbd>+</kbd> <kbd>−</kbd> <kbd>0</kbd></dt><dd data-text="keyZoom"></dd>
    <dt><kbd>Tab</kbd> <span data-text="toTheMap"></span></dt><dd data-text="keyPan"></dd>
    <dt><kbd>H</kbd></dt><dd data-text="keyHeat"></dd>
    <dt><kbd>C</kbd></dt><dd data-text="keyCorridor"></dd>
    <dt class="sized"><kbd>S</kbd></dt><dd class="sized" data-text="keySpace"></dd>
    <dt class="repeats"><kbd>L</kbd></dt><dd class="repeats" data-text="keyLoop"></dd>
    <dt class="repeats"><kbd>B</kbd></dt><dd class="repeats" data-text="keyBottleneck"></dd>
    <dt class="floor"><kbd>F</kbd></dt><dd class="floor" data-text="keyMode"></dd>
    <dt><kbd>/</kbd></dt><dd data-text="keyFind"></dd>
    <dt><kbd>Esc</kbd></dt><dd data-text="keyEscape"></dd>
  </dl>
  <form method="dialog"><button type="submit" data-text="close"></button></form>
</dialog>
`;

/** All of the page of an inspection. */
export const INSPECTION = `
${head(
  `<label id="level-choice" class="speed" hidden><span data-text="level"></span> <select id="level"></select></label>`,
  "printFindings",
)}
<main>
<section class="map" data-label="map">
  ${CANVAS}
  ${HOVER}
</section>
${below(`<p id="size" class="states"></p>`, ["zoom-in", "zoom-out", "fit"])}
</main>

<aside class="side" data-label="findings">
  ${CARD}
  <details id="notes" class="notes" hidden><summary></summary><ul></ul></details>
  <div class="panel">
    ${foundList({ item: "finding", label: "findings", hint: "findWord", find: "findFinding", key: "/" })}
  </div>
</aside>

<section class="paper" aria-hidden="true"><div id="paper-findings"></div></section>
`;
