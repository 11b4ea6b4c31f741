/** What the library says, in German: each English template of the library with its translation. */
export const GERMAN_OF = {
  "{first}, {second}": "{first}, {second}",
  "{first} and {last}": "{first} und {last}",
  "{number} more": "{number} weitere",
  "{name} ({what})": "{name} ({what})",
  "({middle}, {what})": "({middle}, {what})",
  "{tail} to {head}": "{tail} bis {head}",

  "{number} tick": "{number} Zeitschritt",
  "{number} ticks": "{number} Zeitschritte",
  "{number} time unit": "{number} Zeiteinheit",
  "{number} time units": "{number} Zeiteinheiten",
  "{number} length unit": "{number} Längeneinheit",
  "{number} length units": "{number} Längeneinheiten",
  "{number} vertex": "{number} Knoten",
  "{number} vertices": "{number} Knoten",
  "{number} directed edge": "{number} gerichtete Strecke",
  "{number} directed edges": "{number} gerichtete Strecken",
  "{number} place": "{number} Platz",
  "{number} places": "{number} Plätze",
  "{number} other place": "{number} weiterem Platz",
  "{number} other places": "{number} weiteren Plätzen",
  "{number} robot": "{number} Roboter",
  "{number} robots": "{number} Robotern",
  "{number} cell": "{number} Zelle",
  "{number} cells": "{number} Zellen",

  station: "Station",
  "station {name}": "Station {name}",
  parking: "Parkplatz",
  "home of {robot}": "Startplatz von {robot}",
  "stop of {robots}": "Ziel von {robots}",

  "Errors (some work cannot be done)": "Fehler (manche Arbeit ist unmöglich)",
  "Warnings (robots will wait)": "Warnungen (Roboter werden warten)",
  Notes: "Hinweise",
  "{edges}, {number} of them one-way": "{edges}, davon {number} einbahnig",
  "{vertices}, {edges}, {width} x {height}; {places}.":
    "{vertices}, {edges}, {width} x {height}; {places}.",
  "All vertices reach each other.": "Alle Knoten sind voneinander erreichbar.",
  "{number} strongly connected parts, of {sizes} vertices.":
    "{number} Teile, die je in sich erreichbar sind, mit {sizes} Knoten.",
  "Shortest routes are counted from {some} of {all_of} vertices only.":
    "Kürzeste Wege sind nur von {some} der {all_of} Knoten gezählt.",

  "{robot} cannot drive from {start} to {goal}":
    "{robot} kann nicht von {start} nach {goal} fahren",
  "add a lane, or give it another home or stop":
    "eine Strecke ergänzen oder ihm einen anderen Startplatz oder ein anderes Ziel geben",
  "{places} and {vertices} around": "{places} und {vertices} ringsum",
  "{cells} around {place}": "{cells} um {place}",
  "No way leads to {places}": "Zu {places} führt kein Weg",
  "{places} can be entered and not left again": "Nach {places} führt ein Weg, aber keiner zurück",
  "{places} can be left and not reached": "Von {places} führt ein Weg weg, aber keiner hin",
  "No lane joins {places} to the largest part":
    "Keine Strecke verbindet {places} mit dem größten Teil",
  "make a way wide enough for a cell, or ignore it":
    "einen Durchgang öffnen, der für eine Zelle breit genug ist, oder so lassen",
  "add a lane back, or take it out": "eine Strecke zurück ergänzen oder den Knoten entfernen",
  "add a lane back, or take them out": "eine Strecke zurück ergänzen oder die Knoten entfernen",
  "add a lane to it, or take it out": "eine Strecke dorthin ergänzen oder den Knoten entfernen",
  "add a lane to it, or take them out": "eine Strecke dorthin ergänzen oder die Knoten entfernen",
  "add lanes, or take it out": "Strecken ergänzen oder den Knoten entfernen",
  "add lanes, or take them out": "Strecken ergänzen oder die Knoten entfernen",

  "{place} lies on the only way between {places} and {others}":
    "{place} liegt auf dem einzigen Weg zwischen {places} und {others}",
  "{place} is on {share} of the shortest routes, and robots drive round it while one stands there":
    "{place} liegt auf {share} der kürzesten Wege; steht dort ein Roboter, fahren andere außen herum",
  "move it into a bay, or add a way round":
    "in eine Bucht verlegen oder einen Weg außen herum ergänzen",
  "let no other robot need the way while one stands there, or add a way round":
    "den Weg freihalten, solange dort ein Roboter steht, oder einen Weg außen herum ergänzen",
  "park at {place}, {distance} away, which no route needs, or add a way round":
    "auf {place} parken, {distance} entfernt, wo niemand durch muss, oder einen Weg außen herum ergänzen",

  "{one} to {other} is a corridor of {length} without a passing place; {users}, and {round}":
    "{one} bis {other} ist eine Engstelle von {length} ohne Ausweichplatz; {users}, und {round}",
  "{some} of {robots} must use it": "{some} von {robots} müssen hindurch",
  "{share} of the shortest routes use it": "{share} der kürzesten Wege führen hindurch",
  "no way leads round it": "kein Weg führt außen herum",
  "there is a way round": "es gibt einen Weg außen herum",
  "add a passing place in the middle, or make it one-way with a way back":
    "einen Ausweichplatz in der Mitte ergänzen oder eine Einbahnstrecke mit eigenem Rückweg daraus machen",

  "{place} is on {share} of the shortest routes between places":
    "{place} liegt auf {share} der kürzesten Wege zwischen den Plätzen",
  "{place} is on {share} of the shortest routes between vertices":
    "{place} liegt auf {share} der kürzesten Wege zwischen den Knoten",
  "{fact}; {vertices} around it on {least} or more":
    "{fact}; {vertices} ringsum auf {least} oder mehr",
  "add a second way, or spread the places":
    "einen zweiten Weg ergänzen oder die Plätze besser verteilen",

  "A robot of radius {radius} reaches into walls in {cells}, for example in {place}":
    "Ein Roboter mit Radius {radius} ragt in {cells} in Wände, zum Beispiel in {place}",
  "set walls: strict, so that it keeps out of them, or take larger cells":
    "walls: strict setzen, damit er dort nicht fährt, oder größere Zellen nehmen",
  "robots of radius {sizes} need {room}": "Roboter mit Radius {sizes} brauchen {room}",
  "robots of radius {sizes} and {clearance} apart need {room}":
    "Roboter mit Radius {sizes} und {clearance} Abstand brauchen {room}",
  cells: "Zellen",
  "the smallest cells": "den kleinsten Zellen",
  "The middles of {cells} are {distance} apart; {need}":
    "Die Mitten von {cells} sind {distance} voneinander entfernt; {need}",
  "take larger cells, or smaller robots": "größere Zellen oder kleinere Roboter nehmen",
  "{place} is too near to the lane {tail} to {head}; {need}":
    "{place} ist zu nah an der Strecke {tail} bis {head}; {need}",
  "{place} lies on the lane {tail} to {head} and is no end of it":
    "{place} liegt auf der Strecke {tail} bis {head} und ist keines ihrer Enden",
  "a robot on one blocks the other; move one":
    "ein Roboter auf dem einen blockiert das andere; eines verschieben",
  "split the lane there": "die Strecke dort teilen",
  "The lanes {one} and {other} cross without a vertex":
    "Die Strecken {one} und {other} kreuzen sich ohne Knoten",
  "robots wait for each other there; a vertex lets them wait nearer":
    "Roboter warten dort aufeinander; mit einem Knoten warten sie näher",
  "draw a vertex there, or give robots a radius: without one they do not give way":
    "dort einen Knoten setzen oder den Robotern einen Radius geben: ohne ihn lassen sie einander nicht vor",
  "{one} and {other} are {distance} apart; {need}":
    "{one} und {other} sind {distance} voneinander entfernt; {need}",
  "{one} and {other} are the same point": "{one} und {other} sind derselbe Punkt",
  "move one, or use smaller robots": "einen verschieben oder kleinere Roboter nehmen",
  "make them one vertex": "einen Knoten daraus machen",
};
