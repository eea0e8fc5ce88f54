// <halflight-view scene="penumbra" error="2" width="480"></halflight-view>: a scene in anyone's page.
//
// `scene` is the name of a built-in scene, `error` the relative error to stop at (percent), `width` the
// columns of the picture. A `progress` event comes with each pass: { samples, error }.

import init from './halflight.js';
import { Screen } from './canvas.js';
import { Pool, compiled } from './engine/pool.js';
import { Renderer } from './engine/renderer.js';

export class HalflightView extends HTMLElement {
  #pool;

  async connectedCallback() {
    const canvas = document.createElement('canvas');
    canvas.style.width = '100%';
    canvas.setAttribute('role', 'img');
    this.style.display ||= 'block';
    this.attachShadow({ mode: 'open' }).append(canvas);
    const module = await compiled('halflight_bg.wasm');
    const count = Math.max(1, Math.min(4, navigator.hardwareConcurrency ?? 2));
    const [pool] = await Promise.all([Pool.start(module, count), init({ module_or_path: module })]);
    this.#pool = pool;
    const source = { builtin: this.getAttribute('scene') ?? 'still-life' };
    const { facts } = await pool.all({ type: 'load', side: 0, source, edits: [] });
    canvas.setAttribute('aria-label', facts.name);
    this.#render(canvas, facts);
  }

  #render(canvas, facts) {
    const width = Number(this.getAttribute('width') ?? 480);
    const height = Math.round((width * facts.height) / facts.width);
    const screen = new Screen(canvas);
    screen.resize(width, height);
    const renderer = new Renderer(this.#pool);
    renderer.target = Number(this.getAttribute('error') ?? 1) / 100;
    renderer.addEventListener('tile', ({ detail: { film, tile } }) => screen.tile(film, 0, 1, tile));
    renderer.addEventListener('pass', ({ detail: { film } }) => {
      this.dispatchEvent(new CustomEvent('progress', { detail: { samples: film.samples, error: film.error } }));
    });
    renderer.restart(width, height, 1);
    this.renderer = renderer;
  }

  disconnectedCallback() {
    this.renderer?.end();
    this.#pool?.end();
  }
}

customElements.define('halflight-view', HalflightView);
