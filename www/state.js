// Everything that a link restores.

/** What can be chosen for sampling, by the names of `halflight render`. */
export const CHOICES = [
  { name: 'technique', label: 'Technique', values: { auto: 'auto', light: 'lights', bsdf: 'BSDF', mis: 'MIS', control: 'control' } },
  { name: 'lights', label: 'Surface', values: { auto: 'auto', area: 'area', 'solid-angle': 'solid angle', projected: 'projected' } },
  { name: 'choose', label: 'Choice', values: { auto: 'auto', all: 'all', uniform: 'uniform', power: 'power', tree: 'tree' }, needs: 'many' },
  { name: 'environment', label: 'Environment', values: { auto: 'auto', cosine: 'cosine', luminance: 'luminance', compensated: 'compensated', product: 'product' }, needs: 'environment' },
  { name: 'sequence', label: 'Sequence', values: { auto: 'auto', zsobol: 'Sobol, shared', sobol: 'Sobol', random: 'random' } },
];

const AUTO = Object.fromEntries(CHOICES.map(({ name, values }) => [name, Object.keys(values)[0]]));

export const initial = () => ({
  scene: 'still-life',
  camera: null,
  lights: {},
  light: 0,
  aim: true,
  show: 'radiance',
  exposure: 0,
  width: 0,
  target: 1,
  seed: 0,
  adaptive: true,
  compare: false,
  equal: 'samples',
  split: 0.5,
  sides: [{ ...AUTO }, { ...AUTO, lights: 'area', sequence: 'random' }],
});

/** Only what differs from the beginning, as text for a link. */
export function encode(state) {
  const start = initial();
  const changed = Object.entries(state).filter(([key, value]) => (
    JSON.stringify(value) !== JSON.stringify(start[key])));
  if (changed.length === 0) return '';
  const bytes = new TextEncoder().encode(JSON.stringify(Object.fromEntries(changed)));
  const text = btoa(String.fromCharCode(...bytes));
  return text.replaceAll('+', '-').replaceAll('/', '_').replaceAll('=', '');
}

const isNumber = (x) => typeof x === 'number' && Number.isFinite(x);
const isVector = (v) => Array.isArray(v) && v.length === 3 && v.every(isNumber);

/** What each part of a link must be, for it is not ours alone to write. */
const VALID = {
  scene: (v) => typeof v === 'string',
  camera: (v) => v === null || ([v.origin, v.target, v.up].every(isVector) && isNumber(v.halfWidth)),
  lights: (v) => Object.values(v).every((l) => typeof l.kind === 'string' && [l.position, l.direction,
    l.strength].every(isVector) && Array.isArray(l.size) && l.size.length === 2 && l.size.every(isNumber)),
  light: Number.isInteger,
  aim: (v) => typeof v === 'boolean',
  show: (v) => ['radiance', 'visibility', 'occlusion', 'samples', 'error'].includes(v),
  exposure: isNumber,
  width: (v) => Number.isInteger(v) && v >= 0 && v <= 4096,
  target: (v) => isNumber(v) && v > 0,
  seed: (v) => Number.isInteger(v) && v >= 0,
  adaptive: (v) => typeof v === 'boolean',
  compare: (v) => typeof v === 'boolean',
  equal: (v) => v === 'samples' || v === 'time',
  split: (v) => isNumber(v) && v >= 0 && v <= 1,
  sides: (v) => v.length === 2 && v.every((side) => CHOICES.every(({ name, values }) => side[name] in values)),
};

/** The state that a link's text stands for; what cannot be understood is left out. */
export function decode(text) {
  const state = initial();
  if (!text) return state;
  try {
    const bytes = atob(text.replaceAll('-', '+').replaceAll('_', '/'));
    const given = JSON.parse(new TextDecoder().decode(Uint8Array.from(bytes, (c) => c.charCodeAt(0))));
    for (const [key, valid] of Object.entries(VALID)) {
      if (key in given && valid(given[key])) state[key] = given[key];
    }
  } catch {
    return initial();
  }
  return state;
}

/** The camera of a state as a change of a scene, see `change` in engine/core.js. */
export function lookEdit({ origin, target, up, halfWidth }) {
  return ['look', Float32Array.from(origin), Float32Array.from(target), Float32Array.from(up), halfWidth];
}

/** A light of a state, likewise. */
export function lightEdit(index, { kind, position, direction, size, strength }) {
  return ['light', index, kind, ...[position, direction, size, strength].map((v) => Float32Array.from(v))];
}
