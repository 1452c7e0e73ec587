// Where planned shadows lie: the boxes of tiles, slices of the view, and how a camera sees them. Pure.
// Matrices are 16 numbers, column by column.

const kRadians = Math.PI / 180;
const sub = (a, b) => a.map((x, i) => x - b[i]);
const dot = (a, b) => a.reduce((sum, x, i) => sum + x * b[i], 0);
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const unit = (a) => a.map((x) => x / (Math.hypot(...a) || 1));

// The corners of a box, as 0..7 with a bit an axis, are joined by these.
export const kBoxEdges = [0, 1, 2, 3, 4, 5, 6, 7].flatMap((i) => [1, 2, 4].filter((bit) => !(i & bit)).map((bit) => [i, i | bit]));

// The inverse of a 4 x 4 matrix, or null.
export function inverse(m) {
  const rows = [0, 1, 2, 3].map((r) => [0, 1, 2, 3].map((c) => m[4 * c + r]).concat([0, 1, 2, 3].map((c) => Number(c === r))));
  for (let i = 0; i < 4; i += 1) {
    const pivot = rows.slice(i).reduce((best, row, j) => (Math.abs(row[i]) > Math.abs(rows[best][i]) ? i + j : best), i);
    if (Math.abs(rows[pivot][i]) < 1e-30) return null;
    [rows[i], rows[pivot]] = [rows[pivot], rows[i]];
    rows[i] = rows[i].map((x) => x / rows[i][i]);
    for (let j = 0; j < 4; j += 1) if (j !== i) rows[j] = rows[j].map((x, k) => x - rows[j][i] * rows[i][k]);
  }
  return [0, 1, 2, 3].flatMap((c) => [0, 1, 2, 3].map((r) => rows[r][4 + c]));
}

export function transformed(m, [x, y, z]) {
  const at = [0, 1, 2, 3].map((r) => m[r] * x + m[4 + r] * y + m[8 + r] * z + m[12 + r]);
  return at.slice(0, 3).map((v) => v / at[3]);
}

// The corners in the world of what a tile shows, whose clip space reaches from -1 to 1, and in depth from 0 to 1.
export function boxOfTile({ matrix }) {
  const worldFromClip = matrix && inverse(matrix);
  if (!worldFromClip) return null;
  return [0, 1, 2, 3, 4, 5, 6, 7].map((i) => transformed(worldFromClip, [i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : 0]));
}

// A camera's own axes; `tangent` of half its angle upwards, or half its height where it sees in parallel.
export function viewOf({ eye, target, up = [0, 1, 0], perspective, orthographic }, aspect) {
  const forward = unit(sub(target, eye));
  const right = unit(cross(forward, up));
  const tangent = perspective ? Math.tan((perspective.fovYDegrees / 2) * kRadians) : orthographic.height / 2;
  return { eye, forward, right, up: cross(right, forward), tangent, aspect, parallel: !perspective };
}

// The corners of the part of the view between two depths.
export function sliceOfView(view, near, far) {
  return [0, 1, 2, 3, 4, 5, 6, 7].map((i) => {
    const depth = i & 4 ? far : near;
    const half = view.tangent * (view.parallel ? 1 : depth);
    const [x, y] = [(i & 1 ? 1 : -1) * half * view.aspect, (i & 2 ? 1 : -1) * half];
    return view.eye.map((at, axis) => at + view.forward[axis] * depth + view.right[axis] * x + view.up[axis] * y);
  });
}

// A segment as the camera sees it: two places in the picture, 0..1 from its left upper corner; null = all behind.
export function seenSegment(view, a, b) {
  const kNear = 1e-3;
  let [p, q] = [a, b].map((point) => {
    const away = sub(point, view.eye);
    return [dot(away, view.right), dot(away, view.up), dot(away, view.forward)];
  });
  if (!view.parallel) {
    if (p[2] < kNear && q[2] < kNear) return null;
    const cut = (inside, outside) => {
      const t = (kNear - inside[2]) / (outside[2] - inside[2]);
      return inside.map((x, i) => x + t * (outside[i] - x));
    };
    if (p[2] < kNear) p = cut(q, p);
    if (q[2] < kNear) q = cut(p, q);
  }
  return [p, q].map(([x, y, depth]) => {
    const half = view.tangent * (view.parallel ? 1 : depth);
    return [0.5 + x / (2 * half * view.aspect), 0.5 - y / (2 * half)];
  });
}

// The convex hull of points in the plane, as a polygon.
export function hull(points) {
  const sorted = [...points].sort((a, b) => a[0] - b[0] || a[1] - b[1]);
  const chain = (list) => {
    const out = [];
    for (const p of list) {
      while (out.length > 1 && turn(out.at(-2), out.at(-1), p) <= 0) out.pop();
      out.push(p);
    }
    return out.slice(0, -1);
  };
  return [...chain(sorted), ...chain([...sorted].reverse())];
}

const turn = (a, b, c) => (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);

// The rectangle that a picture takes in a frame that shows it whole: [left, top, width, height] in shares of the frame.
export function containedRect(pictureAspect, frameAspect) {
  const [width, height] = pictureAspect > frameAspect ? [1, frameAspect / pictureAspect] : [pictureAspect / frameAspect, 1];
  return [(1 - width) / 2, (1 - height) / 2, width, height];
}
