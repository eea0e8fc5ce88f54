// The workers, or the page itself where there are none.

import { Core } from './core.js';

/** A worker that answers by promise. */
class Remote {
  #worker;
  #waiting = new Map();
  #next = 0;

  constructor(worker) {
    this.#worker = worker;
    worker.onmessage = ({ data: { id, answer, error } }) => {
      const { resolve, reject } = this.#waiting.get(id);
      this.#waiting.delete(id);
      if (error === undefined) resolve(answer);
      else reject(new Error(error));
    };
    worker.onerror = (event) => this.#fail(event.message ?? 'a worker stopped');
  }

  get load() {
    return this.#waiting.size;
  }

  #fail(text) {
    for (const { reject } of this.#waiting.values()) reject(new Error(text));
    this.#waiting.clear();
  }

  ask(message, transfer = []) {
    const id = this.#next++;
    return new Promise((resolve, reject) => {
      this.#waiting.set(id, { resolve, reject });
      this.#worker.postMessage({ id, message }, transfer);
    });
  }

  end() {
    this.#worker.terminate();
    this.#fail('the worker has been ended');
  }
}

/** The same on the page's own thread; it lets the page breathe before each message. */
class Local {
  #core = new Core();
  #last = Promise.resolve();
  load = 0;

  ask(message) {
    this.load += 1;
    const answer = this.#last.then(async () => {
      await new Promise((resolve) => setTimeout(resolve));
      return this.#core.handle(message);
    });
    this.#last = answer.catch(() => {}).finally(() => { this.load -= 1; });
    return answer;
  }

  end() {}
}

async function remote(init) {
  const worker = new Remote(new Worker(new URL('./worker.js', import.meta.url), { type: 'module' }));
  try {
    await worker.ask(init);
    return worker;
  } catch (error) {
    worker.end();
    throw error;
  }
}

/** A module, compiled once for the page and all workers; `path` is relative to the page's folder. */
export async function compiled(path) {
  const url = new URL(`../${path}`, import.meta.url);
  try {
    return await WebAssembly.compileStreaming(fetch(url));
  } catch {
    // A server that does not name the type of a module.
    return WebAssembly.compile(await (await fetch(url)).arrayBuffer());
  }
}

export class Pool {
  /** Those that render. */
  workers = [];
  /** True when they are workers and not the page. */
  parallel = true;

  /** `count` workers for a compiled module, with readers of files or without; the page itself when they
   *  cannot be had. */
  static async start(module, count, files = false) {
    const pool = new Pool();
    pool.files = files;
    const init = { type: 'init', module, files };
    try {
      pool.workers = await Promise.all(Array.from({ length: count }, () => remote(init)));
    } catch {
      const local = new Local();
      await local.ask(init);
      pool.workers = [local];
      pool.parallel = false;
    }
    return pool;
  }

  /** Tells all; the answer of the first. */
  async all(message) {
    const [answer] = await Promise.all(this.workers.map((worker) => worker.ask(message)));
    return answer;
  }

  /** Asks the one with least to do. */
  ask(message, transfer) {
    return this.idlest().ask(message, transfer);
  }

  /** True with a module that reads files. */
  files = false;

  idlest() {
    return this.workers.reduce((a, b) => (b.load < a.load ? b : a));
  }

  end() {
    for (const worker of this.workers) worker.end();
  }
}
