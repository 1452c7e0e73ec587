// Puts the page together: the store in the middle, the panels around it, the frame loop that follows it.

import { capabilities, renderFrame } from './api.mjs';
import { createBakePanel } from './bake_panel.mjs';
import { cameraName, createCameraPanel } from './camera_panel.mjs';
import { createCompare } from './compare.mjs';
import { createControl } from './controls.mjs';
import { fromHash, toHash } from './deep_link.mjs';
import { element } from './dom.mjs';
import { createErrorPanel } from './error_panel.mjs';
import { createEvaluationPanel } from './evaluation_panel.mjs';
import { chooseTechnique, kSections } from './fields.mjs';
import { createFrameLoop } from './frame_loop.mjs';
import { lightsWithSun } from './light_math.mjs';
import { createLightsPanel } from './lights_panel.mjs';
import { createMotionPanel } from './motion_panel.mjs';
import { createNodesPanel } from './nodes_panel.mjs';
import { kFovYDegrees, kWholeScene, orbitInForce } from './orbit_math.mjs';
import { removePath, setPath } from './paths.mjs';
import { createPicture } from './picture.mjs';
import { createPlanOverlay } from './plan_overlay.mjs';
import { createProblems } from './problems.mjs';
import { showReport } from './report_panel.mjs';
import { createScenePanel } from './scene_panel.mjs';
import { withoutScene } from './scene_spec.mjs';
import { copySnippet, download } from './share.mjs';
import { draftSpec, fullSpec, pictureSize } from './spec.mjs';
import { attachOrbit } from './stage.mjs';
import { createStore } from './store.mjs';
import { createSunPanel } from './sun_panel.mjs';
import { isPanorama, kFirstGround, litByFile } from './surroundings_math.mjs';
import { createSurroundingsPanel } from './surroundings_panel.mjs';
import { createTargetPanel } from './target_panel.mjs';
import { createTimings } from './timings.mjs';
import { createViewChoice } from './view_choice.mjs';
import { withFile } from './volume_math.mjs';
import { createVolumePanel } from './volume_panel.mjs';

const byId = (id) => document.getElementById(id);
const stage = byId('stage');
const picture = createPicture(byId('picture'));
const problems = createProblems(document.body, byId('banner'));
const showTimings = createTimings(byId('timings'));
const store = createStore({ ...fromHash(location.hash), summary: null, report: null, cameraShown: null });
const announce = (text) => (byId('live').textContent = text);
const sharpSpec = () => fullSpec(store.state, stageSize());
let shown = null; // what the sharp picture was asked with: {state, spec}

// The spec that gave the picture: view Motion shows what has moved since the picture before it, which is then gone.
function shownSpec() {
  const { spec, view, summary } = store.state;
  const isShown = shown && shown.state.spec === spec && shown.state.view === view && shown.state.summary === summary;
  return isShown ? shown.spec : sharpSpec();
}

// ---- frames

const loop = createFrameLoop({ render, show, fail: refused, busy: (on) => (byId('busy').hidden = !on) });

let askedSize = ''; // of the last sharp picture

const stageSize = () => pictureSize(stage.clientWidth, stage.clientHeight, devicePixelRatio);

async function render(draft, scale, signal) {
  const { state } = store;
  if (!state.summary) return null;
  const size = stageSize();
  const spec = draft ? draftSpec(state, size, scale) : fullSpec(state, size);
  if (!draft) askedSize = JSON.stringify(size);
  return { ...(await renderFrame(state.summary.id, spec, signal)), asked: { state, spec } };
}

async function show({ report, images, roundTripMs, asked }, draft) {
  problems.clear();
  await picture.show(images[0]);
  stage.classList.toggle('draft', draft);
  showTimings(report, roundTripMs);
  plan.update(report, store.state.summary);
  if (draft) return;
  // The scene's own warnings are beside its name.
  const warnings = report.warnings.filter((text) => !store.state.summary.warnings.includes(text));
  showReport(byId('report'), { ...report, warnings });
  const hasReport = report.lights.some(({ tiles, note, lightMap }) => tiles.length || note || lightMap);
  byId('report-section').hidden = !hasReport && !report.environment && !report.volumes.length && !warnings.length;
  shown = asked;
  store.update({ report, cameraShown: asked.spec.camera });
  announce(`The picture is sharp, after ${Math.round(roundTripMs)} milliseconds`);
  if (compare.isOn()) compare.refresh();
}

function refused(error) {
  problems.show(error);
  stage.classList.add('draft');
}

let linkTimer = 0;
store.subscribe((state, before) => {
  const asked = state.spec !== before.spec || state.view !== before.view || state.summary !== before.summary;
  if (!asked) return;
  loop.changed({ settled: state.summary !== before.summary || state.view !== before.view });
  clearTimeout(linkTimer); // browsers take only a few new addresses a second
  linkTimer = setTimeout(() => store.state.summary && history.replaceState(null, '', toHash(store.state)), 250);
});

// The place may change while a picture of it is on its way.
new ResizeObserver(() => {
  if (JSON.stringify(stageSize()) !== askedSize && !store.isSet('width')) loop.changed();
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

function fit() {
  if (store.state.summary) store.setSpec('camera', { orbit: kWholeScene });
}

attachOrbit(stage, {
  orbit: () => orbitInForce(store.state),
  fovY: () => store.effective('camera.perspective.fovYDegrees'),
  move: moveTo,
  fit,
});
byId('camera').append(createCameraPanel(store, fit));

// ---- what lies over the picture

const plan = createPlanOverlay(stage);
const compare = createCompare(store, { picture: byId('picture'), specOf: shownSpec, problems, announce });
stage.append(...plan.nodes, compare.node, createErrorPanel(store, { specOf: sharpSpec, problems, announce }));

function pressed(button, act) {
  const set = (on) => {
    if (!store.state.summary) return;
    button.setAttribute('aria-pressed', String(on));
    act(on);
  };
  button.addEventListener('click', () => set(button.getAttribute('aria-pressed') !== 'true'));
  return set;
}
const setCompare = pressed(byId('compare'), compare.toggle);
pressed(byId('plan'), plan.toggle);
addEventListener('keydown', (event) => {
  if (event.key !== 'Escape') return;
  if (byId('copy-menu').open) {
    byId('copy-menu').open = false;
    byId('copy-menu').querySelector('summary').focus();
  } else if (compare.isOn()) setCompare(false);
});

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

// What a link says of its scene stays with it, also with a file that was added; another scene starts with its own
// camera and light, where it has any, and with nothing of the one before. The first one of all stands on a ground.
function showScene(summary, { added, panorama }) {
  problems.clear();
  const { sceneId, spec } = store.state;
  const same = Boolean(added) || sceneId === summary.id;
  let next = same ? { ...spec } : withoutScene(spec);
  if (!store.state.summary && !same) next.ground ??= kFirstGround;
  next.camera ??= summary.cameras.length ? { node: cameraName(summary.cameras[0]) } : { orbit: kWholeScene };
  if (!next.lights && !summary.lights.length) next.lights = lightsWithSun({ spec: {}, report: null }, {});
  const picture = panorama ?? (added && isPanorama({ name: added }) ? added : null);
  const grid = picture ? null : added;
  if (grid) next.volumes = withFile(store.state, grid);
  if (picture) next = litByFile({ spec: next }, picture);
  store.update({ sceneId: summary.id, summary, spec: next, report: null, cameraShown: null, freshVolume: Boolean(grid) });
}

byId('sun').append(createSunPanel(store), createLightsPanel(store));
const panels = {
  bake: createBakePanel(store, {
    specOf: () => setPath(setPath(removePath(sharpSpec(), 'ground'), 'shadow.technique', 'lightMap'), 'shadow.enabled', true),
    done: () => chooseTechnique('lightMap', store),
    problems,
  }),
  evaluation: createEvaluationPanel(store, { specOf: sharpSpec, problems, announce }),
  motion: createMotionPanel(store),
  nodes: createNodesPanel(store),
  surroundings: createSurroundingsPanel(store, scenePanel.addFiles),
  target: createTargetPanel(store),
  volume: createVolumePanel(store, scenePanel.addFiles),
};
for (const section of kSections) {
  const body = section.fields.map((field) => createControl(field, store));
  if (section.panel) body.push(panels[section.panel]);
  const node = element('details', { open: !section.closed }, element('summary', {}, element('h2', {}, section.title)), ...body);
  if (section.needs) store.subscribe(() => (node.hidden = !section.needs(store)));
  byId('fields').append(node);
}

createViewChoice(store, byId('views'));
store.subscribe(({ summary }) => {
  document.body.classList.toggle('no-scene', !summary);
  for (const part of document.querySelectorAll('.panel > :not(.scene)')) part.inert = !summary;
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
      toast(await act(summary.id, shownSpec()));
      byId('copy-menu').open = false;
    } catch (error) {
      problems.show(error);
    }
  });
}

const copied = async (done, what) => ((await done) ? `${what} copied` : `${what} could not be copied`);
const kCopies = { link: 'Link', curl: 'curl command', python: 'Python code', img: 'Image tag', cli: 'Command line' };
for (const [what, name] of Object.entries(kCopies)) onButton(`copy-${what}`, (id, spec) => copied(copySnippet(what, id, spec), name));
onButton('save-png', async (id, spec) => (await download(id, spec, 'png'), 'PNG saved'));
byId('record').addEventListener('click', async () => {
  const { toggleRecording } = await import('./record_button.mjs');
  const { summary } = store.state;
  const seen = summary && { summary, spec: shownSpec(), orbit: orbitInForce(store.state), lens: lens() };
  if (seen) toggleRecording(byId('record'), seen, { toast, problems });
});
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
