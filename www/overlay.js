// What is drawn over the picture: the chosen light, the probe's rays.

import { add } from './vector.js';
import { svg } from './ui/widgets.js';

/** Most rays that are drawn: more are a fog. */
const RAYS = 96;
/** How far from the picture's edge the handle of a light outside of it stays (CSS pixels). */
const MARGIN = 16;

export class Overlay {
  #svg;
  #handle;
  #size = [1, 1];

  constructor(element, handle) {
    this.#svg = element;
    this.#handle = handle;
  }

  /** Lies over the picture: its place and size in the frame (CSS pixels). */
  place({ left, top, width, height }) {
    Object.assign(this.#svg.style, { left: `${left}px`, top: `${top}px`, width: `${width}px`, height: `${height}px` });
    this.#svg.setAttribute('viewBox', `0 0 ${width} ${height}`);
    this.#size = [width, height];
    this.offset = [left, top];
  }

  #at(orbit, point) {
    const [width, height] = this.#size;
    const { x, y, behind } = orbit.project(point, width / height);
    return { x: x * width, y: y * height, behind };
  }

  /** Draws everything anew. */
  draw({ orbit, light, probe }) {
    const parts = [];
    if (probe) parts.push(...this.#rays(orbit, probe));
    if (light?.outline.length) parts.push(...this.#outline(orbit, light.outline));
    this.#svg.replaceChildren(...parts);
    this.#put(orbit, light);
  }

  #outline(orbit, outline) {
    const corners = Array.from({ length: outline.length / 3 }, (_, i) => (
      this.#at(orbit, outline.slice(3 * i, 3 * i + 3))));
    if (corners.some((c) => c.behind)) return [];
    return [svg('polygon', { class: 'outline', points: corners.map((c) => `${c.x},${c.y}`).join(' ') })];
  }

  #put(orbit, light) {
    const placed = light && !['directional', 'distant', 'constant', 'map', 'none'].includes(light.kind);
    this.#handle.hidden = !placed;
    if (!placed) return;
    const [width, height] = this.#size;
    const { x, y, behind } = this.#at(orbit, light.position);
    // From behind, the shortest way is the other way round.
    const [px, py] = behind ? [width - x, height - y] : [x, y];
    const [cx, cy] = [Math.max(MARGIN, Math.min(width - MARGIN, px)), Math.max(MARGIN, Math.min(height - MARGIN, py))];
    this.#handle.style.left = `${this.offset[0] + cx}px`;
    this.#handle.style.top = `${this.offset[1] + cy}px`;
    const away = behind || cx !== px || cy !== py;
    this.#handle.classList.toggle('away', away);
    this.#handle.classList.toggle('flip', cx > width / 2);
    this.#handle.title = away ? 'The light, outside of the picture: drag to move it' : 'The light: drag to move it; Shift drags nearer and farther';
  }

  #rays(orbit, probe) {
    const from = this.#at(orbit, probe.point);
    if (from.behind) return [];
    const parts = [];
    for (let i = 0; i < Math.min(RAYS, probe.rays.length / 8); i++) {
      const ray = probe.rays.slice(8 * i, 8 * i + 4);
      const to = this.#clipped(orbit, probe.point, ray.slice(0, 3));
      parts.push(svg('line', { class: `ray ${ray[3] ? 'lit' : 'blocked'}`, x1: from.x, y1: from.y, x2: to.x, y2: to.y }));
    }
    const reach = 0.06 * orbit.span(probe.point) * 2;
    const tip = this.#at(orbit, add(probe.point, probe.normal, reach));
    parts.push(svg('line', { class: 'normal', x1: from.x, y1: from.y, x2: tip.x, y2: tip.y }));
    parts.push(svg('circle', { class: 'point', cx: from.x, cy: from.y, r: 5 }));
    return parts;
  }

  /** The end of a ray, or the last of it that is in front of the camera. */
  #clipped(orbit, from, to) {
    if (orbit.orthographic) return this.#at(orbit, to);
    const [near, a, b] = [0.02 * orbit.distance, orbit.depth(from), orbit.depth(to)];
    if (b >= near || a <= near) return this.#at(orbit, to);
    const k = (a - near) / (a - b);
    return this.#at(orbit, add(from, to.map((v, i) => v - from[i]), k));
  }
}
