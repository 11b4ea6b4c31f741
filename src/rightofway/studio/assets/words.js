/** Every text of the studio's own, in one object for each language; what the library says stays as it says it. */

const counted = (count, thing, things = `${thing}s`) => `${count} ${count === 1 ? thing : things}`;

const TEXTS = {
  en: {
    map: "Map", mapRole: "map to draw on", time: "Time", side: "Map, robots, plan", toolbar: "Tools",
    tabs: { map: "Map", robots: "Robots", plan: "Plan" },
    language: "Language", keys: "Keys", close: "Close", files: "Files", save: "Save", saved: "saved", keptAsDraft: "kept as a draft",
    fileName: "Name of the file", unnamed: "name to save it under", newName: "floor", undo: "Undo", redo: "Redo",
    zoomIn: "Zoom in", zoomOut: "Zoom out", fit: "Fit the map",
    startTitle: "Draw a floor, place robots, watch them drive",
    newFloor: "New floor", width: "Width", height: "Height", cellSize: "Cell size", smallest: "Smallest cell", adaptive: "Larger cells in open space", create: "Create the floor", newRoadmap: "Draw lanes instead",
    openTitle: "Open a file", drop: "Drop files here", choose: "Choose files", formats: "Scenarios (YAML, JSON, XLSX), ROS maps with their picture, LIF, Open-RMF, openTCS, Nav2, GraphML, MovingAI maps, plans.",
    inFolder: (name) => `In the folder ${name}`, draftsTitle: "Drawn and not saved",
    kinds: { document: "", workbook: "workbook", layout: "layout", scenario: "robots" },
    tools: {
      pick: ["Pick", "Press a place on the picture."],
      select: ["Select and move", "Press to select, drag to move, drag from an empty place for a box; Shift selects more."],
      line: ["Wall", "Drag from one end of the wall to the other."],
      brush: ["Brush", "Drag over the cells that are blocked."],
      box: ["Block", "Drag over a rectangle that is blocked."],
      door: ["Door", "Press on a wall to open a gap; drag for a wider one."],
      erase: ["Erase", "Drag over what shall be free again."],
      vertex: ["Vertex", "Press where a vertex shall be; with Shift a lane joins it to the last one."],
      lane: ["Lane", "Press from vertex to vertex; press the last one again to end. Shift makes it one-way."],
      mark: ["Station", "Press a vertex to make it a station; Shift makes it a parking place."],
      robot: ["Place robots", "Press the home of a robot, then the place where it works."],
    },
    nextRobots: "Next: place robots", nextPlan: "Next: plan and watch",
    backdrop: "Picture below the map", choosePicture: "Choose a picture to draw over", setScale: "Scale by two places", setOrigin: "Set the origin", removePicture: "Take it away", distance: "Their distance", apply: "Apply",
    pickPoint: (count) => (count > 0 ? `Press ${counted(count, "more place")} on the picture.` : "Now give their distance."),
    noVertexHere: "No robot can stand there.", homeTaken: "Another robot has its home there.", pressStop: "Now press the place where it works; with Shift there are more.",
    pressMore: "Press the next place; without Shift it is the last.", pressHome: "Press the home of the next robot.", pressLane: "Press the next vertex, or the same one to end.",
    robotsElsewhere: "The robots are in another file.", writeHere: "Write them here",
    mapElsewhere: (file) => `The map is the file ${file}.`, drawOnIt: "Draw on a copy of it",
    selected: (count) => counted(count, "thing") + " selected", name: "Name", duplicate: "Copy", remove: "Delete",
    station: "Station", parking: "parking place", charging: "charging place", closed: "closed", bothWays: "both ways", maxSpeed: "Speed limit",
    zones: "Zones (one robot at a time)", zoneOfSelected: "Make a zone of what is selected",
    size: "Size", units: "Unit of length", spacing: "Split lanes at", findings: "What will hurt", nothingFound: "Nothing was found that will hurt.", notes: "Notes of the reader",
    faultCount: (count) => counted(count, "fault"),
    columns: {
      name: ["Name", "Name"], home: ["Home", "Where it starts and ends: N3, or 1.25, 0.75"], stops: ["Stops", "Where it works; several with ; between"], work: ["Work", "Time that it works at each stop", "0"],
      speed: ["Speed", "Length units per time unit", "1"], radius: ["Radius", "Radius of the circle that it needs", "–"], turn: ["Turn", "Time to turn at a stop, or cell", "–"], laps: ["Laps", "How often it makes its round trip", "1"],
    },
    placeRobot: "Place on the map", fillDown: "Fill down", copyTable: "Copy table", pasteTable: "Paste rows of a spreadsheet here", moreRows: (count) => `Show ${count} more`,
    noRobots: "No robots yet: press a home on the map, then a place to work at.",
    randomFleet: "Robots at random", deal: "Deal out", random: { count: "Robots", seed: "Seed", work: "Work", speed: "Speed" },
    planSummary: (planner, seconds) => `${planner}, up to ${seconds} s`, plan: "Plan", planner: "Planner", limit: "Time limit [s]", seed: "Seed", options: "Options", stop: "Stop, keep the best", live: "Plan again at each change",
    bound: "lower bound", flowtime: "flowtime", curve: "Flowtime over time", changedSince: "The map or the robots have changed since this plan.",
    asBefore: "as before", wasBefore: (text) => `was ${text}`, gains: (names) => `Gain: ${names}.`, losesTime: (names) => `Lose: ${names}.`,
    cancel: "Cancel", timeUsed: "Time used", show: "Play", gap: "Gap", took: "Time", makespan: "makespan", robot: "Robot", difference: "Difference",
    comparison: "Compared", sideBySide: "Show side by side", endComparison: "End the comparison", moreRobots: (count) => `and ${counted(count, "more robot")} that ${count === 1 ? "differs" : "differ"} less`,
    takeBack: "Edit what it was planned from", otherPrograms: "For other programs", copy: "Copy", copied: "Copied", copyCommand: "Copy the command line", saveFirst: "The command reads the file as it is saved, not what is drawn here.",
    whatIf: "What if", whatIfOf: (name) => `What if ${name} were different`, chooseRobot: "Choose a robot on the map to change its home, speed or work.",
    closePlace: "Close the place", closeTo: "or the lane from it to", closeIt: "Close it", openAgain: "Open again",
    studies: "Laps and delays", report: "Report", lapsTitle: "Let all robots repeat their trips", rule: "Right of way", runLaps: "Repeat", delaysTitle: "Execute the plan with delays", delays: "Delays", runCount: "Runs", simulate: "Simulate",
    playWorst: (run) => `Play the worst run (${run})`, spread: (from, to, planned) => `Flowtime of the runs: ${from} to ${to}; planned: ${planned}`,
    waits: "Who waits, and why", waitsOf: (name) => `Why ${name} waits`, noWaits: "No robot waits for another one.", letGoFirst: (name) => `Let ${name} go first`, moreWaits: (count) => `and ${count} more; choose a robot on the map`,
    exportTitle: "Take it along", page: "Page", command: "Command line", forms: { html: "Page as file", xlsx: "Workbook", png: "Picture", gif: "Film", json: "Plan file" },
    runs: "Plans", compare: "Compare", runName: "Name of the plan", runKinds: { plan: "unnamed floor", opened: "opened", flip: "flipped", improve: "improved", laps: "laps", simulate: "simulated" },
    states: { queued: "queued", running: "running", done: "", stopped: "stopped", cancelled: "cancelled", failed: "failed", interrupted: "interrupted" },
    watching: "Press a robot or a wait to see why it loses time.", speedOfTime: "Speed", timeHeld: "Time held",
    player: { back: "One tick back", play: "Play or pause (space)", forth: "One tick on", slider: "Time", heat: "Heat map: how long each place is held", space: "What robots book", bottleneck: "Light the bottleneck", states: "What the robots do now" },
    keyList: [
      ["1 2 3", "Map, robots, plan"], ["Arrows", "Move the cursor on the map; Shift goes further"], ["Enter", "Press or release at the cursor"], ["Delete", "Delete what is selected"], ["Esc", "Give up, select nothing"],
      ["Ctrl+Z", "Undo; with Shift redo"], ["Ctrl+D", "Copy what is selected"], ["Ctrl+A", "Select all"], ["Ctrl+S", "Save"], ["Ctrl+Enter", "Plan"], ["+ − 0", "Zoom, fit the map"], ["Space", "Play; held while drawing: move the map"], ["?", "These keys"],
    ],
  },
  de: {
    map: "Karte", mapRole: "Karte zum Zeichnen", time: "Zeit", side: "Karte, Roboter, Plan", toolbar: "Werkzeuge",
    tabs: { map: "Karte", robots: "Roboter", plan: "Plan" },
    language: "Sprache", keys: "Tasten", close: "Schließen", files: "Dateien", save: "Sichern", saved: "gesichert", keptAsDraft: "als Entwurf behalten",
    fileName: "Name der Datei", unnamed: "Name zum Sichern", newName: "boden", undo: "Rückgängig", redo: "Wiederholen",
    zoomIn: "Vergrößern", zoomOut: "Verkleinern", fit: "Karte einpassen",
    startTitle: "Boden zeichnen, Roboter setzen, zusehen",
    newFloor: "Neuer Boden", width: "Breite", height: "Höhe", cellSize: "Zellengröße", smallest: "Kleinste Zelle", adaptive: "Größere Zellen im Freien", create: "Boden anlegen", newRoadmap: "Stattdessen Wege zeichnen",
    openTitle: "Datei öffnen", drop: "Dateien hierher ziehen", choose: "Dateien wählen", formats: "Szenarien (YAML, JSON, XLSX), ROS-Karten mit ihrem Bild, LIF, Open-RMF, openTCS, Nav2, GraphML, MovingAI-Karten, Pläne.",
    inFolder: (name) => `Im Ordner ${name}`, draftsTitle: "Gezeichnet und nicht gesichert",
    kinds: { document: "", workbook: "Arbeitsmappe", layout: "Layout", scenario: "Roboter" },
    tools: {
      pick: ["Ort", "Einen Ort auf dem Bild drücken."],
      select: ["Auswählen und schieben", "Drücken wählt aus, Ziehen schiebt, Ziehen von einer leeren Stelle wählt im Rahmen; Umschalt wählt mehr."],
      line: ["Wand", "Von einem Ende der Wand zum anderen ziehen."],
      brush: ["Pinsel", "Über die Zellen ziehen, die gesperrt sind."],
      box: ["Block", "Ein Rechteck ziehen, das gesperrt ist."],
      door: ["Tür", "Auf eine Wand drücken öffnet eine Lücke; Ziehen eine breitere."],
      erase: ["Radieren", "Über das ziehen, was wieder frei sein soll."],
      vertex: ["Knoten", "Drücken, wo ein Knoten sein soll; mit Umschalt führt ein Weg vom letzten dorthin."],
      lane: ["Weg", "Von Knoten zu Knoten drücken; den letzten noch einmal zum Beenden. Mit Umschalt Einbahn."],
      mark: ["Station", "Einen Knoten drücken macht ihn zur Station; mit Umschalt zum Parkplatz."],
      robot: ["Roboter setzen", "Den Heimatplatz drücken, dann den Platz, wo der Roboter arbeitet."],
    },
    nextRobots: "Weiter: Roboter setzen", nextPlan: "Weiter: planen und zusehen",
    backdrop: "Bild unter der Karte", choosePicture: "Ein Bild zum Nachzeichnen wählen", setScale: "Maßstab aus zwei Orten", setOrigin: "Ursprung setzen", removePicture: "Wegnehmen", distance: "Ihr Abstand", apply: "Anwenden",
    pickPoint: (count) => (count > 0 ? `Noch ${count} auf dem Bild drücken.` : "Jetzt ihren Abstand angeben."),
    noVertexHere: "Dort kann kein Roboter stehen.", homeTaken: "Dort ist ein anderer Roboter zu Hause.", pressStop: "Jetzt den Platz drücken, wo er arbeitet; mit Umschalt mehrere.",
    pressMore: "Den nächsten Platz drücken; ohne Umschalt ist es der letzte.", pressHome: "Den Heimatplatz des nächsten Roboters drücken.", pressLane: "Den nächsten Knoten drücken, oder denselben zum Beenden.",
    robotsElsewhere: "Die Roboter stehen in einer anderen Datei.", writeHere: "Hier aufschreiben",
    mapElsewhere: (file) => `Die Karte ist die Datei ${file}.`, drawOnIt: "Auf einer Kopie zeichnen",
    selected: (count) => `${count} ausgewählt`, name: "Name", duplicate: "Kopieren", remove: "Löschen",
    station: "Station", parking: "Parkplatz", charging: "Ladeplatz", closed: "gesperrt", bothWays: "beide Richtungen", maxSpeed: "Höchstgeschwindigkeit",
    zones: "Zonen (ein Roboter zur Zeit)", zoneOfSelected: "Zone aus der Auswahl",
    size: "Größe", units: "Längeneinheit", spacing: "Wege teilen ab", findings: "Was weh tun wird", nothingFound: "Nichts gefunden, was weh tun wird.", notes: "Anmerkungen des Lesers",
    faultCount: (count) => `${count} Fehler`,
    columns: {
      name: ["Name", "Name"], home: ["Heim", "Wo er beginnt und endet: N3, oder 1.25, 0.75"], stops: ["Halte", "Wo er arbeitet; mehrere mit ; dazwischen"], work: ["Arbeit", "Zeit, die er an jedem Halt arbeitet", "0"],
      speed: ["Tempo", "Längeneinheiten je Zeiteinheit", "1"], radius: ["Radius", "Radius des Kreises, den er braucht", "–"], turn: ["Wenden", "Zeit zum Wenden an einem Halt, oder cell", "–"], laps: ["Runden", "Wie oft er seine Runde fährt", "1"],
    },
    placeRobot: "Auf die Karte setzen", fillDown: "Nach unten füllen", copyTable: "Tabelle kopieren", pasteTable: "Zeilen einer Tabelle hier einfügen", moreRows: (count) => `${count} weitere zeigen`,
    noRobots: "Noch keine Roboter: auf der Karte einen Heimatplatz drücken, dann einen Platz zum Arbeiten.",
    randomFleet: "Zufällige Roboter", deal: "Austeilen", random: { count: "Roboter", seed: "Startzahl", work: "Arbeit", speed: "Tempo" },
    planSummary: (planner, seconds) => `${planner}, höchstens ${seconds} s`, plan: "Planen", planner: "Planer", limit: "Zeitgrenze [s]", seed: "Startzahl", options: "Optionen", stop: "Anhalten, bester Plan bleibt", live: "Bei jeder Änderung neu planen",
    bound: "untere Schranke", flowtime: "Summe der Ankünfte", curve: "Summe der Ankünfte über der Zeit", changedSince: "Karte oder Roboter haben sich seit diesem Plan geändert.",
    asBefore: "wie zuvor", wasBefore: (text) => `zuvor ${text}`, gains: (names) => `Gewinnen: ${names}.`, losesTime: (names) => `Verlieren: ${names}.`,
    cancel: "Abbrechen", timeUsed: "Verbrauchte Zeit", show: "Abspielen", gap: "Abstand", took: "Zeit", makespan: "letzte Ankunft", robot: "Roboter", difference: "Unterschied",
    comparison: "Verglichen", sideBySide: "Nebeneinander zeigen", endComparison: "Vergleich beenden", moreRobots: (count) => `und ${count} weitere Roboter mit kleinerem Unterschied`,
    takeBack: "Bearbeiten, wovon geplant wurde", otherPrograms: "Für andere Programme", copy: "Kopieren", copied: "Kopiert", copyCommand: "Befehlszeile kopieren", saveFirst: "Der Befehl liest die gesicherte Datei, nicht, was hier gezeichnet ist.",
    whatIf: "Was wäre, wenn", whatIfOf: (name) => `Was wäre, wenn ${name} anders wäre`, chooseRobot: "Einen Roboter auf der Karte wählen, um Heim, Tempo oder Arbeit zu ändern.",
    closePlace: "Platz sperren", closeTo: "oder den Weg von dort nach", closeIt: "Sperren", openAgain: "Wieder öffnen",
    studies: "Runden und Verspätungen", report: "Bericht", lapsTitle: "Alle Roboter ihre Fahrten wiederholen lassen", rule: "Vorfahrt", runLaps: "Wiederholen", delaysTitle: "Den Plan mit Verspätungen ausführen", delays: "Verspätungen", runCount: "Läufe", simulate: "Simulieren",
    playWorst: (run) => `Den schlechtesten Lauf abspielen (${run})`, spread: (from, to, planned) => `Summe der Ankünfte der Läufe: ${from} bis ${to}; geplant: ${planned}`,
    waits: "Wer wartet, und warum", waitsOf: (name) => `Warum ${name} wartet`, noWaits: "Kein Roboter wartet auf einen anderen.", letGoFirst: (name) => `${name} zuerst fahren lassen`, moreWaits: (count) => `und ${count} weitere; einen Roboter auf der Karte wählen`,
    exportTitle: "Mitnehmen", page: "Seite", command: "Befehlszeile", forms: { html: "Seite als Datei", xlsx: "Arbeitsmappe", png: "Bild", gif: "Film", json: "Plandatei" },
    runs: "Pläne", compare: "Vergleichen", runName: "Name des Plans", runKinds: { plan: "Boden ohne Namen", opened: "geöffnet", flip: "umgedreht", improve: "verbessert", laps: "Runden", simulate: "simuliert" },
    states: { queued: "wartet", running: "läuft", done: "", stopped: "angehalten", cancelled: "abgebrochen", failed: "gescheitert", interrupted: "unterbrochen" },
    watching: "Einen Roboter oder ein Warten drücken zeigt, warum er Zeit verliert.", speedOfTime: "Tempo", timeHeld: "Zeit belegt",
    player: { back: "Einen Takt zurück", play: "Abspielen oder anhalten (Leertaste)", forth: "Einen Takt vor", slider: "Zeit", heat: "Wärmekarte: wie lange jeder Platz belegt ist", space: "Was Roboter belegen", bottleneck: "Engpass zeigen", states: "Was die Roboter gerade tun" },
    keyList: [
      ["1 2 3", "Karte, Roboter, Plan"], ["Pfeile", "Marke auf der Karte bewegen; mit Umschalt weiter"], ["Enter", "An der Marke drücken oder loslassen"], ["Entf", "Auswahl löschen"], ["Esc", "Aufgeben, nichts auswählen"],
      ["Strg+Z", "Rückgängig; mit Umschalt wiederholen"], ["Strg+D", "Auswahl kopieren"], ["Strg+A", "Alles auswählen"], ["Strg+S", "Sichern"], ["Strg+Enter", "Planen"], ["+ − 0", "Vergrößern, einpassen"], ["Leertaste", "Abspielen; beim Zeichnen gehalten: Karte schieben"], ["?", "Diese Tasten"],
    ],
  },
};

export const LANGUAGES = [["en", "English"], ["de", "Deutsch"]];

/** The language of the page: the one that was chosen, or the browser's, or English. */
export let language = "en";
export let words = TEXTS.en;

export function setLanguage(code) {
  language = TEXTS[code] ? code : "en";
  words = TEXTS[language];
  document.documentElement.lang = language;
  localStorage.setItem("language", language);
}

setLanguage(localStorage.getItem("language") ?? navigator.language.slice(0, 2));
