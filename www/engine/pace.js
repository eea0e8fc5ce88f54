// How many pixels a quick frame has while something moves: as many as keep up the rate of frames.
//
// A controller, and nothing else: it is told how long frames took, and says how large the next one is. It
// knows no clock and no machine, so that a test can be its machine.

/** Milliseconds of a frame that are aimed at: 36 frames a second, so that late ones still leave 30. */
export const AIM_MS = 28;
/** Mean of several frames that is too slow (ms). */
const SLOW_MS = 31;
/** Frames that are judged together: fewer would make the size follow what else the machine does. */
const WINDOW = 8;
/** Sizes are so many times apart, in pixels; and how many sizes larger it gets at once. */
const STEP = 2 ** 0.25;
const MOST_LARGER = 4;
/** Fewest and most pixels of a frame. */
const PIXELS = [1500, 1 << 20];
const STEPS = Math.floor(Math.log(PIXELS[1] / PIXELS[0]) / Math.log(STEP));
/** Windows in a row that must leave room before it gets larger: one, twice as many each time that a size was
 *  too large, and so many at most. */
const MOST_PATIENCE = 8;

const stepOf = (pixels) => Math.max(0, Math.min(STEPS, Math.floor(Math.log(pixels / PIXELS[0]) / Math.log(STEP))));

export class Pace {
  /** Which size it is, counted from the smallest. */
  #step = stepOf(16_000);
  /** What the frames of this window took (ms). */
  #frames = [];
  /** Windows in a row that left room, and how many it takes. */
  #roomy = 0;
  #patience = 1;
  #guessed = true;

  /** Pixels that the next frame may have, those of all sides together. */
  get pixels() {
    return Math.round(PIXELS[0] * STEP ** this.#step);
  }

  /** Columns and rows of the next frame, of one of so many sides, for a picture of a size. */
  size(width, height, sides = 1) {
    const scale = Math.max(1, Math.sqrt((width * height * sides) / this.pixels));
    return [Math.max(1, Math.round(width / scale)), Math.max(1, Math.round(height / scale))];
  }

  /** Something begins to move. What earlier movements have shown is kept; before the first one, `pixels` is a
   *  guess. */
  begin(pixels) {
    if (this.#guessed) this.#step = stepOf(pixels);
    this.#patience = 1;
    this.#frames = [];
    this.#roomy = 0;
  }

  /** Notes how long a frame took, all in all (ms), and how many pixels it had: a picture may have fewer than
   *  there is time for. */
  took(ms, pixels = this.pixels) {
    if (!(ms >= 0)) return;
    this.#guessed = false;
    // When the whole page was held up, that tells little of the size.
    this.#frames.push(Math.min(ms, 4 * AIM_MS));
    const count = this.#frames.length;
    const mean = this.#frames.reduce((a, b) => a + b) / count;
    const isHopeless = count > 1 && Math.min(...this.#frames) > 1.5 * SLOW_MS;
    if (count < WINDOW && !isHopeless) return;
    this.#frames = [];
    // So many steps too slow, if all of the time is the pixels'.
    const off = Math.log(mean / AIM_MS) / Math.log(STEP);
    if (mean > SLOW_MS) {
      this.#patience = Math.min(MOST_PATIENCE, 2 * this.#patience);
      this.#move(-Math.max(1, Math.round(off)));
      return;
    }
    this.#roomy = off <= -1 && pixels > 0.9 * this.pixels ? this.#roomy + 1 : 0;
    if (this.#roomy >= this.#patience) this.#move(Math.min(MOST_LARGER, Math.floor(-off)));
  }

  #move(steps) {
    this.#step = Math.max(0, Math.min(STEPS, this.#step + steps));
    this.#roomy = 0;
  }
}
