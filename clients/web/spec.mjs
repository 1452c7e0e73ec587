// From the page's state to the FrameSpec that is sent. Pure.

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
  const hours = view === 'sunHours' && !spec.sunHours ? dayOf(spec) : {};
  return { ...sized, ...motion, ...hours, views: [view] };
}

// The day of the first sun by place and time, from midnight to midnight by its clock; without one the server says what is missing.
function dayOf({ lights, environment }) {
  const suns = [...(lights ?? []).map((light) => light.sun), environment?.sky?.sun];
  const sun = suns.find((each) => each?.time);
  const [, date, zone] = /^(\d{4}-\d\d-\d\d)T.*?(Z|[+-]\d\d:\d\d)$/i.exec(sun?.time ?? '') ?? [];
  if (!date) return {};
  const next = new Date(Date.parse(`${date}T00:00:00Z`) + 86_400_000).toISOString().slice(0, 10);
  const { time, ...place } = sun;
  return { sunHours: { ...place, begin: `${date}T00:00:00${zone}`, end: `${next}T00:00:00${zone}` } };
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

// The same, cheap enough to follow the hand: fewer pixels, no antialiasing, no target to be searched for. Rays are
// taken last, since they are what exact techniques are for.
export function draftSpec(state, size, scale) {
  const { quality, ...full } = fullSpec(state, size);
  const side = (pixels) => Math.max(16, Math.round((pixels * scale) / 2) * 2);
  const output = { ...full.output, ...kDraftFile };
  const draft = { ...full, width: side(full.width), height: side(full.height), antialiasing: 'none', output };
  if (draft.shadow?.raySamples > 4) draft.shadow = { ...draft.shadow, raySamples: 4 };
  if (draft.environment?.shadows === 'rays') draft.environment = { ...draft.environment, samples: 1 };
  if (scale <= kCoarse) draft.atlas = { ...draft.atlas, baseSize: Math.min(512, draft.atlas?.baseSize ?? 512) };
  const { cascadeCount = 4, partition } = draft.shadow ?? {};
  if (scale <= kCoarsest && partition?.mode !== 'manual') draft.shadow = { ...draft.shadow, cascadeCount: Math.min(2, cascadeCount) };
  return draft;
}

export const withFormat = (spec, format) => ({ ...spec, output: { ...spec.output, format } });
