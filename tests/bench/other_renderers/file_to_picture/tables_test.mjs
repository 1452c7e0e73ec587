// The tables, from a report made by hand.

import assert from 'node:assert/strict';
import test from 'node:test';

import { markdownOf, ratioOf } from './tables.mjs';

const time = (wall, processor) => ({ wall, processor });
const rowsOf = (factor) => [
  { name: 'gnomon render, exact', program: 'Gnomon, exact', shadows: 'exact', cold: time(100, 150) },
  {
    name: 'gnomon serve, exact', program: 'Gnomon, exact', shadows: 'exact', cold: time(120, 170), running: time(90, 130),
    further: time(50, 80),
  },
  {
    name: 'three.js, CSM', program: 'three.js, CSM', shadows: '4 cascades', cold: time(1500 * factor, 3000),
    running: time(900 * factor, 1300), further: time(600 * factor, 800),
  },
  { name: 'F3D', program: 'F3D', shadows: 'none', cold: time(500, 600) },
];
const kReport = {
  machine: 'A processor', cores: 2, rounds: 3, further: 4, loadBefore: 0.5, loadAfter: 1.25, versions: ['Chromium 9'],
  absent: { Blender: 'there is no `blender`' },
  scenes: [{ scene: 'truck', width: 1280, height: 720, rows: rowsOf(1) }, { scene: 'city', rows: rowsOf(2) }],
};

test('a first picture is compared with the command, the others with the server', () => {
  const [scene] = kReport.scenes;
  assert.equal(ratioOf(scene, scene.rows[2], 'cold', 'wall'), 15);
  assert.equal(ratioOf(scene, scene.rows[2], 'cold', 'processor'), 20);
  assert.equal(ratioOf(scene, scene.rows[2], 'running', 'wall'), 10);
  assert.equal(ratioOf(scene, scene.rows[2], 'further', 'wall'), 12);
  assert.equal(ratioOf(scene, scene.rows[3], 'further', 'wall'), undefined);
});

test('the page has both ends of all scenes, a row a program and scene, and names what is missing', () => {
  const page = markdownOf(kReport);
  assert.match(page, /\| Gnomon, exact \| exact \| 1\.0 \| 1\.0 \| 1\.0 \| 1\.0 \| 1\.0 \|/);
  assert.match(page, /\| three\.js, CSM \| 4 cascades \| 15 to 30 \| 20 \| 10 to 20 \| 12 to 24 \| 10 \|/);
  assert.match(page, /\| F3D \| none \| 5\.0 \| 4\.0 \|  \|  \|  \|/);
  assert.match(page, /\| city \| three\.js, CSM \| 3000 \| 30 \| 20 \| 1800 \| 20 \| 10 \| 1200 \| 24 \| 10 \|/);
  assert.match(page, /\| truck \| F3D \| 500 \| 5\.0 \| 4\.0 \|  \|  \|  \|  \|  \|  \|/);
  assert.match(page, /Blender is not in the table: there is no `blender`\./);
});
