/** What if: a robot of the plan is faster, works longer or has another home, or a place is closed. */

import { html, useEffect, useRef, useState } from "../vendor/htm-preact.js";
import { Field } from "../field.js";
import {
  Times,
  changeTime,
  textOfClosure,
  withClosure,
  withTime,
  withoutClosure,
} from "../draw/closures.js";
import { placeOfText } from "../draw/places.js";
import { pressedPlace } from "../draw/press_place.js";
import { COLUMNS, columnOf } from "../robots/columns.js";
import { changeRobots, robotsOf } from "../robots/fleet.js";
import { words } from "../words.js";
/** @import { Column, Complaint, Place, Props, TimeKey } from "../types.js" */
/** @import { ComponentChildren, PageEvent } from "../vendor/htm-preact.js" */

const ASKED = COLUMNS.filter(({ key }) => ["home", "stops", "work", "speed"].includes(key));

/**
 * `children` stand below the fields of the robot that is chosen.
 * @param {Props & {children?: ComponentChildren}} props
 */
export function Ask({ studio, children }) {
  const { store, stage } = studio;
  const robots = robotsOf(store.document) ?? [];
  const name = (stage.isPlan && stage.choice.robot?.name) || null;
  const index = name === null ? -1 : robots.findIndex((robot) => robot.name === name);
  const faults = store.faultsAt("robots", index);
  /**
   * @param {Column} column
   * @returns {boolean}
   */
  const isWrong = ({ key }) => faults.some((fault) => columnOf(fault) === key);
  /**
   * @param {Column} column
   * @param {string} text
   * @returns {void}
   */
  const write = (column, text) => {
    if (column.text(robots[index]) === text) return;
    studio.whatIf((document) =>
      changeRobots(document, [index], (robot) => column.set(robot, text)),
    );
  };
  return html`
    <section class="ask" aria-labelledby="ask-title"><h2 id="ask-title">${name === null || index < 0 ? words.whatIf : words.whatIfOf({ name })}</h2>
      ${
        index < 0
          ? html`<p class="hint">${robotsOf(store.document) ? words.chooseRobot : words.robotsElsewhere}</p>`
          : html`<div class="fields">${ASKED.map(
              (column) => html`
        <label title=${column.words(words)[1]}>${column.words(words)[0]}<${Field} key=${`${name} ${column.key}`} value=${column.text(robots[index])} placeholder=${column.words(words)[2] ?? ""}
          spellcheck="false" aria-invalid=${String(isWrong(column))} onChange=${({ target }) => write(column, target.value)} /></label>`,
            )}</div>`
      }
      ${faults.map(({ named, place, message }) => html`<p class="wrong" role="alert" lang="en">${named || place}: ${message}</p>`)}
      ${children}
      <${Close} studio=${studio} />
    </section>`;
}

/**
 * Close a place or, with both ends, a lane, for ever or for a while; and open it again.
 * @param {Props} props
 */
function Close({ studio }) {
  const { store } = studio;
  const [refused, setRefused] = useState(/** @type {Complaint[]} */ ([])); // faults of what is typed
  const [waiting, setWaiting] = useState(/** @type {AbortController | null} */ (null)); // that gives up the press on the map that is waited for
  /** @type {import("../vendor/htm-preact.js").Ref<HTMLFormElement>} */
  const form = useRef(null);
  useEffect(() => {
    studio.tell("change"); // the line below the map says it, too
    return () => waiting?.abort();
  }, [waiting]);
  /**
   * @param {(Place | undefined)[]} places
   * @returns {Promise<void>}
   */
  const close = (places) =>
    studio.attempt(async () => {
      const given = new FormData(form.current);
      const [from, until] = [String(given.get("from")), String(given.get("until"))];
      const [at, to] = places;
      const what = to === undefined || at === undefined ? { at } : { edge: [at, to] };
      const closure = withTime(withTime(what, "from", from), "until", until);
      const faults = await studio.tryOut((document) => withClosure(document, closure));
      setRefused(faults);
      if (!faults.length) form.current?.reset();
    });
  /**
   * @param {PageEvent} event
   * @returns {void}
   */
  const submit = (event) => {
    event.preventDefault();
    const [at, to] = form.current.querySelectorAll("input");
    if (at.value.trim()) close([at, to].map(({ value }) => placeOfText(value)));
    else at.focus();
  };
  const press = async () => {
    if (waiting) return setWaiting(null);
    const controller = new AbortController();
    setWaiting(controller);
    const places = await pressedPlace(studio, controller.signal);
    setWaiting((now) => (now === controller ? null : now));
    if (places.length) close(places);
    return null;
  };
  /**
   * Whether something is wrong with the end of a lane that is closed, or with both; a place is the first one.
   * @param {number} end
   */
  const isWrong = (end) =>
    String(
      refused.some(({ path: [, , key, at = end] = [] }) =>
        key === "edge" ? at === end : key === "at" && !end,
      ),
    );
  return html`
    <form class="close-place" ref=${form} onSubmit=${submit}>
      <div class="fields">
        <label>${words.closePlace}<input id="close-at" placeholder="N3" spellcheck="false" autocomplete="off" aria-invalid=${isWrong(0)} /></label>
        <label>${words.closeTo}<input id="close-to" placeholder="–" spellcheck="false" autocomplete="off" aria-invalid=${isWrong(1)} /></label>
      </div>
      <${Times} document=${store.document} faults=${refused} />
      ${refused.map(({ message }) => html`<p class="wrong" role="alert" lang="en">${message}</p>`)}
      <div class="buttons">
        <button type="submit" class="framed">${words.closeIt}</button>
        <button type="button" class="framed" aria-pressed=${String(Boolean(waiting))} onClick=${press}>${words.closeByPress}</button>
        <span class="hint">${waiting && words.pressToClose}</span>
      </div>
    </form>
    <${Closed} studio=${studio} />`;
}

/**
 * What is closed, and when; each can be changed, and opened again.
 * @param {Props} props
 */
function Closed({ studio }) {
  const { closures } = studio.store.document;
  if (!closures?.length) return null;
  return html`<ul class="closures">${closures.map((closure, index) => {
    const text = textOfClosure(closure);
    const faults = studio.store.faultsAt("closures", index);
    const open = () => studio.whatIf((document) => withoutClosure(document, index));
    const write = (/** @type {TimeKey} */ key, /** @type {string} */ time) =>
      studio.whatIf((document) => changeTime(document, index, key, time));
    return html`<li><span class="what">${words.closed}<b>${text}</b></span>
      <${Times} document=${studio.store.document} of=${text} faults=${faults} closure=${closure} write=${write} />
      <button type="button" class="quiet" aria-label=${`${words.openAgain}: ${text}`} title=${words.openAgain} onClick=${open}>✕</button>
      ${faults.map(({ message }) => html`<p class="wrong" role="alert" lang="en">${message}</p>`)}</li>`;
  })}</ul>`;
}
