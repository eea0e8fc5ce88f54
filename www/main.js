// The page.

import init, { Scene } from './halflight.js';
import { App } from './app.js';
import { acceptFiles } from './files.js';
import { Pool, compiled } from './engine/pool.js';
import { attach, attachLight, attachSplit } from './pointer.js';
import { download, exr, png } from './save.js';
import { decode } from './state.js';
import { LightPanel } from './ui/light.js';
import { ProbePanel } from './ui/probe.js';
import { SamplingPanel } from './ui/sampling.js';
import { ShowPanel } from './ui/show.js';
import { Status } from './ui/status.js';
import { el } from './ui/widgets.js';

const byId = (id) => document.getElementById(id);

/** The number of workers: as many as there are cores, or as the address says. */
function workers() {
  const wanted = Number(new URLSearchParams(location.search).get('workers') ?? navigator.hardwareConcurrency ?? 2);
  return Math.max(1, Math.min(32, wanted || 1));
}

function panels(app) {
  app.panels = {
    light: new LightPanel(byId('light'), app),
    show: new ShowPanel(byId('show'), app),
    sampling: new SamplingPanel(byId('sampling'), app),
    probe: new ProbePanel(byId('probe'), app),
    status: new Status(app),
  };
}

function showPanels(app) {
  app.panels.light.show();
  app.panels.show.show();
  app.panels.sampling.show();
  const { triangles, analytic, lights, bytes } = app.facts;
  const count = (n, what) => `${n.toLocaleString('en')} ${what}${n === 1 ? '' : 's'}`;
  byId('facts').textContent = `${[count(triangles, 'triangle'), count(analytic, 'analytic shape'), count(lights, 'light')].join(', ')}; ${(bytes / 1e6).toFixed(1)} MB. Nothing leaves this page.`;
}

function chooser(app, builtins) {
  const select = byId('scene');
  select.append(...builtins.map(({ name }) => el('option', { value: name }, name)));
  const about = () => { byId('about').textContent = builtins.find(({ name }) => name === select.value)?.about ?? ''; };
  select.value = app.state.scene;
  about();
  select.onchange = async () => {
    Object.assign(app.state, { scene: select.value, camera: null, lights: {}, light: 0 });
    select.querySelector('option[data-file]')?.remove();
    about();
    app.keep();
    await open(app, { builtin: select.value });
  };
}

/** Shows a scene, or says why it cannot be shown. */
async function open(app, source) {
  try {
    await app.load(source);
    showPanels(app);
    return true;
  } catch (error) {
    app.say(error.message, true);
    return false;
  }
}

function actions(app) {
  const name = () => app.facts.name || 'halflight';
  byId('pause').onclick = () => app.togglePause();
  byId('dismiss').onclick = () => app.say('');
  byId('png').onclick = async () => download(await png(app.canvas), `${name()}.png`);
  byId('exr').onclick = () => {
    const film = app.renderer.films[0];
    download(exr(film, film.linear()), `${name()}.exr`);
  };
  byId('link').onclick = async () => {
    history.replaceState(null, '', app.link());
    try {
      await navigator.clipboard.writeText(location.href);
      app.say('The link is in the clipboard: it restores scene, camera, lights and settings.');
    } catch {
      app.say(`The link: ${location.href}`);
    }
  };
  addEventListener('hashchange', () => location.reload());
  // Back in sight, it goes on.
  document.addEventListener('visibilitychange', () => app.renderer.pause(app.renderer.paused));
}

/** A module that is valid only where 128-bit SIMD is: one function, `i32.const 0; i8x16.splat; drop`. */
const SIMD = Uint8Array.of(0, 97, 115, 109, 1, 0, 0, 0, 1, 4, 1, 96, 0, 0, 3, 2, 1, 0, 10, 9, 1, 7, 0, 65, 0, 253, 15, 26, 11);

async function start() {
  const begun = performance.now();
  if (!globalThis.WebAssembly) throw new Error('it has no WebAssembly, or does not let pages use it.');
  if (!WebAssembly.validate(SIMD)) {
    throw new Error('it has no SIMD in WebAssembly. Those that do: Chrome and Edge from 91, Firefox from 89, Safari from 16.4.');
  }
  const module = await compiled('./halflight_bg.wasm');
  const arrived = performance.now();
  const [pool] = await Promise.all([Pool.start(module, workers()), init({ module_or_path: module })]);
  const builtins = Scene.builtins().map((b) => ({ name: b.name, about: b.about }));
  const state = decode(location.hash.slice(1));
  if (!builtins.some(({ name }) => name === state.scene)) state.scene = builtins[0].name;
  const app = new App(pool, state);
  panels(app);
  chooser(app, builtins);
  actions(app);
  attach(app.canvas, app);
  attachLight(byId('handle'), app.canvas, app);
  attachSplit(byId('split'), app.canvas, app);
  acceptFiles(app, (source) => open(app, source));
  app.renderer.addEventListener('frame', () => {
    app.timing = { begun, arrived, picture: performance.now() };
  }, { once: true });
  // For the console, and for tests.
  window.halflight = { app };
  await open(app, { builtin: state.scene });
  if (!pool.parallel) app.say('Workers are not available here: the page renders by itself, more slowly.');
}

start().catch((error) => {
  byId('message').textContent = `This browser cannot show the page: ${error.message}`;
  byId('message').className = 'bad';
  document.body.dataset.state = 'failed';
});
