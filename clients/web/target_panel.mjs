// What a target led to: which settings were chosen, what they reach, and what else was tried.

import { element, short } from './dom.mjs';
import { percent } from './error_numbers.mjs';

export function createTargetPanel(store) {
  const says = element('p', { class: 'fact' });
  const keep = element('button', { type: 'button', onclick: () => take(store) }, 'Keep these settings');
  const node = element('div', { class: 'tail' }, says, element('div', { class: 'pair' }, keep));
  store.subscribe(({ report, spec }) => {
    const quality = spec.quality && report?.quality;
    node.hidden = !quality;
    if (!quality) return;
    const { settings, milliseconds, error } = quality.tried[quality.chosen];
    says.textContent = `${quality.met ? 'Chosen' : 'Not reached; nearest'}: ${settings}, ${short(milliseconds)} ms, ${percent(error)} wrong. ${quality.tried.length} settings were measured${quality.cached ? ' before' : ''}.`;
  });
  return node;
}

// The chosen settings as if set by hand.
function take(store) {
  const { report, spec } = store.state;
  const { shadow, atlas } = report.quality.tried[report.quality.chosen];
  const { quality, ...rest } = spec;
  store.update({ spec: { ...rest, shadow, atlas } });
}
