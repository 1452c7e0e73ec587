// How wrong the shadow is, as numbers beside the picture: what the plan predicts, and what rays find when asked.

import { renderFrame } from './api.mjs';
import { element } from './dom.mjs';
import { measuredNumbers, predictedNumbers } from './error_numbers.mjs';

// `specOf()`: the sharp spec of the present state.
export function createErrorPanel(store, { specOf, problems, announce }) {
  let running = null; // AbortController
  let measured = null; // {of: the report it belongs to, error}
  const list = element('dl', { class: 'numbers' });
  const button = element('button', { type: 'button', title: 'Trace this frame’s shadow with rays, and compare', onclick: () => (running ? running.abort() : measure()) }, 'Measure');
  const node = element('div', { class: 'error-card', role: 'group', 'aria-label': 'Error of the shadow', hidden: true }, list, button);

  async function measure() {
    const { state } = store;
    running = new AbortController();
    button.textContent = 'Cancel';
    announce('Measuring the error');
    try {
      const { report } = await renderFrame(state.summary.id, { ...specOf(), views: ['error'] }, running.signal);
      if (store.state.spec === state.spec) measured = { of: store.state.spec, error: report.error };
      announce(measured?.error ? 'The error is measured' : 'No light casts a shadow here');
    } catch (error) {
      if (error.name !== 'AbortError') problems.show(error);
    }
    running = null;
    button.textContent = 'Measure';
    show(store.state);
  }

  function show({ report, spec, summary }) {
    const error = report?.error ?? (measured?.of === spec ? measured.error : null);
    const known = [...predictedNumbers(report?.predictedError), ...measuredNumbers(error)];
    const rows = known.length ? known : [['Error', 'not measured yet', 'Estimated only for shadow maps in view']];
    list.replaceChildren(...rows.flatMap(([name, value, says]) => [element('dt', { title: says }, name), element('dd', {}, value)]));
    node.hidden = !summary || !report;
    node.classList.toggle('bad', (error?.misclassified ?? 0) > 0.02);
  }

  store.subscribe((state, before) => {
    if (state.spec !== before.spec || state.summary !== before.summary) running?.abort();
    show(state);
  });
  return node;
}
