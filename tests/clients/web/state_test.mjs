// The page's pure modules: paths, links, specs.

import assert from 'node:assert/strict';
import test from 'node:test';

import { fromHash, toHash } from '../../../clients/web/deep_link.mjs';
import { kSections } from '../../../clients/web/fields.mjs';
import { flatten, getPath, pointerOf, removePath, setPath } from '../../../clients/web/paths.mjs';
import { curlCommand } from '../../../clients/web/snippets.mjs';
import { withoutScene } from '../../../clients/web/scene_spec.mjs';
import { draftSpec, fullSpec, pictureSize } from '../../../clients/web/spec.mjs';
import { createStore } from '../../../clients/web/store.mjs';

test('a path is set without touching what it is set in', () => {
  const before = { shadow: { size: 'Large', filter: { type: 'pcf' } } };
  const after = setPath(before, 'shadow.filter.size', 7);
  assert.deepEqual(after, { shadow: { size: 'Large', filter: { type: 'pcf', size: 7 } } });
  assert.deepEqual(before, { shadow: { size: 'Large', filter: { type: 'pcf' } } });
  assert.deepEqual(setPath({}, 'lights.0.sun.azimuthDegrees', 9), { lights: [{ sun: { azimuthDegrees: 9 } }] });
  assert.equal(getPath(after, 'shadow.filter.size'), 7);
  assert.equal(getPath(after, 'atlas.size'), undefined);
  assert.equal(pointerOf('shadow.filter.size'), '/shadow/filter/size');
});

test('a leaf takes its empty objects with it', () => {
  assert.deepEqual(removePath({ a: { b: { c: 1 } }, d: 2 }, 'a.b.c'), { d: 2 });
  assert.deepEqual(removePath({ a: { b: 1, c: 2 } }, 'a.b'), { a: { c: 2 } });
  assert.deepEqual(removePath({ a: 1 }, 'x.y'), { a: 1 });
});

test('a list of numbers is a leaf, a list of objects is not', () => {
  assert.deepEqual(flatten({ eye: [1, 2], lights: [{ type: 'point' }] }), [['eye', [1, 2]], ['lights.0.type', 'point']]);
});

test('a link brings the state back', () => {
  const state = {
    sceneId: 'ab12',
    view: 'shadow',
    spec: {
      camera: { orbit: { target: [1, -2.5, 3], azimuthDegrees: 30.25 } },
      lights: [{ type: 'directional', sun: { azimuthDegrees: 135, elevationDegrees: 40 } }],
      shadow: { enabled: false, size: 'XLarge' },
    },
  };
  assert.deepEqual(fromHash(toHash(state)), state);
  assert.equal(toHash(fromHash(toHash(state))), toHash(state));
  assert.deepEqual(fromHash(''), { sceneId: null, view: 'color', spec: {} });
});

test('a link spells lists as fields do', () => {
  const state = { sceneId: 'ab12', view: 'color', spec: { lights: [{ intensity: 2 }], volumes: [{ transferFunction: [{ value: 1 }] }] } };
  assert.equal(toHash(state), '#scene=ab12&lights[0].intensity=2&volumes[0].transferFunction[0].value=1');
  assert.deepEqual(fromHash(toHash(state)), state);
  assert.deepEqual(fromHash('#scene=ab12&lights.0.intensity=2').spec, { lights: [{ intensity: 2 }] });
});

test('what belongs to a scene goes with it', () => {
  const stays = { exposure: 1, width: 640, height: 360, shadow: { size: 'Large', filter: { type: 'pcf', size: 7 } }, toneMapping: 'none' };
  const goes = {
    camera: { node: 'node:3' }, lights: [{ type: 'point' }], nodes: [{ node: 4, visible: false }], animation: { index: 2, timeSeconds: 1 },
    scene: 1, materialVariant: 'red', volumes: [{ file: 'a.npy' }], debug: { light: 3 }, motionFrom: { animation: { index: 1 } },
  };
  const lengths = { filter: { ...stays.shadow.filter, radius: 0.2 }, depthRange: { mode: 'manual', min: 0, max: 9 }, bias: { mode: 'manual', depth: 0.1 } };
  assert.deepEqual(withoutScene({ ...stays, ...goes, shadow: { ...stays.shadow, ...lengths } }), stays);
  assert.deepEqual(withoutScene({}), {});
});

test('a picture has a pixel for each of the screen', () => {
  assert.deepEqual(pictureSize(390, 470, 2), { width: 780, height: 940 });
  assert.deepEqual(pictureSize(900, 620, 1), { width: 900, height: 620 });
  const { width, height } = pictureSize(1500, 2000, 3);
  assert.ok(width * height < 1920 * 1080 * 1.01 && Math.abs(width / height - 0.75) < 0.01);
});

test('a link can not reach beyond the spec', () => {
  const { spec } = fromHash('#__proto__.polluted=1&constructor.prototype.polluted=1&a.__proto__.polluted=1&1x=2');
  assert.equal({}.polluted, undefined);
  assert.equal(Object.getPrototypeOf(spec), Object.prototype);
});

test('the window gives the size unless one is chosen', () => {
  const state = { view: 'depth', spec: { exposure: 1 } };
  assert.deepEqual(fullSpec(state, { width: 800, height: 600 }), { width: 800, height: 600, exposure: 1, views: ['depth'] });
  state.spec = { width: 640, height: 360 };
  assert.deepEqual(fullSpec(state, { width: 800, height: 600 }), { width: 640, height: 360, views: ['depth'] });
});

test('a draft is smaller, even and never nothing', () => {
  const draft = draftSpec({ view: 'color', spec: { antialiasing: 'msaa4x' } }, { width: 802, height: 20 }, 0.5);
  assert.deepEqual([draft.width, draft.height, draft.antialiasing], [402, 16, 'none']);
});

test('a draft is a light file, and the sharp picture the one that was asked for', () => {
  const state = { view: 'color', spec: { output: { format: 'exr', exrPixelType: 'float' } } };
  assert.deepEqual(draftSpec(state, { width: 80, height: 40 }, 0.5).output, { format: 'webp', webpQuality: 80, exrPixelType: 'float' });
  assert.deepEqual(fullSpec(state, { width: 80, height: 40 }).output, state.spec.output);
});

test('the curl command survives a shell', () => {
  const command = curlCommand('http://host', 'ab', { camera: { node: "it's" } }, 'exr');
  assert.match(command, /'\{"camera":\{"node":"it'\\''s"\},"output":\{"format":"exr"\}\}'/);
  assert.match(command, /Accept: image\/x-exr/);
});

test('what is in force is the choice, else what the server resolved', () => {
  const store = createStore({ spec: {}, report: { spec: { exposure: 0.5 } } });
  assert.equal(store.effective('exposure'), 0.5);
  store.setSpec('exposure', 0);
  assert.equal(store.effective('exposure'), 0);
  store.clearSpec('exposure');
  assert.equal(store.effective('exposure'), 0.5);
});

test('each technique shows the controls that it uses', () => {
  const shadows = kSections.find(({ title }) => title === 'Shadows').fields;
  const shownFor = (shadow, light) => {
    const store = createStore({ spec: { lights: [{ type: 'directional', ...light }], shadow } });
    return shadows.filter(({ needs }) => !needs || needs(store)).map(({ path }) => path);
  };
  const always = ['shadow.enabled', 'shadow.technique', 'shadow.strength'];
  const tiles = ['shadow.cascadeCount', 'shadow.size', 'shadow.importance'];
  const [on, technique, strength] = always;
  const filters = ['shadow.filter.type', 'shadow.filter.size', 'shadow.filter.radius'];
  assert.deepEqual(shownFor({ technique: 'auto' }), [on, technique, ...tiles, ...filters, strength]);
  assert.deepEqual(shownFor({ technique: 'rayTraced' }), always);
  assert.deepEqual(shownFor({ technique: 'rayTraced' }, { angularDiameterDegrees: 1 }), [on, technique, 'shadow.raySamples', strength]);
  assert.deepEqual(shownFor({ technique: 'lightMap' }), always);
  assert.deepEqual(shownFor({ technique: 'shadowMap', filter: { type: 'pcss' } }), [on, technique, ...tiles, 'shadow.filter.type', strength]);
  assert.deepEqual(shownFor({ enabled: false, technique: 'lightMap' }), [on]);
});

test('a finer light map takes the place of texels a metre', () => {
  const store = createStore({ spec: { shadow: { lightMap: { texelsPerMetre: 9 } } } });
  const field = kSections.flatMap(({ fields }) => fields).find(({ path }) => path === 'shadow.lightMap.size');
  field.choose(2048, store);
  assert.deepEqual(store.state.spec, { shadow: { lightMap: { size: 2048 } } });
});
