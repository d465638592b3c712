// SPDX-License-Identifier: MIT
// Makes viewer.bundle.js. It begins with the licence of three.js, which has to go with every page,
// and with a hash of what it was made from, so that a test can tell when it is out of date.
import { build } from 'esbuild';
import { createHash } from 'node:crypto';
import { copyFileSync, readFileSync } from 'node:fs';

const sources = ['colours.js', 'controls.js', 'data.js', 'drawing.js', 'package.json', 'viewer.js'];
const hash = createHash('sha256');
for (const name of sources) hash.update(readFileSync(name));
copyFileSync('node_modules/three/LICENSE', 'LICENSE.three');

await build({
  entryPoints: ['viewer.js'],
  outfile: 'viewer.bundle.js',
  bundle: true,
  minify: true,
  format: 'iife',
  target: 'es2022',
  charset: 'ascii',
  legalComments: 'none',
  banner: {
    js: `/* made from ${sources.join(' ')}\n   sha256 ${hash.digest('hex')}\n\n` +
      `With three.js:\n\n${readFileSync('LICENSE.three', 'utf8').replace('©', '(c)')}*/`,
  },
});
