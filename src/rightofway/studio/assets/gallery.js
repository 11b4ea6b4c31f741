/** Documents as cards: a small picture of the map, what it is, how many robots. */

import { get, inAddress } from "./api.js";
import { html, useEffect, useRef, useState } from "./vendor/htm-preact.js";
import { language, words } from "./words.js";

const FIRST = 24; // cards of a list; the others on request
const NEAR = "200px"; // how far below the window a card may be when its picture is asked for

const glances = new Map(); // by address and revision: what the server says, or what is wrong
let last = Promise.resolve(); // the last one that was asked for: one at a time, as they come in sight

/** Look at a document: `source` is files, drafts or examples; `revision` changes with it. */
function glance(source, name, revision) {
  const isDark = matchMedia("(prefers-color-scheme: dark)").matches;
  const path = `/glances/${source}/${inAddress(name)}?dark=${isDark}`;
  const key = `${path} ${revision}`;
  if (!glances.has(key)) {
    last = last.then(() => get(path)).catch(({ message }) => ({ trouble: message }));
    glances.set(key, last);
  }
  return glances.get(key);
}

/** A list of documents: `{ source, name, revision, title, note }`; `open` and perhaps `remove` take one. */
export function Gallery({ documents, open, remove }) {
  const [most, setMost] = useState(FIRST);
  const card = (each) =>
    html`<${Card} key=${`${each.source} ${each.name}`} document=${each} open=${open} remove=${remove} />`;
  return html`
    <ul class="gallery">${documents.slice(0, most).map(card)}</ul>
    ${documents.length > most && html`<button type="button" class="framed" onClick=${() => setMost(documents.length)}>${words.moreFiles(documents.length - most)}</button>`}`;
}

function Card({ document, open, remove }) {
  const { source, name, revision, title, note } = document;
  const card = useRef(null);
  const [seen, setSeen] = useState(null);
  useEffect(() => {
    let isGone = false;
    const look = async ([{ isIntersecting }]) => {
      if (!isIntersecting) return;
      watcher.disconnect();
      const found = await glance(source, name, revision);
      if (!isGone) setSeen(found);
    };
    const watcher = new IntersectionObserver(look, { rootMargin: NEAR });
    watcher.observe(card.current);
    return () => {
      isGone = true;
      watcher.disconnect();
    };
  }, [source, name, revision]);
  const about = seen && !seen.trouble ? aboutOf(seen, !note) : "";
  const below = [about, note].filter(Boolean).join(" · ");
  const why = seen?.trouble && { title: seen.trouble, lang: "en" }; // in the library's words
  return html`
    <li class="document" ref=${card}>
      <button type="button" class=${why ? "open foreign" : "open"} title=${why ? null : name} onClick=${() => open(document)}>
        <span class="picture" ...${why}>${seen?.picture ? html`<img src=${seen.picture} alt="" />` : html`<span class="none"></span>`}</span>
        <span class="name" ...${why}>${title}</span>
        <small>${why ? words.notRead : below || " "}</small>
      </button>
      ${remove && html`<button type="button" class="quiet" aria-label=${`${words.remove}: ${title}`} title=${words.remove} onClick=${() => remove(document)}>✕</button>`}
    </li>`;
}

function aboutOf({ kind, robots, extent: [width, height], unit }, hasRoom) {
  const size = unit && hasRoom ? `${width} × ${height} ${unit}` : "";
  const what = kind === "layout" ? words.mapAlone : words.robotCount(robots);
  return [kind === "plan" ? words.planOf(what) : what, size].filter(Boolean).join(" · ");
}

/** When something was, as a person says it: "5 minutes ago". */
export function ago(seconds) {
  const past = seconds - Date.now() / 1000;
  const format = new Intl.RelativeTimeFormat(language, {
    numeric: "auto",
    style: "narrow",
  });
  for (const [unit, length] of [
    ["day", 86400],
    ["hour", 3600],
    ["minute", 60],
  ])
    if (-past >= length) return format.format(Math.round(past / length), unit);
  return format.format(0, "minute");
}
