// The sky from above: zenith in the middle, horizon on the rim, north (-Z) at the top. The sun is dragged over it;
// the gnomon's shadow and the camera's heading show how it falls. Arrow keys move the sun, too.

import { svgElement } from './dom.mjs';

const kRadius = 100; // of the horizon, in the drawing's units
const kRadians = Math.PI / 180;

// Where a place of the sky is drawn.
export function toDome(azimuthDegrees, elevationDegrees) {
  const r = (kRadius * (90 - Math.max(0, elevationDegrees))) / 90;
  return [r * Math.sin(azimuthDegrees * kRadians), -r * Math.cos(azimuthDegrees * kRadians)];
}

export function fromDome(x, y) {
  const r = Math.min(kRadius, Math.hypot(x, y));
  const azimuth = (Math.atan2(x, -y) / kRadians + 360) % 360;
  return { azimuthDegrees: Math.round(azimuth * 10) / 10 % 360, elevationDegrees: Math.round((90 - (90 * r) / kRadius) * 10) / 10 };
}

// `onSun({azimuthDegrees, elevationDegrees})` while it is dragged.
export function createSkyDome(onSun) {
  let sun = { azimuthDegrees: 135, elevationDegrees: 45 };
  const shadow = svgElement('line', { class: 'dome-shadow' });
  const ray = svgElement('line', { class: 'dome-ray' });
  const disc = svgElement('g', { class: 'dome-sun' }, svgElement('circle', { r: 15, class: 'glow' }), svgElement('circle', { r: 7.5 }));
  const heading = svgElement('path', { class: 'dome-heading', d: 'M0 -99 l-5.5 -10 h11 z' });
  const rings = [30, 60].map((elevation) => svgElement('circle', { class: 'dome-ring', r: (kRadius * (90 - elevation)) / 90 }));
  const names = [['N', 0, -84], ['E', 86, 0], ['S', 0, 86], ['W', -86, 0]];
  const letters = names.map(([text, x, y]) => svgElement('text', { class: 'dome-letter', x, y }, text));
  const node = svgElement(
    'svg',
    { class: 'dome', viewBox: '-116 -116 232 232', tabindex: 0, role: 'application', 'aria-label': 'Place of the sun: drag it, or use the arrow keys' },
    svgElement('defs', {}, gradient()),
    svgElement('circle', { class: 'dome-sky', r: kRadius, fill: 'url(#dome-sky)' }),
    ...rings,
    svgElement('path', { class: 'dome-cross', d: 'M-100 0H100M0 -100V100' }),
    ...letters,
    shadow,
    ray,
    svgElement('circle', { class: 'dome-gnomon', r: 2.6 }),
    heading,
    disc,
  );

  const move = (place) => onSun({ ...sun, ...place });
  node.addEventListener('pointerdown', (event) => {
    if (event.button !== 0) return;
    node.setPointerCapture(event.pointerId);
    node.classList.add('held');
    move(placeOf(event));
  });
  node.addEventListener('pointermove', (event) => node.hasPointerCapture(event.pointerId) && move(placeOf(event)));
  node.addEventListener('lostpointercapture', () => node.classList.remove('held'));
  node.addEventListener('keydown', (event) => {
    const step = event.shiftKey ? 15 : 2.5;
    const by = { ArrowLeft: [-step, 0], ArrowRight: [step, 0], ArrowUp: [0, step], ArrowDown: [0, -step] }[event.key];
    if (!by) return;
    event.preventDefault();
    move({
      azimuthDegrees: (sun.azimuthDegrees + by[0] + 360) % 360,
      elevationDegrees: Math.min(90, Math.max(0, sun.elevationDegrees + by[1])),
    });
  });

  function placeOf(event) {
    const box = node.getBoundingClientRect();
    const scale = 232 / box.width;
    return fromDome((event.clientX - box.left) * scale - 116, (event.clientY - box.top) * scale - 116);
  }

  // `dimmed` where the sun is not the light; `heading` is the way that the camera looks, in degrees, or null.
  function show(place, { dimmed = false, headingDegrees = null } = {}) {
    sun = place;
    const [x, y] = toDome(place.azimuthDegrees, place.elevationDegrees);
    disc.setAttribute('transform', `translate(${x} ${y})`);
    ray.setAttribute('x2', x);
    ray.setAttribute('y2', y);
    const length = Math.min(78, 14 / Math.tan(Math.max(2, place.elevationDegrees) * kRadians));
    shadow.setAttribute('x2', -length * Math.sin(place.azimuthDegrees * kRadians));
    shadow.setAttribute('y2', length * Math.cos(place.azimuthDegrees * kRadians));
    heading.toggleAttribute('hidden', headingDegrees === null);
    heading.setAttribute('transform', `rotate(${headingDegrees ?? 0})`);
    node.classList.toggle('dimmed', dimmed);
    node.classList.toggle('night', place.elevationDegrees < 0);
  }
  return { node, show };
}

const gradient = () =>
  svgElement(
    'radialGradient',
    { id: 'dome-sky' },
    svgElement('stop', { offset: '0', 'stop-color': '#3b6ea8' }),
    svgElement('stop', { offset: '0.65', 'stop-color': '#284a75' }),
    svgElement('stop', { offset: '1', 'stop-color': '#1d3352' }),
  );
