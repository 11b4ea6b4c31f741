import { foundList } from "../player/markup.js";

/** The parts of a page that only a fleet that is driven has, by their places. */
export const LIVE_MARKUP = {
  bar: `<div id="live-box" class="live-box" hidden>
      <button type="button" id="live" class="quiet live" aria-pressed="false" data-text="live" data-title="liveAtLength"></button>
      <output id="live-state" class="live-state"></output>
      <button type="button" id="wall" class="quiet" aria-pressed="false" data-text="wall" data-title="wallAtLength"></button>
    </div>
    `,
  aside: `  <p id="lost" class="lost" role="alert" data-text="lost" hidden></p>
  <section id="alarms" class="alarms" aria-live="polite" aria-labelledby="alarm-title" hidden>
    <h2 id="alarm-title" data-text="alarms"></h2>
    <form id="seen-form" class="seen" hidden><button type="submit" class="quiet" data-text="seenAll"></button></form>
    <ul id="alarm-list"></ul>
  </section>
  <section id="hold-ups" class="alarms calm" aria-labelledby="hold-up-title" hidden>
    <h2 id="hold-up-title" data-text="holdUps"></h2>
    <ul id="hold-up-list"></ul>
  </section>
  <div id="orders" class="orders" role="toolbar" data-label="orders" hidden>
    <button type="button" id="hold-all" class="quiet" data-text="holdAll"></button>
    <button type="button" id="stop-all" class="quiet" data-text="stopAll"></button>
    <button type="button" id="go-all" class="quiet" data-text="goAll"></button>
    <button type="button" id="hold-one" class="quiet" data-text="holdOne" hidden></button>
    <button type="button" id="clear-one" class="quiet" data-text="clearOne" hidden></button>
    <button type="button" id="remove-one" class="quiet" data-text="removeOne" hidden></button>
    <button type="button" id="place-one" class="quiet" data-text="placeOne" hidden></button>
    <label class="person" data-title="personAtLength"><span data-text="person"></span> <input type="text" id="person" form="seen-form" maxlength="40" autocomplete="name" required></label>
    <output id="order-answer"></output>
    <p id="last-order" class="last-order" role="status" hidden></p>
  </div>
`,
  tab: `
    <button type="button" role="tab" id="tab-ends" aria-controls="ends" aria-selected="false" tabindex="-1" data-title="endsAtLength"><span data-text="ends"></span> <b></b></button>
    <button type="button" role="tab" id="tab-log" aria-controls="log" aria-selected="false" tabindex="-1"><span data-text="log"></span> <b></b></button>`,
  panel: `
  <div class="panel" id="ends" role="tabpanel" aria-labelledby="tab-ends" hidden>
    <p id="ends-sums" class="ends-sums"></p>
    ${foundList({
      item: "end",
      label: "ends",
      hint: "findEnd",
      find: "findEnd",
      more: `<button type="button" id="ends-by-robot" class="quiet" aria-pressed="false" data-text="endsByRobot"></button>`,
    })}
  </div>
  <div class="panel" id="log" role="tabpanel" aria-labelledby="tab-log" hidden>
    ${foundList({ item: "told", label: "log", hint: "findPlace", find: "findTold" })}
  </div>`,
  dialog: `<dialog id="order-confirm" class="about" aria-labelledby="order-question">
  <p id="order-question"></p>
  <label id="order-place" class="order-place" hidden><span data-text="orderAt"></span> <input type="text" id="order-at" autocomplete="off" spellcheck="false"></label>
  <form method="dialog">
    <button type="submit" id="order-yes" data-text="yes"></button>
    <button type="submit" data-text="cancel"></button>
  </form>
</dialog>

`,
};
