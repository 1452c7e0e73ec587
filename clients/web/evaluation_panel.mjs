// Measures many settings of the present view, and shows them as they come in a chart whose points can be taken.

import { evaluate } from './api.mjs';
import { pointsOf } from './chart_math.mjs';
import { element, short, svgElement } from './dom.mjs';
import { percent } from './error_numbers.mjs';
import { merged } from './merge_patch.mjs';

const kSweeps = [['techniques', 'Techniques'], ['filters', 'Filters'], ['sizes', 'Tile sizes and cascades'], ['all', 'All of these']];
const kBox = { left: 64, top: 22, width: 228, height: 138 }; // room around it for the longest labels
const decade = (power) => String(Number((10 ** power).toPrecision(1)));

// `specOf()`: the sharp spec of the present state.
export function createEvaluationPanel(store, { specOf, problems, announce }) {
  let running = null; // AbortController
  const sweep = element('select', { 'aria-label': 'What is compared' }, ...kSweeps.map(([value, text]) => element('option', { value }, text)));
  const button = element('button', { type: 'button', onclick: () => (running ? running.abort() : run()) }, 'Measure');
  const progress = element('progress', { max: 1, value: 0, hidden: true, 'aria-label': 'Evaluation' });
  const chart = svgElement('svg', { class: 'chart', viewBox: '0 0 308 196', role: 'group', 'aria-label': 'Error over time of each setting' });
  const says = element('p', { class: 'fact', role: 'status' }, 'Speed against error of many settings, for this very view.');
  chart.toggleAttribute('hidden', true);

  async function run() {
    const mine = new AbortController();
    const rows = [];
    running = mine;
    button.textContent = 'Cancel';
    progress.hidden = false;
    progress.value = 0;
    const { quality, views, ...spec } = specOf();
    try {
      const listeners = {
        progress: ({ done, of }) => (progress.value = done / of),
        row: (row) => {
          rows.push(row);
          draw(rows);
        },
      };
      const report = await evaluate(store.state.summary.id, { spec, sweep: sweep.value, repeats: 3 }, listeners, mine.signal);
      draw(report.rows);
      const best = report.rows.filter(({ pareto }) => pareto).length;
      says.textContent = `${report.rows.length} settings; no other beats the ${best} on the line. Click a point to take it.`;
      announce(says.textContent);
    } catch (error) {
      if (error.name !== 'AbortError') problems.show(error);
    }
    progress.hidden = true;
    button.textContent = 'Measure';
    running = null;
  }

  function take(row) {
    store.update({ spec: merged(store.state.spec, row.variant) });
    says.textContent = `Taken: ${row.name}.`;
  }

  function point({ row, x, y }) {
    const text = `${row.name}: ${row.milliseconds === undefined ? 'not timed yet' : `${short(row.milliseconds)} ms`}, ${percent(row.metrics.misclassified)} wrong`;
    const show = () => (says.textContent = text);
    const node = svgElement(
      'circle',
      { cx: kBox.left + (x ?? 0) * kBox.width, cy: kBox.top + (1 - y) * kBox.height, r: row.pareto ? 5.5 : 4.5, class: `point${row.pareto ? ' best' : ''}${x === null ? ' untimed' : ''}`, tabindex: 0, role: 'button', 'aria-label': text, onclick: () => take(row), onpointerenter: show, onfocus: show },
      svgElement('title', {}, text),
    );
    node.addEventListener('keydown', (event) => {
      if (event.key !== 'Enter' && event.key !== ' ') return;
      event.preventDefault();
      take(row);
    });
    return node;
  }

  function draw(rows) {
    const { x, y, points } = pointsOf(rows);
    const front = points.filter(({ row }) => row.pareto).sort((a, b) => a.x - b.x).map((p) => `${kBox.left + p.x * kBox.width},${kBox.top + (1 - p.y) * kBox.height}`);
    const lines = svgElement('polyline', { points: front.join(' '), class: 'front' });
    chart.toggleAttribute('hidden', false);
    chart.replaceChildren(...axes(x, y), lines, ...points.map(point));
  }

  store.subscribe(({ summary }, before) => {
    if (summary === before.summary) return;
    running?.abort();
    chart.toggleAttribute('hidden', true);
  });
  return element('div', {}, element('div', { class: 'pair' }, sweep, button), progress, chart, says);
}

function axes(x, y) {
  const text = (attributes, words) => svgElement('text', attributes, words);
  const marks = ([low, high]) => Array.from({ length: high - low + 1 }, (_, i) => low + i);
  const { left, top, width, height } = kBox;
  return [
    ...marks(x).flatMap((power, i, all) => {
      const at = left + (i / (all.length - 1)) * width;
      return [svgElement('line', { class: 'grid', x1: at, x2: at, y1: top, y2: top + height }), text({ x: at, y: top + height + 18, 'text-anchor': 'middle' }, decade(power))];
    }),
    ...marks(y).flatMap((power, i, all) => {
      const at = top + (1 - i / (all.length - 1)) * height;
      return [svgElement('line', { class: 'grid', x1: left, x2: left + width, y1: at, y2: at }), text({ x: left - 6, y: at + 4, 'text-anchor': 'end' }, `${i ? '' : '≤ '}${decade(power + 2)} %`)];
    }),
    text({ x: left + width / 2, y: top + height + 33, 'text-anchor': 'middle' }, 'milliseconds'),
    text({ x: left - 6, y: top - 10, 'text-anchor': 'end' }, 'wrong'),
  ];
}
