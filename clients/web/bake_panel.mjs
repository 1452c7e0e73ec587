// Bakes the light map of the present lights, and of the environment where it throws shadows, ahead of the frames, and takes it along as a file.

import { bakeAhead, bakeFile } from './api.mjs';
import { element, short } from './dom.mjs';
import { texelsOf } from './report_panel.mjs';
import { saveFile } from './share.mjs';

const kFiles = [
  ['PNG', 'image/png', 'png', 'The share of the first light that arrives, in grey'],
  ['EXR', 'image/x-exr', 'exr', 'The share of each light in floats, a layer for each'],
  ['GLB', 'model/gltf-binary', 'glb', 'The scene with its light map in it, for viewers that know MOZ_lightmap'],
];

// `specOf()`: what is to be baked, whatever its technique; `done()` once it is; `problems` shows what is refused.
export function createBakePanel(store, { specOf, done, problems }) {
  let running = null; // AbortController
  let baked = null; // {sceneId, key}
  const button = element('button', { type: 'button', onclick: () => (running ? running.abort() : bake()) }, 'Bake');
  const progress = element('progress', { max: 1, value: 0, hidden: true, 'aria-label': 'Bake' });
  const text = element('p', { class: 'fact', role: 'status', hidden: true });
  const files = kFiles.map(([name, type, ending, says]) => element('button', { type: 'button', title: says, onclick: () => save(type, ending) }, name));
  const take = element('div', { class: 'pair', hidden: true, role: 'group', 'aria-label': 'Download the light map' }, ...files);

  function show(words) {
    text.textContent = words;
    text.hidden = !words;
  }

  function follow({ done: finished, of, share }) {
    progress.value = (finished + share) / of;
    show(`${of > 1 ? `Light ${finished + 1} of ${of}, ` : ''}${Math.round(100 * share)} %`);
  }

  async function bake() {
    const mine = new AbortController();
    const { id } = store.state.summary;
    running = mine;
    baked = null;
    take.hidden = true;
    progress.hidden = false;
    progress.value = 0;
    button.textContent = 'Cancel';
    show('Starting');
    try {
      const report = await bakeAhead(id, specOf(), follow, mine.signal);
      baked = { sceneId: id, key: report.key };
      const maps = report.lights.map(({ lightMap }) => lightMap).concat(report.environment ?? []);
      show(maps.map(bakedText).join(' '));
      take.hidden = false;
      done();
    } catch (error) {
      show(error.name === 'AbortError' ? 'Cancelled' : '');
      if (error.name !== 'AbortError') problems.show(error);
    }
    progress.hidden = true;
    button.textContent = 'Bake';
    running = null;
  }

  async function save(type, ending) {
    try {
      saveFile(await bakeFile(baked.sceneId, baked.key, type), `gnomon-light-map.${ending}`);
    } catch (error) {
      problems.show(error);
    }
  }

  store.subscribe(({ summary }, before) => {
    button.disabled = !summary;
    if (summary === before.summary) return;
    running?.abort();
    baked = null;
    take.hidden = true;
    show('');
  });
  return element('div', { class: 'tail bake' }, element('div', { class: 'pair' }, button, progress), text, take);
}

function bakedText(lightMap) {
  const { reused, bakeMilliseconds } = lightMap;
  return `${texelsOf(lightMap)}, baked ${reused ? 'before ' : ''}in ${short(bakeMilliseconds / 1000)} s.`;
}
