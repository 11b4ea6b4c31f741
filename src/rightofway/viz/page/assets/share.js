import { EMBEDDED, element } from "./dom.js";
import { texts } from "./language.js";

const SAID_FOR = 2000; // how long a button says what it did [ms]

/** Takes the moment elsewhere: as a link, as a picture. */
export class Share {
  constructor(plan, clock, maps, diagrams, theme, words, deepLink) {
    Object.assign(this, { plan, clock, maps, diagrams, theme, words, deepLink });
    const buttons = {
      "copy-link": () => this.copyLink(),
      "save-picture": () => this.savePicture(),
      print: () => window.print(),
    };
    for (const [id, action] of Object.entries(buttons)) {
      this[id] = document.getElementById(id);
      this[id].addEventListener("click", action);
      this[id].hidden = EMBEDDED; // a frame of another page may do none of these
    }
  }

  async copyLink() {
    const address = this.deepLink.address;
    try {
      await navigator.clipboard.writeText(address);
      this.#say(this["copy-link"], texts.copied);
    } catch {
      window.prompt(texts.copyThis, address); // where the browser keeps the clipboard to itself
    }
  }

  /** Download maps and diagrams of the moment. */
  savePicture() {
    this.picture().toBlob((blob) => {
      const address = URL.createObjectURL(blob);
      const title = this.#titles.map((each) => each.replace(/\.[^.]*$/, "")).join(", ");
      element("a", {
        href: address,
        download: `${texts.pictureName(title, this.words.time(this.clock.tick))}.png`,
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
    const context = made.getContext("2d");
    context.fillStyle = theme.paper;
    context.fillRect(0, 0, made.width, made.height);
    context.fillStyle = theme.ink;
    const write = (text, x, y, size) => {
      context.font = theme.font(size * ratio, 600);
      context.fillText(text, x, y);
    };
    const titles = this.#titles;
    const moment = [maps.length > 2 ? "" : titles.join(", "), words.moment(clock.tick)];
    write(moment.filter(Boolean).join(": "), 28 * ratio, 31 * ratio, 16);
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

  #say(button, text) {
    const before = (button.words ??= button.textContent);
    button.textContent = text;
    setTimeout(() => (button.textContent = before), SAID_FOR);
  }
}
