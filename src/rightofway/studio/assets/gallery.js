/** Documents as cards: a small picture of the map, what it is, how many robots. */

import { UNREACHABLE, get, inAddress } from "./api.js";
import { html, useEffect, useRef, useState } from "./vendor/htm-preact.js";
import { figure, language } from "../../viz/page/assets/language/language.js";
import { words } from "./words.js";
import { present } from "./given.js";
/** @import { Glance } from "./api_types.js" */
/** @import { CardData } from "./types.js" */

const FIRST = 24; // cards of a list; the others on request
const NEAR = "200px"; // how far below the window a card may be when its picture is asked for

/**
 * What the server says of a document, or what is wrong with it.
 * @typedef {Glance | {trouble: string}} Seen
 */

/** @type {Map<string, Promise<Seen>>} */
const glances = new Map(); // by address and revision: what the server says, or what is wrong
/** @type {Promise<Seen>} */
let last = Promise.resolve({ trouble: "" }); // the last one that was asked for: one at a time, as they come in sight

/**
 * Look at a document: `source` is files, drafts or examples; `revision` changes with it.
 * @param {string} source
 * @param {string} name
 * @param {string | number} revision
 * @returns {Promise<Seen>}
 */
function glance(source, name, revision) {
  const isDark = matchMedia("(prefers-color-scheme: dark)").matches;
  const path = /** @type {const} */ (`/glances/${source}/${inAddress(name)}?dark=${isDark}`);
  const key = `${path} ${revision}`;
  if (!glances.has(key)) {
    /** @type {() => Promise<Seen>} */
    const ask = () =>
      get(path).catch(({ message, kind }) => {
        if (kind === UNREACHABLE) glances.delete(key); // it is asked for again
        return { trouble: message };
      });
    last = last.then(ask);
    glances.set(key, last);
  }
  return present(glances.get(key));
}

/**
 * A list of documents: `{ source, name, revision, title, note }`; `open` and perhaps `remove` take one.
 * @param {{documents: CardData[], open: (card: CardData) => void, remove?: (card: CardData) => void}} props
 */
export function Gallery({ documents, open, remove }) {
  const [most, setMost] = useState(FIRST);
  /** @param {CardData} each */
  const card = (each) =>
    html`<${Card} key=${`${each.source} ${each.name}`} document=${each} open=${open} remove=${remove} />`;
  return html`
    <ul class="gallery">${documents.slice(0, most).map(card)}</ul>
    ${documents.length > most && html`<button type="button" class="framed" onClick=${() => setMost(documents.length)}>${words.moreFiles({ count: documents.length - most })}</button>`}`;
}

/** @param {{document: CardData, open: (card: CardData) => void, remove?: (card: CardData) => void}} props */
function Card({ document, open, remove }) {
  const { source, name, revision, title, note } = document;
  const card = useRef(null);
  const [seen, setSeen] = useState(/** @type {Seen | null} */ (null));
  useEffect(() => {
    let isGone = false;
    /**
     * @param {IntersectionObserverEntry[]} entries
     * @returns {Promise<void>}
     */
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
  const found = seen && "kind" in seen ? seen : null;
  const about = found ? aboutOf(found, !note) : "";
  const below = [about, note].filter(Boolean).join(" · ");
  const why = seen && "trouble" in seen && { title: seen.trouble, lang: "en" }; // in the library's words
  return html`
    <li class="document" ref=${card}>
      <button type="button" class=${why ? "open foreign" : "open"} title=${why ? null : name} onClick=${() => open(document)}>
        <span class="picture" ...${why}>${found?.picture ? html`<img src=${found.picture} alt="" />` : html`<span class="none"></span>`}</span>
        <span class="name" ...${why}>${title}</span>
        <small>${why ? words.notRead : below || " "}</small>
      </button>
      ${remove && html`<button type="button" class="quiet" aria-label=${`${words.remove}: ${title}`} title=${words.remove} onClick=${() => remove(document)}>✕</button>`}
    </li>`;
}

/**
 * @param {Glance} seen
 * @param {boolean} hasRoom
 * @returns {string}
 */
function aboutOf({ kind, robots, extent: [width, height], unit }, hasRoom) {
  const size = unit && hasRoom ? figure(`${width} × ${height} ${unit}`) : "";
  const what = kind === "layout" ? words.mapAlone : words.robotCount({ count: robots ?? 0 });
  return [kind === "plan" ? words.planOf({ what }) : what, size].filter(Boolean).join(" · ");
}

/** @type {[Intl.RelativeTimeFormatUnit, number][]} */
const UNITS = [
  ["day", 86400],
  ["hour", 3600],
  ["minute", 60],
]; // [s]

/**
 * When something was, as a person says it: "5 minutes ago".
 * @param {number} seconds
 * @returns {string}
 */
export function ago(seconds) {
  const past = seconds - Date.now() / 1000;
  const format = new Intl.RelativeTimeFormat(language, {
    numeric: "auto",
    style: "short",
  });
  for (const [unit, length] of UNITS)
    if (-past >= length) return format.format(Math.round(past / length), unit);
  return format.format(0, "minute");
}
