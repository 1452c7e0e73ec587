// The controls of the panel, as data. `path` is the field's place in the FrameSpec; `slider` is the comfortable range:
// the number beside it takes any value, and the server says what it refuses. `choose` does more than to set the field;
// `clears` is what goes with it when it is given back, where that is more; `absent` is what its absence means; `whole`
// gives it a row of its own; `keeps` has no default to go back to; `value(store)` is what is shown where that is not the
// field itself; `log` makes a slider's steps equal ratios. `panel` is what else a section holds (app.mjs), `needs` whether it is there.

import { kSunHours } from './sun_hours_fields.mjs';
import { kSurroundings } from './surroundings_fields.mjs';
import { sourceOf } from './surroundings_math.mjs';
import { withFile } from './volume_math.mjs';

const shadowed = (store) => store.effective('shadow.enabled') !== false;
// Views of one light, chosen by debug.light.
const showsOneLight = ({ state: { view } }) => ['cascades', 'shadow'].includes(view) || kDebugViews.some(([name]) => name === view);
const one = (path, value) => (store) => store.effective(path) === value;
const by = (...techniques) => (store) => shadowed(store) && techniques.includes(store.effective('shadow.technique'));
const tiled = by('auto', 'shadowMap');
const soft = (store) => tiled(store) && !['hard', 'pcss'].includes(store.effective('shadow.filter.type'));
const lightHasSize = ({ state }) => (state.spec.lights ?? state.report?.spec.lights ?? []).some((light) => light.angularDiameterDegrees || light.radius);

// A manual range needs both its ends, an automatic one takes none.
function chooseDepthRange(mode, store) {
  if (mode === 'automatic') return store.clearSpec('shadow.depthRange');
  const far = store.state.report?.depthRange[1] || 50;
  store.setSpec('shadow.depthRange', { mode, min: 0, max: Number(far.toPrecision(3)) });
}

// A light map holds no shadows of a ground, which is no part of the file.
export function chooseTechnique(technique, store) {
  if (technique === 'lightMap') store.clearSpec('ground');
  store.setSpec('shadow.technique', technique);
}

// A hard edge has no radius, and pcss takes the light's own size.
function chooseFilter(type, store) {
  if (type === 'hard' || type === 'pcss') store.clearSpec('shadow.filter.radius');
  store.setSpec('shadow.filter.type', type);
}

// Either says how fine a light map is.
function chooseMapSize(size, store) {
  store.clearSpec('shadow.lightMap.texelsPerMetre');
  store.setSpec('shadow.lightMap.size', size);
}

function chooseVolume(file, store) {
  if (!file) return store.clearSpec('volumes');
  const { spec } = store.state;
  store.update({ freshVolume: true, spec: { ...spec, volumes: withFile(store.state, file) } });
}

// Of all that the volume holds, thin or dense.
function chooseVolumeColor(color, store) {
  for (const stop of [0, 1]) store.setSpec(`volumes.0.transferFunction.${stop}.color`, color);
}

// A target is an error or a time, or there is none.
const targetKind = ({ state: { spec } }) => Object.keys(spec.quality ?? {})[0] ?? 'none';
const kFirstTargets = { maxError: 0.005, maxMilliseconds: 100 };

function chooseTarget(kind, store) {
  if (kind === 'none') store.clearSpec('quality');
  else store.setSpec('quality', { [kind]: kFirstTargets[kind] });
}

// Manual splits begin as equal parts.
function choosePartition(mode, store) {
  const count = store.effective('shadow.cascadeCount') ?? 4;
  const splits = Array.from({ length: count }, (_, i) => Number(((i + 1) / count).toPrecision(3)));
  store.setSpec('shadow.partition', mode === 'manual' ? { mode, splits } : { mode });
}

function chooseBias(mode, store) {
  if (mode === 'automatic') store.clearSpec('shadow.bias');
  else store.setSpec('shadow.bias', { mode, depth: 0.005, slope: 0.005, normalOffsetScale: 1 });
}

// Of manual splits there is one a cascade.
function chooseCascades(count, store) {
  store.setSpec('shadow.cascadeCount', count);
  if (store.effective('shadow.partition.mode') === 'manual') choosePartition('manual', store);
}

const manualSplit = (index) => ({
  path: `shadow.partition.splits.${index}`,
  label: `Split ${index + 1}`,
  says: 'Where this cascade ends, as a share of the depth range',
  slider: [0, 1, 0.005],
  keeps: true,
  needs: (store) => one('shadow.partition.mode', 'manual')(store) && store.state.spec.shadow?.partition?.splits?.length > index + 1,
});

const volumeFiles = ({ state }) => [['', 'None'], ...(state.summary?.volumeFiles ?? []).map((name) => [name, name])];
const hasVolume = (store) => store.isSet('volumes.0.file');
const hasBox = (store) => store.isSet('volumes.0.box'); // and not a matrix, or a node alone

const kToneMappings = [
  ['neutral', 'Neutral', 'Colors of surfaces stay, highlights alone are compressed'],
  ['aces', 'ACES', 'A film-like curve'],
  ['agx', 'AgX', 'Soft contrast, bright colors fade to white'],
  ['none', 'None', 'Unchanged, clipped at 1'],
];

export const kSections = [
  kSunHours,
  {
    title: 'Light',
    fields: [
      { path: 'shadowLightPolicy', label: 'Shadows of', choices: [['all', 'All lights'], ['first', 'First sun']], says: 'Which lights cast shadows' },
      { path: 'ambient.intensity', label: 'Ambient', slider: [0, 3, 0.01], says: 'Light of the studio', needs: ({ state }) => sourceOf(state) === 'studio' },
      { path: 'exposure', label: 'Exposure', says: 'Stops', slider: [-6, 6, 0.1] },
      { path: 'toneMapping', label: 'Tone', choices: kToneMappings },
    ],
  },
  kSurroundings,
  {
    title: 'Shadows',
    fields: [
      { path: 'shadow.enabled', label: 'Shadows', toggle: true },
      {
        path: 'shadow.technique',
        label: 'Technique',
        whole: true,
        choices: [
          ['auto', 'Auto', 'For each light rays where they cost at most twice its map, else the map'],
          ['shadowMap', 'Maps', 'Shadow maps: fast, as sharp as their texels'],
          ['rayTraced', 'Rays', 'Exact: rays for every pixel in doubt'],
          ['shadowVolume', 'Volumes', 'Exact, by the stencil buffer; drawn by OpenGL alone'],
          ['lightMap', 'Baked', 'Traced once into a texture of the surfaces, then only looked up; nothing may move, and there is no ground'],
        ],
        choose: chooseTechnique,
        needs: shadowed,
      },
      { path: 'shadow.raySamples', label: 'Rays a pixel', says: 'At most, in the penumbra of a light that has a size', choices: [[4, '4'], [12, '12'], [32, '32'], [128, '128']], needs: (store) => by('auto', 'rayTraced')(store) && lightHasSize(store) },
      { path: 'shadow.cascadeCount', label: 'Cascades', choices: [[1, '1'], [2, '2'], [3, '3'], [4, '4'], [6, '6'], [8, '8']], choose: chooseCascades, needs: tiled },
      { path: 'shadow.size', label: 'Tile size', choices: [['XSmall', 'XS'], ['Small', 'S'], ['Medium', 'M'], ['Large', 'L'], ['XLarge', 'XL']], says: 'Larger is sharper and slower. Default: L for a sun, M for a spot, S for a point light', needs: tiled },
      { path: 'shadow.importance', label: 'Importance', choices: [['low', 'Low'], ['medium', 'Medium'], ['high', 'High']], says: 'Lower makes tiles smaller, and shrinks them first when the atlas is full', needs: tiled },
      { path: 'shadow.filter.type', label: 'Filter', whole: true, choices: [['hard', 'Hard'], ['pcf', 'PCF'], ['vsm', 'VSM'], ['evsm', 'EVSM'], ['msm', 'MSM'], ['pcss', 'PCSS', 'Soft by the size of the light']], choose: chooseFilter, needs: tiled },
      { path: 'shadow.filter.size', label: 'Filter width', says: 'Texels across; wider is softer and slower', choices: [[3, '3'], [5, '5'], [7, '7']], needs: (store) => soft(store) && store.effective('shadow.filter.radius') == null },
      { path: 'shadow.filter.radius', label: 'Filter radius', says: 'Softness in metres, the same everywhere, instead of a width in texels', unit: 'm', needs: soft },
      { path: 'shadow.strength', label: 'Strength', slider: [0, 1, 0.01], needs: shadowed },
    ],
  },
  {
    title: 'Target',
    says: 'The server measures which settings meet the target',
    panel: 'target',
    fields: [
      { path: 'quality', label: 'Choose by', whole: true, choices: [['none', 'Hand'], ['maxError', 'Error', 'The fastest settings with at most this error'], ['maxMilliseconds', 'Time', 'The most exact settings that take no longer than this']], value: targetKind, choose: chooseTarget, absent: 'none' },
      { path: 'quality.maxError', label: 'Max error', says: 'Share of the receivers that are misclassified, 0.01 = 1 %', log: true, slider: [0.0001, 0.1, 0.01], needs: (store) => targetKind(store) === 'maxError', keeps: true },
      { path: 'quality.maxMilliseconds', label: 'Max time', unit: 'ms', says: 'Of a whole warm frame, without encoding', log: true, slider: [1, 2000, 0.01], needs: (store) => targetKind(store) === 'maxMilliseconds', keeps: true },
    ],
  },
  { title: 'Evaluation', closed: true, panel: 'evaluation', fields: [] },
  { title: 'Nodes', closed: true, panel: 'nodes', fields: [] },
  { title: 'Scenes, variants, animation', closed: true, panel: 'motion', fields: [] },
  {
    title: 'Light map',
    closed: true,
    panel: 'bake',
    fields: [
      { path: 'shadow.lightMap.size', label: 'Map size', says: 'Texels along the longer side of the light map; twice as many take four times as long to bake', choices: [[512, '512'], [1024, '1k'], [2048, '2k'], [4096, '4k']], choose: chooseMapSize, needs: shadowed },
    ],
  },
  {
    title: 'Volume',
    closed: true,
    panel: 'volume',
    fields: [
      { path: 'volumes.0.file', label: 'File', says: 'A .npy or .vdb file of the upload', options: volumeFiles, choose: chooseVolume, clears: 'volumes' },
      { path: 'volumes.0.transferFunction.1.extinction', label: 'Density', unit: '/ m', says: 'Share of the light that is taken away on a metre, where it is small', slider: [0, 2, 0.01], needs: hasVolume, keeps: true },
      { path: 'volumes.0.transferFunction.1.value', label: 'Full at', says: 'Value of the grid that has this density; at first the greatest in the file', needs: hasVolume, keeps: true },
      { path: 'volumes.0.transferFunction.1.color', label: 'Color', says: 'White for a cloud, black for soot', color: true, choose: chooseVolumeColor, needs: hasVolume, keeps: true },
      { path: 'volumes.0.box.min', label: 'From', unit: 'm', says: 'Lowest corner of the box that the grid fills: x, y, z', vector: true, needs: hasBox, keeps: true },
      { path: 'volumes.0.box.max', label: 'To', unit: 'm', says: 'Highest corner: x, y, z', vector: true, needs: hasBox, keeps: true },
      { path: 'volumes.0.castShadow', label: 'Casts shadow', toggle: true, absent: true, needs: hasVolume },
      { path: 'volumes.0.receiveShadow', label: 'Receives shadow', toggle: true, absent: true, needs: hasVolume },
    ],
  },
  {
    title: 'Cascade planning',
    closed: true,
    fields: [
      { path: 'shadow.partition.mode', label: 'Partition', choices: [['logarithmic', 'Log'], ['uniform', 'Uniform'], ['manual', 'Manual']], says: 'How split distances are chosen', choose: choosePartition, clears: 'shadow.partition' },
      ...[0, 1, 2, 3, 4, 5, 6].map(manualSplit),
      { path: 'shadow.partition.pssmFactor', label: 'PSSM factor', slider: [0, 1, 0.01], says: '0 = logarithmic, 1 = uniform', needs: one('shadow.partition.mode', 'logarithmic') },
      { path: 'shadow.depthRange.mode', label: 'Depth range', choices: [['automatic', 'Automatic'], ['manual', 'Manual']], says: 'Automatic = from the nearest to the farthest surface in view', choose: chooseDepthRange, clears: 'shadow.depthRange' },
      { path: 'shadow.depthRange.min', label: 'From', unit: 'm', needs: one('shadow.depthRange.mode', 'manual') },
      { path: 'shadow.depthRange.max', label: 'To', unit: 'm', needs: one('shadow.depthRange.mode', 'manual') },
      { path: 'shadow.stabilization', label: 'Stabilise', choices: [['none', 'None'], ['projectionSnapping', 'Proj.', 'Projection snapping'], ['viewSnapping', 'View', 'View snapping']] },
      { path: 'shadow.blendCascades', label: 'Blend cascades', toggle: true },
      { path: 'atlas.baseSize', label: 'Base tile', says: 'Texels along a side of a Large tile', choices: [[512, '512'], [1024, '1024'], [2048, '2048']] },
      { path: 'atlas.size', label: 'Atlas', says: 'Largest side of the atlas; smaller saves memory, and shrinks tiles when it is full', choices: [[1024, '1k'], [2048, '2k'], [4096, '4k'], [8192, '8k']] },
      { path: 'atlas.samples', label: 'Samples', says: 'Depths in each texel; four smooth edges within a texel', choices: [[1, '1'], [4, '4']] },
    ],
  },
  {
    title: 'Bias and casters',
    closed: true,
    fields: [
      { path: 'shadow.bias.mode', label: 'Bias', choices: [['automatic', 'Automatic'], ['manual', 'Manual']], says: 'Automatic = from texels, filter and slope: nothing to tune', choose: chooseBias, clears: 'shadow.bias' },
      { path: 'shadow.bias.depth', label: 'Depth', unit: 'm', says: 'Distance towards the light', needs: one('shadow.bias.mode', 'manual'), keeps: true },
      { path: 'shadow.bias.slope', label: 'Slope', unit: 'm', says: 'Times the tangent of the angle between normal and light', needs: one('shadow.bias.mode', 'manual'), keeps: true },
      { path: 'shadow.bias.normalOffsetScale', label: 'Normal', says: 'Distance along the normal, as a multiple of the depth', needs: one('shadow.bias.mode', 'manual'), keeps: true },
      { path: 'shadow.blendedCasters', label: 'Glass casts', choices: [['dither', 'Dither', 'As much shadow as its alpha says'], ['threshold', 'Threshold', 'All or nothing']] },
      { path: 'shadow.terminator', label: 'Terminator', choices: [['smooth', 'Smooth', 'Curved as shading shows it'], ['flat', 'Flat', 'Along the edges of triangles']] },
    ],
  },
  {
    title: 'Picture',
    fields: [
      { path: 'size', label: 'Size', sizes: [[640, 360], [1280, 720], [1920, 1080]] },
      { path: 'antialiasing', label: 'Antialiasing', choices: [['none', 'None'], ['msaa4x', 'MSAA 4×']] },
      { path: 'debug.light', label: 'Light shown', says: 'Index of the light; default: the first that casts a shadow', needs: showsOneLight },
      { path: 'debug.tile', label: 'Tile shown', says: 'A cascade or a face of that light', needs: ({ state }) => state.view === 'tile' },
    ],
  },
];

export const kViews = [
  ['color', 'Color', 'The shaded scene'],
  ['cascades', 'Cascades', 'Tinted by cascade: green, blue, purple, red, orange, cyan, yellow, pink'],
  ['shadow', 'Shadow', 'Share of the light that arrives, white = all'],
  ['depth', 'Depth', 'Distance along the view axis'],
  ['normal', 'Normal', 'World-space shading normal'],
  ['ids', 'Nodes', 'A color for each node'],
];

// Data that is asked for more rarely.
export const kDataViews = [
  ['materials', 'Materials', 'A color for each material'],
  ['instances', 'Instances', 'A color for each copy of a mesh'],
  ['albedo', 'Albedo', 'Base color, without light'],
  ['position', 'Position', 'Place in the scene’s bounds, as a color'],
  ['motion', 'Motion', 'How far each point has moved since the last picture: the direction as a hue, white = not at all'],
  ['sunHours', 'Sun hours', 'Hours of direct sun on a day, at a place: blue 0, red all daylight'],
  ['atlas', 'Atlas', 'The shadow atlas, depth as grey, each tile named light.tile'],
];

// What helps to tune one light's shadow.
export const kDebugViews = [
  ['texelGrid', 'Texel grid', 'The shadow map’s texels as a checkerboard on the surfaces'],
  ['texelDensity', 'Texel density', 'Pixels that a texel of the shadow map spans: blue 1/16, green 1, red 16'],
  ['blendWeight', 'Blend weight', 'Weight of the next cascade'],
  ['bias', 'Bias', 'How far a surface is moved before it is compared with the map: blue 0.1 mm, green 1 cm, red 1 m'],
  ['casterIds', 'Caster ids', 'A color for each node that casts a shadow'],
  ['lightContribution', 'Light', 'The scene lit by this light alone'],
  ['tile', 'Tile', 'One tile of the atlas, depth as grey'],
  ['reference', 'Reference', 'The share of the light that rays find'],
  ['error', 'Error', 'Compared with rays: false shadow red, false light blue'],
  ['edgeDistance', 'Edge distance', 'How far the shadow’s edges lie from the true ones: black 0, green 8, red 16 pixels'],
];

// As the view `cascades` tints them.
export const kTints = ['#35c26b', '#4f8cff', '#a56bf0', '#ef5b5b', '#f2a33a', '#3ccfcf', '#e8d84a', '#f28fb8'];

// One hue a stage, in the order of the work.
export const kStageColors = {
  queue: '#5b6577',
  load: '#8d7bd6',
  upload: '#b06fc4',
  bake: '#8f7a4a',
  environment: '#5fb3a1',
  volume: '#9aa7b8',
  survey: '#3fa7c9',
  plan: '#36c2ae',
  shadow: '#f6b73c',
  shade: '#6aa5ff',
  predict: '#c9d25a',
  reference: '#7ccf6b',
  sunHours: '#e0b83c',
  readback: '#8fa3bf',
  encode: '#d97c6c',
};
