// Where the light comes from: the dome and two exact angles for the sun, the sky's where there is one, or the scene's own
// lights.

import { choices, slider } from './controls.mjs';
import { element } from './dom.mjs';
import { sunInForce, withSun } from './light_math.mjs';
import { orbitInForce } from './orbit_math.mjs';
import { createSkyDome } from './sky_dome.mjs';

const kAzimuth = { path: 'lights.0.sun.azimuthDegrees', label: 'Azimuth', slider: [0, 360, 0.5] };
const kElevation = { path: 'lights.0.sun.elevationDegrees', label: 'Elevation', slider: [0, 90, 0.5] };

export function createSunPanel(store) {
  const setSun = (sun) => store.update({ spec: withSun(store.state, sun) });
  const dome = createSkyDome(setSun);
  const source = choices(
    {
      label: 'Light from',
      choices: [[true, 'Set by hand'], [false, 'The scene’s own']],
      choose: (sun) => (sun ? setSun({}) : store.clearSpec('lights')),
    },
    store,
    'light-source',
  );
  const angles = [angle(kAzimuth, 'azimuthDegrees'), angle(kElevation, 'elevationDegrees')];
  const node = element(
    'div',
    { class: 'sun-panel' },
    element('div', { class: 'field whole', 'data-pointer': '/lights' }, source.node, problemSlot()),
    element('div', { class: 'sun' }, dome.node, element('div', { class: 'angles' }, ...angles.map((control) => control.row))),
  );

  store.subscribe((state) => {
    const { spec, summary } = state;
    const sky = Boolean(spec.environment?.sky);
    const bySun = Boolean(spec.lights);
    const sun = sunInForce(state);
    const orbit = orbitInForce(state);
    source.show(bySun);
    source.node.hidden = sky || (!summary?.lights.length && bySun);
    dome.show(sun, { dimmed: !sky && !spec.lights?.length, headingDegrees: orbit ? orbit.azimuthDegrees + 180 : null });
    for (const control of angles) control.show(sun);
  });
  return node;

  // Not through the store's path: the first touch must set the whole sun.
  function angle(field, key) {
    const proxy = { setSpec: (_, value) => setSun({ [key]: value }) };
    const input = slider(field, proxy, `sun-${key}`);
    const label = element('label', { class: 'label', for: `sun-${key}` }, field.label, element('span', { class: 'unit' }, ' °'));
    const row = element('div', { class: 'field slider', 'data-pointer': `/lights/0/sun/${key} /environment/sky/sun/${key}` }, element('div', { class: 'caption' }, label), input.node, problemSlot());
    return { row, show: (sun) => input.show(sun[key]) };
  }
}

const problemSlot = () => element('p', { class: 'problem', role: 'alert', hidden: true });
