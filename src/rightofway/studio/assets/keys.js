/** Keys of the whole page; those of the map are with the editor, those of fields with the fields. */

import { TABS } from "./studio.js";

/** The key of each tool. */
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
  measure: "m",
};

const TOOL_OF = Object.fromEntries(Object.entries(TOOL_KEYS).map(([tool, key]) => [key, tool]));

export function listenToKeys(studio) {
  const { store, editor, stage } = studio;
  const withControl = {
    z: (event) => (event.shiftKey ? store.redo() : store.undo()),
    y: () => store.redo(),
    s: () => studio.shelf.save(),
    d: () => editor.tools.get("select").duplicate(),
    a: () => editor.select(editor.hits.inside([-Infinity, -Infinity, Infinity, Infinity])),
    Enter: () => studio.plan(),
  };
  const plain = {
    "+": () => stage.view.viewport.zoom(1.5),
    "=": () => stage.view.viewport.zoom(1.5),
    "-": () => stage.view.viewport.zoom(1 / 1.5),
    0: () => stage.view.viewport.fit(),
    "?": () => studio.help(!studio.isHelping),
    Delete: () => editor.isOn && editor.remove(),
  };
  const playing = {
    " ": () => stage.clock.toggle(),
    ArrowLeft: () => stage.clock.step(-1),
    ArrowRight: () => stage.clock.step(1),
    Escape: () => stage.choice.chooseNothing(),
  };
  let atFocus = ""; // what a field said when it was entered, or written last
  for (const name of ["focusin", "change"])
    document.addEventListener(name, ({ target }) => (atFocus = target.value));
  document.addEventListener("keydown", (event) => {
    if (event.defaultPrevented || (studio.isStarting && event.key !== "?")) return;
    if (document.querySelector("dialog[open]")) return; // its keys are its own
    if (event.key === "Escape" && document.querySelector(":popover-open")) return; // it closes
    const isWriting = event.target.matches(
      "input:not(#slider), select, textarea, [contenteditable]",
    );
    const isControl = event.ctrlKey || event.metaKey;
    const isUndo = "zy".includes(event.key.toLowerCase()) && event.target.value === atFocus; // nothing in the field to undo
    if (isControl && isWriting && !["s", "Enter"].includes(event.key) && !isUndo) return;
    if (!isControl && (isWriting || event.altKey)) return;
    const isPressing =
      event.target.matches("button, a, summary") && [" ", "Enter"].includes(event.key);
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

  const forTab = (key) => (TABS[key - 1] ? () => studio.showTab(TABS[key - 1]) : null);
  const forTool = (key) => (TOOL_OF[key] && editor.isOn ? () => editor.take(TOOL_OF[key]) : null);
}
