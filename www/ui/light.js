// The panel of the chosen light.

import { add, dot, length, scale, sub, unit } from '../vector.js';
import { checkbox, digits, el, numbers, row, select, slider } from './widgets.js';

/** Kinds that can be changed into one another. */
const KINDS = {
  rectangle: 'rectangle', disk: 'disk', sphere: 'sphere', cylinder: 'cylinder', point: 'point',
  directional: 'directional', constant: 'environment, even',
};
const PLACED = ['rectangle', 'disk', 'sphere', 'cylinder', 'point'];
const FLAT = ['rectangle', 'disk'];
const UNITS = { directional: ' W/m²', constant: ' W/m²sr' };

const toCode = (v) => Math.round(255 * (v <= 0.0031308 ? 12.92 * v : 1.055 * v ** (1 / 2.4) - 0.055));
const fromCode = (c) => (c <= 10 ? c / 255 / 12.92 : ((c / 255 + 0.055) / 1.055) ** 2.4);

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
  const perIntensity = (k) => ({ directional: 1 / away, constant: 1 / (away * Math.PI) })[k] ?? 1;
  next.strength = scale(light.strength, perIntensity(kind) / perIntensity(light.kind));
  if (!PLACED.includes(light.kind) && PLACED.includes(kind)) {
    const back = length(light.direction) > 0 ? light.direction : [0, -1, 0];
    next.position = add(target, unit(back), -0.8 * radius);
    const distance = (0.8 * radius) ** 2;
    next.strength = scale(light.strength, distance / (light.kind === 'constant' ? 1 / Math.PI : 1));
  }
  if (!(next.size[0] > 0)) next.size = [0.15 * radius, 0.15 * radius];
  if (kind !== 'rectangle') next.size = kind === 'cylinder' ? next.size : [next.size[0], next.size[0]];
  if (kind === 'directional' && light.kind !== 'constant') next.direction = unit(sub(target, light.position));
  return next;
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
    const light = lights[state.light];
    if (!light) {
      rows.append(el('p', { className: 'note' }, 'This scene is lit by its surroundings alone.'));
      this.#root.replaceChildren(rows);
      return;
    }
    if (lights.length > 1) {
      const names = Object.fromEntries(lights.map((l, i) => [i, l.name]));
      rows.append(select('Which', names, String(state.light), (i) => this.#app.chooseLight(Number(i))));
    }
    if (light.editable) rows.append(...this.#fields(light));
    else rows.append(el('p', { className: 'note' }, `A light of kind ${light.kind} can be seen here, but not changed.`));
    this.#root.replaceChildren(rows);
  }

  #fields(light) {
    const { radius } = this.#app.facts;
    const set = (change) => this.#app.setLight({ ...this.#app.currentLight(), ...change });
    const rows = [select('Kind', KINDS, light.kind, (kind) => {
      const around = { target: this.#app.orbit.target, radius };
      this.#app.setLight(converted(this.#app.currentLight(), kind, around));
      this.show();
    })];
    const [colour, strength] = split(light.strength);
    const picker = el('input', { type: 'color' });
    picker.value = colour;
    picker.oninput = () => set({ strength: joined(picker.value, split(this.#app.currentLight().strength)[1]) });
    const most = Math.max(strength, 1e-6);
    rows.push(slider('Intensity', { min: most / 30, max: most * 30, value: most, log: true, unit: UNITS[light.kind] ?? ' W/sr' },
      (v) => set({ strength: joined(picker.value, v) })));
    rows.push(row('Colour', picker));
    if (light.kind !== 'constant') rows.push(...this.#place(light, radius, set));
    return rows;
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
    }
    if (placed) {
      rows.push(numbers('Place (m)', ['x', 'y', 'z'], light.position, (i, v) => {
        const position = [...this.#app.currentLight().position];
        position[i] = v;
        this.#app.moveLight(position);
      }));
    }
    if (FLAT.includes(light.kind)) {
      rows.push(checkbox('Stays aimed when it moves', this.#app.state.aim, (aim) => this.#app.setAim(aim)));
    }
    if (FLAT.includes(light.kind) || light.kind === 'directional') {
      const turn = (i, v) => { const now = angles(this.#app.currentLight().direction); now[i] = v; set({ direction: direction(...now) }); };
      const [elevation, azimuth] = angles(light.direction);
      const degrees = (v) => `${Math.round(v)}`;
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
