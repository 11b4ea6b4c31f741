/** Whether the page is part of another one, such as a notebook. */
export const EMBEDDED = Boolean(document.isPart) || window.parent !== window;

/** Make an element. Text is always text, never markup: names come from strangers' files. */
export function element(tag, properties = {}, ...children) {
  const made = Object.assign(document.createElement(tag), properties);
  made.append(...children);
  return made;
}

/** Words of the library that have no translation: marked, so that they are read out rightly. */
export function english(text) {
  return text && element("span", { lang: "en" }, text);
}

/** A dot in a robot's colour. */
export function swatch(robot) {
  const dot = element("span", { className: "swatch" });
  dot.style.setProperty("--robot", robot.colour);
  return dot;
}

/** A button that reads as part of a sentence. */
export function link(text, action) {
  const button = element("button", { type: "button", className: "link name" }, text);
  button.addEventListener("click", action);
  return button;
}

/** A line of a list: a time, and what happens then; pressing it goes there. */
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

/** Terms and what they are; leaves out those without. */
export function facts(pairs) {
  const given = pairs.filter(([, value]) => value !== null && value !== "");
  return element(
    "dl",
    { className: "facts" },
    ...given.flatMap(([term, value]) => [element("dt", {}, term), element("dd", {}, value)]),
  );
}
