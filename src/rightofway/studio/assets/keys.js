/** Keys of the whole page; those of the map are with the editor, those of fields with the fields. */

import { TABS } from "./studio.js";
/** @import { Studio } from "./studio.js" */

/**
 * The key of each tool.
 * @type {Record<string, string>}
 */
export const TOOL_KEYS = {
  select: "v",
  line: "w",
  brush: "b",
  box: "r",
  door: "d",
  erase: "e",
  vertex: "n",
  lane: "l",
  mark: "s",
  robot: "a",
  job: "j",
  measure: "m",
};

const TOOL_OF = Object.fromEntries(Object.entries(TOOL_KEYS).map(([tool, key]) => [key, tool]));

/**
 * What stands in a field; undefined for what is none.
 * @param {EventTarget | null} target
 * @returns {unknown}
 */
const textIn = (target) => (target && "value" in target ? target.value : undefined);

/**
 * @param {Studio} studio
 * @returns {void}
 */
export function listenToKeys(studio) {
  const { store, editor, stage } = studio;
  /** @type {Record<string, (event: KeyboardEvent) => unknown>} */
  const withControl = {
    z: (event) => (event.shiftKey ? store.redo() : store.undo()),
    y: () => store.redo(),
    s: () => studio.shelf.save(),
    d: () => editor.tools.get("select").duplicate(),
    a: () => editor.select(editor.hits.inside([-Infinity, -Infinity, Infinity, Infinity])),
    Enter: () => studio.plan(),
  };
  /** @type {Record<string, () => unknown>} */
  const plain = {
    "+": () => stage.view.viewport.zoom(1.5),
    "=": () => stage.view.viewport.zoom(1.5),
    "-": () => stage.view.viewport.zoom(1 / 1.5),
    0: () => stage.view.viewport.fit(),
    "?": () => studio.help(!studio.isHelping),
    Delete: () => editor.isOn && editor.remove(),
  };
  /** @type {Record<string, () => unknown>} */
  const playing = {
    " ": () => stage.clock.toggle(),
    ArrowLeft: () => stage.clock.step(-1),
    ArrowRight: () => stage.clock.step(1),
    Escape: () => stage.choice.chooseNothing(),
  };
  /** @type {unknown} */
  let atFocus = ""; // what a field said when it was entered, or written last
  for (const name of ["focusin", "change"])
    document.addEventListener(name, ({ target }) => (atFocus = textIn(target)));
  document.addEventListener("keydown", (event) => {
    if (event.defaultPrevented || (studio.isStarting && event.key !== "?")) return;
    if (document.querySelector("dialog[open]")) return; // its keys are its own
    if (event.key === "Escape" && document.querySelector(":popover-open")) return; // it closes
    const target = /** @type {Element} */ (event.target);
    const isWriting = target.matches("input:not(#slider), select, textarea, [contenteditable]");
    const isControl = event.ctrlKey || event.metaKey;
    const isUndo = "zy".includes(event.key.toLowerCase()) && textIn(target) === atFocus; // nothing in the field to undo
    if (isControl && isWriting && !["s", "Enter"].includes(event.key) && !isUndo) return;
    if (!isControl && (isWriting || event.altKey)) return;
    const isPressing = target.matches("button, a, summary") && [" ", "Enter"].includes(event.key);
    const action = isControl
      ? withControl[event.key.length > 1 ? event.key : event.key.toLowerCase()]
      : isPressing
        ? null
        : (plain[event.key] ??
          (stage.isPlan ? playing[event.key] : null) ??
          forTab(event.key) ??
          forTool(event.key));
    if (!action) return;
    event.preventDefault();
    action(event);
  });

  /**
   * @param {string} key
   * @returns {(() => void) | null}
   */
  const forTab = (key) =>
    TABS[Number(key) - 1] ? () => studio.showTab(TABS[Number(key) - 1]) : null;
  /**
   * @param {string} key
   * @returns {(() => void) | null}
   */
  const forTool = (key) => (TOOL_OF[key] && editor.isOn ? () => editor.take(TOOL_OF[key]) : null);
}
