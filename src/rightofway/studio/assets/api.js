/** The API of the studio: version 1, the same for every client. */

/** @import { Bodies, DeleteAnswer, ErrorData, GetAnswer, PatchAnswer, PostAnswer, PutAnswer, Saved } from "./api_types.js" */
import { whileBusy } from "./busy.js";
import { connection } from "./connection.js";

const ROOT = "/api/v1";

/** The kind of a refusal where there was no answer. */
export const UNREACHABLE = "unreachable";

/** What the server refuses: its message, its status, and the faults of a document with their places. */
export class Refusal extends Error {
  /**
   * @param {ErrorData} error
   */
  constructor({ message, status, kind, faults }) {
    super(message);
    this.status = status;
    this.kind = kind;
    this.faults = faults;
  }
}

/**
 * Send a request and return what JSON the answer is.
 * @template {string} Path
 * @param {string} method
 * @param {Path} path
 * @param {Bodies[keyof Bodies] | {}} [body]
 * @returns {Promise<any>} What the path answers: the functions below say what that is.
 */
const request = (method, path, body) => whileBusy(answered(method, path, body));

/** @type {typeof request} */
async function answered(method, path, body) {
  /** @type {HeadersInit} */
  const headers = body === undefined ? {} : { "content-type": "application/json" };
  return ask(path, {
    method,
    headers,
    body: body === undefined ? undefined : JSON.stringify(body),
    keepalive: method === "DELETE", // also while the page is being left
  });
}

/**
 * Send a request, and find out whether the server answers at all.
 * @param {string} path
 * @param {RequestInit} init
 * @param {(answer: Response) => Promise<any>} [read]
 * @returns {Promise<any>}
 */
async function ask(path, init, read = (answer) => answer.json()) {
  let answer;
  let data;
  try {
    answer = await fetch(ROOT + path, init);
    data = await (answer.ok ? read(answer) : answer.json());
  } catch {
    connection.lose();
    throw new Refusal({ message: "the studio does not answer", status: 0, kind: UNREACHABLE });
  }
  connection.restore();
  if (!answer.ok) throw new Refusal(data.error);
  return data;
}

/**
 * @template {string} Path
 * @param {Path} path
 * @returns {Promise<GetAnswer<Path>>}
 */
export const get = (path) => request("GET", path);
/**
 * @template {string} Path
 * @param {Path} path
 * @param {Bodies["POST"]} [body]
 * @returns {Promise<PostAnswer<Path>>}
 */
export const post = (path, body) => request("POST", path, body ?? {});
/**
 * @template {string} Path
 * @param {Path} path
 * @param {Bodies["PUT"]} body
 * @returns {Promise<PutAnswer<Path>>}
 */
export const put = (path, body) => request("PUT", path, body);

/**
 * @template {string} Path
 * @param {Path} path
 * @param {Bodies["PATCH"]} body
 * @returns {Promise<PatchAnswer<Path>>}
 */
export const patch = (path, body) => request("PATCH", path, body);

/**
 * @template {string} Path
 * @param {Path} path
 * @returns {Promise<DeleteAnswer<Path>>}
 */
export const remove = (path) => request("DELETE", path);

/**
 * A path of a file in an address: its names, not its slashes, are escaped.
 * @param {string} path
 * @returns {string}
 */
export const inAddress = (path) => path.split("/").map(encodeURIComponent).join("/");

/**
 * Put a file into the folder under a path.
 * @param {Blob} file
 * @param {string} path
 * @param {{replace?: boolean}} [options]
 * @returns {Promise<Saved>}
 */
export const upload = (file, path, options = {}) => whileBusy(uploaded(file, path, options));

/** @type {typeof upload} */
async function uploaded(file, path, { replace = false } = {}) {
  return ask(`/files/${inAddress(path)}?replace=${replace}`, {
    method: "PUT",
    headers: { "content-type": "application/octet-stream" },
    body: file,
  });
}

/**
 * Whether a file has the content that stands under a path of the folder.
 * @param {Blob} file
 * @param {string} path
 * @returns {Promise<boolean>}
 */
export async function sameAs(file, path) {
  const there = ask(`/files/${inAddress(path)}`, {}, (answer) => answer.arrayBuffer());
  const [one, other] = await Promise.all([file.arrayBuffer(), there]);
  if (one.byteLength !== other.byteLength) return false;
  const [bytes, others] = [new Uint8Array(one), new Uint8Array(other)];
  return bytes.every((byte, at) => byte === others[at]);
}

/**
 * The address of something that is shown or downloaded as it is.
 * @param {string} path
 * @returns {string}
 */
export const address = (path) => ROOT + path;
