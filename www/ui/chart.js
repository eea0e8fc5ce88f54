// Error against samples and against time, both logarithmic, for two ways of sampling.

import { digits, el, svg } from './widgets.js';

const [WIDTH, HEIGHT, TOP, BOTTOM, LEFT, GAP] = [292, 168, 14, 30, 40, 18];
const PANEL = (WIDTH - LEFT - GAP) / 2;

/** An error on the scale: beyond 1000 % as a power of ten. */
function percent(v) {
  if (v > 11) return `10${[...String(Math.round(Math.log10(100 * v)))].map((d) => '⁰¹²³⁴⁵⁶⁷⁸⁹'[d]).join('')} %`;
  return `${digits(100 * v, 1).replace(/\.0$/, '')} %`;
}

/** Powers of ten, or of two where there are few of those, in a range. */
function ticks(low, high) {
  const tens = [];
  for (let e = Math.ceil(Math.log10(low) - 1e-9); 10 ** e <= high * 1.0001; e++) tens.push(10 ** e);
  return tens;
}

/** The least range of whole decades around some values. */
function range(values, least) {
  const [low, high] = [Math.min(...values), Math.max(...values)];
  const from = 10 ** Math.floor(Math.log10(low) + 1e-9);
  return [from, Math.max(10 ** Math.ceil(Math.log10(high) - 1e-9), from * least)];
}

function panel(histories, key, left, errors, title, format) {
  const points = histories.map((h) => h.filter((p) => p[key] > 0));
  const [low, high] = range(points.flat().map((p) => p[key]), 10);
  const x = (v) => left + (PANEL * Math.log(v / low)) / Math.log(high / low);
  const y = (v) => TOP + ((HEIGHT - TOP - BOTTOM) * Math.log(errors[1] / v)) / Math.log(errors[1] / errors[0]);
  const parts = [svg('text', { x: left + PANEL / 2, y: HEIGHT - 2, 'text-anchor': 'middle' }, title)];
  for (const t of ticks(...errors)) {
    parts.push(svg('line', { class: 'grid', x1: left, x2: left + PANEL, y1: y(t), y2: y(t) }));
    if (left === LEFT) parts.push(svg('text', { x: left - 5, y: y(t) + 3, 'text-anchor': 'end' }, percent(t)));
  }
  const across = ticks(low, high);
  for (const [i, t] of across.entries()) {
    parts.push(svg('line', { class: 'grid', x1: x(t), x2: x(t), y1: TOP, y2: HEIGHT - BOTTOM }));
    // Those at the ends stay within the panel.
    const anchor = x(t) < left + 12 ? 'start' : x(t) > left + PANEL - 12 ? 'end' : 'middle';
    if (across.length < 4 || i % 2 === 0) parts.push(svg('text', { x: x(t), y: HEIGHT - BOTTOM + 12, 'text-anchor': anchor }, format(t)));
  }
  points.forEach((line, side) => {
    const name = 'ab'[side];
    parts.push(svg('polyline', { class: name, points: line.map((p) => `${x(p[key])},${y(p.error)}`).join(' ') }));
    const last = line.at(-1);
    if (last) parts.push(svg('circle', { class: `dot ${name}`, cx: x(last[key]), cy: y(last.error), r: 3 }));
  });
  return parts;
}

/** What a way of sampling needs for an error, from its history; beyond it, error falls as 1/√n. */
function needed(history, key, error) {
  const next = history.findIndex((p) => p.error <= error);
  if (next < 0) return history.at(-1)[key] * (history.at(-1).error / error) ** 2;
  if (next === 0) return history[0][key];
  const [a, b] = [history[next - 1], history[next]];
  const k = Math.log(a.error / error) / Math.log(a.error / b.error);
  return a[key] * (b[key] / a[key]) ** k;
}

/** "14× fewer", from what left and right need. */
function ratio(left, right, more, less) {
  const k = left / right;
  if (k > 1 / 1.05 && k < 1.05) return undefined;
  return k > 1 ? `${digits(k, 2)}× ${less}` : `${digits(1 / k, 2)}× ${more}`;
}

/** The comparison in words. */
export function verdict([left, right]) {
  const error = Math.min(left.at(-1)?.error ?? NaN, right.at(-1)?.error ?? NaN);
  if (left.length < 3 || right.length < 3 || !(error > 0)) return '';
  const need = (key) => [needed(left, key, error), needed(right, key, error)];
  const samples = ratio(...need('samples'), 'more', 'fewer');
  const time = ratio(...need('seconds'), 'more', 'less');
  const parts = [samples ? `${samples} samples` : 'as many samples', time ? `${time} time` : 'as much time'];
  return `For an error of ${digits(100 * error, 2)} % the right needs about ${parts.join(' and ')}.`;
}

/** Draws the histories of both sides. */
export function chart(figure, histories) {
  const all = histories.flat();
  if (all.length < 2) {
    figure.replaceChildren();
    return;
  }
  const errors = range(all.map((p) => p.error), 10);
  const clock = (t) => (t < 1 ? `${digits(1000 * t, 1)} ms` : `${digits(t, 1)} s`);
  const words = verdict(histories);
  figure.replaceChildren(
    svg('svg', { viewBox: `0 0 ${WIDTH} ${HEIGHT}`, role: 'img', 'aria-label': `Error against samples and time. ${words}` },
      ...panel(histories, 'samples', LEFT, errors, 'samples/pixel', (t) => digits(t, 1)),
      ...panel(histories, 'seconds', LEFT + PANEL + GAP, errors, 'CPU time', clock)),
    el('figcaption', {}, words),
  );
}
