/** @import { Choice } from "./choice.js" */
/** @import { Clock } from "./clock.js" */
/** @import { Loop } from "./loop.js" */
/** @import { Root } from "../common/root.js" */
/** @import { ModeSwitch } from "./mode_switch.js" */
/** @import { Viewport } from "../drawing/viewport.js" */

/**
 * What the keyboard does wherever no text is being written.
 *
 * @param {Root} root
 * @param {Clock} clock
 * @param {Choice} choice
 * @param {Viewport} viewport
 * @param {ModeSwitch} modeSwitch
 * @param {Loop} loop
 */
export function listenToKeys(root, clock, choice, viewport, modeSwitch, loop) {
  const help = root.part("help", HTMLDialogElement);
  const about = root.part("about", HTMLDialogElement);
  const find = root.part("find-robot", HTMLInputElement);
  /** @type {Record<string, (event: KeyboardEvent) => unknown>} */
  const actions = {
    " ": () => clock.toggle(),
    /** @param {KeyboardEvent} event */
    ArrowLeft: (event) => (event.shiftKey ? clock.stepEvent(-1, choice.robot) : clock.step(-1)),
    /** @param {KeyboardEvent} event */
    ArrowRight: (event) => (event.shiftKey ? clock.stepEvent(1, choice.robot) : clock.step(1)),
    Home: () => clock.seek(0),
    End: () => clock.seek(clock.end),
    "[": () => clock.changeRate(-1),
    "]": () => clock.changeRate(1),
    "+": () => viewport.zoom(1.5),
    "=": () => viewport.zoom(1.5),
    "-": () => viewport.zoom(1 / 1.5),
    0: () => viewport.fit(),
    h: () => choice.toggleHeat(),
    c: () => choice.toggleCorridor(),
    s: () => choice.plan.hasSpace && choice.toggleSpace(),
    b: () => choice.toggleBottleneck(),
    l: () => loop.toggle(),
    f: () => modeSwitch.next(),
    "/": () => find.focus(),
    "?": () => help.showModal(),
    Escape: () => choice.chooseNothing(),
  };
  root.part("help-open").addEventListener("click", () => help.showModal());
  root.part("about-open").addEventListener("click", () => about.showModal());
  bindKeys(root, actions, () => help.open || about.open);
}

/**
 * Call an action when its key is pressed, wherever no text is being written.
 *
 * @param {Root} root
 * @param {Record<string, (event: KeyboardEvent) => unknown>} actions by their keys, letters in lower case
 * @param {() => boolean} [isCovered] whether something else has the keys now
 */
export function bindKeys(root, actions, isCovered = () => false) {
  root.listen(root.isPart ? root.element : document, "keydown", (event) => {
    if (!(event instanceof KeyboardEvent)) return;
    const action = actions[event.key.length === 1 ? event.key.toLowerCase() : event.key];
    const isControl = event.ctrlKey || event.metaKey || event.altKey;
    if (!action || isControl || isCovered() || isTaken(event)) return;
    event.preventDefault();
    action(event);
  });
}

/**
 * Whether the element that has the focus needs this key itself.
 *
 * @param {KeyboardEvent} event
 */
function isTaken(event) {
  const { target } = event;
  if (!(target instanceof Element)) return false;
  if (target.matches("input[type=search]")) return event.key !== "Escape";
  if (target.matches("select")) return true;
  if (target.matches("input[type=radio]"))
    return event.key === " " || event.key.startsWith("Arrow");
  return target.matches("button, [role=tab]") && event.key === " ";
}
