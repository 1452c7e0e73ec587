// The plan drawn over the picture: the box of every tile as the camera sees it, all from above in a corner, and the
// tiles of the atlas with their names.

import { element, short, svgElement } from './dom.mjs';
import { kTints } from './fields.mjs';
import { boxOfTile, containedRect, hull, kBoxEdges, seenSegment, sliceOfView, viewOf } from './plan_math.mjs';

const kMapSide = 200; // in the map's units

export function createPlanOverlay(stage) {
  const lines = svgElement('svg', { class: 'plan-lines', 'aria-hidden': 'true', preserveAspectRatio: 'none', viewBox: '0 0 1 1' });
  const map = svgElement('svg', { class: 'plan-map', role: 'img', 'aria-label': 'The plan from above', viewBox: `0 0 ${kMapSide} ${kMapSide}` });
  const atlas = element('div', { class: 'plan-atlas' });
  let on = false;
  let last = null; // {report, summary}

  function show() {
    const { report, summary } = last ?? {};
    const view = report?.spec.camera.eye && viewOf(report.spec.camera, report.spec.width / report.spec.height);
    const isAtlas = report?.spec.views[0] === 'atlas';
    atlas.replaceChildren(...(isAtlas ? tilesOf(report) : []));
    const drawn = on && view && !isAtlas;
    for (const node of [lines, map]) node.toggleAttribute('hidden', !drawn);
    if (!drawn) return;
    place(lines, report.spec.width / report.spec.height);
    const tiles = tilesWithBoxes(report);
    lines.replaceChildren(...tiles.flatMap(({ box, tint }) => kBoxEdges.map(([a, b]) => line(seenSegment(view, box[a], box[b]), tint))).filter(Boolean));
    map.replaceChildren(...drawMap(report, summary, view, tiles));
  }

  // Where the picture lies within the stage, which shows all of it.
  function place(node, aspect) {
    const [left, top, width, height] = containedRect(aspect, stage.clientWidth / stage.clientHeight);
    const percent = (share) => `${100 * share}%`;
    Object.assign(node.style, { left: percent(left), top: percent(top), width: percent(width), height: percent(height) });
  }

  function tilesOf({ lights, atlasSize: [width, height] }) {
    place(atlas, width / height);
    return lights.flatMap(({ light, tiles }) =>
      tiles.map((tile, i) => ({ tile, i })).filter(({ tile }) => tile.tile[2]).map(({ tile, i }) => {
        const [x, y, w, h] = tile.tile;
        const says = `Light ${light}, tile ${i}: ${w} × ${h} texels, ${short(tile.near)} to ${short(tile.far)} m, ${short(Math.max(...tile.texelSize) * 1000)} mm a texel`;
        const box = element('div', { class: 'plan-tile', tabindex: 0, role: 'img', 'aria-label': says }, element('span', {}, says));
        Object.assign(box.style, { left: `${(100 * x) / width}%`, top: `${(100 * y) / height}%`, width: `${(100 * w) / width}%`, height: `${(100 * h) / height}%` });
        return box;
      }),
    );
  }

  return {
    nodes: [lines, map, atlas],
    update(report, summary) {
      last = { report, summary };
      show();
    },
    toggle(next) {
      on = next;
      show();
    },
  };
}

function tilesWithBoxes({ lights }) {
  return lights.flatMap(({ tiles }) => tiles.map((tile, i) => ({ ...tile, box: boxOfTile(tile), tint: kTints[i % kTints.length] }))).filter(({ box }) => box);
}

function line(ends, tint) {
  if (!ends) return null;
  const [[x1, y1], [x2, y2]] = ends;
  return svgElement('line', { x1, y1, x2, y2, stroke: tint, 'vector-effect': 'non-scaling-stroke' });
}

// East to the right, south downwards; as large as the camera and all that it sees in shadow.
function drawMap(report, summary, view, tiles) {
  const slices = tiles.map((tile) => ({ ...tile, slice: sliceOfView(view, tile.near, tile.far) }));
  const flat = ([x, , z]) => [x, z];
  const { boundsMin: low, boundsMax: high } = summary;
  const bounds = [[low[0], low[2]], [high[0], low[2]], [high[0], high[2]], [low[0], high[2]]];
  const all = [...bounds, flat(view.eye)];
  const [left, top] = [0, 1].map((axis) => Math.min(...all.map((p) => p[axis])));
  const size = Math.max(...[0, 1].map((axis) => Math.max(...all.map((p) => p[axis])) - [left, top][axis])) || 1;
  const at = ([x, y]) => [12 + ((x - left) / size) * (kMapSide - 24), 12 + ((y - top) / size) * (kMapSide - 24)];
  const polygon = (points, attributes) => svgElement('polygon', { points: points.map((p) => at(p).map((v) => v.toFixed(1)).join()).join(' '), ...attributes });
  const [x, y] = at(flat(view.eye));
  return [
    polygon(bounds, { class: 'plan-bounds' }),
    ...tiles.map(({ box, tint }) => polygon(hull(box.map(flat)), { fill: 'none', stroke: tint, 'stroke-dasharray': '3 3' })),
    ...slices.map(({ slice, tint, near, far }) => {
      const shape = polygon(hull(slice.map(flat)), { fill: tint, 'fill-opacity': 0.35, stroke: tint });
      shape.append(svgElement('title', {}, `${short(near)} to ${short(far)} m`));
      return shape;
    }),
    svgElement('circle', { cx: x, cy: y, r: 3.5, class: 'plan-eye' }),
  ];
}
