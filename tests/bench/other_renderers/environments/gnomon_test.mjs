import assert from 'node:assert/strict';
import fs from 'node:fs';
import os from 'node:os';
import path from 'node:path';
import test from 'node:test';
import { namedFiles, specOf } from './gnomon.mjs';
import { arrayBytes } from './npy.mjs';

const setup = {
  width: 8, height: 6, rotationDegrees: 60,
  camera: { eye: [0, 0, 5], target: [0, 0, 0], fovYDegrees: 30, near: 1, far: 9 },
};

test('a frame is lit by the environment alone, and stays linear', () => {
  const spec = specOf(setup, 'sky.hdr');
  assert.deepEqual([spec.lights, spec.ambient], [[], { intensity: 0 }]);
  assert.deepEqual(spec.environment, { file: 'sky.hdr', rotationDegrees: 60 });
  assert.deepEqual(spec.output, { format: 'npy', arrayColors: 'linear' });
});

test('each step is another frame, and less than a pixel away', () => {
  const [x] = specOf(setup, 'sky.hdr', 3).camera.eye;
  assert.ok(x > 0 && x < 1e-3);
});

test('a glTF names its buffers and pictures, but not those inside of it', () => {
  const file = path.join(fs.mkdtempSync(path.join(os.tmpdir(), 'named')), 'a.gltf');
  fs.writeFileSync(file, JSON.stringify({
    buffers: [{ uri: 'a.bin' }, { uri: 'data:application/octet-stream;base64,AA==' }],
    images: [{ uri: 'a%20b.png' }, { bufferView: 0 }],
  }));
  assert.deepEqual(namedFiles(file), ['a.bin', 'a%20b.png']);
  assert.deepEqual(namedFiles('a.glb'), []);
});

test('an array begins as NumPy has it, at a multiple of 64 bytes', () => {
  const floats = Buffer.from(new Float32Array([1, 2, 3, 4, 5, 6]).buffer);
  const bytes = arrayBytes(floats, [2, 1, 3]);
  const head = 10 + bytes.readUInt16LE(8);
  assert.equal(head % 64, 0);
  assert.equal(bytes.length, head + 24);
  assert.match(bytes.toString('latin1', 0, head), /^\x93NUMPY\x01\x00..\{.*'shape': \(2, 1, 3,\), \} *\n$/s);
});
