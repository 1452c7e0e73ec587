// The page's geometry: the orbit, the sky dome, the sun that a light stands for.

import assert from 'node:assert/strict';
import test from 'node:test';

import { lightsWithSun, sunAgainst, sunInForce } from '../../../clients/web/light_math.mjs';
import { basis, fitOrbit, kWholeScene, orbitFromView, orbitInForce, panned, turned, zoomed } from '../../../clients/web/orbit_math.mjs';
import { fromDome, toDome } from '../../../clients/web/sky_dome.mjs';

const kRadians = Math.PI / 180;
const dot = (a, b) => a.reduce((sum, part, i) => sum + part * b[i], 0);
const near = (a, b) => assert.ok(Math.abs(a - b) < 1e-6, `${a} is not ${b}`);

// The house's convention: azimuth clockwise from north (-Z), elevation from the horizon.
function skyDirection(azimuthDegrees, elevationDegrees) {
  const [a, e] = [azimuthDegrees * kRadians, elevationDegrees * kRadians];
  return [Math.sin(a) * Math.cos(e), Math.sin(e), -Math.cos(a) * Math.cos(e)];
}

const kPlaces = [0, 45, 90, 135, 200, 300].flatMap((azimuth) => [-60, 0, 20, 80].map((elevation) => [azimuth, elevation]));

test('the picture’s right and up stand on the line of sight', () => {
  for (const [azimuthDegrees, elevationDegrees] of kPlaces) {
    const { right, up } = basis({ azimuthDegrees, elevationDegrees });
    const toEye = skyDirection(azimuthDegrees, elevationDegrees);
    near(dot(right, up), 0);
    near(dot(right, toEye), 0);
    near(dot(up, toEye), 0);
    near(dot(right, right), 1);
    near(dot(up, up), 1);
    assert.ok(up[1] > 0);
  }
  near(basis({ azimuthDegrees: 180, elevationDegrees: 0 }).right[0], 1); // from the south, east is on the right
});

test('an eye and a target are the orbit that has them', () => {
  for (const [azimuthDegrees, elevationDegrees] of kPlaces) {
    const direction = skyDirection(azimuthDegrees, elevationDegrees);
    const centre = [1, 2, 3];
    const eye = centre.map((at, i) => at + direction[i] * 7);
    const target = eye.map((at, i) => at - direction[i]); // a glTF camera: one metre ahead
    const orbit = orbitFromView({ eye, target }, [1, 100], centre);
    near(orbit.distance, 7);
    near(Math.cos((orbit.azimuthDegrees - azimuthDegrees) * kRadians), 1);
    near(orbit.elevationDegrees, elevationDegrees);
    orbit.target.forEach((at, i) => near(at, centre[i]));
  }
});

test('a scene behind the eye is no place to turn about', () => {
  const orbit = orbitFromView({ eye: [0, 0, 0], target: [0, 0, -1] }, [1, 100], [0, 0, 50]);
  near(orbit.distance, 10);
  near(orbit.target[2], -10);
});

test('turning wraps around and stops short of the zenith', () => {
  const orbit = { target: [0, 0, 0], azimuthDegrees: 350, elevationDegrees: 80, distance: 1 };
  assert.equal(turned(orbit, 20, 0).azimuthDegrees, 10);
  assert.equal(turned(orbit, -360, 0).azimuthDegrees, 350);
  assert.ok(turned(orbit, 0, 50).elevationDegrees < 90);
  assert.equal(zoomed(orbit, 0.5).distance, 0.5);
});

test('panning right by the height of the picture moves by what it shows', () => {
  const orbit = { target: [0, 0, 0], azimuthDegrees: 180, elevationDegrees: 0, distance: 10 };
  const moved = panned(orbit, 1, 0, 90);
  near(moved.target[0], -20); // tan 45° · 10 m · 2, and the picture follows the hand
  near(panned(orbit, 0, 1, 90).target[1], 20);
});

test('an orbit that leaves its place to the server is that of the picture of it', () => {
  const camera = { orbit: kWholeScene };
  const report = { spec: { camera: { eye: [0, 0, 10], target: [0, 0, 0] } }, depthRange: [8, 12] };
  const summary = { boundsMin: [-1, -1, -1], boundsMax: [1, 1, 1] };
  assert.equal(orbitInForce({ spec: { camera }, report, summary, cameraShown: { node: 'node:1' } }), null);
  const orbit = orbitInForce({ spec: { camera }, report, summary, cameraShown: camera });
  near(orbit.distance, 10);
  near(orbit.azimuthDegrees, 180);
});

test('the whole box is in view', () => {
  for (const aspect of [0.5, 1, 1.7]) {
    const { distance, target } = fitOrbit([-1, 0, -1], [1, 2, 1], aspect);
    assert.deepEqual(target, [0, 1, 0]);
    assert.ok(distance > (Math.sqrt(3) / Math.sin(22.5 * kRadians)) * 0.999);
  }
  assert.ok(fitOrbit([0, 0, 0], [0, 0, 0]).distance > 0);
});

test('the dome is turned back', () => {
  for (const [azimuth, elevation] of kPlaces) {
    if (elevation < 0) continue;
    const place = fromDome(...toDome(azimuth, elevation));
    near(place.azimuthDegrees, azimuth);
    near(place.elevationDegrees, elevation);
  }
  const [x, y] = toDome(90, 0);
  near(x, 100); // east is on the right
  near(y, 0);
  assert.equal(fromDome(500, 0).elevationDegrees, 0); // beyond the rim is the horizon
});

test('a light that comes from a place in the sky is the sun there', () => {
  for (const [azimuth, elevation] of kPlaces) {
    const sun = sunAgainst(skyDirection(azimuth, elevation).map((part) => -part * 3));
    near(sun.azimuthDegrees, azimuth);
    near(sun.elevationDegrees, elevation);
  }
});

test('the first touch of the sun keeps the light that it replaces', () => {
  const report = { spec: { lights: [{ type: 'point' }, { type: 'directional', direction: [0, -1, 0], color: [1, 0.5, 0], intensity: 9 }] } };
  near(sunInForce({ spec: {}, report }).elevationDegrees, 90);
  assert.deepEqual(lightsWithSun({ spec: {}, report }, { azimuthDegrees: 10, elevationDegrees: 20 }), [
    { type: 'directional', color: [1, 0.5, 0], intensity: 9, sun: { azimuthDegrees: 10, elevationDegrees: 20 } },
  ]);
});
