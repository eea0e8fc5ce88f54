// How far the picture is.

import { CHOICES } from '../state.js';
import { digits } from './widgets.js';

const byId = (id) => document.getElementById(id);

/** Writes what is new: the page is laid out anew for no other. */
function put(id, text) {
  const element = byId(id);
  if (element.textContent !== text) element.textContent = text;
}

const percent = (error) => (error === undefined ? '–' : `${digits(100 * error, 2)} %`);

/** Samples of a pixel in the mean. */
const mean = (samples) => (Math.abs(samples - Math.round(samples)) < 1e-6 ? String(Math.round(samples)) : samples.toFixed(1));

function seconds(ms) {
  const s = ms / 1000;
  return s < 60 ? `${s.toFixed(1)} s` : `${Math.floor(s / 60)} min ${Math.floor(s % 60)} s`;
}

/** What a side does that is not left to the scene. */
function named(side) {
  const said = CHOICES.filter(({ name, values }) => side[name] !== Object.keys(values)[0]);
  return said.map(({ name, values }) => values[side[name]]).join(', ') || 'auto';
}

export class Status {
  #app;

  constructor(app) {
    this.#app = app;
  }

  show() {
    const { renderer, state, canvas } = this.#app;
    const { films, moving } = renderer;
    if (films.length === 0) return;
    const [film] = films;
    put('error', films.map((f) => percent(moving ? undefined : f.error)).join(' | '));
    put('spp', films.map((f) => mean(f.samples)).join(' | '));
    put('rate', `${digits(renderer.rate / 1e6, 2)} M`);
    put('elapsed-name', moving ? 'frames/s' : 'elapsed');
    put('elapsed', moving ? String(renderer.frames.length) : seconds(renderer.elapsed));
    put('size', `${canvas.width} × ${canvas.height}`);
    this.#goal(film, moving);
    const pause = byId('pause');
    pause.setAttribute('aria-pressed', String(renderer.paused));
    pause.lastElementChild.textContent = renderer.paused ? 'Go on' : 'Pause';
    this.#sides(films, state);
  }

  #goal(film, moving) {
    const { renderer } = this.#app;
    const known = !moving && film.error !== undefined;
    const part = renderer.done(film) ? 1 : known ? Math.min(1, (renderer.target / film.error) ** 2) : 0;
    byId('goal').firstElementChild.style.transform = `scaleX(${part})`;
    byId('goal').setAttribute('aria-valuenow', String(Math.round(100 * part)));
    document.body.dataset.state = moving ? 'moving' : renderer.films.every((f) => renderer.done(f)) ? 'done' : 'rendering';
  }

  #sides(films, state) {
    const bar = byId('split');
    document.body.classList.toggle('comparing', state.compare);
    bar.hidden = !state.compare;
    if (!state.compare) {
      byId('left').hidden = byId('right').hidden = true;
      return;
    }
    const { left, top, width, height } = this.#app.box;
    const x = left + state.split * width;
    Object.assign(bar.style, { left: `${x}px`, top: `${top}px`, height: `${height}px` });
    bar.setAttribute('aria-valuenow', String(Math.round(100 * state.split)));
    ['left', 'right'].forEach((name, side) => {
      const label = byId(name);
      label.hidden = false;
      const film = films[side];
      const bold = document.createElement('b');
      bold.textContent = named(state.sides[side]);
      label.replaceChildren(bold, ` ${percent(film?.error)}, ${mean(film?.samples ?? 0)} samples`);
      label.style.bottom = `${top + 10}px`;
      label.style[name] = `${left + 10}px`;
    });
  }
}
