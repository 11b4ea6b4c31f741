/** The API of the studio: version 1, the same for every client. */

const ROOT = "/api/v1";

/** What the server refuses: its message, its status, and the faults of a document with their places. */
class Refusal extends Error {
  constructor({ message, status, kind, faults }) {
    super(message);
    Object.assign(this, { status, kind, faults });
  }
}

/** Send a request and return what JSON the answer is. */
export async function request(method, path, body) {
  const headers = body === undefined ? {} : { "content-type": "application/json" };
  const answer = await fetch(ROOT + path, {
    method,
    headers,
    body: body === undefined ? undefined : JSON.stringify(body),
    keepalive: method === "DELETE", // also while the page is being left
  });
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

/** Put a file into the folder under a path. */
export async function upload(file, path, { replace = false } = {}) {
  const answer = await fetch(`${ROOT}/files/${inAddress(path)}?replace=${replace}`, {
    method: "PUT",
    headers: { "content-type": "application/octet-stream" },
    body: file,
  });
  const data = await answer.json();
  if (!answer.ok) throw new Refusal(data.error);
  return data;
}

/** Whether a file has the content that stands under a path of the folder. */
export async function sameAs(file, path) {
  const answer = await fetch(`${ROOT}/files/${inAddress(path)}`);
  const [one, other] = await Promise.all([file.arrayBuffer(), answer.arrayBuffer()]);
  if (one.byteLength !== other.byteLength) return false;
  const [bytes, others] = [new Uint8Array(one), new Uint8Array(other)];
  return bytes.every((byte, at) => byte === others[at]);
}

/** The address of something that is shown or downloaded as it is. */
export const address = (path) => ROOT + path;
