// Elements in one call: element('button', {class: 'quiet', onclick}, 'Fit').

export const element = (name, attributes, ...children) => filled(document.createElement(name), attributes, children);

export const svgElement = (name, attributes, ...children) =>
  filled(document.createElementNS('http://www.w3.org/2000/svg', name), attributes, children);

function filled(node, attributes = {}, children = []) {
  for (const [key, value] of Object.entries(attributes)) {
    if (key.startsWith('on')) node.addEventListener(key.slice(2), value);
    else if (value === true) node.setAttribute(key, '');
    else if (value !== false && value !== null && value !== undefined) node.setAttribute(key, value);
  }
  node.append(...children.filter((child) => child !== null && child !== undefined));
  return node;
}

// Milliseconds, metres and the like: three digits that matter.
export function short(number) {
  if (number === 0) return '0';
  const size = Math.abs(number);
  if (size >= 1e6 || size < 1e-3) return number.toExponential(1);
  return String(Number(number.toPrecision(3)));
}

export function count(number) {
  if (number >= 1e6) return `${(number / 1e6).toFixed(number >= 1e7 ? 1 : 2)} M`;
  if (number >= 1e4) return `${Math.round(number / 1e3)} k`;
  return String(number);
}
