// What a worker does with its instance of the module; without workers, the page does it itself.
//
// A message is { type, side, ... }: `side` 0 or 1 says which of two scenes, for comparing two ways to
// render one. Answers are plain objects and typed arrays.

/** Which module: with readers of files, or the page's own. */
const MODULES = { false: '../halflight.js', true: '../files/halflight.js' };

/** The fields of an object of the module, as a plain object with plain arrays; the module's is freed. */
function plain(object, ...fields) {
  const value = (v) => (ArrayBuffer.isView(v) ? [...v] : v);
  const out = Object.fromEntries(fields.map((field) => [field, value(object[field])]));
  object.free();
  return out;
}

const facts = (scene) => plain(scene.facts(), 'name', 'width', 'height', 'triangles', 'analytic', 'lights',
  'environments', 'bytes', 'radius', 'warnings');
const view = (scene) => plain(scene.view(), 'origin', 'right', 'up', 'forward', 'orthographic', 'half_width');
const lights = (scene) => scene.lights().map((light) => plain(light, 'name', 'kind', 'position', 'direction',
  'size', 'strength', 'outline', 'editable'));

function probe(scene, { x, y, samples }) {
  const seen = scene.probe(x, y, samples);
  if (!seen) return null;
  const out = plain(seen, 'point', 'normal', 'distance', 'samples', 'irradiance', 'means', 'errors', 'unshadowed',
    'closed_form', 'rays', 'lights');
  out.lights = out.lights.map((light) => plain(light, 'light', 'kind', 'arriving', 'unshadowed', 'closed_form',
    'density'));
  return out;
}

/** A scene: { builtin } or { name, files: [[path, bytes]] }, and perhaps { sky: { name, files } }. */
function open({ Scene, Files }, { builtin, name, files = [], sky }) {
  if (!Files) return Scene.builtin(builtin);
  const given = new Files();
  for (const [path, bytes] of [...files, ...(sky?.files ?? [])]) given.add(path, bytes);
  try {
    const scene = builtin ? Scene.builtin(builtin) : Scene.read(name, given);
    if (sky) scene.surround(sky.name, given);
    return scene;
  } finally {
    given.free();
  }
}

/** Makes the changes of a message, in order. */
function change(scene, edits) {
  for (const [what, ...args] of edits) {
    if (what === 'look') scene.look(...args);
    else if (what === 'light') scene.set_light(...args);
    else if (what === 'choose') scene.choose(...args);
    else if (what === 'settle') scene.settle();
    else throw new Error(`no such change: ${what}`);
  }
}

export class Core {
  #module;
  #memory;
  #scenes = [];
  /** Tiles in the middle of a step, two at most. Those of a scene that is gone may come to the end of theirs: until
   *  the page begins anew, it may ask for that. */
  #tiles = [];

  /** Answers a message. */
  async handle(message) {
    if (message.type === 'init') {
      this.#module = await import(MODULES[message.files]);
      ({ memory: this.#memory } = await this.#module.default({ module_or_path: message.module }));
      return {};
    }
    if (message.type === 'memory') return { bytes: this.#memory.buffer.byteLength };
    if (message.type === 'load') return this.#load(message);
    if (message.type === 'close') {
      this.#scenes[message.side]?.free();
      this.#scenes[message.side] = undefined;
      return {};
    }
    const scene = this.#scenes[message.side];
    if (!scene) throw new Error('there is no scene');
    if (message.type === 'change') {
      change(scene, message.edits);
      return { lights: lights(scene) };
    }
    if (message.type === 'render') return this.#render(scene, message);
    if (message.type === 'refine') return this.#refine(scene, message);
    if (message.type === 'probe') {
      scene.resize(...message.size);
      return { probe: probe(scene, message) };
    }
    throw new Error(`no such message: ${message.type}`);
  }

  #load({ side, source, edits }) {
    const scene = open(this.#module, source);
    this.#scenes[side]?.free();
    this.#scenes[side] = scene;
    const author = { facts: facts(scene), view: view(scene) };
    change(scene, edits);
    return { ...author, lights: lights(scene) };
  }

  /** Keeps a tile in the place of another, or of none. */
  #put(lane, tile) {
    this.#tiles[lane]?.free();
    this.#tiles[lane] = tile;
  }

  /** Takes a step of a tile, or so much of it as time allows; without a `tile`, goes on with the last. */
  #refine(scene, { lane, size, tile, state, pixels, error, most, milliseconds }) {
    const start = performance.now();
    scene.resize(...size);
    scene.choose('samples', String(most));
    if (tile) this.#put(lane, new this.#module.Refinement(...tile, state, pixels));
    const now = this.#tiles[lane];
    const samples = scene.refine(now, error, milliseconds);
    const answer = { samples, midway: now.is_midway() };
    if (!answer.midway) {
      Object.assign(answer, { state: now.state(), pixels: now.pixels(), mse: now.relative_mse() });
      this.#put(lane);
    }
    return { ...answer, ms: performance.now() - start };
  }

  #render(scene, { size, tile: [x0, y0, x1, y1], first, last, most, pixels }) {
    const start = performance.now();
    scene.resize(...size);
    scene.choose('samples', String(most));
    const words = pixels ?? new Uint32Array(8 * (x1 - x0) * (y1 - y0));
    const [sum, values] = scene.render(x0, y0, x1, y1, first, last, words);
    return { pixels: words, sum, values, ms: performance.now() - start };
  }
}

/** The memory that goes with an answer, rather than being copied. */
export const transfers = ({ pixels, state }) => [pixels, state].filter(Boolean).map((words) => words.buffer);
