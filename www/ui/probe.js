// One point of the picture, explained.

import { digits, el, svg } from './widgets.js';

/** Between these fractions a point is in the penumbra. */
const UMBRA = 0.002;
const LIT = 0.998;

function place(fraction, unshadowed) {
  if (!(unshadowed > 0)) return 'faces away from the light';
  if (fraction < UMBRA) return 'umbra';
  return fraction > LIT ? 'lit' : 'penumbra';
}

/** The mean against samples, with a band of one standard error. */
function convergence({ means, errors, closed_form: exact }) {
  const [width, height] = [292, 64];
  const shown = means.map((mean, i) => [mean, errors[i]]).slice(1);
  if (shown.length < 2) return '';
  const last = shown.at(-1)[0];
  const spread = Math.max(...shown.map(([m, e]) => Math.abs(m - last) + e), 1e-3 * Math.abs(last), 1e-9);
  const x = (i) => (i * width) / (shown.length - 1);
  const y = (v) => Math.max(0, Math.min(height, height / 2 - ((v - last) * height) / (2.1 * spread)));
  const upper = shown.map(([m, e], i) => `${x(i)},${y(m + e)}`);
  const lower = shown.map(([m, e], i) => `${x(i)},${y(m - e)}`).reverse();
  const picture = svg('svg', { viewBox: `0 0 ${width} ${height}`, preserveAspectRatio: 'none', role: 'img', 'aria-label': 'The mean with its standard error, against samples' },
    svg('polygon', { class: 'band', points: [...upper, ...lower].join(' ') }),
    svg('polyline', { class: 'mean', points: shown.map(([m], i) => `${x(i)},${y(m)}`).join(' ') }));
  if (exact !== undefined && Math.abs(exact - last) < spread) {
    picture.append(svg('line', { class: 'exact', x1: 0, x2: width, y1: y(exact), y2: y(exact) }));
  }
  return picture;
}

function line(name, ...value) {
  return el('tr', {}, el('th', { scope: 'row' }, ...[name].flat()), el('td', {}, ...value));
}

const watts = (v) => `${digits(v, 4)} W/m²`;

function density(probe) {
  const rays = Array.from({ length: probe.rays.length / 8 }, (_, i) => probe.rays[8 * i + 4]).filter((p) => p > 0);
  if (rays.length === 0) return probe.rays.length > 0 ? 'δ' : '–';
  const [low, high] = [Math.min(...rays), Math.max(...rays)];
  return high / low < 1.005 ? `${digits(high, 4)} sr⁻¹` : `${digits(low, 3)} … ${digits(high, 3)} sr⁻¹`;
}

export class ProbePanel {
  #root;
  #app;

  constructor(root, app) {
    this.#root = root;
    this.#app = app;
  }

  show(probe, surface) {
    this.#root.hidden = !probe;
    if (!probe) return;
    const close = el('button', { type: 'button', 'aria-label': 'Close the probe' }, 'Close');
    close.onclick = () => this.#app.closeProbe();
    const arriving = probe.means.at(-1) ?? 0;
    const error = probe.errors.at(-1) ?? 0;
    const fraction = probe.unshadowed > 0 ? Math.min(1, arriving / probe.unshadowed) : 0;
    const meter = el('span');
    meter.style.transform = `scaleX(${fraction})`;
    const shown = Array.from({ length: probe.rays.length / 8 }, (_, i) => probe.rays[8 * i + 3]);
    const lit = shown.filter((arrives) => arrives).length;
    const rows = [
      line('Irradiance', `${digits(arriving, 4)} ± ${digits(error, 2)} W/m²`),
      line('Without shadows', watts(probe.unshadowed)),
    ];
    if (probe.closed_form !== undefined) rows.push(line('In closed form', watts(probe.closed_form)));
    rows.push(line(`Density, ${surface}`, density(probe)));
    rows.push(line([el('span', { className: 'swatch lit' }), 'arrive'], String(lit)));
    rows.push(line([el('span', { className: 'swatch blocked' }), 'blocked'], String(shown.length - lit)));
    if (probe.lights.length > 1) {
      for (const light of probe.lights.slice(0, 4)) rows.push(line(`from light ${light.light}, ${light.kind}`, watts(light.arriving)));
    }
    this.#root.replaceChildren(
      el('h2', {}, 'Probe', close),
      el('p', { className: 'big' }, el('b', {}, `${digits(100 * fraction, 3)} % `), el('small', {}, `of the light arrives: ${place(fraction, probe.unshadowed)}`)),
      el('div', { className: 'meter' }, meter),
      el('table', {}, el('tbody', {}, ...rows)),
      convergence(probe),
      el('p', { className: 'note' }, `${probe.samples.toLocaleString('en')} samples; the band is one standard error${probe.closed_form === undefined ? '' : ', the dashes are the closed form without shadows'}.`),
    );
  }
}
