// Brings another volume into the scene, and fits its density to the values in the file.

import { element } from './dom.mjs';
import { chosenFiles } from './drop_files.mjs';
import { scaledTo } from './volume_math.mjs';

// `add(files)` uploads the scene once more, with these beside it.
export function createVolumePanel(store, add) {
  const input = element('input', { type: 'file', multiple: true, hidden: true, accept: '.npy,.vdb' });
  input.addEventListener('change', async () => {
    await add(chosenFiles(input.files));
    input.value = '';
  });
  const button = element('button', { type: 'button', onclick: () => input.click() }, 'Add a grid…');
  store.subscribe(({ freshVolume, report, spec }, before) => {
    const values = report !== before.report && report?.volumes[0]?.values;
    if (freshVolume && values && spec.volumes) store.update({ freshVolume: false, spec: { ...spec, volumes: scaledTo(values, spec.volumes) } });
  });
  const says = element('p', { class: 'fact' }, 'Clouds, smoke or fog from a .npy or .vdb file beside the scene.');
  return element('div', { class: 'tail' }, says, element('div', { class: 'pair' }, button, input));
}
