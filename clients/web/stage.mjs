// The picture and the hand on it: drag turns, shift or right drag (or two fingers) pans, the wheel (or a pinch) comes
// nearer; arrow keys turn, shift and arrow keys pan, + and - zoom, F fits.

import { panned, turned, zoomed } from './orbit_math.mjs';

const kDegreesPerPixel = 0.35;
const kKeyDegrees = 5;
const kKeyPixels = 40;

// `node` takes the pointer; `orbit()` gives the present orbit or null; `fovY()` the lens in degrees; `move(orbit)` is
// given the next orbit; `fit()` starts over.
export function attachOrbit(node, { orbit, fovY, move, fit }) {
  const pointers = new Map();
  const change = (next) => {
    const now = orbit();
    if (now) move(next(now));
  };
  const pan = (now, rightPixels, downPixels) => {
    const height = node.clientHeight || 1;
    return panned(now, rightPixels / height, downPixels / height, fovY());
  };

  node.addEventListener('contextmenu', (event) => event.preventDefault());
  node.addEventListener('pointerdown', (event) => {
    if (event.button === 1 || event.target.closest('button, a, input, label')) return;
    node.setPointerCapture(event.pointerId);
    pointers.set(event.pointerId, { x: event.clientX, y: event.clientY, pans: event.shiftKey || event.button === 2 });
    node.classList.add('held');
  });
  node.addEventListener('pointermove', (event) => {
    const from = pointers.get(event.pointerId);
    if (!from) return;
    const to = { ...from, x: event.clientX, y: event.clientY };
    if (pointers.size === 2) pinch(from, to, event.pointerId);
    else if (pointers.size === 1) drag(from, to);
    pointers.set(event.pointerId, to);
  });
  node.addEventListener('lostpointercapture', (event) => {
    pointers.delete(event.pointerId);
    if (!pointers.size) node.classList.remove('held');
  });
  node.addEventListener(
    'wheel',
    (event) => {
      event.preventDefault();
      const pixels = event.deltaMode === WheelEvent.DOM_DELTA_LINE ? event.deltaY * 33 : event.deltaY;
      change((now) => zoomed(now, Math.exp(pixels * 0.0012)));
    },
    { passive: false },
  );
  node.addEventListener('dblclick', (event) => !event.target.closest('button') && fit());
  node.addEventListener('keydown', (event) => {
    const next = keyed(event);
    if (!next) return;
    event.preventDefault();
    next();
  });

  function drag(from, to) {
    const [right, down] = [to.x - from.x, to.y - from.y];
    if (from.pans) change((now) => pan(now, right, down));
    else change((now) => turned(now, right * kDegreesPerPixel, down * kDegreesPerPixel));
  }

  // Each finger's move counts half for the pan; the ratio of their distances zooms.
  function pinch(from, to, id) {
    const [other] = [...pointers].filter(([key]) => key !== id).map(([, pointer]) => pointer);
    const apart = (a) => Math.hypot(a.x - other.x, a.y - other.y) || 1;
    change((now) => pan(zoomed(now, apart(from) / apart(to)), (to.x - from.x) / 2, (to.y - from.y) / 2));
  }

  function keyed({ key, shiftKey }) {
    const arrow = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[key];
    if (arrow && shiftKey) return () => change((now) => pan(now, -arrow[0] * kKeyPixels, -arrow[1] * kKeyPixels));
    if (arrow) return () => change((now) => turned(now, -arrow[0] * kKeyDegrees, -arrow[1] * kKeyDegrees));
    if (key === '+' || key === '=') return () => change((now) => zoomed(now, 0.85));
    if (key === '-') return () => change((now) => zoomed(now, 1 / 0.85));
    if (key === 'f' || key === 'F' || key === 'Home') return fit;
    return null;
  }
}
