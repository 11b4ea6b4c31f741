/** The stream of events of all runs; the browser opens it again where it is lost. */

const EVENTS = ["runs", "run", "progress", "plan", "deleted"];

/** Hear of all runs: first the list of them, then what happens; `refused` is called where there is no stream. */
export function hear(tell, refused = () => {}) {
  const stream = new EventSource("/api/v1/events");
  for (const name of EVENTS)
    stream.addEventListener(name, ({ data }) => tell(name, JSON.parse(data)));
  stream.onerror = () => stream.readyState === EventSource.CLOSED && refused();
  return stream;
}
