// What stands behind the panels: lights, nodes, charts, plans, snippets, patches.

import assert from 'node:assert/strict';
import test from 'node:test';

import { decades, placeOf, pointsOf } from '../../../clients/web/chart_math.mjs';
import { differenceOf } from '../../../clients/web/difference.mjs';
import { measuredNumbers, percent, predictedNumbers } from '../../../clients/web/error_numbers.mjs';
import { kSections } from '../../../clients/web/fields.mjs';
import { steered } from '../../../clients/web/frame_loop.mjs';
import { lightsInForce, newLight, retyped, withShadow } from '../../../clients/web/light_list.mjs';
import { merged } from '../../../clients/web/merge_patch.mjs';
import { wrappedTime } from '../../../clients/web/motion_panel.mjs';
import { found, ownSwitch, switchInForce, treeOf, withSwitch } from '../../../clients/web/node_tree.mjs';
import { boxOfTile, containedRect, hull, inverse, seenSegment, sliceOfView, transformed, viewOf } from '../../../clients/web/plan_math.mjs';
import { cliCommand, frameAddress, imageTag, pythonCode } from '../../../clients/web/snippets.mjs';
import { draftSpec, kDraftScales } from '../../../clients/web/spec.mjs';
import { createStore } from '../../../clients/web/store.mjs';

const state = { spec: {}, report: null, summary: { boundsMin: [-1, 0, -1], boundsMax: [1, 2, 1] } };
const near = (a, b, by = 1e-6) => a.forEach((x, i) => assert.ok(Math.abs(x - b[i]) < by, `${a} is not ${b}`));

test('lights in force are the own ones, else those of the frame without their resolved shadow', () => {
  const report = { spec: { lights: [{ type: 'directional', direction: [0, -1, 0], innerConeDegrees: 0, outerConeDegrees: 45, shadow: { enabled: true } }] } };
  assert.deepEqual(lightsInForce({ spec: {}, report }), [{ type: 'directional', direction: [0, -1, 0] }]);
  assert.deepEqual(lightsInForce({ spec: { lights: [] }, report }), []);
});

test('a new lamp stands above what the camera turns about; another type keeps its place', () => {
  const spot = newLight('spot', state);
  assert.ok(spot.position[1] > 1);
  assert.deepEqual(spot.direction, [0, -1, 0]);
  const point = retyped({ ...spot, color: [1, 0, 0], intensity: 7 }, 'point', state);
  assert.deepEqual([point.type, point.position, point.color, point.intensity, point.direction], ['point', spot.position, [1, 0, 0], 7, undefined]);
  assert.equal(retyped(point, 'directional', state).position, undefined);
  assert.deepEqual(withShadow({ type: 'point', shadow: { size: 'Small' } }, true), { type: 'point' });
  assert.deepEqual(withShadow({ type: 'point' }, false).shadow, { enabled: false });
});

test('nodes become a tree with the triangles of all below', () => {
  const nodes = [{ node: 0, name: 'House', triangles: 2 }, { node: 1, name: 'roof', parent: 0, triangles: 5 }, { node: 2, name: 'tile', parent: 1, triangles: 7 }];
  const [root] = treeOf(nodes);
  assert.equal(root.total, 14);
  assert.equal(root.children[0].children[0].name, 'tile');
  assert.deepEqual(found(nodes, 'OO').map(({ node }) => node), [1]);
  assert.deepEqual(found(nodes, '2').map(({ node }) => node), [2]);
});

test('the nearest setting up the tree is in force, and casting follows being seen', () => {
  const entries = [{ node: 0, visible: false }, { node: 1, castShadow: true }];
  assert.equal(switchInForce(entries, [0, 1], 'visible'), false);
  assert.equal(switchInForce(entries, [0], 'castShadow'), false);
  assert.equal(switchInForce(entries, [0, 1], 'castShadow'), true);
  assert.equal(switchInForce(entries, [0, 1], 'receiveShadow'), true);
  assert.equal(ownSwitch(entries, 1, 'visible'), undefined);
  assert.deepEqual(withSwitch(entries, 1, 'castShadow', undefined), [{ node: 0, visible: false }]);
  assert.deepEqual(withSwitch(undefined, 4, 'visible', false), [{ node: 4, visible: false }]);
});

test('a patch merges as RFC 7396 says', () => {
  assert.deepEqual(merged({ a: { b: 1, c: 2 }, d: [1] }, { a: { b: null, e: { f: null, g: 1 } }, d: [2] }), { a: { c: 2, e: { g: 1 } }, d: [2] });
  assert.deepEqual(merged([1], { a: 1 }), { a: 1 });
});

test('a chart has equal ratios, and rows that are not timed have no time', () => {
  assert.deepEqual(decades([3, 40, 0], [0, 1]), [0, 2]);
  assert.deepEqual(decades([], [0, 1]), [0, 1]);
  assert.equal(placeOf(10, [0, 2]), 0.5);
  assert.equal(placeOf(0, [0, 2]), 0);
  const { points } = pointsOf([{ milliseconds: 10, metrics: { misclassified: 0.01 } }, { metrics: { misclassified: 0 } }, { problems: [] }]);
  assert.deepEqual(points.map(({ x }) => x === null), [false, true]);
});

test('a matrix and its inverse cancel; a singular one has none', () => {
  const matrix = [2, 0, 0, 0, 0, 0, 4, 0, 0, -1, 0, 0, 3, 5, 7, 1];
  near(transformed(inverse(matrix), transformed(matrix, [1, -2, 3])), [1, -2, 3]);
  assert.equal(inverse(new Array(16).fill(0)), null);
  assert.equal(boxOfTile({}), null);
  near(boxOfTile({ matrix: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1] })[7], [1, 1, 1]);
});

test('a camera sees what is ahead in the middle, and cuts what reaches behind it', () => {
  const view = viewOf({ eye: [0, 0, 5], target: [0, 0, 0], up: [0, 1, 0], perspective: { fovYDegrees: 90 } }, 2);
  const [middle, right] = seenSegment(view, [0, 0, 0], [10, 5, 0]);
  near(middle, [0.5, 0.5]);
  near(right, [1, 0]);
  assert.equal(seenSegment(view, [0, 0, 6], [1, 0, 7]), null);
  assert.ok(seenSegment(view, [0, 0, 0], [0, 0, 9]).flat().every(Number.isFinite));
  near(sliceOfView(view, 1, 2)[7], [4, 2, 3]);
});

test('a hull leaves out what lies within, and a picture is shown whole', () => {
  assert.equal(hull([[0, 0], [2, 0], [2, 2], [0, 2], [1, 1]]).length, 4);
  near(containedRect(2, 1), [0, 0.25, 1, 0.5]);
  near(containedRect(1, 2), [0.25, 0, 0.5, 1]);
});

test('pictures that are equal do not differ', () => {
  const a = new Uint8ClampedArray([10, 20, 30, 255, 0, 0, 0, 255]);
  assert.deepEqual([differenceOf(a, a).visible, differenceOf(a, a).mean], [0, 0]);
  const b = new Uint8ClampedArray([10, 20, 30, 255, 90, 0, 0, 255]);
  const { map, visible, mean } = differenceOf(a, b);
  assert.deepEqual([visible, mean, [...map.slice(0, 4)], [...map.slice(4)]], [0.5, 45, [0, 0, 0, 255], [255, 255, 30, 255]]);
});

test('errors are told in words that fit beside a picture', () => {
  assert.equal(percent(0), '0 %');
  assert.equal(percent(0.00001), '< 0.01 %');
  assert.equal(percent(0.0123), '1.23 %');
  assert.deepEqual(predictedNumbers(undefined), []);
  assert.deepEqual(measuredNumbers({ misclassified: 0, acne: 0, leak: 0 }).map(([name]) => name), ['Wrong']);
  assert.deepEqual(measuredNumbers({ misclassified: 0.1, acne: 0, leak: 0, edgeDisplacement: { mean: 1, max: 2 } }).length, 4);
});

test('a clip goes round', () => {
  assert.equal(wrappedTime(1.5, 1000, 2), 0.5);
  assert.equal(wrappedTime(1, 500, 0), 0);
});

test('drafts get smaller at once where they are far too slow', () => {
  assert.equal(steered(0.5, 1000), 0.33);
  assert.equal(steered(0.5, 100), 0.4);
  assert.equal(steered(0.5, 10), 0.67);
  assert.equal(steered(0.5, 60), 0.5);
  assert.equal(steered(kDraftScales[0], 1000), kDraftScales[0]);
});

test('a draft searches for no target, and its maps get coarser only where it is small', () => {
  const spec = { quality: { maxError: 0.01 }, shadow: { technique: 'rayTraced', raySamples: 64 } };
  const draft = draftSpec({ view: 'color', spec }, { width: 800, height: 600 }, 0.5);
  assert.deepEqual([draft.quality, draft.shadow, draft.atlas], [undefined, { technique: 'rayTraced', raySamples: 4 }, undefined]);
  assert.equal(draftSpec({ view: 'color', spec: {} }, { width: 800, height: 600 }, 0.2).shadow.cascadeCount, 2);
  const manual = { partition: { mode: 'manual', splits: [0.2, 0.5, 1] }, cascadeCount: 3 };
  assert.deepEqual(draftSpec({ view: 'color', spec: { shadow: manual } }, { width: 800, height: 600 }, 0.12).shadow, manual);
  assert.deepEqual(draftSpec({ view: 'color', spec: { atlas: { baseSize: 2048 } } }, { width: 800, height: 600 }, 0.25).atlas, { baseSize: 512 });
});

test('snippets survive where they go', () => {
  const spec = { width: 8, height: 4, camera: { node: "it's" }, lights: [{ type: 'point' }], views: ['color'] };
  assert.match(cliCommand('http://h', 'ab', spec), /it'\\''s/);
  assert.match(pythonCode('http://h', 'ab', { name: "'''" }), /\\u0027\\u0027\\u0027/);
  const query = new URL(frameAddress('http://h', 'ab', spec)).searchParams;
  assert.deepEqual([query.get('camera.node'), query.get('lights'), query.get('views')], ["it's", '[{"type":"point"}]', '["color"]']);
  assert.match(imageTag('http://h', 'ab', spec), /^<img src="[^"]*&amp;[^"]*" width="8" height="4" alt="">$/);
});

const fieldOf = (path) => kSections.flatMap(({ fields }) => fields).find((field) => field.path === path);

test('a target is one of two, or none', () => {
  const store = createStore({ spec: {}, report: null });
  const field = fieldOf('quality');
  field.choose('maxError', store);
  assert.equal(field.value(store), 'maxError');
  field.choose('maxMilliseconds', store);
  assert.deepEqual(Object.keys(store.state.spec.quality), ['maxMilliseconds']);
  field.choose('none', store);
  assert.deepEqual(store.state.spec, {});
});

test('manual splits are as many as there are cascades', () => {
  const store = createStore({ spec: { shadow: { cascadeCount: 2 } }, report: null });
  fieldOf('shadow.partition.mode').choose('manual', store);
  assert.deepEqual(store.state.spec.shadow.partition, { mode: 'manual', splits: [0.5, 1] });
  fieldOf('shadow.cascadeCount').choose(4, store);
  assert.equal(store.state.spec.shadow.partition.splits.length, 4);
});
