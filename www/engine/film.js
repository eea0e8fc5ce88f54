// The pixels of a picture with all that is known about them, as the module keeps them.

import { Progress } from '../halflight.js';

/** Words of a pixel: mean and squared deviations of three channels, samples, rejected samples. */
export const WORDS = 8;

export class Film {
  constructor(width, height) {
    this.width = width;
    this.height = height;
    this.words = new Uint32Array(WORDS * width * height);
    this.floats = new Float32Array(this.words.buffer);
    /** Samples of every pixel, and of the one that has most. */
    this.samples = 0;
    this.most = 1;
    /** Milliseconds that workers have spent on it. */
    this.busy = 0;
    /** What each pass has led to: { samples, seconds, error }. */
    this.history = [];
    this.progress = new Progress();
    this.error = undefined;
  }

  free() {
    this.progress.free();
  }

  /** A copy of the pixels of a tile. */
  cut([x0, y0, x1, y1]) {
    const columns = WORDS * (x1 - x0);
    const out = new Uint32Array(columns * (y1 - y0));
    for (let y = y0; y < y1; y++) {
      const from = WORDS * (y * this.width + x0);
      out.set(this.words.subarray(from, from + columns), columns * (y - y0));
    }
    return out;
  }

  /** Puts the pixels of a tile back. */
  paste([x0, y0, x1, y1], pixels) {
    this.most = Math.max(this.most, pixels[6]);
    const columns = WORDS * (x1 - x0);
    for (let y = y0; y < y1; y++) {
      const from = columns * (y - y0);
      this.words.set(pixels.subarray(from, from + columns), WORDS * (y * this.width + x0));
    }
  }

  /** Takes note of a pass over the whole picture. */
  record(samples, sum, values) {
    this.samples = samples;
    this.progress.record(samples, sum, values);
    this.error = this.progress.error();
    if (this.error !== undefined) {
      this.history.push({ samples, seconds: this.busy / 1000, error: this.error });
    }
  }

  /** The linear picture: red, green, blue of each pixel, row by row from the top; never below 0. */
  linear() {
    const out = new Float32Array(3 * this.width * this.height);
    for (let i = 0, o = 0; o < out.length; i += WORDS) {
      for (let c = 0; c < 3; c++) out[o++] = Math.max(this.floats[i + c], 0);
    }
    return out;
  }
}
