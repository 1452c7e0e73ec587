import assert from 'node:assert/strict';
import test from 'node:test';
import { boundsOf, cameraAround } from './camera.mjs';

const near = (a, b) => a.forEach((value, i) => assert.ok(Math.abs(value - b[i]) < 1e-9, `${a} is not ${b}`));

test('bounds follow the nodes', () => {
  const { min, max } = boundsOf({
    scenes: [{ nodes: [0] }],
    nodes: [
      { translation: [10, 0, 0], scale: [2, 2, 2], children: [1] },
      { mesh: 0, rotation: [0, Math.SQRT1_2, 0, Math.SQRT1_2] },
    ],
    meshes: [{ primitives: [{ attributes: { POSITION: 0 } }] }],
    accessors: [{ min: [0, 0, 0], max: [1, 2, 3] }],
  });
  near(min, [10, 0, -2]); // a quarter turn about Y takes Z to X and X to -Z
  near(max, [16, 4, 0]);
});

test('the ball around the box touches the edge of the picture', () => {
  const { eye, target, fovYDegrees, near: close, far } = cameraAround(
    { min: [-1, -1, -1], max: [1, 1, 1] }, { azimuthDegrees: 0, elevationDegrees: 0 });
  near(target, [0, 0, 0]);
  near(eye, [0, 0, Math.sqrt(3) / Math.sin(fovYDegrees * Math.PI / 360)]);
  assert.ok(close < eye[2] - Math.sqrt(3) && far > eye[2] + Math.sqrt(3));
});

test('a camera at 90 degrees stands on +X', () => {
  const { eye } = cameraAround({ min: [-1, -1, -1], max: [1, 1, 1] }, { azimuthDegrees: 90, elevationDegrees: 0 });
  assert.ok(eye[0] > 1);
  near(eye.slice(1), [0, 0]);
});
