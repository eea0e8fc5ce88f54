// How the light is sampled, and what two ways have to say about each other.

import { CHOICES } from '../state.js';
import { buttons, checkbox, el, renew } from './widgets.js';

export class SamplingPanel {
  #root;
  #app;

  constructor(root, app) {
    this.#root = root;
    this.#app = app;
  }

  show() {
    const { state, facts } = this.#app;
    const needed = { many: facts.lights > 1, environment: facts.environments > 0 };
    const offered = CHOICES.filter(({ needs }) => !needs || needed[needs]);
    const sides = state.compare ? [0, 1] : [0];
    const grid = el('div', { className: `sides ${state.compare ? '' : 'one'}` });
    if (state.compare) {
      grid.append(el('span'), el('span', { className: 'head a' }, 'Left'), el('span', { className: 'head b' }, 'Right'));
    }
    for (const { name, label, values } of offered) {
      grid.append(el('span', { className: 'name' }, label));
      for (const side of sides) grid.append(this.#select(side, name, state.compare ? `${label}, ${['left', 'right'][side]}` : label, values));
    }
    const rows = el('div', { className: 'rows' },
      checkbox('Compare two, side by side', state.compare, (on) => this.#compare(on)), grid);
    if (!state.compare) rows.append(checkbox('Samples go where the error is', state.adaptive, (on) => this.#app.setAdaptive(on)));
    if (state.compare) {
      rows.append(buttons('At equal', { samples: 'equal samples', time: 'equal time' }, state.equal, (v) => this.#app.setEqual(v)));
    }
    renew(this.#root, rows);
  }

  /** The chart is what one compares for: it comes into sight. */
  async #compare(on) {
    await this.#app.compare(on);
    const behavior = matchMedia('(prefers-reduced-motion: reduce)').matches ? 'auto' : 'smooth';
    if (on) document.getElementById('chart').scrollIntoView({ block: 'nearest', behavior });
  }

  #select(side, name, label, values) {
    const options = Object.entries(values).map(([key, text]) => el('option', { value: key }, text));
    const control = el('select', { 'aria-label': label }, ...options);
    control.value = this.#app.state.sides[side][name];
    control.onchange = () => this.#app.setChoice(side, name, control.value);
    return control;
  }
}
