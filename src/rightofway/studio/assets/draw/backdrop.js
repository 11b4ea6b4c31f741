/** The picture below the map: chosen, laid by presses on it, and kept in the scenario. */

import { get, inAddress, upload } from "../api.js";
import { Observable } from "../../../viz/page/assets/common/observable.js";
import { html, useEffect, useRef, useState } from "../vendor/htm-preact.js";
import { words } from "../words.js";
import { isNetwork, withoutKey } from "./network.js";
import { numberOf, rounded, toDrawing } from "./places.js";
import { present } from "../given.js";
/** @import { Theme } from "../../../viz/page/assets/drawing/theme.js" */
/** @import { ScenarioStore } from "../document.js" */
/** @import { Stage } from "../stage.js" */
/** @import { DrawingPoint, PictureData, Point, Props } from "../types.js" */
/** @import { PageEvent } from "../vendor/htm-preact.js" */
/** @import { Editor } from "./editor.js" */

const FIRST_SHARE = 0.8; // of the map's pane that a picture takes below a roadmap, which has no size of its own
const LARGEST = 4096; // pixels of the longer side that are kept in memory
const USUAL_OPACITY = 0.6;

/**
 * The document says which picture, the library where it lies on the map; the viewer draws it.
 * Event: `image` when there is another one.
 */
export class Backdrop extends Observable {
  /** @type {ImageBitmap | null} */
  image = null; // an ImageBitmap

  /**
   * @param {ScenarioStore} store
   * @param {Stage} stage
   */
  constructor(store, stage) {
    super();
    this.store = store;
    this.stage = stage;
    this.columns = 1; // pixels of a row of the picture as it is in its file
    store.on("document", () => this.#load());
    stage.on("show", () => this.#give());
  }

  #shown = ""; // the address of the image

  get picture() {
    return this.store.document?.map?.picture ?? null;
  }

  /**
   * Put a picture into the scenario's folder, and lay the map over it.
   * @param {File} file
   * @returns {Promise<void>}
   */
  async take(file) {
    const { store } = this;
    const name = await this.#kept(file);
    const { width, height } = await createImageBitmap(file);
    const laid = isNetwork(store.document) ? this.#inSight(width, height) : {}; // else as wide as the map
    this.#put({ file: name, ...laid });
  }

  /**
   * Put a file beside the scenario: under its name, or with a number where another picture has it.
   * @param {File} file
   * @returns {Promise<string>}
   */
  async #kept(file) {
    const { files } = await get("/files");
    const taken = new Set(files.map(({ path }) => path));
    const [, stem, ending = ""] = present(/^(.*?)(\.[^.]*)?$/.exec(file.name));
    let name = file.name;
    for (let number = 2; taken.has(this.#path(name)); number++) {
      if (await isSame(file, this.#address(name))) return name;
      name = `${stem}-${number}${ending}`;
    }
    await upload(file, this.#path(name));
    return name;
  }

  /**
   * @param {string} name
   * @returns {string}
   */
  #path(name) {
    /** @type {string[]} */
    const parts = [];
    for (const part of [...this.store.folder.split("/"), ...name.split("/")]) {
      if (part === "..") parts.pop();
      else if (part && part !== ".") parts.push(part);
    }
    return parts.join("/");
  }

  /**
   * @param {string} name
   * @returns {string}
   */
  #address(name) {
    return `/api/v1/files/${inAddress(this.#path(name))}`;
  }

  /**
   * Scale and origin of a picture in the middle of what is seen.
   * @param {number} width
   * @param {number} height
   * @returns {{scale: number, origin: Point}}
   */
  #inSight(width, height) {
    const { viewport, roadmap } = this.stage.view;
    const { clientWidth, clientHeight } = this.stage.canvas;
    const pixels = Math.max(width / clientWidth, height / clientHeight) / FIRST_SHARE;
    /** @type {Point} */
    const corner = [
      viewport.toX((clientWidth - width / pixels) / 2),
      viewport.toY((clientHeight + height / pixels) / 2),
    ];
    return {
      scale: rounded(roadmap.unit / viewport.scale / pixels),
      origin: roadmap.toSite(...corner).map(rounded),
    };
  }

  /**
   * Length of a pixel and the lower left corner on the site, written or as the library found them.
   * @returns {{scale: number, origin: Point}}
   */
  #laid() {
    const background = present(this.stage.plan.roadmap.background);
    const { roadmap } = this.stage.view;
    const { scale, origin } = present(this.picture);
    return {
      scale: numberOf(scale, (background.width * roadmap.unit) / this.columns),
      origin: origin?.map((length) => numberOf(length)) ?? roadmap.toSite(...leftLow(background)),
    };
  }

  /**
   * Let two places of the site be a distance apart; the first one stays where it is.
   * @param {Point[]} places
   * @param {number} distance
   * @returns {void}
   */
  rescale([one, other], distance) {
    const { scale, origin } = this.#laid();
    const factor = distance / Math.hypot(other[0] - one[0], other[1] - one[1]);
    this.#put({
      ...present(this.picture),
      scale: rounded(scale * factor),
      origin: origin.map((length, axis) => rounded(one[axis] + (length - one[axis]) * factor)),
    });
  }

  /**
   * Lay the picture so that what is at one place of the site comes to lie at another one.
   * @param {Point[]} places
   * @returns {void}
   */
  move([from, to]) {
    const { scale, origin } = this.#laid();
    this.#put({
      ...present(this.picture),
      scale: rounded(scale),
      origin: origin.map((length, axis) => rounded(length + to[axis] - from[axis])),
    });
  }

  /** Let the picture be as wide as the map again. */
  fit() {
    const { scale, origin, ...rest } = present(this.picture);
    this.#put(rest);
  }

  /**
   * @param {number} opacity
   * @returns {void}
   */
  setOpacity(opacity) {
    this.#put({ ...present(this.picture), opacity });
  }

  remove() {
    this.store.change((document) => ({ ...document, map: withoutKey(document.map, "picture") }));
  }

  /**
   * @param {PictureData} picture
   * @returns {void}
   */
  #put(picture) {
    this.store.change((document) => ({
      ...document,
      map: { ...document.map, picture },
    }));
  }

  async #load() {
    const address = this.picture?.file ? this.#address(this.picture.file) : "";
    if (address === this.#shown) return;
    this.#shown = address;
    this.image = null;
    const image = address && (await pictureAt(address));
    if (!image || address !== this.#shown) return;
    this.image = image.image;
    this.columns = image.columns;
    this.#give();
    this.stage.repaint();
    this.tell("image");
  }

  /** The map that is shown takes the picture from memory; that of a plan may bring its own. */
  #give() {
    const background = this.stage.plan?.roadmap.background;
    if (background && !background.href) background.image = this.image;
  }
}

/**
 * The lower left corner of a picture in the drawing.
 * @param {{x: number, y: number, height: number, turn?: number}} background
 * @returns {Point}
 */
const leftLow = ({ x, y, height, turn = 0 }) => [
  x - height * Math.sin(turn),
  y + height * Math.cos(turn),
];

/**
 * A picture of the folder, made smaller if it is large; null if there is none that a browser shows.
 * @param {string} address
 * @returns {Promise<{image: ImageBitmap, columns: number} | null>}
 */
async function pictureAt(address) {
  const answer = await fetch(address);
  if (!answer.ok) return null;
  const whole = await createImageBitmap(await answer.blob()).catch(() => null);
  if (!whole) return null;
  const share = Math.min(LARGEST / Math.max(whole.width, whole.height), 1);
  const image =
    share < 1
      ? await createImageBitmap(whole, { resizeWidth: Math.round(whole.width * share) })
      : whole;
  return { image, columns: whole.width };
}

/**
 * @param {Blob} file
 * @param {string} address
 * @returns {Promise<boolean>}
 */
async function isSame(file, address) {
  const answer = await fetch(address);
  if (!answer.ok) return false;
  const [one, other] = await Promise.all([file.arrayBuffer(), answer.arrayBuffer()]);
  if (one.byteLength !== other.byteLength) return false;
  const [a, b] = [new Uint8Array(one), new Uint8Array(other)];
  return a.every((byte, i) => byte === b[i]);
}

/** Places of the site that are pressed one after the other, until there are enough. */
export class PickTool {
  static called = "pick";
  isDrawn = false;
  /** @type {Point[]} */
  points = [];
  /** @type {Point | null} */
  over = null;
  /** @type {string[]} */
  sentences = [];
  /** @type {(points: Point[]) => void} */
  done = () => {};

  /** @param {Editor} editor */
  constructor(editor) {
    this.editor = editor;
  }

  get isBusy() {
    return this.points.length > 0;
  }

  /**
   * Ask for places, each by a sentence; `done` is called with them.
   * @param {string[]} sentences
   * @param {(points: Point[]) => void} done
   * @returns {void}
   */
  ask(sentences, done) {
    this.cancel();
    this.sentences = sentences;
    this.done = done;
    this.editor.tool = this;
    this.editor.say(sentences[0]);
  }

  press() {}

  /**
   * @param {DrawingPoint} point
   * @returns {void}
   */
  drag(point) {
    this.hover(point);
  }

  /**
   * @param {DrawingPoint} point
   * @returns {void}
   */
  hover(point) {
    this.over = this.editor.roadmap.toSite(point.x, point.y);
  }

  leave() {
    this.over = null;
  }

  /**
   * @param {DrawingPoint} point
   * @returns {void}
   */
  release(point) {
    const { editor } = this;
    this.points.push(editor.roadmap.toSite(point.x, point.y));
    editor.say(this.sentences[this.points.length]);
    if (this.points.length < this.sentences.length) return;
    const { points, done } = this;
    this.cancel();
    editor.take("select");
    done(points);
  }

  cancel() {
    this.points = [];
    this.over = null;
  }

  /**
   * @param {CanvasRenderingContext2D} context
   * @param {Theme} theme
   * @param {number} scale
   * @returns {void}
   */
  paint(context, theme, scale) {
    const { roadmap } = this.editor;
    context.strokeStyle = theme.held;
    context.lineWidth = 2 / scale;
    const reach = 9 / scale;
    context.beginPath();
    for (const point of [...this.points, ...(this.over ? [this.over] : [])]) {
      const [x, y] = toDrawing(roadmap, ...point);
      context.moveTo(x - reach, y);
      context.lineTo(x + reach, y);
      context.moveTo(x, y - reach);
      context.lineTo(x, y + reach);
    }
    if (this.points.length && this.over) {
      context.moveTo(...toDrawing(roadmap, ...this.points[this.points.length - 1]));
      context.lineTo(...toDrawing(roadmap, ...this.over));
    }
    context.stroke();
  }
}

/** @param {Props} props */
export function BackdropPanel({ studio }) {
  const { backdrop, editor, store } = studio;
  const { picture } = backdrop;
  const [points, setPoints] = useState(/** @type {Point[] | null} */ (null));
  /**
   * @param {string[]} sentences
   * @param {(points: Point[]) => void} done
   * @returns {void}
   */
  const pick = (sentences, done) => editor.tools.get("pick").ask(sentences, done);
  /**
   * @param {{target: HTMLInputElement}} event
   * @returns {unknown}
   */
  const choose = ({ target }) =>
    target.files?.length && studio.attempt(() => backdrop.take(present(target.files)[0]));
  /**
   * @param {string} text
   * @param {() => void} action
   */
  const button = (text, action) =>
    html`<button type="button" class="framed" onClick=${action}>${text}</button>`;
  const rescale = (/** @type {number} */ distance) => {
    backdrop.rescale(present(points), distance);
    setPoints(null);
  };
  const wrong = store.faultsAt("map", "picture");
  return html`
    <section class="backdrop"><h2>${words.backdrop}</h2>
      ${
        !picture
          ? html`<label class="wide">${words.choosePicture}<input type="file" accept="image/png,image/jpeg,image/webp,image/bmp" onChange=${choose} /></label>`
          : html`
        <div class="fields">
          <span class="hint">${picture.file}</span>
          <label>${words.opacity}<input type="range" min="0.1" max="1" step="0.05" value=${numberOf(picture.opacity, USUAL_OPACITY)}
            onChange=${({ target }) => backdrop.setOpacity(Number(target.value))} /></label>
        </div>
        <div class="buttons">
          ${backdrop.image && button(words.setScale, () => pick(words.pickScale, setPoints))}
          ${backdrop.image && button(words.movePicture, () => pick(words.pickMove, (two) => backdrop.move(two)))}
          ${backdrop.image && button(words.setOrigin, () => pick(words.pickOrigin, ([origin]) => backdrop.move([origin, [0, 0]])))}
          ${picture.scale !== undefined && !isNetwork(store.document) && button(words.fitPicture, () => backdrop.fit())}
          ${button(words.removePicture, () => backdrop.remove())}
        </div>
        ${points && html`<${Distance} unit=${store.document.units?.length ?? ""} onGiven=${rescale} />`}`
      }
      ${wrong.map(({ message }) => html`<p class="wrong" role="alert" lang="en">${message}</p>`)}
    </section>`;
}

/**
 * The distance of the two places that were pressed.
 * @param {{unit: string, onGiven: (distance: number) => void}} props
 */
function Distance({ unit, onGiven }) {
  const [distance, setDistance] = useState(1);
  /** @type {import("../vendor/htm-preact.js").Ref<HTMLInputElement>} */
  const field = useRef(null);
  useEffect(() => field.current.select(), []);
  /**
   * @param {PageEvent} event
   * @returns {void}
   */
  const give = (event) => {
    event.preventDefault();
    onGiven(distance);
  };
  return html`
    <form class="fields" onSubmit=${give}>
      <label>${words.distance}<span><input type="number" required min="0.001" step="any" value=${distance} ref=${field}
        onInput=${({ target }) => setDistance(Number(target.value))} /> ${unit}</span></label>
      <button type="submit" class="framed strong">${words.apply}</button>
    </form>`;
}
