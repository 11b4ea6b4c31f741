/** The robots as a spreadsheet beside the map: type, paste, fill down, sort; faults stand at their cells. */

import { html, useState } from "../vendor/htm-preact.js";
import { words } from "../words.js";
import { COLUMNS, columnOf } from "./columns.js";
import { addRobots, changeRobots, removeRobots, robotsOf, sortRobots, tableText } from "./fleet.js";
import { RandomFleet } from "./random.js";

const MOST_ROWS = 400; // that are written at once; the others on request

export function RobotPanel({ studio }) {
  const { store, editor } = studio;
  const robots = robotsOf(store.document);
  const [sorted, setSorted] = useState({ key: "", isDown: false });
  const [shown, setShown] = useState(MOST_ROWS);
  const [cell, setCell] = useState(null); // the one that was written last: { row, column }
  if (!robots) {
    return html`<div class="scroll">
      <div class="aside">
        <p>${words.robotsElsewhere}</p>
        <button
          type="button"
          class="framed"
          disabled=${!store.survey.ok}
          onClick=${() => studio.shelf.inline()}
        >
          ${words.writeHere}
        </button>
      </div>
    </div>`;
  }
  const faults = store.faults.filter(({ place }) => place.startsWith("robots"));
  const faultOf = (row, key) =>
    faults
      .filter(({ place }) => place.startsWith(`robots[${row}]`) && columnOf(place) === key)
      .map(({ message }) => message)
      .join(" ");
  const sort = (column) => {
    const isDown = sorted.key === column.key && !sorted.isDown;
    setSorted({ key: column.key, isDown });
    store.change((document) => sortRobots(document, column.value ?? column.text, isDown));
  };
  const write = (row, column, text) => {
    if (column.text(robots[row]) === text) return;
    store.change((document) => changeRobots(document, [row], (robot) => column.set(robot, text)));
  };
  const paste = (event, row, at) => {
    const rows = event.clipboardData
      .getData("text")
      .replace(/\r?\n$/, "")
      .split(/\r?\n/)
      .map((line) => line.split("\t"));
    if (rows.length === 1 && rows[0].length === 1) return;
    event.preventDefault();
    store.change((document) => pasted(document, rows, row, at));
  };
  const fill = () => {
    const column = COLUMNS[cell.column];
    const text = column.text(robots[cell.row]);
    const below = robots.map((_, index) => index).filter((index) => index > cell.row);
    store.change((document) => changeRobots(document, below, (robot) => column.set(robot, text)));
  };
  const select = (row, event) => {
    if (event.target.matches("input")) return;
    if (event.shiftKey || event.ctrlKey) editor.selection.toggle({ kind: "robot", id: row });
    else editor.select([{ kind: "robot", id: row }]);
    editor.changed();
  };
  return html` <div class="scroll">
      <div class="buttons">
        <button
          type="button"
          class="framed"
          onClick=${() => editor.take("robot")}
        >
          ${words.placeRobot}
        </button>
        <button
          type="button"
          class="framed"
          disabled=${cell === null || !["work", "speed", "radius", "turn", "laps"].includes(COLUMNS[cell.column].key)}
          onClick=${fill}
        >
          ${words.fillDown}
        </button>
        <button
          type="button"
          class="framed"
          disabled=${!robots.length}
          onClick=${() => navigator.clipboard.writeText(tableText(robots, COLUMNS))}
        >
          ${words.copyTable}
        </button>
      </div>
      ${faults.length > 0 && html`<p class="wrong" role="alert">${faults[0].named || faults[0].place}: ${faults[0].message}</p>`}
      ${
        robots.length > 0
          ? html` <div class="sheet">
                <table class="robots">
                  <thead>
                    <tr>
                      ${COLUMNS.map(
                        (column) =>
                          html`<th
                            scope="col"
                            aria-sort=${sorted.key === column.key ? (sorted.isDown ? "descending" : "ascending") : "none"}
                          >
                            <button
                              type="button"
                              title=${words.columns[column.key][1]}
                              onClick=${() => sort(column)}
                            >
                              ${words.columns[column.key][0]}
                            </button>
                          </th>`,
                      )}
                      <th><span class="unseen">${words.remove}</span></th>
                    </tr>
                  </thead>
                  <tbody onKeyDown=${moveInTable}>
                    ${robots.slice(0, shown).map(
                      (robot, row) =>
                        html` <tr
                          key=${row}
                          aria-selected=${String(editor.selection.has({ kind: "robot", id: row }))}
                          onClick=${(event) => select(row, event)}
                        >
                          ${COLUMNS.map((column, at) => {
                            const fault = faultOf(row, column.key);
                            return html`<td class=${column.key}>
                              <input
                                value=${column.text(robot)}
                                aria-label=${`${words.columns[column.key][0]}, ${robot.name}`}
                                aria-invalid=${String(Boolean(fault))}
                                title=${fault}
                                placeholder=${words.columns[column.key][2] ?? ""}
                                spellcheck="false"
                                onFocus=${() => {
                                  setCell({ row, column: at });
                                  editor.select([{ kind: "robot", id: row }]);
                                }}
                                onChange=${(event) => write(row, column, event.target.value)}
                                onPaste=${(event) => paste(event, row, at)}
                              />
                            </td>`;
                          })}
                          <td>
                            <button
                              type="button"
                              class="quiet"
                              aria-label=${`${words.remove} ${robot.name}`}
                              onClick=${() => store.change((document) => removeRobots(document, [row]))}
                            >
                              ✕
                            </button>
                          </td>
                        </tr>`,
                    )}
                  </tbody>
                </table>
              </div>
              ${robots.length > shown && html`<button type="button" class="framed" onClick=${() => setShown(shown + MOST_ROWS)}>${words.moreRows(robots.length - shown)}</button>`}`
          : html`<p class="hint">${words.noRobots}</p>`
      }
      <label class="wide paste"
        >${words.pasteTable}<textarea
          rows="1"
          aria-label=${words.pasteTable}
          onPaste=${(event) => paste(event, robots.length, 0)}
        ></textarea>
      </label>
      <${RandomFleet} studio=${studio} />
    </div>
    ${robots.length > 0 && html`<div class="next"><button type="button" class="framed strong" disabled=${!store.survey.ok} onClick=${() => studio.plan()}>${words.nextPlan}</button></div>`}`;
}

/** Rows of a spreadsheet, from a cell on; rows that are not there yet are added; headings are left out. */
function pasted(document, rows, row, at) {
  const heads = rows[0].map((text) => text.trim().toLowerCase());
  const keys = heads.map((head) => (head === "target" ? "stops" : head));
  const isHead =
    keys.filter((key) => COLUMNS.some((column) => column.key === key)).length > rows[0].length / 2;
  const columns = isHead
    ? keys.map((key) => COLUMNS.find((column) => column.key === key))
    : COLUMNS.slice(at);
  const lines = isHead ? rows.slice(1) : rows;
  const missing = row + lines.length - robotsOf(document).length;
  const next =
    missing > 0
      ? addRobots(
          document,
          Array.from({ length: missing }, () => ({})),
        )
      : document;
  const written = (robot, texts) =>
    texts.reduce((done, text, i) => (columns[i] ? columns[i].set(done, text) : done), robot);
  return changeRobots(
    next,
    lines.map((_, i) => row + i),
    (robot, index) => written(robot, lines[index - row]),
  );
}

/** Enter and the arrow keys go up and down in a column, as in a spreadsheet. */
function moveInTable(event) {
  const step = { Enter: event.shiftKey ? -1 : 1, ArrowDown: 1, ArrowUp: -1 }[event.key];
  if (!step || !event.target.matches("input")) return;
  event.preventDefault();
  const [cell, row] = [event.target.closest("td"), event.target.closest("tr")];
  const next = step > 0 ? row.nextElementSibling : row.previousElementSibling;
  const input = next?.children[cell.cellIndex]?.querySelector("input");
  if (input) input.focus();
  else event.target.blur();
}
