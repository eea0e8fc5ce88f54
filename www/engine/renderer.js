// Progressive rendering. One picture gets its samples where its error is, tile by tile; two that are compared
// get passes that double the samples. And quick frames at a lower resolution while something moves.

import { Film } from './film.js';
import { Pace } from './pace.js';

/** How long a worker should be busy with one tile (ms): no longer than a change may wait. */
const TILE_MS = 30;
/** How long workers may be busy with the first frame of all (ms). */
const FIRST_FRAME_MS = 16;
/** How long nothing must have moved before the picture is refined (ms). */
const STILL_MS = 140;
/** How often something is said about it (ms). */
const REPORT_MS = 100;
/** Samples after which a pixel is as good as single precision can make it. */
const MOST_SAMPLES = 1 << 16;

export class Renderer extends EventTarget {
  films = [];
  paused = false;
  /** Relative error at which it is good enough. */
  target = 0.01;
  /** Fixed number of samples instead, when not 0. */
  budget = 0;
  /** False when every pixel of one picture, too, is to get as many samples. */
  adaptive = true;
  /** `samples` or `time`: what two sides have in common. */
  equal = 'samples';
  /** Samples of all workers in a second. */
  rate = 1e6;
  /** Frames of late, for telling how many there are in a second. */
  frames = [];
  elapsed = 0;
  /** How large the frames are. */
  pace = new Pace();
  /** Called before a frame, for telling the workers what has moved. */
  prepare = () => {};

  #pool;
  #generation = 0;
  #moving = false;
  #moved = 0;
  /** True when something has moved since the last frame. */
  #due = false;
  #wake = () => {};
  #ended = false;

  constructor(pool) {
    super();
    this.#pool = pool;
    this.#loop();
  }

  #tell(type, detail) {
    this.dispatchEvent(new CustomEvent(type, { detail }));
  }

  /** Begins anew: `sides` pictures of a size. Call it after the scene has changed. */
  restart(width, height, sides) {
    this.#generation += 1;
    for (const film of this.films) film.free();
    this.films = Array.from({ length: sides }, () => new Film(width, height));
    this.elapsed = 0;
    this.#wake();
  }

  /** As `restart`, for something that is being moved: quick frames first. */
  move(width, height, sides) {
    if (!this.#moving) this.pace.begin(this.rate * (FIRST_FRAME_MS / 1000));
    this.#moving = this.#due = true;
    this.#moved = performance.now();
    this.restart(width, height, sides);
  }

  /** Other workers; they render when the next `restart` or `move` says what. */
  use(pool) {
    this.restart(0, 0, 0);
    this.#pool = pool;
  }

  /** Nothing more is rendered. */
  end() {
    this.restart(0, 0, 0);
    this.#ended = true;
  }

  /** True while something moves. */
  get moving() {
    return this.#moving;
  }

  /** The movement is over. */
  release() {
    this.#moved = -Infinity;
    this.#wake();
  }

  pause(paused) {
    this.paused = paused;
    this.#wake();
  }

  /** True when a side is good enough, or has what it may have. */
  done(film) {
    if (this.budget) return film.samples >= this.budget;
    if (this.refines) return film.meets(this.target);
    return film.samples >= MOST_SAMPLES || (film.samples >= 8 && film.error <= this.target);
  }

  /** True when samples go where the error is. */
  get refines() {
    return this.adaptive && !this.budget && this.films.length === 1;
  }

  /** The side to work on next; undefined when all are done. Of two, none goes on without the other. */
  #next() {
    if (this.films.length === 0 || this.films.every((film) => this.done(film))) return undefined;
    const spent = (film) => (this.equal === 'time' ? film.busy : film.samples);
    return this.films.reduce((a, b) => (spent(b) < spent(a) ? b : a));
  }

  async #loop() {
    while (!this.#ended) {
      const generation = this.#generation;
      try {
        await this.#step();
      } catch (error) {
        // Of work that nobody waits for any more, nothing is said.
        if (generation !== this.#generation) continue;
        this.restart(0, 0, 0);
        this.#tell('failed', { error });
      }
    }
  }

  /** A frame, a pass, or a rest. */
  async #step() {
    const film = this.paused && this.films[0]?.samples ? undefined : this.#next();
    if (!film || document.hidden) {
      this.#tell('idle');
      await this.#rest(500);
    } else if (this.#moving) {
      await this.#frame();
    } else if (this.refines) {
      await this.#refine(film);
    } else {
      await this.#pass(film);
    }
  }

  /** Waits until something happens, but not for long (ms). */
  async #rest(most) {
    await new Promise((resolve) => { this.#wake = resolve; setTimeout(resolve, most); });
    this.#wake = () => {};
  }

  /** A frame at a resolution that takes a fraction of a second. */
  async #frame() {
    if (!this.#due && performance.now() - this.#moved > STILL_MS) {
      this.#moving = false;
      this.frames = [];
      this.#tell('still');
      return;
    }
    const generation = this.#generation;
    const { width, height } = this.films[0];
    const sides = this.films.length;
    const size = this.pace.size(width, height, sides);
    const pixels = size[0] * size[1] * sides;
    this.#due = false;
    const start = performance.now();
    this.prepare();
    const films = await Promise.all(this.films.map((_, side) => this.#quick(side, size)));
    const busy = films.reduce((sum, film) => sum + film.busy, 0);
    this.#measure(pixels, busy / this.#pool.workers.length);
    if (generation !== this.#generation && this.films.length !== sides) return;
    this.frames = [...this.frames.filter((t) => start - t < 1000), performance.now()];
    this.#tell('frame', { films });
    // What the page has to draw is drawn while it waits for the next frame, and counts as that one's.
    this.pace.took(performance.now() - start, pixels);
    // What has not moved since is not worth another frame.
    if (generation === this.#generation) {
      await this.#rest(Math.max(0, STILL_MS - (performance.now() - this.#moved)));
    }
  }

  /** One sample for each pixel of a small film, a band to each worker. */
  async #quick(side, [width, height]) {
    const film = new Film(width, height);
    const { workers } = this.#pool;
    await Promise.all(workers.map(async (worker, i) => {
      const edge = (k) => Math.round((height * k) / workers.length);
      const tile = [0, edge(i), width, edge(i + 1)];
      if (tile[1] === tile[3]) return;
      const message = { type: 'render', side, size: [width, height], tile, first: 0, last: 1, most: 1 };
      const { pixels, ms } = await worker.ask(message);
      film.busy += ms;
      film.paste(tile, pixels);
    }));
    return film;
  }

  /** Steps of all tiles that are not good enough, those first that have had least. */
  async #refine(film) {
    const generation = this.#generation;
    if (!film.tiles) film.cutIntoTiles();
    const goes = () => generation === this.#generation && this.refines && !this.paused && !document.hidden;
    const start = performance.now() - this.elapsed;
    let [told, taken] = [performance.now(), 0];
    const work = async (worker, lane) => {
      for (let tile; goes() && (tile = film.nextTile(this.target));) {
        tile.busy = true;
        taken += await this.#take(worker, lane, { film, tile, generation });
        if (generation !== this.#generation) return;
        tile.busy = false;
        const now = performance.now();
        this.elapsed = now - start;
        if (now - told < REPORT_MS && !film.meets(this.target)) continue;
        this.#measure(taken, now - told);
        [told, taken] = [now, 0];
        this.#tell('pass', { film, side: 0 });
      }
    };
    await Promise.all(this.#pool.workers.flatMap((worker) => [work(worker, 0), work(worker, 1)]));
  }

  /** Takes a step of a tile, in pieces between which a worker listens; how many samples that were. */
  async #take(worker, lane, { film, tile, generation }) {
    const size = [film.width, film.height];
    const error = this.target;
    const message = { type: 'refine', side: 0, lane, size, error, most: MOST_SAMPLES, milliseconds: TILE_MS };
    const [pixels, { rect, state }] = [film.cut(tile.rect), tile];
    let answer = await worker.ask({ ...message, tile: rect, state, pixels }, [pixels.buffer, state.buffer]);
    let { samples } = answer;
    film.busy += answer.ms;
    while (answer.midway && generation === this.#generation) {
      answer = await worker.ask(message);
      samples += answer.samples;
      film.busy += answer.ms;
    }
    if (generation !== this.#generation) return 0;
    film.samples += samples / (film.width * film.height);
    film.refined(tile, answer, samples, error);
    if (samples > 0) this.#tell('tile', { film, side: 0, tile: rect });
    return samples;
  }

  /** As many samples again for each pixel of a side. */
  async #pass(film) {
    const generation = this.#generation;
    const side = this.films.indexOf(film);
    const most = this.budget || MOST_SAMPLES;
    const [first, last] = [film.samples, Math.min(Math.max(1, 2 * film.samples), most)];
    const tiles = this.#tiles(film, last - first);
    const totals = tiles.map(() => [0, 0]);
    let next = 0;
    const start = performance.now();
    const work = async (worker) => {
      while (next < tiles.length && generation === this.#generation) {
        const index = next++;
        totals[index] = await this.#tile(worker, { film, side, tile: tiles[index], first, last, generation });
      }
    };
    // Two at a time for each worker, so that none waits for the page.
    await Promise.all(this.#pool.workers.flatMap((worker) => [work(worker), work(worker)]));
    if (generation !== this.#generation) return;
    const ms = performance.now() - start;
    this.elapsed += ms;
    this.#measure(film.width * film.height * (last - first), ms);
    const [sum, values] = totals.reduce((a, b) => [a[0] + b[0], a[1] + b[1]], [0, 0]);
    film.record(last, sum, values);
    this.#tell('pass', { film, side });
  }

  async #tile(worker, { film, side, tile, first, last, generation }) {
    const pixels = film.cut(tile);
    const message = { type: 'render', side, size: [film.width, film.height], tile, first, last, most: this.budget || MOST_SAMPLES, pixels };
    const answer = await worker.ask(message, [pixels.buffer]);
    if (generation !== this.#generation) return [0, 0];
    film.paste(tile, answer.pixels);
    film.busy += answer.ms;
    this.#tell('tile', { film, side, tile });
    return [answer.sum, answer.values];
  }

  /** Rectangles of such a size that a worker is soon done with one. */
  #tiles({ width, height }, samples) {
    const pixels = (this.rate / this.#pool.workers.length) * (TILE_MS / 1000) / samples;
    const rows = Math.max(1, Math.min(Math.floor(pixels / width), Math.ceil(height / 8)));
    const columns = rows > 1 ? width : Math.max(16, Math.min(width, Math.floor(pixels)));
    const tiles = [];
    for (let y = 0; y < height; y += rows) {
      for (let x = 0; x < width; x += columns) {
        tiles.push([x, y, Math.min(x + columns, width), Math.min(y + rows, height)]);
      }
    }
    return tiles;
  }

  #measure(samples, ms) {
    const now = samples / Math.max(ms / 1000, 1e-3);
    this.rate += 0.4 * (now - this.rate);
  }
}
