// How far the picture is.

import { CHOICES } from '../state.js';
import { digits } from './widgets.js';

const byId = (id) => document.getElementById(id);

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
    byId('error').textContent = films.map((f) => percent(moving ? undefined : f.error)).join(' | ');
    byId('spp').textContent = films.map((f) => mean(f.samples)).join(' | ');
    byId('rate').textContent = `${digits(renderer.rate / 1e6, 2)} M`;
    const fps = renderer.frames.length;
    byId('elapsed').textContent = moving ? `${fps} frames/s` : seconds(renderer.elapsed);
    byId('size').textContent = `${canvas.width} × ${canvas.height}`;
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
    bar.hidden = !state.compare;
    const { left, top, width, height } = this.#app.box;
    const x = left + state.split * width;
    Object.assign(bar.style, { left: `${x}px`, top: `${top}px`, height: `${height}px` });
    bar.setAttribute('aria-valuenow', String(Math.round(100 * state.split)));
    ['left', 'right'].forEach((name, side) => {
      const label = byId(name);
      label.hidden = !state.compare;
      if (!state.compare) return;
      const film = films[side];
      const bold = document.createElement('b');
      bold.textContent = named(state.sides[side]);
      label.replaceChildren(bold, ` ${percent(film?.error)}, ${mean(film?.samples ?? 0)} samples`);
      label.style.bottom = `${top + 10}px`;
      label.style[name] = `${left + 10}px`;
    });
  }
}
