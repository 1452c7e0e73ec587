// Puts the page together: the store in the middle, the panels around it, the frame loop that follows it.

import { capabilities, renderFrame } from './api.mjs';
import { createBakePanel } from './bake_panel.mjs';
import { createCameraPanel } from './camera_panel.mjs';
import { choices, createControl } from './controls.mjs';
import { fromHash, toHash } from './deep_link.mjs';
import { element } from './dom.mjs';
import { kDebugViews, kSections, kViews } from './fields.mjs';
import { createFrameLoop } from './frame_loop.mjs';
import { lightsWithSun } from './light_math.mjs';
import { fitOrbit, kFovYDegrees, orbitInForce } from './orbit_math.mjs';
import { setPath } from './paths.mjs';
import { createPicture } from './picture.mjs';
import { createProblems } from './problems.mjs';
import { showReport } from './report_panel.mjs';
import { createScenePanel } from './scene_panel.mjs';
import { copyCurl, copyLink, download } from './share.mjs';
import { draftSpec, fullSpec } from './spec.mjs';
import { attachOrbit } from './stage.mjs';
import { createStore } from './store.mjs';
import { createSunPanel } from './sun_panel.mjs';
import { createTimings } from './timings.mjs';
import { withFile } from './volume_math.mjs';
import { createVolumePanel } from './volume_panel.mjs';

const byId = (id) => document.getElementById(id);
const stage = byId('stage');
const picture = createPicture(byId('picture'));
const problems = createProblems(document.body, byId('banner'));
const showTimings = createTimings(byId('timings'));
const store = createStore({ ...fromHash(location.hash), summary: null, report: null });

// ---- frames

const loop = createFrameLoop({ render, show, fail: refused, busy: (on) => (byId('busy').hidden = !on) });

function stageSize() {
  const limited = Math.min(1, 1920 / stage.clientWidth, 1080 / stage.clientHeight);
  const even = (pixels) => Math.max(16, Math.round((pixels * limited) / 2) * 2);
  return { width: even(stage.clientWidth), height: even(stage.clientHeight) };
}

function render(draft, scale, signal) {
  const { state } = store;
  if (!state.summary) return null;
  const spec = draft ? draftSpec(state, stageSize(), scale) : fullSpec(state, stageSize());
  return renderFrame(state.summary.id, spec, signal);
}

async function show({ report, images, roundTripMs }, draft) {
  problems.clear();
  await picture.show(images[0]);
  stage.classList.toggle('draft', draft);
  showTimings(report, roundTripMs);
  if (draft) return;
  showReport(byId('report'), report);
  const told = report.lights.some(({ tiles, note, lightMap }) => tiles.length || note || lightMap);
  byId('report-section').hidden = !told && !report.volumes.length && !report.warnings.length;
  store.update({ report });
}

function refused(error) {
  problems.show(error);
  stage.classList.add('draft');
}

store.subscribe((state, before) => {
  const asked = state.spec !== before.spec || state.view !== before.view || state.summary !== before.summary;
  if (!asked) return;
  loop.changed({ settled: state.summary !== before.summary || state.view !== before.view });
  if (state.summary) history.replaceState(null, '', toHash(state));
});

let askedSize = JSON.stringify(stageSize());
new ResizeObserver(() => {
  const size = JSON.stringify(stageSize());
  if (size === askedSize || store.isSet('width')) return;
  askedSize = size;
  loop.changed();
}).observe(stage);

// ---- camera

// The lens stays when the eye moves: the user's own, else that of the camera that is looked through.
function lens() {
  const { perspective, orthographic } = store.state.spec.camera ?? {};
  if (perspective || orthographic) return { ...(perspective && { perspective }), ...(orthographic && { orthographic }) };
  const fovYDegrees = store.state.report?.spec.camera.perspective?.fovYDegrees;
  return fovYDegrees && fovYDegrees !== kFovYDegrees ? { perspective: { fovYDegrees } } : {};
}

const moveTo = (orbit) => store.setSpec('camera', { ...lens(), orbit });
const wholeScene = ({ boundsMin, boundsMax }) => fitOrbit(boundsMin, boundsMax, stage.clientWidth / stage.clientHeight);

function fit() {
  if (store.state.summary) store.setSpec('camera', { orbit: wholeScene(store.state.summary) });
}

attachOrbit(stage, {
  orbit: () => orbitInForce(store.state),
  fovY: () => store.effective('camera.perspective.fovYDegrees'),
  move: moveTo,
  fit,
});
byId('camera').append(createCameraPanel(store, fit));

// ---- scene, light and the other fields

const scenePanel = createScenePanel({
  list: byId('scene-list'),
  button: byId('upload'),
  input: byId('files'),
  progress: byId('upload-progress'),
  facts: byId('scene-facts'),
  dropZone: document.body,
  pick: showScene,
  fail: problems.show,
});
byId('empty-upload').addEventListener('click', () => byId('files').click());

// A link's camera and light stay with its scene, also with the file of another volume; another scene starts with its
// own, where it has any.
function showScene(summary, added) {
  problems.clear();
  const { sceneId, spec } = store.state;
  const same = Boolean(added) || sceneId === summary.id;
  const { camera, lights, volumes, ...rest } = spec;
  const [eye] = summary.cameras;
  const next = { ...rest, camera: (same && camera) || (eye ? { node: eye.node } : { orbit: wholeScene(summary) }) };
  if (same && lights) next.lights = lights;
  else if (!summary.lights.length) next.lights = lightsWithSun({ spec: {}, report: null }, {});
  if (added) next.volumes = withFile(store.state, added);
  else if (volumes?.every(({ file }) => summary.volumeFiles.includes(file))) next.volumes = volumes;
  store.update({ sceneId: summary.id, summary, spec: next, report: null, freshVolume: Boolean(added) });
}

byId('sun').append(createSunPanel(store));
const panels = {
  bake: createBakePanel(store, {
    specOf: () => setPath(setPath(fullSpec(store.state, stageSize()), 'shadow.technique', 'lightMap'), 'shadow.enabled', true),
    done: () => store.setSpec('shadow.technique', 'lightMap'),
    problems,
  }),
  volume: createVolumePanel(store, scenePanel.addFiles),
};
for (const section of kSections) {
  const body = section.fields.map((field) => createControl(field, store));
  if (section.panel) body.push(panels[section.panel]);
  byId('fields').append(element('details', { open: !section.closed }, element('summary', {}, element('h2', {}, section.title)), ...body));
}

// ---- views

const views = choices({ label: 'View', choices: kViews, choose: (view) => store.update({ view }) }, store, 'view');
const debugViews = element(
  'select',
  { 'aria-label': 'Debug view', onchange: () => debugViews.value && store.update({ view: debugViews.value }) },
  element('option', { value: '' }, 'Debug view …'),
  ...kDebugViews.map(([value, text, says]) => element('option', { value, title: says }, text)),
);
byId('views').append(views.node, debugViews);
store.subscribe(({ view, summary }) => {
  views.show(view);
  debugViews.value = kDebugViews.some(([name]) => name === view) ? view : '';
  document.body.classList.toggle('no-scene', !summary);
  for (const part of document.querySelectorAll('.panel > :not(.scene)')) part.inert = !summary;
});
addEventListener('keydown', (event) => {
  if (event.target.closest('input, select, textarea') || event.ctrlKey || event.metaKey || event.altKey) return;
  const view = kViews[Number(event.key) - 1];
  if (view) store.update({ view: view[0] });
});

// ---- taking it along

let toastTimer = 0;
function toast(text) {
  clearTimeout(toastTimer);
  byId('toast').textContent = text;
  byId('toast').classList.add('shown');
  toastTimer = setTimeout(() => byId('toast').classList.remove('shown'), 2200);
}

function onButton(id, act) {
  byId(id).addEventListener('click', async () => {
    const { summary } = store.state;
    if (!summary) return toast('There is no scene yet');
    try {
      toast(await act(summary.id, fullSpec(store.state, stageSize())));
    } catch (error) {
      problems.show(error);
    }
  });
}

const copied = async (done, what) => ((await done) ? `${what} copied` : `${what} could not be copied`);
onButton('copy-link', () => copied(copyLink(), 'Link'));
onButton('copy-curl', (id, spec) => copied(copyCurl(id, spec), 'curl command'));
onButton('save-png', async (id, spec) => (await download(id, spec, 'png'), 'PNG saved'));
onButton('save-exr', async (id, spec) => (await download(id, spec, 'exr'), 'EXR saved'));

// ---- start

addEventListener('hashchange', () => {
  const { sceneId, view, spec } = fromHash(location.hash);
  if (sceneId && sceneId !== store.state.sceneId) {
    store.update({ sceneId, view, spec });
    scenePanel.load(sceneId);
  } else if (sceneId) {
    store.update({ view, spec });
  }
});

scenePanel.load(store.state.sceneId).then(() => (byId('empty').hidden = Boolean(store.state.summary)));
store.subscribe(({ summary }) => summary && (byId('empty').hidden = true));
capabilities().then(
  ({ renderer: { renderer, software } }) => (byId('device').textContent = `${renderer}${software ? ' · software, no GPU' : ''}`),
  () => {},
);
