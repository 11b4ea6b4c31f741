/** The API of the studio: version 1, the same for every client. */

const ROOT = "/api/v1";

/** What the server refuses: its message, its status, and the faults of a document with their places. */
export class Refusal extends Error {
  constructor({ message, status, kind, faults }) {
    super(message);
    Object.assign(this, { status, kind, faults });
  }
}

/** Send a request and return what JSON the answer is. */
export async function request(method, path, body) {
  const headers = body === undefined ? {} : { "content-type": "application/json" };
  const answer = await fetch(ROOT + path, { method, headers, body: body === undefined ? undefined : JSON.stringify(body) });
  const data = await answer.json();
  if (!answer.ok) throw new Refusal(data.error);
  return data;
}

export const get = (path) => request("GET", path);
export const post = (path, body = {}) => request("POST", path, body);
export const put = (path, body) => request("PUT", path, body);
export const remove = (path) => request("DELETE", path);

/** A path of a file in an address: its names, not its slashes, are escaped. */
export const inAddress = (path) => path.split("/").map(encodeURIComponent).join("/");

/** Put a file into the folder, as it was dropped. */
export async function upload(file, { replace = false } = {}) {
  const answer = await fetch(`${ROOT}/files/${inAddress(file.name)}?replace=${replace}`, {
    method: "PUT",
    headers: { "content-type": "application/octet-stream" },
    body: file,
  });
  const data = await answer.json();
  if (!answer.ok) throw new Refusal(data.error);
  return data;
}

/** The address of something that is shown or downloaded as it is. */
export const address = (path) => ROOT + path;

/** Hear the events of a run until it is over: `{ run, progress, plan }` are functions. Returns what ends it. */
export function listen(number, hearers) {
  const source = new EventSource(address(`/runs/${number}/events`));
  for (const [name, hear] of Object.entries(hearers)) {
    source.addEventListener(name, (event) => hear(JSON.parse(event.data)));
  }
  source.addEventListener("run", (event) => {
    if (!["queued", "running"].includes(JSON.parse(event.data).state)) source.close();
  });
  return () => source.close();
}
