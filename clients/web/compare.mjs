// Two settings side by side: A is kept, B is what the panel says; a handle divides the picture, with their difference,
// or the error of either, between the two.

import { renderFrame } from './api.mjs';
import { differenceOf } from './difference.mjs';
import { element, short } from './dom.mjs';
import { percent } from './error_numbers.mjs';

const kBetween = [['difference', 'Difference'], ['errorA', 'Error of A'], ['errorB', 'Error of B'], ['', 'Nothing']];
const kBand = 0.1; // of the stage's width to each side of the handle

const urlOf = ({ contentType, data }) => `data:${contentType};base64,${data}`;

async function pixelsOf(image, width, height) {
  const canvas = element('canvas', { width, height });
  const context = canvas.getContext('2d', { willReadFrequently: true });
  context.drawImage(image, 0, 0, width, height);
  return context.getImageData(0, 0, width, height);
}

// `picture`: the image that shows B; `specOf()`: the sharp spec of the present state.
export function createCompare(store, { picture, specOf, problems, announce }) {
  let kept = null; // spec of A
  let at = 0.5;
  let work = null; // AbortController
  const a = element('img', { class: 'compare-a', alt: '' });
  const between = element('canvas', { class: 'compare-between' });
  const handle = element('button', { type: 'button', class: 'compare-handle', role: 'slider', 'aria-label': 'Divide between A and B', 'aria-valuemin': 0, 'aria-valuemax': 100 }, element('span', {}, 'A'), element('span', {}, 'B'));
  const choice = element('select', { 'aria-label': 'Between A and B', onchange: () => refresh() }, ...kBetween.map(([value, text]) => element('option', { value }, text)));
  const says = element('span', { class: 'compare-says', role: 'status' });
  const swap = element('button', { type: 'button', title: 'B takes the settings of A, and A those of B', onclick: () => exchange() }, 'Swap');
  const bar = element('div', { class: 'compare-bar' }, choice, swap, says);
  const layer = element('div', { class: 'compare', hidden: true }, a, between, handle, bar);

  function set(next) {
    at = Math.min(1, Math.max(0, next));
    layer.style.setProperty('--at', `${100 * at}%`);
    layer.style.setProperty('--band-left', `${100 * Math.max(0, at - kBand)}%`);
    layer.style.setProperty('--band-right', `${100 * (1 - Math.min(1, at + kBand))}%`);
    handle.setAttribute('aria-valuenow', String(Math.round(100 * at)));
  }

  handle.addEventListener('pointerdown', (event) => handle.setPointerCapture(event.pointerId));
  handle.addEventListener('pointermove', (event) => {
    if (!handle.hasPointerCapture(event.pointerId)) return;
    const box = layer.getBoundingClientRect();
    set((event.clientX - box.left) / box.width);
  });
  handle.addEventListener('keydown', (event) => {
    const by = { ArrowLeft: -0.02, ArrowRight: 0.02, ArrowDown: -0.02, ArrowUp: 0.02, Home: -1, End: 1 }[event.key];
    if (!by) return;
    event.preventDefault();
    event.stopPropagation();
    set(at + by);
  });

  // A follows the camera of B.
  const specOfA = () => {
    const { camera, width, height, views, animation } = specOf();
    return { ...kept, camera, width, height, views, ...(animation && { animation }) };
  };

  async function refresh() {
    work?.abort();
    if (!kept) return;
    work = new AbortController();
    const { signal } = work;
    const { id } = store.state.summary;
    try {
      const frame = await renderFrame(id, specOfA(), signal);
      a.src = urlOf(frame.images[0]);
      await a.decode();
      await fillBetween(id, signal);
      layer.classList.remove('waiting');
    } catch (error) {
      if (error.name !== 'AbortError' && !signal.aborted) problems.show(error);
    }
  }

  async function fillBetween(id, signal) {
    const [width, height] = [a.naturalWidth, a.naturalHeight];
    between.width = width;
    between.height = height;
    between.hidden = !choice.value;
    says.textContent = '';
    if (choice.value === 'difference') {
      const [one, other] = await Promise.all([pixelsOf(a, width, height), pixelsOf(picture, width, height)]);
      const { map, visible, mean } = differenceOf(one.data, other.data);
      between.getContext('2d').putImageData(new ImageData(map, width, height), 0, 0);
      says.textContent = `${percent(visible)} of the pixels differ, on average by ${short(Number(mean.toFixed(2)))} of 255`;
    } else if (choice.value) {
      const spec = choice.value === 'errorA' ? specOfA() : specOf();
      const { report, images } = await renderFrame(id, { ...spec, views: ['error'] }, signal);
      const image = new Image();
      image.src = urlOf(images[0]);
      await image.decode();
      between.getContext('2d').drawImage(image, 0, 0, width, height);
      if (report.error) says.textContent = `${percent(report.error.misclassified)} wrong`;
    }
  }

  function exchange() {
    const { camera, ...other } = kept;
    kept = specOf();
    const { views, width, height, ...next } = other;
    store.update({ spec: { ...next, camera: store.state.spec.camera } });
  }

  function toggle(on) {
    kept = on ? specOf() : null;
    layer.hidden = !on;
    set(0.5);
    announce(on ? 'The present settings are A. Change any, to compare.' : 'The comparison is closed');
    if (on) refresh();
    else work?.abort();
  }

  // A belongs to the picture that is sharp: while drafts are shown, B is shown alone.
  store.subscribe((state, before) => {
    if (state.summary !== before.summary && kept) toggle(false);
    if (state.spec === before.spec && state.view === before.view) return;
    work?.abort();
    layer.classList.add('waiting');
  });
  return { node: layer, toggle, refresh, isOn: () => Boolean(kept) };
}
