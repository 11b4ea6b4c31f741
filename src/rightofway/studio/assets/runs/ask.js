/** What if: a robot of the plan is faster, works longer or has another home, or a place is closed. */

import { html, useState } from "../vendor/htm-preact.js";
import { Field } from "../field.js";
import { placeOfText } from "../draw/places.js";
import { pressedPlace } from "../draw/press_place.js";
import { COLUMNS, columnOf } from "../robots/columns.js";
import { changeRobots, robotsOf } from "../robots/fleet.js";
import { words } from "../words.js";
import { textOfClosure, withClosure, withoutClosure } from "./closures.js";

const ASKED = COLUMNS.filter(({ key }) => ["home", "stops", "work", "speed"].includes(key));

export function Ask({ studio }) {
  const { store, stage } = studio;
  const robots = robotsOf(store.document) ?? [];
  const name = stage.isPlan ? stage.choice.robot?.name : undefined;
  const index = robots.findIndex((robot) => robot.name === name);
  const faults = store.faultsAt(`robots[${index}]`);
  const isWrong = ({ key }) => faults.some(({ place }) => columnOf(place) === key);
  const write = (column, text) => {
    if (column.text(robots[index]) === text) return;
    studio.whatIf((document) =>
      changeRobots(document, [index], (robot) => column.set(robot, text)),
    );
  };
  return html`
    <section class="ask" aria-labelledby="ask-title"><h2 id="ask-title">${index < 0 ? words.whatIf : words.whatIfOf(name)}</h2>
      ${
        index < 0
          ? html`<p class="hint">${words.chooseRobot}</p>`
          : html`<div class="fields">${ASKED.map(
              (column) => html`
        <label title=${words.columns[column.key][1]}>${words.columns[column.key][0]}<${Field} key=${`${name} ${column.key}`} value=${column.text(robots[index])} placeholder=${words.columns[column.key][2] ?? ""}
          spellcheck="false" aria-invalid=${String(isWrong(column))} onChange=${({ target }) => write(column, target.value)} /></label>`,
            )}</div>`
      }
      ${faults.map(({ named, place, message }) => html`<p class="wrong" role="alert" lang="en">${named || place}: ${message}</p>`)}
      <${Close} studio=${studio} />
    </section>`;
}

/** Close a place or, with both ends, a lane, for ever; and open it again. */
function Close({ studio }) {
  const { store } = studio;
  const [at, setAt] = useState("");
  const [to, setTo] = useState("");
  const [isPressing, setIsPressing] = useState(false);
  const close = (event) => {
    event.preventDefault();
    const places = [at, to].map(placeOfText);
    if (places[0] === undefined) return;
    studio.whatIf((document) => withClosure(document, ...places));
    setAt("");
    setTo("");
  };
  const press = async () => {
    setIsPressing(true);
    const places = await pressedPlace(studio);
    setIsPressing(false);
    if (places.length) studio.whatIf((document) => withClosure(document, ...places));
  };
  return html`
    <button type="button" class="framed" disabled=${isPressing} onClick=${press}>${isPressing ? words.pressToClose : words.closeByPress}</button>
    <form class="close-place" onSubmit=${close}>
      <label>${words.closePlace}<input id="close-at" value=${at} placeholder="N3" spellcheck="false" onInput=${({ target }) => setAt(target.value)} /></label>
      <label>${words.closeTo}<input id="close-to" value=${to} placeholder="–" spellcheck="false" onInput=${({ target }) => setTo(target.value)} /></label>
      <button type="submit" class="framed" disabled=${!at.trim()}>${words.closeIt}</button>
    </form>
    ${store.faultsAt("closures").map(({ named, place, message }) => html`<p class="wrong" role="alert" lang="en">${named || place}: ${message}</p>`)}
    ${
      store.document.closures?.length > 0 &&
      html`<ul class="closures">${store.document.closures.map((closure, index) => {
        const text = textOfClosure(closure);
        const open = () => studio.whatIf((document) => withoutClosure(document, index));
        return html`<li>${words.closed}: ${text} <button type="button" class="quiet" aria-label=${`${words.openAgain}: ${text}`} title=${words.openAgain} onClick=${open}>✕</button></li>`;
      })}</ul>`
    }`;
}
