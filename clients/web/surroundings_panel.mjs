// Brings a picture of all directions into the scene.

import { element } from './dom.mjs';
import { chosenFiles } from './drop_files.mjs';

// `add(files)` uploads the scene once more, with these beside it.
export function createSurroundingsPanel(store, add) {
  const input = element('input', { type: 'file', hidden: true, accept: '.hdr,.exr' });
  input.addEventListener('change', async () => {
    await add(chosenFiles(input.files));
    input.value = '';
  });
  const button = element('button', { type: 'button', onclick: () => input.click() }, 'Choose a picture…');
  store.subscribe(({ askPanorama }) => {
    if (!askPanorama) return;
    store.update({ askPanorama: false });
    input.click();
  });
  const says = element('p', { class: 'fact' }, 'An .hdr or .exr of all directions, twice as wide as high; or drop it on the page.');
  return element('div', { class: 'tail' }, says, element('div', { class: 'pair' }, button, input));
}
