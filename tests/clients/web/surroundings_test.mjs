// Light from all around and the ground on the page: what it makes of a choice, and what goes with it.

import assert from 'node:assert/strict';
import test from 'node:test';

import { fromHash, toHash } from '../../../clients/web/deep_link.mjs';
import { kSections } from '../../../clients/web/fields.mjs';
import { lightsInForce } from '../../../clients/web/light_list.mjs';
import { sunInForce, withSun } from '../../../clients/web/light_math.mjs';
import { withoutScene } from '../../../clients/web/scene_spec.mjs';
import { draftSpec } from '../../../clients/web/spec.mjs';
import { createStore } from '../../../clients/web/store.mjs';
import { isPanorama, litByFile, litByOwnLight, litBySky, litByStudio, sourceOf } from '../../../clients/web/surroundings_math.mjs';

const kSun = { azimuthDegrees: 200, elevationDegrees: 30 };
const kLamp = { type: 'point', position: [0, 2, 0] };
const kByHand = { lights: [{ type: 'directional', intensity: 2, sun: kSun }, kLamp] };
const stateOf = (spec, summary = { environmentFiles: ['a.hdr', 'b.exr'] }) => ({ spec, summary, report: null });
const fieldOf = (path) => kSections.flatMap(({ fields }) => fields).find((field) => field.path === path);

test('pictures of all directions are known by their names', () => {
  assert.deepEqual([{ name: 'a.HDR' }, { name: 'x/b.exr' }, { name: 'c.hdr.png' }].map(isPanorama), [true, true, false]);
});

test('a sky takes over the sun that was set by hand, and the dome turns it', () => {
  const spec = litBySky(stateOf(kByHand));
  assert.deepEqual(spec.environment, { background: 'environment', sky: { sun: kSun } });
  assert.deepEqual(spec.lights, [kLamp]);
  assert.deepEqual(sunInForce(stateOf(spec)), kSun);
  const turned = withSun(stateOf(spec), { elevationDegrees: 5 });
  assert.deepEqual(turned.environment.sky.sun, { ...kSun, elevationDegrees: 5 });
  assert.deepEqual(turned.lights, [kLamp]);
  const back = litByStudio(stateOf(turned));
  assert.deepEqual(back.lights, [{ type: 'directional', sun: { ...kSun, elevationDegrees: 5 } }, kLamp]);
  assert.equal(back.environment, undefined);
});

test('a picture has its own sun and is seen; the lights of the scene stay', () => {
  const spec = litByFile(stateOf({ ...kByHand, environment: { sky: {}, intensity: 3e-5, rotationDegrees: 20 } }), 'a.hdr');
  assert.deepEqual(spec, { lights: [kLamp], environment: { background: 'environment', rotationDegrees: 20, file: 'a.hdr' } });
  assert.equal(litByFile(stateOf({}), 'a.hdr').lights, undefined);
  assert.equal(litByFile(stateOf({ environment: { background: 'blurred' } }), 'a.hdr').environment.background, 'blurred');
  assert.deepEqual(litByStudio(stateOf(spec)).environment, { rotationDegrees: 20 });
  assert.deepEqual([spec, litBySky(stateOf({})), {}].map((each) => sourceOf({ spec: each })), ['file', 'sky', 'studio']);
});

test('a glTF’s own light is the source unless another is named', () => {
  const own = (spec) => stateOf(spec, { environmentLight: 0 });
  assert.deepEqual([{}, { environment: { studio: 'even' } }, { environment: { sky: {} } }].map((spec) => sourceOf(own(spec))), ['light', 'studio', 'sky']);
  assert.equal(sourceOf(stateOf({ environment: { light: 1 } })), 'light');
  const studio = litByStudio(own({ environment: { background: 'environment' } }));
  assert.deepEqual(studio.environment, { studio: 'lamps' });
  assert.deepEqual(litByStudio(own({ environment: { studio: 'even', file: 'a.hdr' } })).environment, { studio: 'even' });
  const back = litByOwnLight(own({ ...kByHand, environment: { studio: 'even', intensity: 2 } }));
  assert.deepEqual(back, { lights: [kLamp], environment: { background: 'environment' } });
  const without = createStore(stateOf({}));
  fieldOf('environment').choose('light', without);
  assert.deepEqual(without.state.spec, {});
});

test('the sun of a picture is no light of the user’s own', () => {
  const lights = [kLamp, { type: 'directional', direction: [0, -1, 0] }];
  const report = { spec: { lights, environment: { extractSun: 'removed' } }, environment: { sun: { lux: 3 } } };
  assert.deepEqual(lightsInForce({ spec: {}, report }), [kLamp]);
  assert.equal(lightsInForce({ spec: {}, report: { spec: { lights } } }).length, 2);
  assert.equal(fieldOf('environment.extractSun').value(createStore({ spec: {}, report })), 'auto');
});

test('the panel offers the pictures of the upload, and asks for one where there is none', () => {
  const store = createStore(stateOf({}));
  fieldOf('environment').choose('file', store);
  assert.equal(store.state.spec.environment.file, 'a.hdr');
  assert.deepEqual(fieldOf('environment.file').options(store).map(([value]) => value), ['a.hdr', 'b.exr']);
  assert.deepEqual(fromHash(toHash({ sceneId: 'ab', view: 'color', spec: store.state.spec })).spec, store.state.spec);
  const bare = createStore(stateOf({}, {}));
  fieldOf('environment').choose('file', bare);
  assert.deepEqual([bare.state.askPanorama, bare.state.spec], [true, {}]);
});

test('a ground and shadows of the surroundings are there or not', () => {
  const store = createStore(stateOf({}));
  fieldOf('ground').choose('surface', store);
  assert.deepEqual([store.state.spec.ground, fieldOf('ground').value(store)], [{ mode: 'surface' }, 'surface']);
  fieldOf('ground').choose('none', store);
  fieldOf('environment.shadows').choose(true, store);
  assert.deepEqual([store.state.spec, fieldOf('ground').value(store)], [{ environment: { shadows: 'rays' } }, 'none']);
  fieldOf('environment.shadows').choose(false, store);
  assert.deepEqual(store.state.spec, {});
});

test('a light map goes without a ground', () => {
  const store = createStore(stateOf({ ground: { mode: 'catcher' } }));
  fieldOf('shadow.technique').choose('rayTraced', store);
  assert.deepEqual(store.state.spec, { ground: { mode: 'catcher' }, shadow: { technique: 'rayTraced' } });
  fieldOf('shadow.technique').choose('lightMap', store);
  assert.deepEqual(store.state.spec, { shadow: { technique: 'lightMap' } });
});

test('another scene has not the picture of the one before, and no height of its ground', () => {
  const spec = { environment: { file: 'a.hdr', shadows: 'rays' }, ground: { mode: 'catcher', height: 3, size: 20 } };
  assert.deepEqual(withoutScene(spec), { environment: { shadows: 'rays' }, ground: { mode: 'catcher' } });
});

test('a draft sends one ray a pixel into the sky', () => {
  const draft = (environment) => draftSpec({ view: 'color', spec: { environment } }, { width: 800, height: 600 }, 0.5).environment;
  assert.deepEqual(draft({ shadows: 'rays', samples: 16 }), { shadows: 'rays', samples: 1 });
  assert.deepEqual(draft({ samples: 16 }), { samples: 16 });
});
