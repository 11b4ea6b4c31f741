import { figure, texts } from "./language.js";

/** @import { UnitsData } from "../payload.d.ts" */

/** @typedef {readonly [bigint, bigint]} Fraction Numerator and denominator. */

/**
 * Length of each unit of time [s].
 *
 * @type {Record<string, Fraction>}
 */
const SECONDS = { ms: [1n, 1000n], s: [1n, 1n], min: [60n, 1n], h: [3600n, 1n] };

/** The offset from UTC at the end of an instant. */
const OFFSET = /(?:Z|[+-]\d\d:\d\d)$/;

/** The last instant that the package writes [ms]. */
const LAST = Date.parse("9999-12-31T23:59:59.99Z");

/**
 * A number ("30313/700", 0.5, 1e-7) as an exact fraction: numerator and denominator.
 *
 * @param {string | number} value
 * @returns {Fraction}
 */
export function fraction(value) {
  const [top, bottom] = String(value).split("/");
  if (bottom) return [BigInt(top), BigInt(bottom)];
  const [digits, exponent = "0"] = top.split("e");
  const [whole, part = ""] = digits.split(".");
  const power = BigInt(exponent) - BigInt(part.length);
  const number = BigInt(whole + part);
  return power < 0n ? [number, 10n ** -power] : [number * 10n ** power, 1n];
}

/**
 * The whole number nearest to a fraction; a half is rounded away from zero.
 *
 * @param {Fraction} options
 */
function halfUp([top, bottom]) {
  const magnitude = (2n * (top < 0n ? -top : top) + bottom) / (2n * bottom);
  return top < 0n ? -magnitude : magnitude;
}

/**
 * A whole number of units of the last decimal, as text with `digits` decimals.
 *
 * @param {bigint} number
 * @param {number} digits
 */
function withPoint(number, digits) {
  const text = String(number < 0n ? -number : number).padStart(digits + 1, "0");
  const cut = text.length - digits;
  return `${number < 0n ? "-" : ""}${text.slice(0, cut)}${digits ? "." : ""}${text.slice(cut)}`;
}

/**
 * A fraction with exactly `digits` decimals.
 *
 * @param {Fraction} options
 * @param {number} [digits]
 */
function fixed([top, bottom], digits = 2) {
  return withPoint(halfUp([top * 10n ** BigInt(digits), bottom]), digits);
}

/**
 * A fraction as a person writes it: all decimals if `digits` are enough, else exactly `digits`, so
 * that a rounded number looks rounded; two significant digits for what would be 0.00.
 *
 * @param {Fraction} options
 * @param {number} [digits]
 */
export function decimal([top, bottom], digits = 2) {
  const scaled = top * 10n ** BigInt(digits);
  const text = fixed([top, bottom], digits);
  if (scaled % bottom === 0n) return digits ? text.replace(/\.?0+$/, "") : text;
  if (halfUp([scaled, bottom])) return text;
  const rounded = (Number(top) / Number(bottom)).toExponential(1);
  return Number(rounded).toFixed(1 - Number(rounded.split("e")[1]));
}

/** Times, lengths and speeds as people read them; the twin of quantities.py, case for case. */
export class Quantities {
  /** @type {Fraction} */
  #perTick;

  /** The instant of time 0 as if it were in UTC [ms]; null without a start. */
  #start;

  /**
   * `units` has `length` and `time`, each a name or null, and perhaps `start`; `tick` is a numerator
   * and a denominator.
   *
   * @param {UnitsData} units
   * @param {readonly [number | bigint, number | bigint]} tick
   */
  constructor(units, tick) {
    this.units = units;
    this.#perTick = [BigInt(tick[0]), BigInt(tick[1])];
    this.seconds = SECONDS[units.time ?? ""] ?? null;
    this.#start = units.start ? Date.parse(`${units.start.replace(OFFSET, "")}Z`) : null;
  }

  /**
   * How long a number of ticks lasts: "6 min 23 s", "2 time units".
   *
   * @param {number | string} ticks
   */
  duration(ticks) {
    const time = this.#time(ticks);
    return this.seconds
      ? figure(this.#clock(product(time, this.seconds)))
      : texts.timeUnits({ number: figure(decimal(time)) });
  }

  /**
   * A point in time: "10:32", "6 min 23 s" after the start, "time 2".
   *
   * @param {number | string} ticks
   */
  moment(ticks) {
    if (this.#start !== null && this.seconds)
      return figure(this.#clockTime(this.#start, product(this.#time(ticks), this.seconds)));
    return this.seconds ? this.duration(ticks) : texts.moment({ number: this.cell(ticks) });
  }

  /**
   * A time as the bare number of a table's cell.
   *
   * @param {number | string} ticks
   */
  cell(ticks) {
    return figure(decimal(this.#time(ticks)));
  }

  /**
   * A time where there is little room: a duration, or a bare number where no unit is known.
   *
   * @param {number | string} ticks
   */
  short(ticks) {
    return this.seconds ? this.duration(ticks) : this.cell(ticks);
  }

  /**
   * The same while time runs: always with `digits` decimals, so that the text does not jump.
   *
   * @param {number | string} ticks
   * @param {number} [digits]
   */
  running(ticks, digits = 1) {
    const time = this.#time(ticks);
    return this.seconds
      ? figure(this.#clock(product(time, this.seconds), (part) => fixed(part, digits)))
      : figure(fixed(time, digits));
  }

  /**
   * A length: "0.45 m", "0.45 length units".
   *
   * @param {string | number} value
   */
  length(value) {
    const { length } = this.units;
    const number = figure(decimal(fraction(value)));
    return length ? `${number} ${length}` : texts.lengthUnits({ number });
  }

  /**
   * A speed: "1.2 m/s"; a bare number where the scenario names no units.
   *
   * @param {string | number} value
   */
  speed(value) {
    const { length, time } = this.units;
    const number = figure(decimal(fraction(value)));
    return length && time ? `${number} ${length}/${time}` : number;
  }

  /** @param {number | string} ticks */
  #time(ticks) {
    return product(fraction(ticks), this.#perTick);
  }

  /**
   * A time of day, some seconds after the start [ms], rounded to hundredths; with the date on later
   * days.
   *
   * @param {number} start
   * @param {Fraction} seconds
   */
  #clockTime(start, [top, bottom]) {
    const moment = new Date(start + 10 * Number(halfUp([top * 100n, bottom])));
    if (Number.isNaN(moment.getTime()) || moment.getTime() > LAST)
      return this.#clock([top, bottom]);
    const [date, clock] = moment.toISOString().slice(0, -2).split("T");
    const day = date === new Date(start).toISOString().split("T")[0] ? "" : `${date} `;
    const isWhole = clock.endsWith(":00.00");
    return `${day}${isWhole ? clock.slice(0, -6) : clock.replace(/\.?0+$/, "")}`;
  }

  /**
   * A duration [s] in the parts that a person would say; `write` writes its seconds.
   *
   * @param {Fraction} options
   * @param {(part: Fraction, digits?: number) => string} [write]
   * @returns {string}
   */
  #clock([top, bottom], write = decimal) {
    if (top < 0n) return `-${this.#clock([-top, bottom], write)}`;
    if (this.units.time === "ms" && top < bottom) return `${write([top * 1000n, bottom])} ms`;
    if (halfUp([top * 100n, bottom]) < 60n * 100n) return `${write([top, bottom])} s`;
    const tenths = halfUp([top * 10n, bottom]);
    if (tenths < 3600n * 10n) {
      const rest = tenths % 600n;
      return `${tenths / 600n} min${rest || write !== decimal ? ` ${write([rest, 10n], 1)} s` : ""}`;
    }
    const seconds = halfUp([top, bottom]);
    /** @type {[bigint, string][]} */
    const parts = [
      [seconds / 3600n, "h"],
      [(seconds / 60n) % 60n, "min"],
      [seconds % 60n, "s"],
    ];
    return parts
      .filter(([number]) => number)
      .map(([number, unit]) => `${number} ${unit}`)
      .join(" ");
  }
}

/**
 * What two fractions make, multiplied.
 *
 * @param {Fraction} options
 * @param {Fraction} other
 * @returns {Fraction}
 */
export function product([top, bottom], [otherTop, otherBottom]) {
  return [top * otherTop, bottom * otherBottom];
}
