// Mouse, touch and keys on the picture.

import { canTurn } from './ui/light.js';

/** A press that moves less than this is a click (CSS pixels). */
const CLICK = 5;

/** Turning per width of the picture (rad), and per key. */
const TURN = Math.PI;
const KEY_TURN = 0.06;

export function attach(canvas, app) {
  const pointers = new Map();
  let moved = 0;
  let pan = false;
  let turns = false;

  const size = () => canvas.getBoundingClientRect();
  const spread = () => {
    const [a, b] = [...pointers.values()];
    return b ? Math.hypot(a.x - b.x, a.y - b.y) : 0;
  };

  canvas.addEventListener('pointerdown', (event) => {
    canvas.setPointerCapture(event.pointerId);
    pointers.set(event.pointerId, { x: event.clientX, y: event.clientY });
    moved = pointers.size > 1 ? CLICK : 0;
    pan = event.button === 2 || event.button === 1 || event.shiftKey;
    turns = event.altKey && canTurn(app.currentLight());
  });

  canvas.addEventListener('pointermove', (event) => {
    const last = pointers.get(event.pointerId);
    if (!last) return;
    const [dx, dy] = [event.clientX - last.x, event.clientY - last.y];
    const before = spread();
    pointers.set(event.pointerId, { x: event.clientX, y: event.clientY });
    moved += Math.hypot(dx, dy);
    if (moved < CLICK) return;
    canvas.classList.add('moving');
    const { width } = size();
    if (turns && pointers.size === 1) {
      app.turnLight((TURN * dx) / width);
      return;
    }
    if (pointers.size > 1) {
      app.orbit.zoom(before / Math.max(spread(), 1));
      app.orbit.pan(-dx / width, dy / width);
    } else if (pan) {
      app.orbit.pan((-2 * dx) / width, (2 * dy) / width);
    } else {
      app.orbit.turn((-TURN * dx) / width, (TURN * dy) / width);
    }
    app.cameraMoved();
  });

  const up = (event) => {
    if (!pointers.delete(event.pointerId)) return;
    canvas.classList.remove('moving');
    if (pointers.size > 0) return;
    if (moved >= CLICK) {
      app.released();
      if (turns) app.panels.light.show();
    } else if (event.type === 'pointerup' && event.button === 0) {
      const { left, top, width, height } = size();
      app.probeAt((event.clientX - left) / width, (event.clientY - top) / height);
    }
  };
  canvas.addEventListener('pointerup', up);
  canvas.addEventListener('pointercancel', up);
  canvas.addEventListener('contextmenu', (event) => event.preventDefault());

  canvas.addEventListener('wheel', (event) => {
    event.preventDefault();
    app.orbit.zoom(Math.exp(Math.max(-60, Math.min(60, event.deltaY)) * 0.002));
    app.cameraMoved();
  }, { passive: false });

  canvas.addEventListener('keydown', (event) => {
    const arrows = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[event.key];
    if (arrows) {
      const [x, y] = arrows;
      if (event.shiftKey) app.orbit.pan(0.05 * x, 0.05 * y);
      else app.orbit.turn(KEY_TURN * x, KEY_TURN * y);
      app.cameraMoved();
    } else if (event.key === '+' || event.key === '=') {
      app.orbit.zoom(0.94);
      app.cameraMoved();
    } else if (event.key === '-') {
      app.orbit.zoom(1 / 0.94);
      app.cameraMoved();
    } else if ((event.key === '[' || event.key === ']') && canTurn(app.currentLight())) {
      app.turnLight(event.key === '[' ? -KEY_TURN : KEY_TURN);
      app.panels.light.show();
    } else if (event.key === 'Enter') {
      app.probeAt(0.5, 0.5);
    } else if (event.key === 'Home') {
      app.home();
    } else if (event.key === 'Escape') {
      app.closeProbe();
    } else if (event.key === ' ') {
      app.togglePause();
    } else {
      return;
    }
    event.preventDefault();
  });
}

/** The handle of the light: along the picture, or with Shift toward it and away. */
export function attachLight(handle, canvas, app) {
  let last;
  const move = (dx, dy, deep) => {
    handle.classList.add('known');
    const light = app.currentLight();
    const step = (2 * app.orbit.span(light.position)) / canvas.getBoundingClientRect().width;
    const { right, trueUp, forward } = app.orbit;
    app.moveLight(light.position.map((v, i) => (
      deep ? v - forward[i] * dy * step : v + (right[i] * dx - trueUp[i] * dy) * step)));
  };
  handle.addEventListener('pointerdown', (event) => {
    handle.setPointerCapture(event.pointerId);
    last = [event.clientX, event.clientY];
  });
  handle.addEventListener('pointermove', (event) => {
    if (!last) return;
    move(event.clientX - last[0], event.clientY - last[1], event.shiftKey);
    last = [event.clientX, event.clientY];
  });
  const up = () => {
    if (!last) return;
    last = undefined;
    app.released();
    app.panels.light.show();
  };
  handle.addEventListener('pointerup', up);
  handle.addEventListener('pointercancel', up);
  handle.addEventListener('keydown', (event) => {
    const step = 12;
    const by = { ArrowLeft: [-step, 0], ArrowRight: [step, 0], ArrowUp: [0, -step], ArrowDown: [0, step],
      PageUp: [0, -step, true], PageDown: [0, step, true] }[event.key];
    if (!by) return;
    event.preventDefault();
    move(...by);
    app.panels.light.show();
  });
}

/** The bar between two ways of sampling. */
export function attachSplit(bar, canvas, app) {
  let dragged = false;
  const at = (event) => {
    const { left, width } = canvas.getBoundingClientRect();
    app.setSplit((event.clientX - left) / width);
  };
  bar.addEventListener('pointerdown', (event) => { bar.setPointerCapture(event.pointerId); dragged = true; });
  bar.addEventListener('pointermove', (event) => { if (dragged) at(event); });
  const up = () => { dragged = false; };
  bar.addEventListener('pointerup', up);
  bar.addEventListener('pointercancel', up);
  bar.addEventListener('keydown', (event) => {
    const by = { ArrowLeft: -0.02, ArrowRight: 0.02, Home: -1, End: 1 }[event.key];
    if (!by) return;
    event.preventDefault();
    app.setSplit(app.state.split + by);
  });
}
