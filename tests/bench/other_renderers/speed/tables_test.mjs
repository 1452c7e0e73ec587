// The tables, from a report made by hand.

import assert from 'node:assert/strict';
import test from 'node:test';

import { markdownOf, timesExact } from './tables.mjs';

const kRows = [
  { kind: 'gnomon', name: 'Gnomon cpu, exact', says: '`rayTraced`', warm: 50, warm4x: 60, cold: 100 },
  { kind: 'cascaded', name: 'three.js, CSM', says: '4 cascades', warm: 800, warm4x: 900, cold: 1500, coldPage: 1000 },
  { kind: 'cascaded', name: 'PlayCanvas', says: '4 cascades', warm: 700, warm4x: 1200, cold: 1600, coldPage: 1100 },
];
const kReport = {
  machine: 'A processor', cores: 2, frames: 12, coldRounds: 3, loadBefore: 0.5, loadAfter: 1.25,
  versions: [{ name: 'three.js, CSM', version: 'r1', chromium: '9', graphics: 'ANGLE (SwiftShader)' }],
  absent: { VTK: 'no Python' },
  scenes: [{ scene: 'truck', width: 1280, height: 720, rows: kRows }],
};

test('the fastest of a kind is compared with the exact frame, each time with its own', () => {
  const [scene] = kReport.scenes;
  assert.equal(timesExact(scene, 'cascaded', 'warm'), 14);
  assert.equal(timesExact(scene, 'cascaded', 'warm4x'), 15);
  assert.equal(timesExact(scene, 'cascaded', 'cold'), 15);
  assert.equal(timesExact(scene, 'kept map', 'warm'), undefined);
});

test('a page for the README has both tables between its marks, and names what is missing', () => {
  const page = markdownOf(kReport);
  const marked = page.slice(page.indexOf('<!-- readme -->'), page.indexOf('<!-- /readme -->'));
  assert.match(marked, /\| truck \| \*\*14\*\* \| \*\*15\*\* \| \*\*15\*\* \|  \|  \|  \|/);
  assert.match(marked, /\| truck \| PlayCanvas \| 4 cascades \| 700 \| 14 \| 1200 \| 20 \| 1600 \| 16 \| 1100 \|/);
  assert.match(marked, /\| Gnomon cpu, exact \| `rayTraced` \| 50\.0 \| 1\.0 \| 60\.0 \| 1\.0 \| 100 \| 1\.0 \|  \|/);
  assert.match(marked, /three\.js r1, Chromium 9, WebGL 2 SwiftShader/);
  assert.match(marked, /VTK is not in the table: no Python\./);
});
