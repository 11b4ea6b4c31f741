/** The clipboard: a piece of a drawing as text, so that it can go into another tab or into a file. */

import { words } from "../words.js";
import { isEmpty, pieceOf, pieceOfText, textOfPiece } from "./piece.js";

export class Clipboard {
  #last = null; // where the browser gives nobody what is on its clipboard

  constructor(editor) {
    this.editor = editor;
    for (const name of ["copy", "cut", "paste"])
      document.addEventListener(name, (event) => this.#isMeant(event) && this.#on[name](event));
  }

  /** Whether the map is meant, not a text that is written or selected. */
  #isMeant({ target }) {
    const { isReady } = this.editor;
    const isText = target.closest?.("input, textarea, select, dialog, [contenteditable]");
    return isReady && !isText && getSelection().isCollapsed;
  }

  #on = {
    copy: (event) => {
      const piece = pieceOf(this.editor);
      if (isEmpty(piece)) return;
      event.preventDefault();
      event.clipboardData.setData("text/plain", textOfPiece(piece));
      this.#keep(piece);
    },
    cut: (event) => {
      this.#on.copy(event);
      if (event.defaultPrevented) this.editor.remove();
    },
    paste: (event) => {
      const piece = pieceOfText(event.clipboardData.getData("text/plain"));
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

  /** Paste from a menu, at a place of the drawing. */
  async paste(point) {
    const text = await navigator.clipboard?.readText?.().catch(() => "");
    const piece = pieceOfText(text ?? "") ?? this.#last;
    if (piece) this.editor.tools.get("select").paste(piece, point);
    else this.editor.say(words.nothingToPaste);
  }

  #keep(piece) {
    this.#last = piece;
    this.editor.say(words.copiedPiece);
  }
}
