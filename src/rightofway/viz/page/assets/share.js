import { AXIS_HEIGHT } from "./axis.js";
import { EMBEDDED, element } from "./dom.js";
import { texts } from "./language.js";

const SAID_FOR = 2000; // how long a button says what it did [ms]

/** Takes the moment elsewhere: as a link, as a picture. */
export class Share {
  constructor(plan, clock, maps, diagram, theme, words, deepLink) {
    Object.assign(this, { plan, clock, maps, diagram, theme, words, deepLink });
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

  /** Download map and diagram of the moment. */
  savePicture() {
    this.picture().toBlob((blob) => {
      const address = URL.createObjectURL(blob);
      const title = this.#title(this.#titles.map((each) => each.replace(/\.[^.]*$/, "")));
      element("a", {
        href: address,
        download: `${texts.pictureName(title, this.words.time(this.clock.tick))}.png`,
      }).click();
      setTimeout(() => URL.revokeObjectURL(address), SAID_FOR);
    });
  }

  get #titles() {
    return [this.plan.title, this.plan.other?.title].filter(Boolean);
  }

  #title(titles) {
    return titles.length > 1 ? texts.twoTitles(...titles) : (titles[0] ?? "");
  }

  /** Heading, maps and diagram of the moment on one canvas. */
  picture() {
    const { theme, words, clock } = this;
    const { canvas: diagram } = this.diagram;
    const maps = this.maps.map(({ canvas }) => canvas);
    const [map] = maps;
    const ratio = map.width / map.clientWidth;
    const head = Math.round(48 * ratio);
    const isBeside = diagram.getBoundingClientRect().left >= map.getBoundingClientRect().right;
    const across = maps.reduce((sum, canvas) => sum + canvas.width, 0);
    const [left, top] = isBeside ? [across, head] : [0, head + map.height];
    const width = isBeside ? across + diagram.width : across;
    const height = Math.max(head + map.height, top + diagram.height);
    const made = element("canvas", { width, height });
    const context = made.getContext("2d");
    context.fillStyle = theme.paper;
    context.fillRect(0, 0, made.width, made.height);
    maps.forEach((canvas, place) => context.drawImage(canvas, place * map.width, head));
    if (diagram.height) context.drawImage(diagram, left, top);
    context.scale(ratio, ratio);
    context.fillStyle = theme.ink;
    context.font = theme.font(16, 600);
    context.fillText(
      [this.#title(this.#titles), words.moment(clock.tick)].filter(Boolean).join(": "),
      28,
      31,
    );
    const x = left / ratio + this.diagram.area.x(clock.tick);
    if (diagram.height)
      context.fillRect(x - 0.75, top / ratio, 1.5, diagram.clientHeight - AXIS_HEIGHT);
    return made;
  }

  #say(button, text) {
    const before = (button.words ??= button.textContent);
    button.textContent = text;
    setTimeout(() => (button.textContent = before), SAID_FOR);
  }
}
