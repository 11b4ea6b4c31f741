/** A picture below a roadmap that is being drawn: its scale by two places and their distance, its origin by one. */

import { inAddress, upload } from "../api.js";
import { html, useState } from "../vendor/htm-preact.js";
import { words } from "../words.js";
import { toDrawing } from "./places.js";

const FIRST_SHARE = 0.8; // of the map's pane that a new picture takes

/** Kept for the file in this browser: it is for drawing only, and no part of the scenario. */
export class Backdrop {
  image = null; // an ImageBitmap
  place = null; // { file, left, top, scale }: corner on the site [length unit], length units in a pixel

  constructor(store, stage) {
    Object.assign(this, { store, stage });
    this.of = 0;
    stage.on("underlay", () => this.#paint());
    store.on("document", () => store.opened !== this.of && this.#open());
  }

  get #key() {
    return `backdrop ${this.store.folder} ${this.store.path}`;
  }

  /** Take a picture, put it into the folder, and show it in the middle of what is seen. */
  async take(file) {
    const { path } = await upload(file, file.name, { replace: true });
    this.image = await createImageBitmap(file);
    const { viewport, roadmap } = this.stage.view;
    const { clientWidth, clientHeight } = this.stage.canvas;
    const pixels =
      Math.max(this.image.width / clientWidth, this.image.height / clientHeight) / FIRST_SHARE;
    const scale = roadmap.unit / viewport.scale / pixels;
    const corner = [
      (clientWidth - this.image.width / pixels) / 2,
      (clientHeight - this.image.height / pixels) / 2,
    ];
    const [left, top] = roadmap.toSite(viewport.toX(corner[0]), viewport.toY(corner[1]));
    this.#put({ file: path, left, top, scale });
  }

  /** Let two places of the site be a distance apart; the first one stays where it is. */
  rescale([one, other], distance) {
    const { left, top, scale, file } = this.place;
    const factor = distance / Math.hypot(other[0] - one[0], other[1] - one[1]);
    this.#put({
      file,
      left: one[0] + (left - one[0]) * factor,
      top: one[1] + (top - one[1]) * factor,
      scale: scale * factor,
    });
  }

  /** Let a place of the site be the origin. */
  setOrigin([x, y]) {
    this.#put({ ...this.place, left: this.place.left - x, top: this.place.top - y });
  }

  remove() {
    this.image = this.place = null;
    localStorage.removeItem(this.#key);
    this.stage.ask();
  }

  #put(place) {
    this.place = place;
    localStorage.setItem(this.#key, JSON.stringify(place));
    this.stage.ask();
  }

  async #open() {
    this.of = this.store.opened;
    this.image = this.place = null;
    const place = JSON.parse(localStorage.getItem(this.#key) ?? "null");
    if (!place) return;
    const answer = await fetch(`/api/v1/files/${inAddress(place.file)}`);
    if (!answer.ok) return;
    const image = await createImageBitmap(await answer.blob());
    Object.assign(this, { place, image });
    this.stage.ask();
  }

  #paint() {
    const { image, place, stage } = this;
    if (!image) return;
    const { roadmap } = stage.plan;
    const [x, y] = toDrawing(roadmap, place.left, place.top);
    const side = place.scale / roadmap.unit;
    stage.context.globalAlpha = 0.6;
    stage.context.drawImage(image, x, y, image.width * side, image.height * side);
    stage.context.globalAlpha = 1;
  }
}

/** Places of the site that are pressed one after the other, until there are enough. */
export class PickTool {
  static called = "pick";
  isDrawn = false;

  constructor(editor) {
    this.editor = editor;
    this.cancel();
  }

  get isBusy() {
    return this.points.length > 0;
  }

  /** Ask for a number of places; `done` is called with them. */
  ask(count, done) {
    Object.assign(this, { count, done, points: [] });
    this.editor.tool = this;
    this.editor.say(words.pickPoint(count));
  }

  press() {}

  drag() {}

  hover() {}

  release(point) {
    const { editor } = this;
    this.points.push(editor.roadmap.toSite(point.x, point.y));
    editor.say(words.pickPoint(this.count - this.points.length));
    if (this.points.length < this.count) return;
    const { points, done } = this;
    this.cancel();
    editor.take("select");
    done(points);
  }

  cancel() {
    this.points = [];
  }

  paint(context, theme, scale) {
    context.strokeStyle = theme.held;
    context.lineWidth = 2 / scale;
    for (const point of this.points) {
      const [x, y] = toDrawing(this.editor.roadmap, ...point);
      const reach = 9 / scale;
      context.beginPath();
      for (const [right, down] of [
        [1, 0],
        [0, 1],
      ]) {
        context.moveTo(x - right * reach, y - down * reach);
        context.lineTo(x + right * reach, y + down * reach);
      }
      context.stroke();
    }
  }
}

export function BackdropPanel({ studio }) {
  const { backdrop, editor } = studio;
  const [points, setPoints] = useState(null);
  const [distance, setDistance] = useState(1);
  const pick = (count, done) => editor.tools.get("pick").ask(count, done);
  const change = (action) => {
    action();
    studio.tell("change");
  };
  return html`
    <section><h2>${words.backdrop}</h2>
      ${
        !backdrop.image
          ? html`<label class="wide">${words.choosePicture}<input type="file" accept="image/png,image/jpeg,image/bmp"
        onChange=${({ target }) => studio.attempt(() => backdrop.take(target.files[0]))} /></label>`
          : html`
        <div class="buttons">
          <button type="button" class="framed" onClick=${() => pick(2, setPoints)}>${words.setScale}</button>
          <button type="button" class="framed" onClick=${() => pick(1, ([origin]) => change(() => backdrop.setOrigin(origin)))}>${words.setOrigin}</button>
          <button type="button" class="framed" onClick=${() => change(() => backdrop.remove())}>${words.removePicture}</button>
        </div>
        ${
          points &&
          html`<form class="fields" onSubmit=${(event) => {
            event.preventDefault();
            change(() => backdrop.rescale(points, distance));
            setPoints(null);
          }}><label>${words.distance}<input type="number" required min="0.001" step="any" value=${distance} onInput=${({ target }) => setDistance(Number(target.value))} /></label>
          <button type="submit" class="framed strong">${words.apply}</button></form>`
        }`
      }
    </section>`;
}
