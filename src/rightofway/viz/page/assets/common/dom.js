/** @import { Robot } from "../plan/robot.js" */

/**
 * Whether an element is in a frame of another page, or in a player that is a part of one.
 *
 * @param {Element} within
 */
export function isEmbedded(within) {
  return window.parent !== window || Boolean(within.closest(".part"));
}

/**
 * The data that a page was written with.
 *
 * @param {Document} page
 */
export function payloadOf(page) {
  const data = page.getElementById("payload");
  if (!data) throw new Error("page: there are no data (look at the template)");
  return JSON.parse(data.textContent);
}

/**
 * All elements that a selector finds.
 *
 * @template {Element} E
 * @param {string} selector
 * @param {new () => E} Kind their class; elements of others are left out
 * @param {ParentNode} [within]
 * @returns {E[]}
 */
export function all(selector, Kind, within = document) {
  /** @type {E[]} */
  const found = [];
  for (const each of within.querySelectorAll(selector)) if (each instanceof Kind) found.push(each);
  return found;
}

/**
 * Make an element. Text is always text, never markup: names come from strangers' files.
 *
 * @template {keyof HTMLElementTagNameMap} K
 * @param {K} tag
 * @param {Partial<Omit<HTMLElementTagNameMap[K], "style">>} [properties]
 * @param {...(Node | string)} children
 * @returns {HTMLElementTagNameMap[K]}
 */
export function element(tag, properties = {}, ...children) {
  const made = document.createElement(tag);
  Object.assign(made, properties);
  made.append(...children);
  return made;
}

/**
 * A dot in a robot's colour.
 *
 * @param {Robot} robot
 */
export function swatch(robot) {
  const dot = element("span", { className: "swatch" });
  dot.style.setProperty("--robot", robot.colour);
  return dot;
}

/**
 * A button that reads as part of a sentence.
 *
 * @param {string} text
 * @param {() => void} action
 */
export function link(text, action) {
  const button = element("button", { type: "button", className: "link name" }, text);
  button.addEventListener("click", action);
  return button;
}

/**
 * A line of a list: a time, and what happens then; pressing it goes there.
 *
 * @param {string} time
 * @param {string} text
 * @param {() => void} action
 */
export function goTo(time, text, action) {
  const button = element(
    "button",
    { type: "button", className: "go" },
    element("time", {}, time),
    element("span", { className: "name" }, text),
  );
  button.addEventListener("click", action);
  return element("li", {}, button);
}

/**
 * Terms and what they are; leaves out those without.
 *
 * @param {[string, string | Node | null][]} pairs
 */
export function facts(pairs) {
  const given = pairs.filter(([, value]) => value !== null && value !== "");
  return element(
    "dl",
    { className: "facts" },
    ...given.flatMap(([term, value]) => [element("dt", {}, term), element("dd", {}, value ?? "")]),
  );
}
