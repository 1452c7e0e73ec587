// Azimuth and elevation of the sun, from the effective light. Pure.

import { setPath } from './paths.mjs';

const kRadians = Math.PI / 180;
const kFirstSun = { azimuthDegrees: 135, elevationDegrees: 40 };
const tenth = (degrees) => Math.round(degrees * 10) / 10;

// The place in the sky that light travelling along `direction` comes from.
export function sunAgainst([x, y, z]) {
  const elevation = Math.asin(-y / (Math.hypot(x, y, z) || 1)) / kRadians;
  const azimuth = (Math.atan2(-x, z) / kRadians + 360) % 360;
  return { azimuthDegrees: tenth(azimuth) % 360, elevationDegrees: tenth(elevation) };
}

// The lights of a frame but for the sun of its environment, which is there without being asked for.
export const lightsOf = (report) => (report?.environment?.sun ? report.spec.lights.slice(0, -1) : report?.spec.lights);

const firstDirectional = (lights) => lights?.find(({ type }) => (type ?? 'directional') === 'directional');

// The sun of the sky, else that of the user's own light, else that of the last frame's first directional light, else a pleasant one.
export function sunInForce({ spec, report }) {
  const own = spec.environment?.sky?.sun ?? spec.lights?.[0]?.sun;
  const light = firstDirectional(report?.spec.lights);
  const shown = light?.sun ?? (light?.direction && sunAgainst(light.direction));
  return { ...kFirstSun, ...(own ?? shown) };
}

// A light of the user's own with its sun there; at first it has the color and strength of the one that it replaces.
export function lightsWithSun(state, sun) {
  const [own, ...others] = state.spec.lights ?? [];
  const kept = ['color', 'temperatureKelvin', 'intensity', 'angularDiameterDegrees', 'cullingMask'];
  const base = own ?? pick(firstDirectional(state.report?.spec.lights) ?? {}, kept);
  return [{ type: 'directional', ...base, sun: { ...sunInForce(state), ...sun } }, ...others];
}

// The spec with its sun there: that of the sky, or else a light.
export function withSun(state, sun) {
  const { spec } = state;
  return spec.environment?.sky ? setPath(spec, 'environment.sky.sun', { ...sunInForce(state), ...sun }) : { ...spec, lights: lightsWithSun(state, sun) };
}

const pick = (object, keys) => Object.fromEntries(keys.filter((key) => key in object).map((key) => [key, object[key]]));
