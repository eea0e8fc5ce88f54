// Scenes and skies that are dropped on the picture, or opened.

import { Pool, compiled } from './engine/pool.js';
import { el } from './ui/widgets.js';

const SCENES = ['xml', 'gltf', 'glb'];
const SKIES = ['hdr', 'exr'];

const extension = (name) => name.slice(name.lastIndexOf('.') + 1).toLowerCase();

/** The files of a drop, those in folders too: [path, File]. */
async function dropped(items) {
  const entries = [...items].map((item) => item.webkitGetAsEntry?.()).filter(Boolean);
  const files = [];
  const walk = async (entry) => {
    if (entry.isFile) {
      files.push([entry.fullPath.slice(1), await new Promise((resolve, reject) => { entry.file(resolve, reject); })]);
      return;
    }
    const reader = entry.createReader();
    for (;;) {
      const some = await new Promise((resolve, reject) => { reader.readEntries(resolve, reject); });
      if (some.length === 0) return;
      for (const inner of some) await walk(inner);
    }
  };
  for (const entry of entries) await walk(entry);
  return files;
}

/** What files make: a scene, or a sky for the scene that is shown. */
export function understood(names) {
  const scenes = names.filter((name) => SCENES.includes(extension(name)));
  // Of several, the others are included by the one with the shortest path.
  if (scenes.length > 0) return { scene: scenes.sort((a, b) => a.split('/').length - b.split('/').length || a.length - b.length)[0] };
  const sky = names.find((name) => SKIES.includes(extension(name)));
  if (sky && names.length === 1) return { sky };
  const list = names.slice(0, 3).join(', ');
  throw new Error(`${list}: nothing here that can be shown. Drop a scene (Mitsuba 3 .xml, glTF 2.0 .gltf or .glb) with its meshes and pictures, or one sky (.hdr, .exr) in longitude and latitude.`);
}

/** Has files opened by `show(source)`, which says whether it could. */
export function acceptFiles(app, show) {
  const byId = (id) => document.getElementById(id);

  /** The readers of files are in a module of their own, which is fetched now. */
  async function withReaders() {
    if (app.pool.files) return;
    const old = app.pool;
    app.use(await Pool.start(await compiled('files/halflight_bg.wasm'), old.workers.length, true));
    old.end();
    await app.load(app.source);
  }

  async function take(files) {
    const { state } = app;
    const kept = { camera: state.camera, lights: state.lights, light: state.light };
    try {
      if (files.length === 0) return;
      const what = understood(files.map(([path]) => path));
      app.say(`Reading ${what.scene ?? what.sky} …`);
      await withReaders();
      const bytes = await Promise.all(files.map(async ([path, file]) => [path, new Uint8Array(await file.arrayBuffer())]));
      Object.assign(state, { camera: what.sky ? kept.camera : null, lights: {}, light: 0 });
      const source = what.sky ? { ...app.source, sky: { name: what.sky, files: bytes } } : { name: what.scene, files: bytes };
      if (await show(source)) {
        named(what.scene ? app.facts.name : `${app.facts.name}, ${what.sky}`);
        if (app.facts.warnings.length === 0) app.say('Shown from files of this computer: a link cannot restore them.');
        return;
      }
    } catch (error) {
      app.say(error.message, true);
    }
    Object.assign(state, kept);
  }

  /** What is shown is none of the scenes to choose from. */
  function named(name) {
    const select = byId('scene');
    const option = select.querySelector('option[data-file]') ?? el('option', { 'data-file': '' });
    option.value = option.textContent = name;
    select.append(option);
    select.value = name;
    byId('about').textContent = 'from files of this computer';
  }

  const input = byId('files');
  byId('open').onclick = () => input.click();
  input.onchange = async () => {
    await take([...input.files].map((file) => [file.webkitRelativePath || file.name, file]));
    input.value = '';
  };
  const shown = (on) => { byId('drop').hidden = !on; };
  addEventListener('dragover', (event) => { event.preventDefault(); shown(true); });
  addEventListener('dragleave', (event) => { if (!event.relatedTarget) shown(false); });
  addEventListener('drop', async (event) => {
    event.preventDefault();
    shown(false);
    // The items are gone after the first wait: their entries are taken at once.
    const found = dropped(event.dataTransfer.items);
    const plain = [...event.dataTransfer.files].map((file) => [file.name, file]);
    const files = await found;
    await take(files.length > 0 ? files : plain);
  });
}
