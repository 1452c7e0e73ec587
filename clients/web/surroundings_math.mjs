// Light from all around, and the ground, as the page makes them. Pure.

import { lightsWithSun, sunInForce } from './light_math.mjs';
import { getPath, removePath, setPath } from './paths.mjs';

export const isPanorama = ({ name }) => /\.(hdr|exr)$/i.test(name);

export const hasOwnLight = ({ summary }) => Number.isInteger(summary?.environmentLight);

// What lights the scene from all around: a picture of the upload, a computed sky, a light of the glTF, or the studio. A
// glTF's own light is there unless another is named.
export function sourceOf({ spec, summary }) {
  const named = ['file', 'sky', 'light', 'studio'].find((source) => getPath(spec, `environment.${source}`) !== undefined);
  return named ?? (hasOwnLight({ summary }) ? 'light' : 'studio');
}

// Of another source: its intensity has another unit.
const withoutSource = (spec) => ['environment.file', 'environment.sky', 'environment.light', 'environment.intensity'].reduce(removePath, spec);

// Seen behind the scene, unless that was chosen.
const seen = (spec) => (getPath(spec, 'environment.background') ? spec : setPath(spec, 'environment.background', 'environment'));

// A picture and a sky have suns of their own: the one that was set by hand goes, other lights stay.
const withoutSun = ({ lights, ...spec }) => (lights ? { ...spec, lights: lights.filter(({ sun }, i) => i > 0 || !sun) } : spec);

export const litByFile = ({ spec }, file) => withoutSun(setPath(withoutSource(seen(spec)), 'environment.file', file));

export const litBySky = (state) => withoutSun(setPath(withoutSource(seen(state.spec)), 'environment.sky', { sun: sunInForce(state) }));

// By the glTF's own light, which has its own sun.
export const litByOwnLight = ({ spec }) => withoutSun(removePath(withoutSource(seen(spec)), 'environment.studio'));

// Back to the studio, with a sun where the sky's or the picture's was. Over a glTF's own light it must be named.
export function litByStudio(state) {
  const plain = removePath(withoutSource(state.spec), 'environment.background');
  const isNamed = !hasOwnLight(state) || getPath(plain, 'environment.studio');
  const spec = isNamed ? plain : setPath(plain, 'environment.studio', 'lamps');
  const hasSun = !spec.lights || spec.lights[0]?.sun;
  return hasSun ? spec : { ...spec, lights: [...lightsWithSun({ spec: {}, report: null }, sunInForce(state)), ...spec.lights] };
}

export const kFirstGround = { mode: 'catcher' };
