// Camera paths, specs and turns.

import assert from 'node:assert/strict';
import test from 'node:test';

import { eyesOf, median, setupOf, specOf, turned, turnsOf } from './scenes.mjs';

const kScene = {
  width: 1280, height: 720,
  camera: { eye: [5, 3, 1], target: [1, 2, 1], up: [0, 2, 0], fovy_deg: 45, near: 0.1, far: 100 },
  sun: { direction_to_light: [0.5, 0.8, -0.3] }, cascades: 4, map_size: 2048, shadow_distance: 40,
  background: [0, 0, 0], ambient: 0.35, orbit_frames: 4, orbit_step_deg: 90,
};

function near(points, expected) {
  points.forEach((point, i) => point.forEach((value, k) => assert.ok(Math.abs(value - expected[i][k]) < 1e-12)));
}

test('a point is turned counter-clockwise about an axis of any length', () => {
  near([turned([1, 0, 0], [0, 0, 5], 90), turned([1, 2, 3], [1, 2, 3], 77)], [[0, 1, 0], [1, 2, 3]]);
});

test('the camera goes round its target and keeps its height and its distance', () => {
  near(eyesOf(kScene), [[5, 3, 1], [1, 3, -3], [-3, 3, 1], [1, 3, 5]]);
});

test('Gnomon and the others get the same frame', () => {
  const setup = setupOf(kScene, { url: 'x.glb', antialias: false });
  const spec = specOf(kScene, 1, { antialiasing: 'none' });
  assert.deepEqual(spec.camera.eye, setup.eyes[1]);
  assert.deepEqual(spec.camera.perspective, { fovYDegrees: 45, near: 0.1, far: 100 });
  assert.deepEqual(spec.lights, [{ type: 'directional', direction: setup.towardsSun.map((value) => -value) }]);
  assert.equal(spec.antialiasing, 'none');
});

test('turns share no frame, and end with the orbit', () => {
  assert.deepEqual(turnsOf({ rounds: 3, counted: 3, frames: 14 }), [
    { first: 0, uncounted: 3, count: 6 }, { first: 6, uncounted: 1, count: 4 }, { first: 10, uncounted: 1, count: 4 }]);
  assert.throws(() => turnsOf({ rounds: 3, counted: 3, frames: 13 }), /13 frames/);
});

test('the median of an even number lies between the two in the middle', () => {
  assert.equal(median([3, 1, 2]), 2);
  assert.equal(median([9, 1, 2, 4]), 3);
});
