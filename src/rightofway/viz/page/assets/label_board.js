const SQUARE = 48; // pixels; side of the squares that taken places are sorted into

/** Which places of a picture are taken, so that no two labels are written over each other. */
export class LabelBoard {
  #squares = new Map();

  /** Start again on a canvas of a given size; nothing is free beyond its borders. */
  clear(width, height) {
    this.#squares.clear();
    Object.assign(this, { width, height });
  }

  /** Keep a rectangle free of labels. */
  take(left, top, right, bottom) {
    this.#add({ left, top, right, bottom, radius: 0 });
  }

  /** Keep a disc free of labels. */
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

  #add(item) {
    for (const key of this.#keys(item.left, item.top, item.right, item.bottom)) {
      if (!this.#squares.has(key)) this.#squares.set(key, []);
      this.#squares.get(key).push(item);
    }
  }

  *#keys(left, top, right, bottom) {
    for (let row = Math.floor(top / SQUARE); row <= Math.floor(bottom / SQUARE); row++) {
      for (let column = Math.floor(left / SQUARE); column <= Math.floor(right / SQUARE); column++)
        yield row * 65536 + column;
    }
  }
}

/** Where a label may stand round a disc, best first: how far right and down its middle is. */
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

/** The box of a label on a side of a disc. */
export function boxBeside(x, y, radius, width, height, [right, down]) {
  const [middleX, middleY] = [
    x + right * (radius + 3 + width / 2),
    y + down * (radius + 2 + height / 2),
  ];
  return [middleX - width / 2, middleY - height / 2, middleX + width / 2, middleY + height / 2];
}

/** How wide texts are in a font [pixels]; each is measured once. */
export class TextWidths {
  #widths = new Map();

  of(context, text, font) {
    const key = `${font} ${text}`;
    if (!this.#widths.has(key)) {
      context.font = font;
      this.#widths.set(key, context.measureText(text).width);
    }
    return this.#widths.get(key);
  }
}

/** A name, and the beginning of one that is too long [characters]. */
export function cut(name, longest = 20) {
  return name.length > longest ? `${name.slice(0, longest - 1)}…` : name;
}
