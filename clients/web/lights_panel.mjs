// The lights as a list, each edited in place; lights are added and taken away here.

import { createControl } from './controls.mjs';
import { element } from './dom.mjs';
import { lightsInForce, nameOfLight, newLight, retyped, withShadow } from './light_list.mjs';

const kTypes = [['directional', 'Sun'], ['spot', 'Spot'], ['point', 'Point']];
const kMostLights = 16; // that the page edits; the server takes more

export function createLightsPanel(store) {
  const rows = [];
  const list = element('div', { class: 'light-rows' });
  const adds = kTypes.map(([type, name]) => element('button', { type: 'button', onclick: () => add(type) }, `+ ${name}`));
  const edit = element('button', { type: 'button', onclick: () => store.setSpec('lights', lightsInForce(store.state)) }, 'Edit these lights');
  const note = element('p', { class: 'fact' });

  function add(type) {
    const lights = lightsInForce(store.state);
    store.setSpec('lights', [...lights, newLight(type, store.state)]);
    rows[lights.length].setAttribute('open', '');
    rows[lights.length].querySelector('summary').focus();
  }

  store.subscribe((state) => {
    const lights = state.spec.lights;
    const shown = lights ?? lightsInForce(state);
    for (let i = rows.length; i < Math.min(kMostLights, lights?.length ?? 0); i += 1) list.append((rows[i] = createRow(store, i)));
    edit.hidden = Boolean(lights) || !shown.length;
    note.textContent = lights ? '' : shown.map(nameOfLight).join(', ');
    note.hidden = Boolean(lights);
    for (const button of adds) button.disabled = (lights?.length ?? 0) >= kMostLights;
  });
  return element('div', { class: 'lights' }, note, list, element('div', { class: 'pair wrap' }, edit, ...adds));
}

function createRow(store, index) {
  const path = `lights.${index}`;
  const light = () => store.state.spec.lights?.[index];
  const put = (next) => store.setSpec(path, next);
  const isLamp = () => ['spot', 'point'].includes(light()?.type);
  const is = (type) => () => light()?.type === type;
  const fields = [
    { path: `${path}.type`, label: 'Type', choices: kTypes, choose: (type) => put(retyped(light(), type, store.state)), absent: 'directional', keeps: true },
    { path: `${path}.intensity`, label: 'Intensity', says: 'Lux of a sun, candela of a lamp', log: true, slider: [0.1, 10000, 0.01], absent: 3 },
    { path: `${path}.color`, label: 'Color', color: true, absent: [1, 1, 1] },
    { path: `${path}.angularDiameterDegrees`, label: 'Size', unit: '°', says: 'Angle of its disc, 0.53 for the real sun; exact shadows, baked ones and PCSS are soft by it', slider: [0, 10, 0.01], absent: 0, needs: () => !isLamp() },
    { path: `${path}.radius`, label: 'Size', unit: 'm', says: 'Radius of the glowing ball', slider: [0, 2, 0.01], absent: 0, needs: isLamp },
    { path: `${path}.position`, label: 'Position', unit: 'm', vector: true, needs: isLamp, keeps: true },
    { path: `${path}.direction`, label: 'Direction', says: 'In which its light travels', vector: true, needs: () => Boolean(light()?.direction), keeps: true },
    { path: `${path}.sun.azimuthDegrees`, label: 'Azimuth', unit: '°', slider: [0, 360, 0.5], needs: () => index > 0 && Boolean(light()?.sun), keeps: true },
    { path: `${path}.sun.elevationDegrees`, label: 'Elevation', unit: '°', slider: [0, 90, 0.5], needs: () => index > 0 && Boolean(light()?.sun), keeps: true },
    { path: `${path}.innerConeDegrees`, label: 'Inner cone', unit: '°', slider: [0, 89, 1], absent: 0, needs: is('spot') },
    { path: `${path}.outerConeDegrees`, label: 'Outer cone', unit: '°', slider: [1, 89, 1], absent: 45, needs: is('spot') },
    { path: `${path}.range`, label: 'Range', unit: 'm', says: 'Beyond it the light has no effect', needs: isLamp },
    { path: `${path}.shadow.enabled`, label: 'Casts shadow', toggle: true, absent: true, keeps: true, value: () => light()?.shadow?.enabled ?? true, choose: (on) => put(withShadow(light(), on)) },
  ];
  const title = element('span', {});
  const remove = element('button', { type: 'button', class: 'quiet', onclick: () => store.setSpec('lights', store.state.spec.lights.filter((_, i) => i !== index)) }, 'Remove this light');
  const row = element('details', { class: 'light-row' }, element('summary', {}, title), ...fields.map((field) => createControl(field, store)), remove);
  store.subscribe(() => {
    row.hidden = !light();
    if (light()) title.textContent = nameOfLight(light(), index);
    remove.disabled = (store.state.spec.lights?.length ?? 0) < 2;
  });
  return row;
}
