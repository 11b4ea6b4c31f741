import { all, isEmbedded } from "./dom.js";

/**
 * The element that a player fills: its parts by their names, and all that ends with the player. The ids
 * of parts are for names of ARIA only; those of a second player in the same tree have a number.
 */
export class Root {
  #gone = new AbortController();
  #suffix = "";
  #frame = 0;
  /** @type {Element[]} */
  #made = [];

  /** @param {HTMLElement} element `document.body` where the player is the page */
  constructor(element) {
    this.element = element;
    this.isPart = element !== document.body;
  }

  /** The element whose style holds for the player. */
  get top() {
    return this.isPart ? this.element : document.documentElement;
  }

  get isEmbedded() {
    return isEmbedded(this.element);
  }

  /**
   * Put markup first into the element, under ids that nothing else has.
   *
   * @param {string} markup
   */
  fill(markup) {
    const made = document.createElement("template");
    made.innerHTML = markup;
    this.element.classList.toggle("part", this.isPart);
    this.#suffix = freeSuffix(this.element, all("[id]", Element, made.content));
    for (const attribute of NAMING)
      for (const each of all(`[${attribute}]`, Element, made.content))
        each.setAttribute(attribute, each.getAttribute(attribute) + this.#suffix);
    this.#made = [...made.content.children];
    this.element.prepend(made.content);
  }

  /**
   * A part by the name that it has in the markup.
   *
   * @template {HTMLElement} [E=HTMLElement]
   * @param {string} name
   * @param {abstract new () => E} [Kind] its class
   * @returns {E}
   */
  part(name, Kind) {
    const found = this.element.querySelector(`#${name}${this.#suffix}`);
    if (!(found instanceof (Kind ?? HTMLElement)))
      throw new Error(
        `page: there is no ${Kind?.name ?? "element"} "${name}" (look at the markup)`,
      );
    return /** @type {E} */ (found);
  }

  /**
   * A part, or null where the markup has none of the name.
   *
   * @param {string} name
   */
  find(name) {
    return this.element.querySelector(`#${name}${this.#suffix}`);
  }

  /**
   * All elements that a selector finds.
   *
   * @template {Element} E
   * @param {string} selector
   * @param {new () => E} Kind their class; elements of others are left out
   */
  all(selector, Kind) {
    return all(selector, Kind, this.element);
  }

  /**
   * Listen to what outlives the player, until that ends.
   *
   * @param {EventTarget} target
   * @param {string} event
   * @param {(event: Event) => void} listener
   */
  listen(target, event, listener) {
    target.addEventListener(event, listener, { signal: this.#gone.signal });
  }

  /**
   * Call `listener` when an element has another size, until the player ends.
   *
   * @param {Element} element
   * @param {() => void} listener
   */
  observe(element, listener) {
    const observer = new ResizeObserver(listener);
    observer.observe(element);
    this.atEnd(() => observer.disconnect());
  }

  /**
   * Call `paint` with the next frame, unless the player has ended by then.
   *
   * @param {(now: number) => void} paint
   */
  ask(paint) {
    if (!this.#gone.signal.aborted) this.#frame = requestAnimationFrame(paint);
  }

  /**
   * Call `action` when the player ends.
   *
   * @param {() => void} action
   */
  atEnd(action) {
    this.#gone.signal.addEventListener("abort", action);
  }

  /** Take away what was made, with all that listens, observes or waits for a frame. */
  destroy() {
    cancelAnimationFrame(this.#frame);
    this.#gone.abort();
    for (const each of this.#made) each.remove();
    this.#made = [];
    this.element.classList.remove("part");
  }
}

const NAMING = ["id", "for", "name", "aria-controls", "aria-labelledby", "aria-describedby"];

/**
 * What makes ids new among those of the tree that an element is in: nothing, "-2", "-3" and so on.
 *
 * @param {HTMLElement} element
 * @param {Element[]} named
 */
function freeSuffix(element, named) {
  const tree = /** @type {ParentNode} */ (element.getRootNode());
  for (let count = 1; ; count++) {
    const suffix = count > 1 ? `-${count}` : "";
    if (!named.some(({ id }) => tree.querySelector(`#${id}${suffix}`))) return suffix;
  }
}
