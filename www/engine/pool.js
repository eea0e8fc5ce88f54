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

async function remote(module) {
  const worker = new Remote(new Worker(new URL('./worker.js', import.meta.url), { type: 'module' }));
  try {
    await worker.ask({ type: 'init', module });
    return worker;
  } catch (error) {
    worker.end();
    throw error;
  }
}

export class Pool {
  /** Those that render. */
  workers = [];
  /** True when they are workers and not the page. */
  parallel = true;

  /** `count` workers for a compiled module; the page itself when they cannot be had. */
  static async start(module, count) {
    const pool = new Pool();
    try {
      pool.workers = await Promise.all(Array.from({ length: count }, () => remote(module)));
    } catch {
      const local = new Local();
      await local.ask({ type: 'init', module });
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

  idlest() {
    return this.workers.reduce((a, b) => (b.load < a.load ? b : a));
  }

  end() {
    for (const worker of this.workers) worker.end();
  }
}
