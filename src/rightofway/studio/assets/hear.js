/** The stream of events of all runs, and the runs as these events describe them. */

const EVENTS = ["runs", "run", "progress", "plan", "deleted"];

/**
 * Hear of all runs: first the list of them, then what happens; `refused` is called where there is no
 * stream. The browser opens it again where it is lost.
 */
export function hear(tell, refused = () => {}) {
  const stream = new EventSource("/api/v1/events");
  for (const name of EVENTS)
    stream.addEventListener(name, ({ data }) => tell(name, JSON.parse(data)));
  stream.onerror = () => stream.readyState === EventSource.CLOSED && refused();
  return stream;
}

/** The runs as the events so far describe them, by number; null before the first list. */
export class KnownRuns {
  byNumber = null;

  /** Take in an event. */
  take(name, data) {
    if (name === "runs") this.byNumber = new Map(data.runs.map((run) => [run.number, run]));
    if (!this.byNumber) return;
    const { number } = data;
    if (name === "run") this.byNumber.set(number, data);
    if (name === "deleted") this.byNumber.delete(number);
    if (name === "plan" && this.byNumber.has(number))
      Object.assign(this.byNumber.get(number), { figures: data.figures, has_plan: true });
  }
}
