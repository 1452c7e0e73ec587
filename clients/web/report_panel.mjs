// What the frame's report says about each light's tiles or light map, and its warnings.

import { count, element, short } from './dom.mjs';
import { kTints } from './fields.mjs';

export function showReport(node, report) {
  node.replaceChildren(...report.lights.map(lightOf), surroundingsOf(report), ...report.volumes.map(volumeOf), ...report.warnings.map((text) => element('p', { class: 'warning' }, text)));
}

function lightOf(light) {
  const rows = light.tiles.map((tile, i) => {
    const dot = element('i', { 'aria-hidden': 'true' });
    dot.style.background = kTints[i % kTints.length];
    return element(
      'tr',
      {},
      element('th', { scope: 'row' }, dot, String(i)),
      element('td', {}, `${short(tile.near)} – ${short(tile.far)}`),
      element('td', {}, tile.tile[2] ? `${tile.tile[2]}²` : '–'),
      element('td', {}, tile.tile[2] ? short(Math.max(...tile.texelSize) * 1000) : '–'),
      element('td', { title: `${count(tile.culledTriangles)} culled` }, count(tile.casterTriangles)),
    );
  });
  const head = [['no.', 'Number of the cascade or face'], ['metres', 'View depth; for a spot or point light, distance from it'], ['tile', 'Texels'], ['mm', 'Size of a texel in the world'], ['tri', 'Caster triangles drawn']];
  const table = element(
    'table',
    {},
    element('thead', {}, element('tr', {}, ...head.map(([text, says]) => element('th', { scope: 'col', title: says }, text)))),
    element('tbody', {}, ...rows),
  );
  return element(
    'div',
    { class: 'light-report' },
    light.choice && element('p', { class: 'fact' }, `${light.choice.technique === 'rayTraced' ? 'Rays' : 'Map'}: ${light.choice.why}`),
    light.note && element('p', { class: 'note' }, light.note),
    light.lightMap && element('p', { class: 'fact' }, mapOf(light.lightMap)),
    rows.length ? table : null,
  );
}

function surroundingsOf({ environment }) {
  if (!environment) return '';
  const { width, height, sun } = environment;
  const sunsWords = sun ? `a sun of ${short(sun.lux)} lux, ${short(sun.angularDiameterDegrees)}° wide` : 'no sun in it';
  return element('p', { class: 'fact' }, `Surroundings: ${width ? `${width} × ${height} texels` : 'a computed sky'}, ${sunsWords}.`);
}

function volumeOf({ voxels, values, reused, lightMilliseconds }) {
  const made = `its light made ${reused ? 'before' : 'now'} in ${short(lightMilliseconds)} ms`;
  return element('p', { class: 'fact' }, `Volume: ${voxels.join(' × ')} voxels of ${short(values[0])} to ${short(values[1])}, ${made}.`);
}

function mapOf(lightMap) {
  const made = `baked ${lightMap.reused ? 'before' : 'now'} in ${short(lightMap.bakeMilliseconds)} ms`;
  return `Light map: ${texelsOf(lightMap)}, ${made}.`;
}

export const texelsOf = ({ width, height, texelsPerMetre }) => `${width} × ${height} texels, ${short(texelsPerMetre)} a metre`;
