// The pixels of a picture with all that is known about them, as the module keeps them.

import { Progress, Refinement } from '../halflight.js';

/** Words of a pixel: mean and squared deviations of three channels, samples, rejected samples. */
export const WORDS = 8;

export class Film {
  #words;
  #floats;
  #progress;

  constructor(width, height) {
    this.width = width;
    this.height = height;
    /** Samples of a pixel in the mean, and of the one that has most. */
    this.samples = 0;
    this.most = 1;
    /** Where samples go where the error is: { rect, state, mse, steps, met, busy } of each tile. */
    this.tiles = undefined;
    /** Milliseconds that workers have spent on it. */
    this.busy = 0;
    /** What each pass has led to: { samples, seconds, error }. */
    this.history = [];
    this.error = undefined;
  }

  free() {
    this.#progress?.free();
    this.#progress = undefined;
  }

  /** The pixels; most films of something that moves are gone before there are any. */
  get words() {
    this.#words ??= new Uint32Array(WORDS * this.width * this.height);
    return this.#words;
  }

  /** The same bits as numbers. */
  get floats() {
    this.#floats ??= new Float32Array(this.words.buffer);
    return this.#floats;
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
    for (let i = 6; i < pixels.length; i += WORDS) this.most = Math.max(this.most, pixels[i]);
    const columns = WORDS * (x1 - x0);
    for (let y = y0; y < y1; y++) {
      const from = columns * (y - y0);
      this.words.set(pixels.subarray(from, from + columns), WORDS * (y * this.width + x0));
    }
  }

  /** Cuts the picture into the tiles of the command line. */
  cutIntoTiles() {
    const side = Refinement.side();
    this.tiles = [];
    for (let y = 0; y < this.height; y += side) {
      for (let x = 0; x < this.width; x += side) {
        const rect = [x, y, Math.min(x + side, this.width), Math.min(y + side, this.height)];
        this.tiles.push({ rect, state: new Uint32Array(0), mse: undefined, steps: 0, met: Infinity, busy: false });
      }
    }
  }

  /** True when every tile is known to be as good as that. */
  meets(error) {
    return this.tiles?.every((tile) => tile.met <= error) ?? false;
  }

  /** Of the tiles that nobody works on and that are not good enough, the one that has had least. */
  nextTile(error) {
    const open = this.tiles.filter((tile) => !tile.busy && tile.met > error);
    return open.reduce((least, tile) => (least && least.steps <= tile.steps ? least : tile), undefined);
  }

  /** Takes note of a step of a tile that has come to its end. */
  refined(tile, { pixels, state, mse }, samples, error) {
    this.paste(tile.rect, pixels);
    Object.assign(tile, { state, mse, steps: tile.steps + 1 });
    if (samples === 0) tile.met = error;
    const area = ([x0, y0, x1, y1]) => (x1 - x0) * (y1 - y0);
    const sum = this.tiles.reduce((total, { rect, mse: part }) => total + area(rect) * part, 0);
    this.error = Number.isFinite(sum) ? Math.sqrt(sum / (this.width * this.height)) : undefined;
  }

  /** Takes note of a pass over the whole picture. */
  record(samples, sum, values) {
    this.samples = samples;
    this.#progress ??= new Progress();
    this.#progress.record(samples, sum, values);
    this.error = this.#progress.error();
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
