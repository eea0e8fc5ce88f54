// The page's state and what follows from each change of it.

import { Orbit } from './camera.js';
import { Screen } from './canvas.js';
import { layout } from './layout.js';
import { legend, rendered, showLegend } from './display.js';
import { Renderer } from './engine/renderer.js';
import { Overlay } from './overlay.js';
import { CHOICES, encode, lightEdit, lookEdit } from './state.js';
import { aimed, turned } from './ui/light.js';
import { chart } from './ui/chart.js';

/** Samples of a probe: at once, and when the picture is still. */
const PROBE = [64, 4096];

const byId = (id) => document.getElementById(id);

export class App {
  /** Set by main.js: { light, show, sampling, probe, status }. */
  panels = {};
  lights = [];
  facts = { radius: 1, lights: 0, environments: 0, width: 3, height: 2, name: '', warnings: [] };
  source = null;
  orbit = null;

  #pool;
  #edits = new Map();
  #lightsMoved = false;
  #probed = null;
  #probe = null;
  #loading = 0;
  #author;
  #keeping;

  constructor(pool, state) {
    this.#pool = pool;
    this.state = state;
    this.canvas = byId('canvas');
    this.screen = new Screen(this.canvas);
    this.overlay = new Overlay(byId('overlay'), byId('handle'));
    this.renderer = new Renderer(pool);
    this.renderer.target = state.target / 100;
    Object.assign(this.renderer, { equal: state.equal, adaptive: state.adaptive });
    this.renderer.prepare = () => this.#flush();
    const sides = () => this.renderer.films.length;
    this.renderer.addEventListener('tile', ({ detail: { film, side, tile } }) => this.screen.tile(film, side, sides(), tile));
    this.renderer.addEventListener('frame', ({ detail }) => { this.screen.frame(detail.films); this.panels.status.show(); });
    this.renderer.addEventListener('pass', () => { this.#passed(); });
    this.renderer.addEventListener('still', () => this.#still());
    this.renderer.addEventListener('idle', () => this.panels.status.show());
    this.renderer.addEventListener('failed', ({ detail }) => this.say(detail.error.message, true));
    new ResizeObserver(() => this.fit()).observe(byId('frame'));
  }

  get sides() {
    return this.state.compare ? 2 : 1;
  }

  get size() {
    return [this.canvas.width, this.canvas.height];
  }

  say(text, bad = false) {
    const message = byId('message');
    if (message.textContent !== text) message.textContent = text;
    message.classList.toggle('bad', bad);
  }

  /** Shows a scene, see `open` in engine/core.js. The state's camera, lights and choices are applied. */
  async load(source) {
    const loading = ++this.#loading;
    const author = await this.#pool.all({ type: 'load', side: 0, source, edits: this.#all(0) });
    if (loading !== this.#loading) return;
    this.source = source;
    Object.assign(this, { facts: author.facts, lights: author.lights });
    this.closeProbe();
    this.#author = author.view;
    this.orbit = new Orbit(author.view, this.facts.radius);
    if (this.state.camera) this.orbit.restore(this.state.camera);
    this.state.light = Math.min(this.state.light, Math.max(0, this.lights.length - 1));
    this.canvas.setAttribute('aria-label', `${this.facts.name}: ${this.facts.triangles} triangles, ${this.facts.lights} lights`);
    if (this.state.compare) await this.#second();
    this.say(this.facts.warnings.join('\n'));
    this.#resize();
    // A quick picture first, and what the camera turns around meanwhile.
    this.renderer.move(...this.size, this.sides);
    this.renderer.addEventListener('frame', () => this.renderer.release(), { once: true });
    this.refresh();
    if (!this.state.camera) await this.#focus(loading);
  }

  /** What is in the middle of the picture is what the camera turns around. */
  async #focus(loading) {
    const { probe } = await this.#pool.ask({ type: 'probe', side: 0, size: [3, 3], x: 1, y: 1, samples: 0 });
    if (probe && loading === this.#loading && !this.state.camera) this.orbit = new Orbit(this.#author, probe.distance);
  }

  get pool() { return this.#pool; }

  /** Other workers. */
  use(pool) {
    this.#pool = pool;
    this.renderer.use(pool);
  }

  /** The scene a second time, for the right side. */
  #second() {
    return this.#pool.all({ type: 'load', side: 1, source: this.source, edits: this.#all(1) });
  }

  /** Tells the workers the choices of both sides, and begins anew. */
  async #apply() {
    // Nobody may work on a side that goes away.
    if (!this.state.compare) this.renderer.restart(...this.size, 1);
    if (this.state.compare) await this.#second();
    else await this.#pool.all({ type: 'close', side: 1 });
    await this.#pool.all({ type: 'change', side: 0, edits: this.#choices(0) });
    this.renderer.restart(...this.size, this.sides);
    this.refresh();
  }

  /** Everything that the state changes of a scene. */
  #all(side) {
    const edits = Object.entries(this.state.lights).map(([index, light]) => lightEdit(Number(index), light));
    if (this.state.camera) edits.unshift(lookEdit(this.state.camera));
    return [...edits, ['settle'], ...this.#choices(side)];
  }

  #choices(side) {
    const chosen = CHOICES.map(({ name }) => ['choose', name, this.state.sides[side][name]]);
    return [...chosen, ['choose', 'seed', String(this.state.seed)], ['choose', 'show', rendered(this.state.show)]];
  }

  // Changes

  /** Notes a change, the latest of its kind, and follows it with quick frames. */
  #send(key, edit) {
    this.#edits.set(key, edit);
    this.renderer.move(...this.size, this.sides);
  }

  /** Tells the workers what has changed since the last frame. */
  async #flush() {
    if (this.#edits.size === 0) return;
    const edits = [...this.#edits.values()];
    this.#edits.clear();
    try {
      const sides = Array.from({ length: this.sides }, (_, side) => side);
      const answers = await Promise.all(sides.map((side) => this.#pool.all({ type: 'change', side, edits })));
      this.lights = answers[0].lights;
      this.facts.lights = Math.max(this.facts.lights, this.lights.filter(({ kind }) => kind !== 'none').length);
      this.say('');
    } catch (error) {
      this.say(error.message, true);
    }
    this.draw();
    this.#again();
  }

  cameraMoved() {
    this.state.camera = this.orbit.save();
    this.draw();
    this.#send('look', lookEdit(this.state.camera));
    this.keep();
  }

  home() {
    this.state.camera = null;
    this.keep();
    this.reload();
  }

  /** The scene again, with the state as it is. */
  reload() {
    return this.load(this.source).catch((error) => this.say(error.message, true));
  }

  chooseLight(index) {
    this.state.light = index;
    this.panels.light.show();
    this.draw();
    this.keep();
  }

  /** The chosen light as it is, or is to be. */
  currentLight() {
    const { light, lights } = this.state;
    const shown = this.lights[light];
    if (!lights[light] && !shown) return undefined;
    const list = ({ kind, position, direction, size, strength }) => ({ kind, position: [...position],
      direction: [...direction], size: [...size], strength: [...strength] });
    return list(lights[light] ?? shown);
  }

  setLight(light) {
    const index = this.state.light;
    this.state.lights[index] = light;
    this.#lightsMoved = true;
    this.#send(`light ${index}`, lightEdit(index, light));
    this.keep();
  }

  /** Adds a light after the last, and chooses it. */
  async addLight(index, light) {
    this.state.light = index;
    this.setLight(light);
    await this.#flush();
    this.panels.light.show();
    this.panels.sampling.show();
  }

  moveLight(position) {
    const light = this.currentLight();
    const isAimed = ['rectangle', 'disk', 'spot'].includes(light.kind);
    const direction = isAimed && this.state.aim ? aimed(light, position, this.orbit.target) : light.direction;
    this.setLight({ ...light, position, direction });
  }

  /** Turns the chosen light about the vertical (rad). */
  turnLight(angle) {
    this.setLight(turned(this.currentLight(), angle));
  }

  setAim(aim) {
    this.state.aim = aim;
    this.keep();
  }

  released() {
    this.renderer.release();
  }

  /** Nothing moves any more: the tables are built for the lights as they are. */
  #still() {
    if (this.#lightsMoved) {
      this.#lightsMoved = false;
      for (let side = 0; side < this.sides; side++) this.#pool.all({ type: 'change', side, edits: [['settle']] });
    }
    this.#again(1);
  }

  // What is shown

  setShow(show) {
    const before = rendered(this.state.show);
    this.state.show = show;
    this.keep();
    if (rendered(show) === before) this.refresh();
    else this.#apply();
  }

  setExposure(exposure) {
    this.state.exposure = exposure;
    this.refresh();
    this.keep();
  }

  setTarget(target) {
    this.state.target = target;
    this.renderer.target = target / 100;
    this.renderer.pause(this.renderer.paused);
    this.panels.status.show();
    this.keep();
  }

  /** The picture from its first sample. */
  restart() {
    this.renderer.restart(...this.size, this.sides);
    this.panels.status.show();
  }

  setWidth(width) {
    this.state.width = width;
    this.fit();
    this.keep();
  }

  // Sampling

  setChoice(side, name, value) {
    this.state.sides[side][name] = value;
    this.keep();
    return this.#apply();
  }

  compare(on) {
    this.state.compare = on;
    this.keep();
    this.panels.sampling.show();
    return this.#apply();
  }

  setAdaptive(adaptive) {
    this.state.adaptive = this.renderer.adaptive = adaptive;
    this.keep();
    this.restart();
  }

  setEqual(equal) {
    this.state.equal = this.renderer.equal = equal;
    this.keep();
    this.restart();
  }

  setSplit(split) {
    this.state.split = Math.max(0, Math.min(1, split));
    this.refresh();
    this.keep();
  }

  // The probe

  /** Looks at a place of the picture: x and y from 0 to 1. */
  probeAt(x, y) {
    this.#probed = [Math.max(0, Math.min(0.9999, x)), Math.max(0, Math.min(0.9999, y))];
    return this.#again(1);
  }

  async #again(level = 0) {
    if (!this.#probed) return;
    const [place, size] = [this.#probed, this.size];
    const [x, y] = [Math.floor(place[0] * size[0]), Math.floor(place[1] * size[1])];
    const message = { type: 'probe', side: 0, size, x, y, samples: PROBE[level] };
    const probe = await this.#pool.ask(message).then((answer) => answer.probe, () => undefined);
    if (place !== this.#probed || probe === undefined) return;
    this.#probe = probe;
    const { values: names } = CHOICES.find(({ name }) => name === 'lights');
    this.panels.probe.show(probe, names[this.state.sides[0].lights]);
    this.draw();
    if (!probe) this.say('There is no surface at this point.');
  }

  get probe() {
    return this.#probe;
  }

  closeProbe() {
    this.#probed = this.#probe = null;
    this.panels.probe.show(null);
    this.draw();
  }

  // The picture's place in the page

  togglePause() {
    this.renderer.pause(!this.renderer.paused);
    this.panels.status.show();
  }

  /** Puts the picture into its frame; true when its pixels have changed. */
  #resize() {
    const { box, columns, rows } = layout(byId('frame'), this.facts.width / this.facts.height, this.state.width);
    Object.assign(this.canvas.style, { width: `${box.width}px`, height: `${box.height}px` });
    this.overlay.place(box);
    this.box = box;
    const changed = columns !== this.canvas.width || rows !== this.canvas.height;
    this.screen.resize(columns, rows);
    return changed;
  }

  fit() {
    if (!this.orbit) return;
    if (this.#resize()) this.restart();
    this.refresh();
  }

  /** Draws what lies over the picture. */
  draw() {
    if (this.orbit) this.overlay.draw({ orbit: this.orbit, light: this.lights[this.state.light], probe: this.#probe });
  }

  #passed() {
    this.panels.status.show();
    // The colours are relative to the most samples that a pixel has.
    if (this.state.show === 'samples') this.screen.all(this.renderer.films);
    if (this.state.compare) chart(byId('chart'), this.renderer.films.map((film) => film.history));
  }

  /** All that does not come from the renderer. */
  refresh() {
    const { show, exposure, compare, split } = this.state;
    this.screen.style = { show, exposure, split };
    this.screen.all(this.renderer.films);
    showLegend(byId('legend'), legend(show), this.box);
    byId('chart').hidden = !compare;
    this.panels.status.show();
    this.draw();
  }

  /** What a link would keep goes into the address. */
  keep() {
    clearTimeout(this.#keeping);
    this.#keeping = setTimeout(() => history.replaceState(null, '', this.link()), 250);
  }

  link() {
    const text = encode(this.state);
    return `${location.pathname}${location.search}${text ? `#${text}` : ''}`;
  }
}
