// What is shown of the picture, how bright, how large, how good.

import { digits, el, renew, select, slider } from './widgets.js';

const SHOW = {
  radiance: 'radiance', visibility: 'visibility of the light', occlusion: 'ambient occlusion',
  error: 'standard error', samples: 'samples per pixel',
};
const WIDTHS = { 0: 'fits the page', 240: '240', 480: '480', 720: '720', 960: '960', 1440: '1440' };

export class ShowPanel {
  #root;
  #app;

  constructor(root, app) {
    this.#root = root;
    this.#app = app;
  }

  /** A picture from its first sample. */
  #again() {
    const button = el('button', { type: 'button', className: 'add', title: 'Throw the samples away and begin anew' }, 'Begin anew');
    button.onclick = () => this.#app.restart();
    return button;
  }

  show() {
    const { state } = this.#app;
    const widths = state.width in WIDTHS ? WIDTHS : { ...WIDTHS, [state.width]: String(state.width) };
    renew(this.#root, el('div', { className: 'rows' },
      select('Show', SHOW, state.show, (v) => this.#app.setShow(v)),
      slider('Exposure', { min: -6, max: 6, value: state.exposure, format: (v) => `${v > 0 ? '+' : ''}${v.toFixed(1).replace('-', '−')}`, unit: ' EV' },
        (v) => this.#app.setExposure(Math.round(10 * v) / 10)),
      slider('Stop at', { min: 0.05, max: 20, value: state.target, log: true, format: (v) => digits(v, 2), unit: ' %' },
        (v) => this.#app.setTarget(Number(v.toPrecision(2)))),
      select('Columns', widths, String(state.width), (v) => this.#app.setWidth(Number(v))),
      this.#again()));
  }
}
