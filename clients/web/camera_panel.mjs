// Orbit by hand, or a camera of the scene; and its lens.

import { createControl } from './controls.mjs';
import { element, short } from './dom.mjs';

const kLens = { path: 'camera.perspective.fovYDegrees', label: 'Lens', unit: '°', says: 'Full vertical angle of view', slider: [5, 120, 0.5], clears: 'camera.perspective', needs: (store) => !store.effective('camera.orthographic') };

// As a request asks for a camera of the file, whatever its name.
export const cameraName = ({ node }) => `node:${node}`;

// `fit()` gives the orbit of the whole scene.
export function createCameraPanel(store, fit) {
  const list = element('select', { id: 'camera-node', 'aria-label': 'Camera' });
  const button = element('button', { type: 'button', class: 'quiet', onclick: fit, title: 'Show the whole scene (F)' }, 'Fit');
  const readout = element('p', { class: 'readout' });
  list.addEventListener('change', () => {
    if (list.value === '') fit();
    else store.setSpec('camera', { node: list.value });
  });
  const node = element(
    'div',
    { class: 'field whole', 'data-pointer': '/camera' },
    element('div', { class: 'pair' }, list, button),
    readout,
    element('p', { class: 'problem', role: 'alert', hidden: true }),
  );

  let shown;
  store.subscribe(({ spec, summary }) => {
    if (summary !== shown) {
      shown = summary;
      const cameras = (summary?.cameras ?? []).map((camera) => element('option', { value: cameraName(camera) }, camera.name || `Camera at node ${camera.node}`));
      list.replaceChildren(element('option', { value: '' }, 'Orbit by hand'), ...cameras);
    }
    list.value = spec.camera?.node ?? '';
    readout.textContent = readoutOf(spec.camera?.orbit);
  });
  return element('div', {}, node, createControl(kLens, store));
}

function readoutOf(orbit) {
  if (!orbit) return '';
  const { azimuthDegrees, elevationDegrees, distance, target } = orbit;
  const way = `${azimuthDegrees.toFixed(1)}° · ${elevationDegrees.toFixed(1)}°`;
  return target && distance ? `${way} · ${short(distance)} m from ${target.map((v) => short(v)).join(' ')}` : `${way} · the whole scene`;
}
