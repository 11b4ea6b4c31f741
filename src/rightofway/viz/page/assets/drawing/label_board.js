const SQUARE = 48; // pixels; side of the squares that taken places are sorted into

/** @typedef {[number, number, number, number]} Box Left, top, right, bottom. */
/** @typedef {{ left: number, top: number, right: number, bottom: number, x: number, y: number, radius: number }} Taken A rectangle, or the disc in it. */

/** Which places of a picture are taken, so that no two labels are written over each other. */
export class LabelBoard {
  /** @type {Map<number, Taken[]>} */
  #squares = new Map();
  width = 0;
  height = 0;

  /**
   * Start again on a canvas of a given size; nothing is free beyond its borders.
   *
   * @param {number} width
   * @param {number} height
   */
  clear(width, height) {
    this.#squares.clear();
    this.width = width;
    this.height = height;
  }

  /**
   * Keep a rectangle free of labels.
   *
   * @param {number} left
   * @param {number} top
   * @param {number} right
   * @param {number} bottom
   */
  take(left, top, right, bottom) {
    this.#add({ left, top, right, bottom, x: left, y: top, radius: 0 });
  }

  /**
   * Keep a disc free of labels.
   *
   * @param {number} x
   * @param {number} y
   * @param {number} radius
   */
  takeDisc(x, y, radius) {
    this.#add({
      left: x - radius,
      top: y - radius,
      right: x + radius,
      bottom: y + radius,
      x,
      y,
      radius,
    });
  }

  /**
   * @param {number} left
   * @param {number} top
   * @param {number} right
   * @param {number} bottom
   */
  isFree(left, top, right, bottom) {
    if (left < 0 || top < 0 || right > this.width || bottom > this.height) return false;
    for (const key of this.#keys(left, top, right, bottom)) {
      for (const it of this.#squares.get(key) ?? []) {
        if (it.left >= right || it.right <= left || it.top >= bottom || it.bottom <= top) continue;
        if (!it.radius) return false;
        const across = it.x - Math.min(Math.max(it.x, left), right);
        const down = it.y - Math.min(Math.max(it.y, top), bottom);
        if (across * across + down * down < it.radius * it.radius) return false;
      }
    }
    return true;
  }

  /** @param {Taken} item */
  #add(item) {
    for (const key of this.#keys(item.left, item.top, item.right, item.bottom)) {
      const square = this.#squares.get(key);
      if (square) square.push(item);
      else this.#squares.set(key, [item]);
    }
  }

  /**
   * @param {number} left
   * @param {number} top
   * @param {number} right
   * @param {number} bottom
   */
  *#keys(left, top, right, bottom) {
    for (let row = Math.floor(top / SQUARE); row <= Math.floor(bottom / SQUARE); row++) {
      for (let column = Math.floor(left / SQUARE); column <= Math.floor(right / SQUARE); column++)
        yield row * 65536 + column;
    }
  }
}

/**
 * Where a label may stand round a disc, best first: how far right and down its middle is.
 *
 * @type {readonly (readonly [number, number])[]}
 */
export const SIDES = [
  [1, 0],
  [-1, 0],
  [0, -1],
  [0, 1],
  [0.75, -0.8],
  [-0.75, -0.8],
  [0.75, 0.8],
  [-0.75, 0.8],
  [1, -1],
  [-1, -1],
  [1, 1],
  [-1, 1],
];

/**
 * The box of a label on a side of a disc.
 *
 * @param {number} x
 * @param {number} y
 * @param {number} radius
 * @param {number} width
 * @param {number} height
 * @param {readonly [number, number]} options
 * @returns {Box}
 */
export function boxBeside(x, y, radius, width, height, [right, down]) {
  const [middleX, middleY] = [
    x + right * (radius + 3 + width / 2),
    y + down * (radius + 2 + height / 2),
  ];
  return [middleX - width / 2, middleY - height / 2, middleX + width / 2, middleY + height / 2];
}

/** How wide texts are in a font [pixels]; each is measured once. */
export class TextWidths {
  /** @type {Map<string, number>} */
  #widths = new Map();

  /**
   * @param {CanvasRenderingContext2D} context
   * @param {string} text
   * @param {string} font
   */
  of(context, text, font) {
    const key = `${font} ${text}`;
    let width = this.#widths.get(key);
    if (width === undefined) {
      context.font = font;
      ({ width } = context.measureText(text));
      this.#widths.set(key, width);
    }
    return width;
  }
}

/**
 * A name, and the beginning of one that is too long [characters].
 *
 * @param {string} name
 * @param {number} [longest]
 */
export function cut(name, longest = 20) {
  return name.length > longest ? `${name.slice(0, longest - 1)}…` : name;
}
