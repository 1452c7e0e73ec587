// Where the time went: a stacked bar of the stages with their milliseconds, and what was drawn.

import { count, element, short } from './dom.mjs';
import { kStageColors } from './fields.mjs';

const kLeastShare = 0.004; // of the whole: below, a stage has its number but no room in the bar

export function createTimings(node) {
  const bar = element('div', { class: 'stage-bar', role: 'img' });
  const legend = element('ul', { class: 'stage-legend' });
  const facts = element('ul', { class: 'facts' });
  node.append(bar, element('div', { class: 'timing-rows' }, legend, facts));

  return function show(report, roundTripMs) {
    const stages = Object.entries(report.stages).map(([stage, milliseconds]) => ({ stage, milliseconds }));
    const total = stages.reduce((sum, { milliseconds }) => sum + milliseconds, 0);
    bar.setAttribute('aria-label', `Server time ${short(total)} milliseconds`);
    bar.replaceChildren(...stages.filter((stage) => stage.milliseconds > total * kLeastShare).map((stage) => segment(stage, total)));
    legend.replaceChildren(...stages.map(entry), element('li', { class: 'total' }, element('b', {}, `${short(total)} ms`), ' server'));
    facts.replaceChildren(...factsOf(report, roundTripMs).map(([name, value, says]) => element('li', { title: says }, `${name} `, element('b', {}, value))));
  };
}

function segment({ stage, milliseconds }, total) {
  const node = element('span', { title: `${stage}: ${short(milliseconds)} ms` });
  node.style.flexGrow = milliseconds / total;
  node.style.background = kStageColors[stage] ?? '#7a8496';
  return node;
}

function entry({ stage, milliseconds }) {
  const dot = element('i', { 'aria-hidden': 'true' });
  dot.style.background = kStageColors[stage] ?? '#7a8496';
  return element('li', { class: milliseconds < 0.05 ? 'idle' : null }, dot, `${stage} `, element('b', {}, short(Number(milliseconds.toFixed(2)))));
}

function factsOf({ counts, atlasSize, depthRange, lights, spec }, roundTripMs) {
  const tiles = lights.reduce((sum, light) => sum + light.tiles.length, 0);
  const facts = [
    ['frame', `${spec.width} × ${spec.height}`, 'Pixels of this picture'],
    ['round trip', `${short(roundTripMs)} ms`, 'From the request to the decoded reply, as the browser sees it'],
    ['shaded', `${count(counts.shadedTriangles)} of ${count(counts.sceneTriangles)} triangles`, 'Drawn for the surfaces to light, of those in the scene'],
    ['cast', `${count(counts.casterTriangles)}`, 'Triangles drawn into all shadow tiles'],
    ['draws', count(counts.drawCalls), 'Draw calls'],
  ];
  if (atlasSize[0]) facts.push(['atlas', `${atlasSize[0]} × ${atlasSize[1]}, ${tiles} ${tiles === 1 ? 'tile' : 'tiles'}`, 'Texels']);
  if (depthRange[1]) facts.push(['depth', `${short(depthRange[0])} – ${short(depthRange[1])} m`, 'Nearest and farthest surface in view']);
  return facts;
}
