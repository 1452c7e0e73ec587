// Which scene is shown: a list of those that the server has, an upload by button or by drop, and what the scene holds.

import { Refusal, scenePages, uploadScene } from './api.mjs';
import { count, element, short } from './dom.mjs';
import { chosenFiles, droppedFiles } from './drop_files.mjs';
import { nameOf, rememberName } from './scene_names.mjs';
import { isPanorama } from './surroundings_math.mjs';
import { isGrid } from './volume_math.mjs';

// `pick(summary, {added, panorama})` when another scene is to be shown: `added` is the name of a file that the present
// one has got, `panorama` that of a picture that came with a new one; `fail(error)` for what goes wrong.
export function createScenePanel({ list, button, input, progress, facts, dropZone, pick, fail }) {
  let scenes = [];
  const sources = new Map(); // what was uploaded from here, by the scene's id

  async function load(wantedId) {
    try {
      scenes = [];
      for await (const page of scenePages()) scenes.push(...page);
    } catch (error) {
      return fail(error);
    }
    fillList();
    const wanted = scenes.find(({ id }) => id === wantedId);
    if (wantedId && !wanted) fail(new Refusal(404, 'The scene of this link is not on this server.', []));
    const first = wanted ?? scenes[0];
    if (first) show(first);
  }

  function fillList() {
    list.replaceChildren(...scenes.map(({ id, triangles }) => element('option', { value: id }, `${nameOf(id)} · ${count(triangles)} tri`)));
    list.disabled = !scenes.length;
    if (!scenes.length) list.append(element('option', {}, 'No scene yet'));
  }

  function show(summary, files = {}) {
    list.value = summary.id;
    facts.replaceChildren(...factsOf(summary));
    pick(summary, files);
  }

  // A scene is all of its upload, so that the same files go up again, with these.
  async function addFiles(files) {
    const own = sources.get(list.value);
    if (!own) return fail(new Refusal(0, 'The files of this scene were not chosen on this page. Choose or drop them together with what is added.', []));
    await upload([...own.filter(({ name }) => !files.some((file) => file.name === name)), ...files], files[0].name);
  }

  async function upload(files, added) {
    if (!files.length) return;
    if (files.every(isAdded)) return addFiles(files);
    progress.hidden = false;
    progress.value = 0;
    button.disabled = true;
    try {
      const summary = await uploadScene(files, (share) => {
        if (share < 1) progress.value = share;
        else progress.removeAttribute('value'); // sent: now the server reads it
      });
      rememberName(summary.id, files.find(({ name }) => /\.(glb|gltf)$/i.test(name)).name.split('/').pop());
      sources.set(summary.id, files);
      scenes = [summary, ...scenes.filter(({ id }) => id !== summary.id)];
      fillList();
      show(summary, { added, panorama: !added && files.some(isPanorama) ? summary.environmentFiles?.[0] : undefined });
    } catch (error) {
      fail(error);
    } finally {
      progress.hidden = true;
      button.disabled = false;
    }
  }

  list.addEventListener('change', () => {
    const chosen = scenes.find(({ id }) => id === list.value);
    if (chosen) show(chosen);
  });
  button.addEventListener('click', () => input.click());
  input.addEventListener('change', async () => {
    await upload(chosenFiles(input.files));
    input.value = '';
  });
  acceptDrops(dropZone, upload);
  return { load, addFiles };
}

// What is no scene by itself.
const isAdded = (file) => isGrid(file) || isPanorama(file);

function acceptDrops(zone, upload) {
  const holdsFiles = (event) => event.dataTransfer?.types.includes('Files');
  zone.addEventListener('dragover', (event) => {
    if (!holdsFiles(event)) return;
    event.preventDefault();
    zone.classList.add('dropping');
  });
  zone.addEventListener('dragleave', (event) => {
    if (!zone.contains(event.relatedTarget)) zone.classList.remove('dropping');
  });
  zone.addEventListener('drop', async (event) => {
    if (!holdsFiles(event)) return;
    event.preventDefault();
    zone.classList.remove('dropping');
    upload(await droppedFiles(event.dataTransfer));
  });
}

function factsOf({ triangles, nodes, materials, images, boundsMin, boundsMax, warnings }) {
  const size = boundsMax.map((high, i) => short(high - boundsMin[i])).join(' × ');
  const facts = [
    [`${count(triangles)}`, 'triangles'],
    [`${count(nodes)}`, nodes === 1 ? 'node' : 'nodes'],
    [`${count(materials)}`, materials === 1 ? 'material' : 'materials'],
    [`${count(images)}`, images === 1 ? 'image' : 'images'],
    [size, 'm'],
  ];
  const items = facts.map(([value, name]) => element('li', {}, element('b', {}, value), ` ${name}`));
  if (!warnings.length) return items;
  const list = element('ul', {}, ...warnings.map((text) => element('li', {}, text)));
  return [...items, element('li', { class: 'warnings' }, element('details', {}, element('summary', {}, `${warnings.length} ${warnings.length === 1 ? 'warning' : 'warnings'}`), list))];
}
