/** The clipboard: a piece of a drawing as text, so that it can go into another tab or into a file. */

import { words } from "../words.js";
import { isEmpty, pieceOf, pieceOfText, textOfPiece } from "./piece.js";
/** @import { DrawingPoint, Piece } from "../types.js" */
/** @import { Editor } from "./editor.js" */

/** @type {["copy", "cut", "paste"]} */
const NAMES = ["copy", "cut", "paste"];

export class Clipboard {
  /** @type {Piece | null} */
  #last = null; // where the browser gives nobody what is on its clipboard

  /** @param {Editor} editor */
  constructor(editor) {
    this.editor = editor;
    for (const name of NAMES)
      document.addEventListener(name, (event) => this.#isMeant(event) && this.#on[name](event));
  }

  /**
   * Whether the map is meant, not a text that is written or selected.
   * @param {ClipboardEvent} event
   * @returns {boolean}
   */
  #isMeant({ target }) {
    const { isReady } = this.editor;
    const isText =
      target instanceof Element &&
      target.closest("input, textarea, select, dialog, [contenteditable]");
    return isReady && !isText && Boolean(getSelection()?.isCollapsed);
  }

  /** @type {Record<string, (event: ClipboardEvent) => void>} */
  #on = {
    copy: (event) => {
      const piece = pieceOf(this.editor);
      if (isEmpty(piece)) return;
      event.preventDefault();
      event.clipboardData?.setData("text/plain", textOfPiece(piece));
      this.#keep(piece);
    },
    cut: (event) => {
      this.#on.copy(event);
      if (event.defaultPrevented) this.editor.remove();
    },
    paste: (event) => {
      const piece = pieceOfText(event.clipboardData?.getData("text/plain") ?? "");
      if (!piece) return;
      event.preventDefault();
      this.editor.tools.get("select").paste(piece);
    },
  };

  /** Copy from a menu. */
  async copy() {
    const piece = pieceOf(this.editor);
    if (isEmpty(piece)) return;
    this.#keep(piece);
    await navigator.clipboard?.writeText(textOfPiece(piece)).catch(() => {});
  }

  async cut() {
    await this.copy();
    this.editor.remove();
  }

  /**
   * Paste from a menu, at a place of the drawing.
   * @param {DrawingPoint} point
   * @returns {Promise<void>}
   */
  async paste(point) {
    const text = await navigator.clipboard?.readText?.().catch(() => "");
    const piece = pieceOfText(text ?? "") ?? this.#last;
    if (piece) this.editor.tools.get("select").paste(piece, point);
    else this.editor.say(words.nothingToPaste);
  }

  /**
   * @param {Piece} piece
   * @returns {void}
   */
  #keep(piece) {
    this.#last = piece;
    this.editor.say(words.copiedPiece);
  }
}
