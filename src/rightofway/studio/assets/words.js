/** Every text of the studio, in one place for each language. */

const TEXTS = {
  en: {
    files: "Files",
    drop: "Drop a file here",
    runs: "Runs",
    planner: "Planner",
    limit: "Time limit [s]",
    plan: "Plan",
    stop: "Stop, keep the best",
    cancel: "Cancel",
    save: "Save",
    noFile: "Open a file to begin.",
    faults: "Faults",
    bound: "lower bound",
    flowtime: "flowtime",
    play: "Play or pause",
    page: "Open the plan",
    remove: "Delete",
    command: "Command",
    saved: "saved",
    map: "Map",
    curve: "Flowtime over time",
    queued: "queued", running: "running", done: "done", stopped: "stopped",
    cancelled: "cancelled", failed: "failed", interrupted: "interrupted",
  },
  de: {
    files: "Dateien",
    drop: "Datei hierher ziehen",
    runs: "Läufe",
    planner: "Planer",
    limit: "Zeitgrenze [s]",
    plan: "Planen",
    stop: "Anhalten, bester Plan bleibt",
    cancel: "Abbrechen",
    save: "Sichern",
    noFile: "Zum Anfangen eine Datei öffnen.",
    faults: "Fehler",
    bound: "untere Schranke",
    flowtime: "Summe der Ankünfte",
    play: "Abspielen oder anhalten",
    page: "Plan öffnen",
    remove: "Löschen",
    command: "Befehl",
    saved: "gesichert",
    map: "Karte",
    curve: "Summe der Ankünfte über der Zeit",
    queued: "wartet", running: "läuft", done: "fertig", stopped: "angehalten",
    cancelled: "abgebrochen", failed: "gescheitert", interrupted: "unterbrochen",
  },
};

const language = navigator.language.slice(0, 2);

/** The texts in the browser's language, or in English. */
export const words = TEXTS[language] ?? TEXTS.en;
document.documentElement.lang = TEXTS[language] ? language : "en";
