/** What the keyboard does wherever no text is being written. */
export function listenToKeys(clock, choice, viewport, modeSwitch, loop) {
  const help = document.getElementById("help");
  const about = document.getElementById("about");
  const find = document.getElementById("find-robot");
  const actions = {
    " ": () => clock.toggle(),
    ArrowLeft: (event) => (event.shiftKey ? clock.stepEvent(-1, choice.robot) : clock.step(-1)),
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
  document.getElementById("help-open").addEventListener("click", () => help.showModal());
  document.getElementById("about-open").addEventListener("click", () => about.showModal());
  document.addEventListener("keydown", (event) => {
    const action = actions[event.key.length === 1 ? event.key.toLowerCase() : event.key];
    if (
      !action ||
      help.open ||
      about.open ||
      event.ctrlKey ||
      event.metaKey ||
      event.altKey ||
      isTaken(event)
    )
      return;
    event.preventDefault();
    action(event);
  });
}

/** Whether the element that has the focus needs this key itself. */
function isTaken(event) {
  const { target } = event;
  if (target.matches("input[type=search]")) return event.key !== "Escape";
  if (target.matches("select")) return true;
  if (target.matches("input[type=radio]"))
    return event.key === " " || event.key.startsWith("Arrow");
  return target.matches("button, [role=tab]") && event.key === " ";
}
