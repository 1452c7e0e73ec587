// Processor time of trees of processes.

import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import test from 'node:test';

import { measured, parsedStat, ticksOfTree } from './measured.mjs';

test('a name with spaces and brackets does not move the numbers', () => {
  const text = '12 (a) b (c) S 7 12 12 0 -1 4194304 100 0 0 0 3 4 50 60 20 0 1 0 100 0 0\n';
  assert.deepEqual(parsedStat(text), { parent: 7, ticks: 117 });
});

test('all descendants count, and no one else', () => {
  const stats = new Map([
    [1, { parent: 0, ticks: 1000 }], [5, { parent: 1, ticks: 1 }], [6, { parent: 5, ticks: 20 }],
    [9, { parent: 6, ticks: 300 }], [8, { parent: 1, ticks: 5000 }],
  ]);
  assert.equal(ticksOfTree(stats, 5), 321);
});

test('a child that has ended counts with what it spent', async () => {
  const busy = 'const end = Date.now() + 300; while (Date.now() < end);';
  const { value, wall, processor } = await measured(() => spawnSync(process.execPath, ['-e', busy]).status);
  assert.equal(value, 0);
  assert.ok(wall >= 300);
  assert.ok(processor >= 20, `${processor} ms`);
});
