// From the page's state to the FrameSpec that is sent. Pure.

import { removePath } from './paths.mjs';

// The sharp picture of the present state. `size` is used where the user chose none.
export function fullSpec({ spec, view, report }, size) {
  const sized = spec.width && spec.height ? spec : { ...size, ...spec };
  const motion = view === 'motion' && !spec.motionFrom ? { motionFrom: momentOf(report) } : {};
  return { ...sized, ...motion, views: [view] };
}

// What the last picture showed.
const momentOf = (report) => (report ? { camera: report.spec.camera, animation: report.spec.animation ?? {}, nodes: placesOf(report.spec.nodes) } : {});
const placesOf = (nodes = []) =>
  nodes.map(({ visible, castShadow, receiveShadow, layers, ...place }) => place).filter((place) => Object.keys(place).length > 1);

// The same, cheap enough to follow the hand: fewer pixels, no antialiasing.
export function draftSpec(state, size, scale) {
  const full = fullSpec(state, size);
  const side = (pixels) => Math.max(16, Math.round((pixels * scale) / 2) * 2);
  return { ...full, width: side(full.width), height: side(full.height), antialiasing: 'none' };
}

// One command that gives the same picture.
export function curlCommand(origin, sceneId, spec, format) {
  const body = JSON.stringify(format === 'png' ? removePath(spec, 'output.format') : withFormat(spec, format));
  const type = format === 'png' ? 'image/png' : 'image/x-exr';
  return [
    `curl -sSf -X POST ${quoted(`${origin}/v1/scenes/${sceneId}/frames`)}`,
    `-H 'Content-Type: application/json' -H 'Accept: ${type}'`,
    `-d ${quoted(body)} -o frame.${format}`,
  ].join(' \\\n  ');
}

export const withFormat = (spec, format) => ({ ...spec, output: { ...spec.output, format } });

const quoted = (text) => `'${text.replaceAll("'", "'\\''")}'`;
