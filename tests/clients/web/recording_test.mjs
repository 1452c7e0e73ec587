// What a recording shows.

import assert from 'node:assert/strict';
import test from 'node:test';

import { recordedSequence } from '../../../clients/web/recording.mjs';

const orbit = { target: [0, 1, 0], azimuthDegrees: 350, elevationDegrees: 20, distance: 9 };
const clips = { animations: [{ name: 'still', durationSeconds: 0 }, { name: 'walk', durationSeconds: 0.5 }] };

test('without an animation the camera turns once around, and ends a step before it began', () => {
  const { spec, frames, framesPerSecond } = recordedSequence({ spec: { width: 64, camera: { node: 3 } }, summary: clips, orbit, lens: { perspective: { fovYDegrees: 30 } } });
  assert.deepEqual(spec, { width: 64, camera: { perspective: { fovYDegrees: 30 }, orbit } });
  const azimuths = frames.map(({ camera }) => camera.orbit.azimuthDegrees);
  assert.equal(azimuths.length, 6 * framesPerSecond);
  assert.equal(azimuths[0], 350);
  azimuths.forEach((azimuth, i) => assert.ok(Math.abs(((azimuths[0] + (360 * i) / azimuths.length) % 360) - azimuth) < 1e-9));
});

test('an animation that is chosen plays once, before a camera that stands still', () => {
  const { spec, frames, framesPerSecond } = recordedSequence({ spec: { camera: { node: 3 }, animation: { index: 1, timeSeconds: 0.3 } }, summary: clips, orbit, lens: {} });
  assert.deepEqual(spec.camera, { node: 3 });
  assert.equal(framesPerSecond, 30);
  assert.deepEqual(frames.map(({ animation }) => Math.round(animation.timeSeconds * 30)), Array.from({ length: 15 }, (_, i) => i));
});

test('what stands still is turned, and nothing is recorded before the first frame', () => {
  assert.ok(recordedSequence({ spec: { animation: { index: 0 } }, summary: clips, orbit, lens: {} }).frames[1].camera);
  assert.equal(recordedSequence({ spec: {}, summary: clips, orbit: null, lens: {} }), null);
});
