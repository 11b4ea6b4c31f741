/** The period as a function of a speed, a work time or the headway: exact, from the pieces of the report. */

import { decimal, fraction } from "../../../viz/page/assets/language/quantities.js";
/** @import { Fraction } from "../../../viz/page/assets/language/quantities.js" */
/** @import { CurveData } from "../api_types.js" */
/** @import { Numeral, ParameterPiece } from "../types.js" */

/**
 * @param {Fraction} one
 * @param {Fraction} other
 * @returns {Fraction}
 */
export const plus = ([a, b], [c, d]) => [a * d + c * b, b * d];
/**
 * @param {Fraction} one
 * @param {Fraction} other
 * @returns {Fraction}
 */
export const minus = ([a, b], [c, d]) => [a * d - c * b, b * d];
/**
 * @param {Fraction} one
 * @param {Fraction} other
 * @returns {Fraction}
 */
export const times = ([a, b], [c, d]) => reduced([a * c, b * d]);
/**
 * @param {Fraction} one
 * @param {Fraction} other
 * @returns {Fraction}
 */
export const over = ([a, b], [c, d]) => reduced([a * d, b * c]);
/**
 * @param {Fraction} value
 * @returns {number}
 */
export const number = ([top, bottom]) => Number(top) / Number(bottom);
/**
 * @param {Fraction} one
 * @param {Fraction} other
 * @returns {number}
 */
export const compared = ([a, b], [c, d]) => Number(a * d - c * b);

/**
 * @param {Fraction} value
 * @returns {Fraction}
 */
function reduced([top, bottom]) {
  let [a, b] = [top < 0n ? -top : top, bottom];
  while (b) [a, b] = [b, a % b];
  return a ? [top / a, bottom / a] : [0n, 1n];
}

/**
 * As a document has it: a number, or text where it has no end as a decimal.
 * @param {Fraction} value
 * @returns {Numeral}
 */
export function written([top, bottom]) {
  const text = decimal([top, bottom], 9);
  const isExact = compared(fraction(text), [top, bottom]) === 0;
  return isExact ? Number(text) : `${top}/${bottom}`;
}

const STEPS = 100; // about so many positions of a slider
const ROUND = [1n, 2n, 5n];

/**
 * A length of steps that is easy to read: 1, 2 or 5, times a power of ten.
 * @param {number} span
 * @returns {Fraction}
 */
function roundStep(span) {
  const power = Math.floor(Math.log10(span / STEPS));
  /** @type {Fraction} */
  const ten = power < 0 ? [1n, 10n ** BigInt(-power)] : [10n ** BigInt(power), 1n];
  const factor = ROUND.find((each) => (Number(each) * number(ten) * STEPS) / span >= 0.999) ?? 10n;
  return times([factor, 1n], ten);
}

export class ParameterCurve {
  /** @param {CurveData} curve */
  constructor({ kind, robot, stop, value, pieces }) {
    this.kind = kind;
    this.robot = robot;
    this.stop = stop;
    this.key = `${kind} ${robot} ${stop}`;
    /** @type {Fraction} */
    this.value = fraction(value);
    /** @type {ParameterPiece[]} */
    this.pieces = pieces.map(({ from, to, fixed, slope, circuit }) => ({
      from: fraction(from),
      to: fraction(to),
      fixed: fraction(fixed),
      slope: fraction(slope),
      circuit,
    }));
    this.least = this.pieces[0].from;
    this.most = this.pieces[this.pieces.length - 1].to;
    /** @type {Fraction} */
    this.step = this.isFixed ? [1n, 1n] : roundStep(number(minus(this.most, this.least)));
    /**
     * @param {Fraction} span
     * @returns {number}
     */
    const steps = (span) => Math.ceil(number(over(span, this.step)) - 1e-9);
    this.first = -steps(minus(this.value, this.least));
    this.last = steps(minus(this.most, this.value));
  }

  /** Whether no other value is possible: any headway would stop a circle of robots for ever. */
  get isFixed() {
    return compared(this.least, this.most) === 0;
  }

  /**
   * The value of a position of the slider; 0 is that of the scenario.
   * @param {number} position
   * @returns {Fraction}
   */
  at(position) {
    const value = plus(this.value, times([BigInt(position), 1n], this.step));
    if (compared(value, this.least) < 0) return this.least;
    return compared(value, this.most) > 0 ? this.most : reduced(value);
  }

  /**
   * The piece of a value; where two meet, the one of larger values.
   * @param {Fraction} value
   * @returns {ParameterPiece}
   */
  pieceAt(value) {
    return (
      this.pieces.find(({ to }) => compared(value, to) < 0) ?? this.pieces[this.pieces.length - 1]
    );
  }

  /**
   * The period for a value [time unit].
   * @param {Fraction} value
   * @returns {Fraction}
   */
  period(value) {
    const { fixed, slope } = this.pieceAt(value);
    return reduced(plus(fixed, this.kind === "speed" ? over(slope, value) : times(slope, value)));
  }
}
