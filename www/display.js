// From what is known of the pixels to what is shown of them.

import { WORDS } from './engine/film.js';

const CODES = 4096;

/** sRGB codes of linear values from 0 to 1. Source: IEC 61966-2-1:1999. */
const SRGB = Uint8ClampedArray.from({ length: CODES + 1 }, (_, i) => {
  const v = i / CODES;
  return Math.round(255 * (v <= 0.0031308 ? 12.92 * v : 1.055 * v ** (1 / 2.4) - 0.055));
});

/** Colours between given ones, 256 of them: red, green, blue. */
function ramp(...stops) {
  const colours = stops.map((hex) => [1, 3, 5].map((i) => Number.parseInt(hex.slice(i, i + 2), 16)));
  const out = new Uint8ClampedArray(3 * 256);
  for (let i = 0; i < 256; i++) {
    const at = (i / 255) * (colours.length - 1);
    const k = Math.min(Math.floor(at), colours.length - 2);
    for (let c = 0; c < 3; c++) out[3 * i + c] = colours[k][c] + (at - k) * (colours[k + 1][c] - colours[k][c]);
  }
  return { out, css: `linear-gradient(90deg, ${stops.join(', ')})` };
}

const ARRIVING = ramp('#0f1d3a', '#28406f', '#8a4f7d', '#e0734f', '#f9b95c', '#fff0c4');
const HEAT = ramp('#0c0a1d', '#3a1c6e', '#8c2981', '#de4968', '#fe9f6d', '#fcf3c0');
const GREY = ramp('#000000', '#ffffff');

/** Errors that are shown (fractions): the ends of a logarithmic scale. */
const ERRORS = [1e-3, 1];

/** Relative standard error of a pixel: √(Σ σ² / n) over √(Σ mean² + 0.01), as relMSE weighs it. */
function relativeError(floats, words, i) {
  const n = words[i + 6];
  if (n < 2) return ERRORS[1];
  const squares = floats[i + 3] + floats[i + 4] + floats[i + 5];
  const means = floats[i] ** 2 + floats[i + 1] ** 2 + floats[i + 2] ** 2;
  return Math.sqrt(squares / (n * (n - 1)) / (means + 0.03));
}

/** The ways to show a picture: their values from 0 to 1, or −1 for nothing there. */
const SCALAR = {
  visibility: {
    colours: ARRIVING,
    labels: ['umbra 0', 'penumbra', 'lit 1'],
    value: (floats, words, i) => {
      if (!(floats[i + 2] > 0)) return -1;
      return floats[i + 1] > 0 ? floats[i] / floats[i + 1] : 0;
    },
  },
  occlusion: { colours: GREY, labels: ['closed 0', '', 'open 1'], value: (floats, words, i) => floats[i] },
  samples: {
    colours: HEAT,
    labels: ['1', '', 'most'],
    value: (floats, words, i, most) => Math.log2(Math.max(words[i + 6], 1)) / Math.log2(Math.max(most, 2)),
  },
  error: {
    colours: HEAT,
    labels: ['0.1 %', '3 %', '100 %'],
    value: (floats, words, i) => {
      const log = Math.log(relativeError(floats, words, i) / ERRORS[0]) / Math.log(ERRORS[1] / ERRORS[0]);
      return Math.max(0, Math.min(1, log));
    },
  },
};

/** What the module has to render for a way to show it. */
export const rendered = (show) => (show === 'visibility' || show === 'occlusion' ? show : 'radiance');

/** The scale beside the picture; undefined for plain radiance. */
export const legend = (show) => SCALAR[show] && { labels: SCALAR[show].labels, css: SCALAR[show].colours.css };

/** Puts a scale at the top right of the picture, or takes it away. */
export function showLegend(element, scale, { left, top, width }) {
  element.hidden = !scale;
  if (!scale) return;
  Object.assign(element.style, { left: `${left + width - 190}px`, top: `${top + 10}px` });
  element.querySelector('.ramp').style.background = scale.css;
  ['low', 'mid', 'high'].forEach((name, i) => { element.querySelector(`.${name}`).textContent = scale.labels[i]; });
}

/** Turns pixels [x0, x1) × [y0, y1) of a film into bytes of an image of the same size. */
export function shade(film, image, [x0, y0, x1, y1], { show, exposure }) {
  const { floats, words, width } = film;
  const bytes = image.data;
  const scalar = SCALAR[show];
  const gain = CODES * 2 ** exposure;
  for (let y = y0; y < y1; y++) {
    for (let x = x0; x < x1; x++) {
      const pixel = y * width + x;
      const i = WORDS * pixel;
      const o = 4 * pixel;
      bytes[o + 3] = 255;
      if (scalar) {
        const v = scalar.value(floats, words, i, film.most);
        const code = 3 * Math.round(255 * Math.max(0, Math.min(1, v)));
        for (let c = 0; c < 3; c++) bytes[o + c] = v < 0 ? 24 : scalar.colours.out[code + c];
      } else {
        for (let c = 0; c < 3; c++) bytes[o + c] = SRGB[Math.min(CODES, Math.max(0, floats[i + c]) * gain) | 0];
      }
    }
  }
}
