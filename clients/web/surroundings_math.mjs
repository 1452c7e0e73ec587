// Light from all around, and the ground, as the page makes them. Pure.

import { lightsWithSun, sunInForce } from './light_math.mjs';
import { getPath, removePath, setPath } from './paths.mjs';

export const isPanorama = ({ name }) => /\.(hdr|exr)$/i.test(name);

// What lights the scene from all around: a picture of the upload, a computed sky, or the studio without either.
export const sourceOf = ({ spec }) => (getPath(spec, 'environment.file') ? 'file' : getPath(spec, 'environment.sky') ? 'sky' : 'studio');

// Of another source: its intensity has another unit.
const withoutSource = (spec) => ['environment.file', 'environment.sky', 'environment.intensity'].reduce(removePath, spec);

// Seen behind the scene, unless that was chosen.
const seen = (spec) => (getPath(spec, 'environment.background') ? spec : setPath(spec, 'environment.background', 'environment'));

// A picture and a sky have suns of their own: the one that was set by hand goes, other lights stay.
const withoutSun = ({ lights, ...spec }) => (lights ? { ...spec, lights: lights.filter(({ sun }, i) => i > 0 || !sun) } : spec);

export const litByFile = ({ spec }, file) => withoutSun(setPath(withoutSource(seen(spec)), 'environment.file', file));

export const litBySky = (state) => withoutSun(setPath(withoutSource(seen(state.spec)), 'environment.sky', { sun: sunInForce(state) }));

// Back to the studio, with a sun where the sky's or the picture's was.
export function litByStudio(state) {
  const spec = removePath(withoutSource(state.spec), 'environment.background');
  const hasSun = !spec.lights || spec.lights[0]?.sun;
  return hasSun ? spec : { ...spec, lights: [...lightsWithSun({ spec: {}, report: null }, sunInForce(state)), ...spec.lights] };
}

export const kFirstGround = { mode: 'catcher' };
