/** @import { DrivenFrame, FeedData, PhraseData } from "../payload.d.ts" */

/** @typedef {{ done: boolean, text?: PhraseData }} OrderAnswer What became of an order of a person. */

/**
 * Listen to frames, for ever: a browser that has lost the server asks again, and names the last frame that it has.
 *
 * @param {FeedData} data
 * @param {{ take: (frame: DrivenFrame) => void, connect: (isConnected: boolean) => void }} listener
 * @returns {() => void} what ends the listening
 */
export function listenToFeed({ stream }, { take, connect }) {
  if (!stream) return () => {};
  let source = new EventSource(stream);
  let known = "";
  let retry = 0;
  const open = () => {
    source.addEventListener("open", () => connect(true));
    source.addEventListener("message", ({ data, lastEventId }) => {
      known = lastEventId;
      take(JSON.parse(data));
    });
    source.addEventListener("error", () => {
      connect(false);
      if (source.readyState !== EventSource.CLOSED) return; // it tries again by itself
      retry = window.setTimeout(() => {
        source = new EventSource(`${stream}?known=${encodeURIComponent(known)}`);
        open();
      }, 1000);
    });
  };
  open();
  return () => {
    clearTimeout(retry);
    source.close();
  };
}

/**
 * Ask the control for something.
 *
 * @param {string} address
 * @param {{ kind: string, name?: string, at?: string, person?: string }} order
 * @returns {Promise<OrderAnswer>}
 */
export async function sendOrder(address, order) {
  try {
    const answer = await fetch(address, {
      method: "POST",
      headers: { "content-type": "application/json" },
      body: JSON.stringify(order),
    });
    const data = await answer.json();
    return answer.ok ? data : { done: false, text: data.error.message };
  } catch {
    return { done: false, text: "" };
  }
}
