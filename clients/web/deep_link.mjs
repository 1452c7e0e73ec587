// The state as location.hash and back: "#scene=…&view=shadow&camera.orbit.azimuthDegrees=30&lights[0].intensity=2". Pure.

import { flatten, setPath } from './paths.mjs';

export function toHash({ sceneId, view, spec }) {
  const words = [];
  if (sceneId) words.push(['scene', sceneId]);
  if (view !== 'color') words.push(['view', view]);
  for (const [path, value] of flatten(spec).sort(([a], [b]) => (a < b ? -1 : 1))) words.push([spelled(path), rounded(value)]);
  const query = new URLSearchParams(words.map(([key, value]) => [key, text(value)]));
  return `#${query.toString().replaceAll('%2C', ',').replaceAll('%5B', '[').replaceAll('%5D', ']')}`;
}

export function fromHash(hash) {
  const state = { sceneId: null, view: 'color', spec: {} };
  for (const [key, value] of new URLSearchParams(hash.replace(/^#/, ''))) {
    if (key === 'scene') state.sceneId = value;
    else if (key === 'view') state.view = value;
    else if (/^[A-Za-z]\w*(\.\w+|\[\d+\])*$/.test(key) && !key.includes('__')) state.spec = setPath(state.spec, dotted(key), parsed(value));
  }
  return state;
}

// The index of a list's element as fields are spelled everywhere, and as paths.mjs takes it.
const spelled = (path) => path.replace(/\.(\d+)(?=\.|$)/g, '[$1]');
const dotted = (key) => key.replace(/\[(\d+)\]/g, '.$1');

const text = (value) => (typeof value === 'string' ? value : JSON.stringify(value));

// Enough digits for any picture, short enough to read.
function rounded(value) {
  if (Array.isArray(value)) return value.map(rounded);
  return typeof value === 'number' ? Number(value.toPrecision(7)) : value;
}

function parsed(value) {
  try {
    return JSON.parse(value);
  } catch {
    return value;
  }
}
