// The panel of the chosen light.

import { add, dot, length, scale, sub, unit } from '../vector.js';
import { checkbox, digits, el, numbers, renew, row, select, slider } from './widgets.js';

/** Kinds that can be changed into one another. */
const KINDS = {
  rectangle: 'rectangle', disk: 'disk', sphere: 'sphere', cylinder: 'cylinder', point: 'point', spot: 'spot',
  directional: 'directional', distant: 'sun', constant: 'environment, even', none: 'none',
};
/** Kinds that keep their form. */
const RIGID = { mesh: 'mesh', triangle: 'triangle', painted: 'painted', map: 'environment map' };
const PLACED = ['rectangle', 'disk', 'sphere', 'cylinder', 'point', 'spot', 'mesh', 'triangle', 'painted'];
const AIMED = ['rectangle', 'disk', 'spot'];
const PARALLEL = ['directional', 'distant'];
const UNITS = { directional: ' W/m²', distant: ' W/m²', constant: ' W/m²sr', mesh: ' W/m²sr', triangle: ' W/m²sr', painted: '×', map: '×' };
/** Most lights that a scene is given here. */
const MOST = 16;
/** Full angles of a new light (degrees): of a spot, all and undimmed; of a sun, the true one's. */
const ANGLES = { spot: [60, 40], distant: [0.533, 0.533] };

const toCode = (v) => Math.round(255 * (v <= 0.0031308 ? 12.92 * v : 1.055 * v ** (1 / 2.4) - 0.055));
const fromCode = (c) => (c <= 10 ? c / 255 / 12.92 : ((c / 255 + 0.055) / 1.055) ** 2.4);

const degrees = (v) => `${Math.round(v)}`.replace('-', '−');

/** The colour of a strength as a picker has it, and how strong it is. */
function split(strength) {
  const most = Math.max(...strength, 1e-9);
  return [`#${strength.map((v) => toCode(v / most).toString(16).padStart(2, '0')).join('')}`, most];
}

const joined = (hex, most) => [1, 3, 5].map((i) => most * fromCode(Number.parseInt(hex.slice(i, i + 2), 16)));

/** A light of another kind that lights the scene about as much. */
function converted(light, kind, { target, radius }) {
  const next = { ...light, kind };
  const away = Math.max(length(sub(light.position, target)), 1e-3) ** 2;
  const perIntensity = (k) => ({ directional: 1 / away, distant: 1 / away, constant: 1 / (away * Math.PI) })[k] ?? 1;
  next.strength = scale(light.strength, perIntensity(kind) / perIntensity(light.kind));
  if (light.kind === 'none') return { ...next, ...fresh(kind, { target, radius }) };
  if (kind === 'none') return next;
  if (!PLACED.includes(light.kind) && PLACED.includes(kind)) {
    const back = length(light.direction) > 0 ? light.direction : [0, -1, 0];
    next.position = add(target, unit(back), -0.8 * radius);
    const distance = (0.8 * radius) ** 2;
    next.strength = scale(light.strength, distance / (light.kind === 'constant' ? 1 / Math.PI : 1));
  }
  if (!(next.size[0] > 0) || light.kind in ANGLES) next.size = [0.15 * radius, 0.15 * radius];
  if (kind !== 'rectangle') next.size = kind === 'cylinder' ? next.size : [next.size[0], next.size[0]];
  next.size = ANGLES[kind] ?? next.size;
  if (kind === 'spot' && !AIMED.includes(light.kind)) next.direction = unit(sub(target, next.position));
  if (PARALLEL.includes(kind) && PLACED.includes(light.kind)) next.direction = unit(sub(target, light.position));
  return next;
}

/** A light where there was none: above what the camera turns around, and a little to its side. */
function fresh(kind, { target, radius }) {
  const away = 0.45 * radius;
  const position = add(target, unit([-0.5, 1, 0.4]), away);
  const strength = { directional: 2, distant: 2, constant: 0.6 }[kind] ?? 2 * away * away;
  const size = ANGLES[kind] ?? [0.1 * radius, 0.1 * radius];
  return { kind, position, direction: unit(sub(target, position)), size, strength: Array(3).fill(strength) };
}

/** Angles of a direction: from where the light comes (degrees). */
function angles([x, y, z]) {
  const norm = length([x, y, z]) || 1;
  return [(Math.asin(-y / norm) * 180) / Math.PI, (Math.atan2(-x, -z) * 180) / Math.PI];
}

function direction(elevation, azimuth) {
  const [e, a] = [(elevation * Math.PI) / 180, (azimuth * Math.PI) / 180];
  return [-Math.cos(e) * Math.sin(a), -Math.sin(e), -Math.cos(e) * Math.cos(a)];
}

export class LightPanel {
  #root;
  #app;

  constructor(root, app) {
    this.#root = root;
    this.#app = app;
  }

  /** Shows the chosen light anew. */
  show() {
    const { lights, state } = this.#app;
    const rows = el('div', { className: 'rows' });
    const light = lights[state.light] && this.#app.currentLight();
    if (!light) rows.append(el('p', { className: 'note' }, 'This scene is lit by its surroundings alone.'));
    if (lights.length > 1) {
      const kind = (l, i) => state.lights[i]?.kind ?? l.kind;
      // A light without a name has that of the kind that it had.
      const named = (l, i) => `${i + 1}: ${l.name in KINDS ? KINDS[kind(l, i)] : RIGID[l.name] ?? l.name}`;
      const names = Object.fromEntries(lights.map((l, i) => [i, named(l, i)]));
      rows.append(select('Which', names, String(state.light), (i) => this.#app.chooseLight(Number(i))));
    }
    if (light) rows.append(...this.#fields(light, lights[state.light].editable));
    if (lights.length < MOST) rows.append(this.#adder(lights.length));
    renew(this.#root, rows);
  }

  /** Adds a light after the last. */
  #adder(index) {
    const button = el('button', { type: 'button', className: 'add' }, 'Add a light');
    button.onclick = () => {
      const { orbit, facts } = this.#app;
      this.#app.addLight(index, fresh('sphere', { target: orbit.target, radius: facts.radius }));
    };
    return button;
  }

  #fields(light, editable) {
    const { radius } = this.#app.facts;
    const set = (change) => this.#app.setLight({ ...this.#app.currentLight(), ...change });
    const rows = [];
    if (editable) {
      rows.push(select('Kind', KINDS, light.kind, (kind) => {
        const around = { target: this.#app.orbit.target, radius };
        this.#app.setLight(converted(this.#app.currentLight(), kind, around));
        this.show();
      }));
    }
    // Where there is no choice, it is said what it is.
    if (!editable) rows.push(el('div', { className: 'row' }, el('span', { className: 'name' }, 'Kind'), el('span', {}, RIGID[light.kind] ?? light.kind)));
    if (light.kind === 'none') return rows;
    const [colour, strength] = split(light.strength);
    const picker = el('input', { type: 'color' });
    picker.value = colour;
    picker.oninput = () => set({ strength: joined(picker.value, split(this.#app.currentLight().strength)[1]) });
    const most = Math.max(strength, 1e-6);
    rows.push(slider('Intensity', { min: most / 30, max: most * 30, value: most, log: true, unit: UNITS[light.kind] ?? ' W/sr' },
      (v) => set({ strength: joined(picker.value, v) })));
    if (light.kind !== 'map') rows.push(row('Colour', picker));
    if (light.kind === 'map') rows.push(...this.#turn(light, set));
    else if (light.kind !== 'constant') rows.push(...this.#place(light, radius, set));
    if (!editable && light.kind !== 'map') {
      rows.push(el('p', { className: 'note' }, `${light.kind === 'painted' ? 'A painted light' : 'A light made of triangles'} keeps its form: it can be moved, made brighter and given another colour.`));
    }
    return rows;
  }

  #turn(light, set) {
    const turned = slider('Turn', { min: -180, max: 180, value: light.size[0], format: degrees, unit: '°' }, (v) => set({ size: [v, 0] }));
    return [turned, el('p', { className: 'note for-mouse' }, 'Alt and drag in the picture turn it, too.')];
  }

  #place(light, radius, set) {
    const rows = [];
    const placed = PLACED.includes(light.kind);
    const range = { min: radius * 1e-3, max: radius, log: true, format: (v) => digits(v, 3), unit: ' m' };
    if (light.kind === 'rectangle' || light.kind === 'cylinder') {
      const at = (i, v) => { const size = [...this.#app.currentLight().size]; size[i] = v; set({ size }); };
      rows.push(slider('Width', { ...range, value: light.size[0] }, (v) => at(0, v)));
      rows.push(slider('Height', { ...range, value: light.size[1] }, (v) => at(1, v)));
    } else if (light.kind === 'disk' || light.kind === 'sphere') {
      rows.push(slider('Diameter', { ...range, value: light.size[0] }, (v) => set({ size: [v, v] })));
    } else if (light.kind === 'spot') {
      const wide = { min: 1, max: 170, format: (v) => digits(v, 3), unit: '°' };
      rows.push(slider('Cone', { ...wide, value: light.size[0] }, (v) => set({ size: [v, Math.min(v, this.#app.currentLight().size[1])] })));
      rows.push(slider('Undimmed', { ...wide, min: 0, value: light.size[1] }, (v) => set({ size: [Math.max(v, this.#app.currentLight().size[0]), v] })));
    } else if (light.kind === 'distant') {
      rows.push(slider('Diameter', { min: 0.05, max: 60, value: light.size[0], log: true, format: (v) => digits(v, 3), unit: '°' }, (v) => set({ size: [v, v] })));
    }
    if (placed) {
      rows.push(numbers('Place (m)', ['x', 'y', 'z'], light.position, (i, v) => {
        const position = [...this.#app.currentLight().position];
        position[i] = v;
        this.#app.moveLight(position);
      }));
    }
    if (AIMED.includes(light.kind)) {
      rows.push(checkbox('Stays aimed when it moves', this.#app.state.aim, (aim) => this.#app.setAim(aim)));
    }
    if (AIMED.includes(light.kind) || PARALLEL.includes(light.kind)) {
      const turn = (i, v) => { const now = angles(this.#app.currentLight().direction); now[i] = v; set({ direction: direction(...now) }); };
      const [elevation, azimuth] = angles(light.direction);
      rows.push(slider('Elevation', { min: -90, max: 90, value: elevation, format: degrees, unit: '°' }, (v) => turn(0, Math.max(-89.9, Math.min(89.9, v)))));
      rows.push(slider('Azimuth', { min: -180, max: 180, value: azimuth, format: degrees, unit: '°' }, (v) => turn(1, v)));
    }
    return rows;
  }
}

/** The direction of a flat light after a move, when it stays aimed at what it was aimed at. */
export function aimed(light, position, target) {
  const to = sub(target, light.position);
  const reach = Math.max(0.2 * length(to), dot(to, light.direction));
  const at = add(light.position, light.direction, reach);
  const turned = sub(at, position);
  return length(turned) > 0 ? unit(turned) : light.direction;
}

/** True for a light so far away that it has a direction and no place. */
export const canTurn = (light) => light?.kind === 'map' || PARALLEL.includes(light?.kind);

/** Such a light turned about the vertical (rad): what is behind the scene goes to the right. */
export function turned(light, angle) {
  const [x, y, z] = light.direction;
  const [sin, cos] = [Math.sin(angle), Math.cos(angle)];
  if (light.kind !== 'map') return { ...light, direction: [x * cos - z * sin, y, z * cos + x * sin] };
  const degrees = light.size[0] - (angle * 180) / Math.PI;
  return { ...light, size: [degrees - 360 * Math.round(degrees / 360), 0] };
}
