// One control of the panel for each field of fields.mjs: it shows what is in force, and what is set by hand can be
// given back to the default.

import { hexOf, linearOf } from './color_math.mjs';
import { element } from './dom.mjs';
import { pointerOf } from './paths.mjs';

let serial = 0;

export function createControl(field, store) {
  const id = `field-${(serial += 1)}`;
  const { node, show } = inputOf(field, store, id);
  const reset = element(
    'button',
    { class: 'reset', type: 'button', title: 'Back to the default', 'aria-label': `${field.label}: back to the default`, onclick: () => clear(field, store) },
    '↺',
  );
  const isGroup = Boolean(field.choices);
  const label = element(isGroup ? 'span' : 'label', { class: 'label', id: `${id}-label`, for: isGroup ? null : id }, field.label);
  if (field.unit) label.append(element('span', { class: 'unit' }, ` ${field.unit}`));
  const row = element(
    'div',
    { class: `field ${kindOf(field)}`, 'data-pointer': pointerOf(field.path), title: field.says },
    element('div', { class: 'caption' }, label, reset),
    node,
    element('p', { class: 'problem', role: 'alert', hidden: true }),
  );
  store.subscribe(() => {
    row.hidden = field.needs ? !field.needs(store) : false;
    row.classList.toggle('set', !field.keeps && isSet(field, store));
    show(field.value ? field.value(store) : (store.effective(field.path) ?? field.absent));
  });
  return row;
}

const kindOf = ({ toggle, slider, whole }) => (toggle ? 'toggle' : slider ? 'slider' : whole ? 'choice whole' : 'choice');

const isSet = ({ sizes, path }, store) => (sizes ? store.isSet('width') : store.isSet(path));

function clear({ sizes, clears, path }, store) {
  for (const each of sizes ? ['width', 'height'] : [clears ?? path]) store.clearSpec(each);
}

function inputOf(field, store, id) {
  if (field.toggle) return toggle(field, store, id);
  if (field.slider) return slider(field, store, id);
  if (field.choices) return choices(field, store, id);
  if (field.sizes) return sizes(field, store, id);
  if (field.options) return select(field, store, id);
  if (field.vector) return vector(field, store, id);
  if (field.color) return color(field, store, id);
  if (field.date) return date(field, store, id);
  return number(field, store, id);
}

function toggle({ path, choose }, store, id) {
  const set = () => (choose ? choose(node.checked, store) : store.setSpec(path, node.checked));
  const node = element('input', { type: 'checkbox', role: 'switch', id, onchange: set });
  return { node, show: (value) => (node.checked = value ?? false) };
}

function numberInput(id, label, onvalue) {
  const node = element('input', { type: 'number', step: 'any', id, 'aria-label': label, inputmode: 'decimal' });
  node.addEventListener('input', () => Number.isFinite(node.valueAsNumber) && onvalue(node.valueAsNumber));
  const show = (value) => {
    if (document.activeElement !== node && value !== undefined) node.value = Number(Number(value).toPrecision(6));
  };
  return { node, show };
}

export function slider({ path, label, log, slider: ends, ...field }, store, id) {
  const set = (value) => (field.choose ? field.choose(value, store) : store.setSpec(path, value));
  const [, , step] = ends;
  const along = log ? Math.log10 : (value) => value; // a value's place on the slider
  const [min, max] = ends.slice(0, 2).map(along);
  const valueAt = (place) => (log ? Number((10 ** place).toPrecision(2)) : place);
  const range = element('input', { type: 'range', min, max, step, id, oninput: () => set(valueAt(range.valueAsNumber)) });
  const exact = numberInput(null, `${label}, exact`, set);
  const show = (value) => {
    if (value === undefined) return;
    const place = along(value);
    range.value = place;
    if (log) range.setAttribute('aria-valuetext', String(value));
    const share = (at) => ((Math.min(max, Math.max(min, at)) - min) / (max - min)) * 100;
    const [from, to] = [share(log ? min : 0), share(place)].sort((a, b) => a - b); // filled from zero, wherever that is
    range.style.setProperty('--from', `${from}%`);
    range.style.setProperty('--to', `${to}%`);
    exact.show(value);
  };
  return { node: element('div', { class: 'pair' }, range, exact.node), show };
}

const number = ({ path, label }, store, id) => numberInput(id, label, (value) => store.setSpec(path, value));

function vector({ path, label }, store, id) {
  const set = (axis) => (value) => store.setSpec(`${path}.${axis}`, value);
  const parts = ['x', 'y', 'z'].map((name, axis) => numberInput(axis ? null : id, `${label}, ${name}`, set(axis)));
  const node = element('div', { class: 'triple' }, ...parts.map((part) => part.node));
  return { node, show: (value) => parts.forEach((part, axis) => part.show(value?.[axis])) };
}

function color({ path, choose }, store, id) {
  const set = (value) => (choose ? choose(value, store) : store.setSpec(path, value));
  const node = element('input', { type: 'color', id, oninput: () => set(linearOf(node.value)) });
  return { node, show: (value) => value && (node.value = hexOf(value)) };
}

function date({ choose }, store, id) {
  const node = element('input', { type: 'date', id, min: '1900-01-02', max: '2100-12-30', oninput: () => node.validity.valid && node.value && choose(node.value, store) });
  const show = (value) => {
    if (document.activeElement !== node) node.value = value;
  };
  return { node, show };
}

// `options(store)`: [[value, text]], the first of them for nothing.
function select({ options, choose }, store, id) {
  const node = element('select', { id, onchange: () => choose(node.value, store) });
  let shown = '';
  const show = (value) => {
    const list = options(store);
    if (JSON.stringify(list) !== shown) node.replaceChildren(...list.map(([each, text]) => element('option', { value: each }, text)));
    shown = JSON.stringify(list);
    node.value = value ?? list[0]?.[0] ?? '';
  };
  return { node, show };
}

export function choices({ path, label, choices: list, choose }, store, id) {
  const pick = (value) => (choose ? choose(value, store) : store.setSpec(path, value));
  const radios = list.map(([value]) => element('input', { type: 'radio', name: id, onchange: () => pick(value) }));
  const parts = list.map(([, text, says], i) => element('label', { title: says }, radios[i], element('span', {}, text)));
  const node = element('div', { class: 'segments', role: 'radiogroup', 'aria-label': label }, ...parts);
  const show = (value) => radios.forEach((radio, i) => (radio.checked = list[i][0] === value));
  return { node, show };
}

function sizes({ sizes: list }, store, id) {
  const options = list.map(([w, h]) => element('option', { value: `${w}x${h}` }, `${w} × ${h}`));
  const node = element('select', { id }, element('option', { value: '' }, 'As large as the window'), ...options);
  node.addEventListener('change', () => {
    const [width, height] = node.value.split('x').map(Number);
    const spec = { ...store.state.spec, width, height };
    if (!node.value) {
      delete spec.width;
      delete spec.height;
    }
    store.update({ spec });
  });
  const show = () => {
    const { width, height } = store.state.spec;
    node.value = width ? `${width}x${height}` : '';
  };
  return { node, show };
}
