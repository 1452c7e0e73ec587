// Volumes and bakes on the page: what it makes of a file, of colors, and of events.

import assert from 'node:assert/strict';
import test from 'node:test';

import { hexOf, linearOf } from '../../../clients/web/color_math.mjs';
import { fromHash, toHash } from '../../../clients/web/deep_link.mjs';
import { createEventReader } from '../../../clients/web/event_reader.mjs';
import { kSections } from '../../../clients/web/fields.mjs';
import { createStore } from '../../../clients/web/store.mjs';
import { isGrid, newVolume, scaledTo, withFile } from '../../../clients/web/volume_math.mjs';

const kSummary = { boundsMin: [-50, 0, -50], boundsMax: [50, 10, 50], volumeFiles: ['cloud.npy', 'smoke.vdb'] };
const fieldOf = (path) => kSections.flatMap(({ fields }) => fields).find((field) => field.path === path);

const stateOf = (spec, summary = kSummary) => ({ spec, summary, report: null });

test('a new volume is a cloud above what the camera turns about', () => {
  const orbit = { target: [10, 2, 0], azimuthDegrees: 0, elevationDegrees: 20, distance: 100 };
  const { file, box, transferFunction } = newVolume(stateOf({ camera: { orbit } }), 'cloud.npy');
  assert.equal(file, 'cloud.npy');
  assert.deepEqual(box, { min: [-8, 14, -18], max: [28, 28, 18] });
  assert.deepEqual(transferFunction.map(({ value, extinction }) => [value, extinction]), [[0, 0], [1, 0.286]]);
  const flat = newVolume(stateOf({}, { boundsMin: [0, 0, 0], boundsMax: [0, 0, 0] }), 'a.vdb').box;
  for (const axis of [0, 1, 2]) assert.ok(flat.min[axis] < flat.max[axis]);
  assert.deepEqual([{ name: 'a.NPY' }, { name: 'x/b.vdb' }, { name: 'c.npy.png' }].map(isGrid), [true, true, false]);
});

test('another file is shown where the first one was, and its values set the scale', () => {
  const first = withFile(stateOf({}), 'cloud.npy');
  const moved = [{ ...first[0], box: { min: [0, 0, 0], max: [1, 2, 3] } }];
  const second = withFile(stateOf({ volumes: moved }), 'smoke.vdb');
  assert.equal(second[0].file, 'smoke.vdb');
  assert.deepEqual(second[0].box, moved[0].box);
  assert.equal(scaledTo([-3, 255], second)[0].transferFunction[1].value, 255);
  assert.equal(scaledTo([-3, 0], second), second);
});

test('the panel offers the files of the upload, and takes the volume away again', () => {
  const store = createStore({ spec: {}, summary: kSummary, report: null });
  const field = fieldOf('volumes.0.file');
  assert.deepEqual(field.options(store).map(([value]) => value), ['', 'cloud.npy', 'smoke.vdb']);
  field.choose('cloud.npy', store);
  assert.ok(store.state.freshVolume);
  fieldOf('volumes.0.transferFunction.1.color').choose([1, 0.5, 0], store);
  assert.deepEqual(store.state.spec.volumes[0].transferFunction.map(({ color }) => color), [[1, 0.5, 0], [1, 0.5, 0]]);
  const { spec } = store.state;
  assert.deepEqual(fromHash(toHash({ sceneId: 'ab', view: 'color', spec })).spec, spec);
  field.choose('', store);
  assert.deepEqual(store.state.spec, {});
});

test('colors are shown as screens have them, and sent as light adds up', () => {
  assert.deepEqual(linearOf('#ffffff'), [1, 1, 1]);
  assert.equal(linearOf('#808080')[0], 0.2159);
  for (const hex of ['#000000', '#0a0b0c', '#7f3fd2', '#ffffff']) assert.equal(hexOf(linearOf(hex)), hex);
  assert.equal(hexOf([2, -1, 0]), '#ff0000');
});

test('events are read out of any pieces', () => {
  const text = 'event: progress\ndata: {"share": 0.5}\n\n: still here\n\nevent: result\ndata: {}\n\nevent: cut';
  for (const length of [1, 7, text.length]) {
    const events = [];
    const read = createEventReader((name, data) => events.push([name, data]));
    for (let at = 0; at < text.length; at += length) read(text.slice(at, at + length));
    assert.deepEqual(events, [['progress', '{"share": 0.5}'], ['result', '{}']]);
  }
});
