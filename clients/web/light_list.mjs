// Lights that are edited in place: new ones, other types, and which are in force. Pure.

import { lightsOf, lightsWithSun } from './light_math.mjs';
import { fitOrbit, orbitInForce } from './orbit_math.mjs';

const rounded = (value) => Number(value.toPrecision(4));

// The user's own lights, else those of the last frame as if the user had chosen them.
export function lightsInForce({ spec, report }) {
  if (spec.lights) return spec.lights;
  return (lightsOf(report) ?? []).map(({ shadow, ...light }) => withoutIdleCones(light));
}

// A new light of a type where it lights what the camera turns about, as strongly as a sun of 3 lux would.
export function newLight(type, state) {
  if (type === 'directional') return lightsWithSun({ spec: {}, report: null }, {})[0];
  const { target, distance } = orbitInForce(state) ?? fitOrbit(state.summary.boundsMin, state.summary.boundsMax);
  const height = 0.35 * distance;
  const lamp = { type, position: [target[0], target[1] + height, target[2]].map(rounded), intensity: rounded(3 * height ** 2) };
  return type === 'spot' ? { ...lamp, direction: [0, -1, 0], innerConeDegrees: 20, outerConeDegrees: 35 } : lamp;
}

// The light as one of another type; color and what else both types have stays.
export function retyped(light, type, state) {
  const { color, temperatureKelvin, cullingMask, shadow } = light;
  const kept = Object.fromEntries(Object.entries({ color, temperatureKelvin, cullingMask, shadow }).filter(([, value]) => value !== undefined));
  const next = { ...newLight(type, state), ...kept };
  return light.position && next.position ? { ...next, position: light.position, intensity: light.intensity ?? next.intensity } : next;
}

// A light with its shadow on, as the frame's own, or off.
export function withShadow({ shadow, ...light }, on) {
  if (on) return light;
  return { ...light, shadow: { enabled: false } };
}

export const nameOfLight = ({ type = 'directional', sun }, index) =>
  `${index + 1} · ${{ directional: sun ? 'Sun' : 'Directional', spot: 'Spot', point: 'Point' }[type]}`;

function withoutIdleCones({ innerConeDegrees, outerConeDegrees, ...light }) {
  return light.type === 'spot' ? { ...light, innerConeDegrees, outerConeDegrees } : light;
}
