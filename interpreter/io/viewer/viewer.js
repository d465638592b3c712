// SPDX-License-Identifier: MIT
// Shows the run in a page that `gmsim view` wrote.
import { Controls } from './controls.js';
import { loadRun } from './data.js';
import { Drawing } from './drawing.js';

async function main() {
  const run = await loadRun();
  const drawing = new Drawing(document.getElementById('view'), run);
  new Controls(run, drawing);
  document.body.dataset.ready = 'yes';
}

main().catch((error) => {
  document.getElementById('label').textContent = '';
  document.getElementById('notice').textContent = `The run cannot be shown: ${error.message}`;
});
