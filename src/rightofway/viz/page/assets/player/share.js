import { contextOf } from "../drawing/canvas.js";
import { element } from "../common/dom.js";
import { texts } from "../language/language.js";

/** @import { Root } from "../common/root.js" */
/** @import { Clock } from "./clock.js" */
/** @import { DeepLink } from "./deep_link.js" */
/** @import { Diagram } from "../timetable/diagram.js" */
/** @import { MapView } from "../map/map_view.js" */
/** @import { Plan } from "../plan/plan.js" */
/** @import { Theme } from "../drawing/theme.js" */
/** @import { Words } from "../language/words.js" */

const SAID_FOR = 2000; // how long a button says what it did [ms]

/** Takes the moment elsewhere: as a link, as a picture. */
export class Share {
  /**
   * @param {Root} root
   * @param {Plan} plan
   * @param {Clock} clock
   * @param {MapView[]} maps
   * @param {Diagram[]} diagrams
   * @param {Theme} theme
   * @param {Words} words
   * @param {DeepLink} deepLink
   */
  constructor(root, plan, clock, maps, diagrams, theme, words, deepLink) {
    this.root = root;
    this.plan = plan;
    this.clock = clock;
    this.maps = maps;
    this.diagrams = diagrams;
    this.theme = theme;
    this.words = words;
    this.deepLink = deepLink;
    const buttons = {
      "copy-link": () => this.copyLink(),
      "save-picture": () => this.savePicture(),
      print: () => window.print(),
    };
    for (const [id, action] of Object.entries(buttons)) {
      const button = root.part(id);
      button.addEventListener("click", action);
      button.hidden = root.isEmbedded; // a frame of another page may do none of these
    }
  }

  async copyLink() {
    const address = this.deepLink.address;
    try {
      await navigator.clipboard.writeText(address);
      this.#say(this.root.part("copy-link"), texts.copied);
    } catch {
      window.prompt(texts.copyThis, address); // where the browser keeps the clipboard to itself
    }
  }

  /** Download maps and diagrams of the moment. */
  savePicture() {
    this.picture().toBlob((blob) => {
      if (!blob) return; // a picture larger than the browser can make
      const address = URL.createObjectURL(blob);
      const title = this.#titles.map((each) => each.replace(/\.[^.]*$/, "")).join(", ");
      element("a", {
        href: address,
        download: `${texts.pictureName({ title, time: this.words.time(this.clock.tick) })}.png`,
      }).click();
      setTimeout(() => URL.revokeObjectURL(address), SAID_FOR);
    });
  }

  get #titles() {
    return [this.plan, ...this.plan.others].map(({ title }) => title).filter(Boolean);
  }

  /** Heading, maps and diagrams of the moment on one canvas, the maps in columns as on the screen. */
  picture() {
    const { theme, words, clock } = this;
    const diagrams = this.diagrams.map(({ canvas }) => canvas).filter(({ height }) => height);
    const maps = this.maps.map(({ canvas }) => canvas);
    const [map] = maps;
    const ratio = map.width / map.clientWidth;
    /** @param {HTMLCanvasElement} canvas */
    const leftOf = (canvas) => Math.round(canvas.getBoundingClientRect().left);
    const columns = new Set(maps.map(leftOf)).size;
    const [head, caption] = [48, maps.length > 1 ? 24 : 0].map((pixels) =>
      Math.round(pixels * ratio),
    );
    const [across, line] = [columns * map.width, map.height + caption];
    const down = Math.ceil(maps.length / columns) * line;
    const isBeside = diagrams.length && leftOf(diagrams[0]) >= leftOf(map) + map.clientWidth;
    const [left, top] = isBeside ? [across, head] : [0, head + down];
    const high = diagrams.reduce((sum, { height }) => sum + height + caption, 0);
    const width = isBeside ? across + diagrams[0].width : across;
    const made = element("canvas", { width, height: Math.max(head + down, top + high) });
    const context = contextOf(made);
    context.fillStyle = theme.paper;
    context.fillRect(0, 0, made.width, made.height);
    context.fillStyle = theme.ink;
    /**
     * @param {string} text
     * @param {number} x
     * @param {number} y
     * @param {number} size
     */
    const write = (text, x, y, size) => {
      context.font = theme.font(size * ratio, 600);
      context.fillText(text, x, y);
    };
    const titles = this.#titles;
    const moment = [maps.length > 2 ? "" : titles.join(", "), words.moment(clock.tick)];
    write(moment.filter(Boolean).join(": "), 28 * ratio, 31 * ratio, 16);
    /**
     * @param {HTMLCanvasElement} canvas
     * @param {number} index
     * @param {number} x
     * @param {number} y
     */
    const place = (canvas, index, x, y) => {
      context.drawImage(canvas, x, y + caption);
      if (caption) write(titles[index] ?? "", x + 28 * ratio, y + 16 * ratio, 12);
    };
    maps.forEach((canvas, index) =>
      place(
        canvas,
        index,
        (index % columns) * map.width,
        head + Math.floor(index / columns) * line,
      ),
    );
    let y = top;
    diagrams.forEach((canvas, index) => {
      place(canvas, index, left, y);
      const x = left + ratio * this.diagrams[0].area.x(clock.tick);
      const { area } = this.diagrams[index];
      context.fillRect(x - 0.75 * ratio, y + caption, 1.5 * ratio, ratio * area.bottom);
      y += canvas.height + caption;
    });
    return made;
  }

  /**
   * @param {HTMLElement} button
   * @param {string} text
   */
  #say(button, text) {
    const before = (button.dataset.words ??= button.textContent ?? "");
    button.textContent = text;
    setTimeout(() => (button.textContent = before), SAID_FOR);
  }
}
