// A camera that goes around a point, and where things are in its picture.

import { add, cross, dot, length, scale, sub, unit } from './vector.js';

export class Orbit {
  /** `view` as the module gives it; `distance` (m) to what it turns around. */
  constructor(view, distance) {
    this.orthographic = view.orthographic;
    this.halfWidth = view.half_width;
    this.origin = [...view.origin];
    this.target = add(this.origin, [...view.forward], distance);
    this.up = [...view.up];
    // Turning keeps the horizon level, unless the author's is not.
    this.pole = Math.abs(view.right[1]) < 1e-3 ? [0, 1, 0] : this.up;
  }

  get forward() {
    return unit(sub(this.target, this.origin));
  }

  get right() {
    return unit(cross(this.forward, this.up));
  }

  get trueUp() {
    return cross(this.right, this.forward);
  }

  get distance() {
    return length(sub(this.target, this.origin));
  }

  /** Turns around the target (rad). */
  turn(yaw, pitch) {
    const back = unit(sub(this.origin, this.target));
    const { distance, pole } = this;
    const height = Math.asin(Math.max(-1, Math.min(1, dot(back, pole))));
    const level = unit(sub(back, scale(pole, Math.sin(height))));
    const side = cross(pole, level);
    const turned = add(scale(level, Math.cos(yaw)), side, Math.sin(yaw));
    const to = Math.max(-1.5, Math.min(1.5, height + pitch));
    const direction = add(scale(turned, Math.cos(to)), pole, Math.sin(to));
    this.origin = add(this.target, direction, distance);
    this.up = pole;
  }

  /** Moves sideways, in halves of the picture's width. */
  pan(x, y) {
    const step = this.halfWidth * (this.orthographic ? 1 : this.distance);
    const by = add(scale(this.right, x * step), this.trueUp, y * step);
    this.origin = add(this.origin, by);
    this.target = add(this.target, by);
  }

  /** Comes nearer: by a factor below 1. */
  zoom(factor) {
    if (this.orthographic) this.halfWidth *= factor;
    else this.origin = add(this.target, sub(this.origin, this.target), factor);
  }

  /** What a link keeps. */
  save() {
    const { origin, target, up, halfWidth } = this;
    return { origin, target, up, halfWidth };
  }

  restore(saved) {
    Object.assign(this, structuredClone(saved));
  }

  /** How far in front of the camera a point is (m). */
  depth(point) {
    return dot(sub(point, this.origin), this.forward);
  }

  /** Metres that half of the picture's width spans at a point's depth. */
  span(point) {
    return this.halfWidth * (this.orthographic ? 1 : Math.max(this.depth(point), 0.05 * this.distance));
  }

  /** Where a point is: x and y from 0 to 1 from the top left corner; `behind` when it is not in front. */
  project(point, aspect) {
    const v = sub(point, this.origin);
    const z = dot(v, this.forward);
    const behind = !this.orthographic && z <= 1e-6 * this.distance;
    const w = this.halfWidth * (this.orthographic ? 1 : Math.max(z, 1e-3 * this.distance));
    return {
      x: 0.5 + (0.5 * dot(v, this.right)) / w,
      y: 0.5 - (0.5 * dot(v, this.trueUp) * aspect) / w,
      behind,
    };
  }
}
