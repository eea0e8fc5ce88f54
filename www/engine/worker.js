// One of several workers: an instance of the module with scenes of its own.

import { Core, transfers } from './core.js';

const core = new Core();
let last = Promise.resolve();

// In the order in which they come, one after the other.
onmessage = ({ data }) => {
  last = last.then(async () => {
    try {
      const answer = await core.handle(data.message);
      postMessage({ id: data.id, answer }, transfers(answer));
    } catch (error) {
      postMessage({ id: data.id, error: error.message ?? String(error) });
    }
  });
};
