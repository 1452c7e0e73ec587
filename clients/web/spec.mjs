// From the page's state to the FrameSpec that is sent. Pure.

import { sunHoursInForce } from './sun_hours.mjs';

const kMostPixels = 1920 * 1080;

// The size of a picture that has a pixel for each of the screen's, in a place of so many CSS pixels; where these are more
// than kMostPixels, of the same shape.
export function pictureSize(width, height, pixelRatio) {
  const scale = Math.min(pixelRatio, Math.sqrt(kMostPixels / Math.max(1, width * height)));
  const side = (pixels) => Math.max(16, Math.round(pixels * scale));
  return { width: side(width), height: side(height) };
}

// The sharp picture of the present state. `size` is used where the user chose none.
export function fullSpec({ spec, view, report }, size) {
  const sized = spec.width && spec.height ? spec : { ...size, ...spec };
  const motion = view === 'motion' && !spec.motionFrom ? { motionFrom: momentOf(report) } : {};
  const hours = view === 'sunHours' ? { sunHours: sunHoursInForce(spec) } : {};
  return { ...sized, ...motion, ...hours, views: [view] };
}

// What the last picture showed.
const momentOf = (report) => (report ? { camera: report.spec.camera, animation: report.spec.animation ?? {}, nodes: placesOf(report.spec.nodes) } : {});
const placesOf = (nodes = []) =>
  nodes.map(({ visible, castShadow, receiveShadow, layers, ...place }) => place).filter((place) => Object.keys(place).length > 1);

// How small a draft may be drawn, as shares of the picture's sides.
export const kDraftScales = [0.12, 0.16, 0.2, 0.25, 0.33, 0.4, 0.5, 0.67, 0.8];
const kCoarse = 0.33; // from here down, shadow maps are coarser too
const kCoarsest = 0.2; // and from here down, fewer

// A ninth of the bytes of a PNG, and a third less time until it is seen, even where no network lies between; JPEG lies
// between the two, and has no alpha.
const kDraftFile = { format: 'webp', webpQuality: 80 };

const kDraftMinutes = 30; // of a step of sun hours

// The same, cheap enough to follow the hand: fewer pixels, no antialiasing, no target to be searched for. Rays are
// taken last, since they are what exact techniques are for.
export function draftSpec(state, size, scale) {
  const { quality, ...full } = fullSpec(state, size);
  const side = (pixels) => Math.max(16, Math.round((pixels * scale) / 2) * 2);
  const output = { ...full.output, ...kDraftFile };
  const draft = { ...full, width: side(full.width), height: side(full.height), antialiasing: 'none', output };
  if (draft.sunHours) draft.sunHours = { ...draft.sunHours, stepMinutes: Math.max(kDraftMinutes, draft.sunHours.stepMinutes ?? 0) };
  if (draft.shadow?.raySamples > 4) draft.shadow = { ...draft.shadow, raySamples: 4 };
  if (draft.environment?.shadows === 'rays') draft.environment = { ...draft.environment, samples: 1 };
  if (scale <= kCoarse) draft.atlas = { ...draft.atlas, baseSize: Math.min(512, draft.atlas?.baseSize ?? 512) };
  const { cascadeCount = 4, partition } = draft.shadow ?? {};
  if (scale <= kCoarsest && partition?.mode !== 'manual') draft.shadow = { ...draft.shadow, cascadeCount: Math.min(2, cascadeCount) };
  return draft;
}

export const withFormat = (spec, format) => ({ ...spec, output: { ...spec.output, format } });
