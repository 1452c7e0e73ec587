// Where the camera stands: the same for all engines, from the file's own bounds. Pure but for reading the file.
import fs from 'node:fs';

const kLens = 30; // degrees from top to bottom
const radians = (degrees) => degrees * Math.PI / 180;

function jsonOf(file) {
  const bytes = fs.readFileSync(file);
  if (bytes.toString('latin1', 0, 4) !== 'glTF') return JSON.parse(bytes);
  return JSON.parse(bytes.toString('utf8', 20, 20 + bytes.readUInt32LE(12)));
}

// Columns, as glTF has them.
function matrixOf({ matrix, translation: t = [0, 0, 0], rotation: [x, y, z, w] = [0, 0, 0, 1], scale: s = [1, 1, 1] }) {
  if (matrix) return matrix;
  const columns = [
    [1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)],
    [2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)],
    [2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)],
  ];
  return [...columns.flatMap((column, i) => [...column.map((value) => value * s[i]), 0]), ...t, 1];
}

const product = (a, b) => Array.from({ length: 16 }, (_, i) => (
  [0, 1, 2, 3].reduce((sum, k) => sum + a[4 * k + i % 4] * b[4 * (i >> 2) + k], 0)));

const moved = (m, [x, y, z]) => [0, 1, 2].map((i) => m[i] * x + m[4 + i] * y + m[8 + i] * z + m[12 + i]);

// The box of all vertices of the default scene, unskinned and unposed.
export function boundsOf(gltf) {
  const min = [Infinity, Infinity, Infinity];
  const max = [-Infinity, -Infinity, -Infinity];
  function visit(index, parent) {
    const node = gltf.nodes[index];
    const world = product(parent, matrixOf(node));
    for (const { attributes } of gltf.meshes?.[node.mesh]?.primitives ?? []) {
      const box = gltf.accessors[attributes.POSITION];
      for (let corner = 0; corner < 8; ++corner) {
        const at = moved(world, [0, 1, 2].map((i) => (corner >> i & 1 ? box.max[i] : box.min[i])));
        at.forEach((value, i) => {
          min[i] = Math.min(min[i], value);
          max[i] = Math.max(max[i], value);
        });
      }
    }
    for (const child of node.children ?? []) visit(child, world);
  }
  const identity = matrixOf({});
  for (const index of gltf.scenes[gltf.scene ?? 0].nodes) visit(index, identity);
  return { min, max };
}

// Before the box, so that the ball around it just fits. 0 degrees look along -Z; more go to the right of the model.
export function cameraAround({ min, max }, { azimuthDegrees = 30, elevationDegrees = 15, nearer = 1 } = {}) {
  const target = min.map((value, i) => (value + max[i]) / 2);
  const radius = Math.hypot(...min.map((value, i) => max[i] - value)) / 2;
  const distance = radius / Math.sin(radians(kLens / 2)) / nearer;
  const [azimuth, elevation] = [radians(azimuthDegrees), radians(elevationDegrees)];
  const away = [Math.sin(azimuth) * Math.cos(elevation), Math.sin(elevation), Math.cos(azimuth) * Math.cos(elevation)];
  return {
    eye: target.map((value, i) => value + distance * away[i]), target, fovYDegrees: kLens,
    near: Math.max(distance - 1.2 * radius, distance / 100), far: distance + 1.2 * radius,
  };
}

export const cameraOf = (file, view) => cameraAround(boundsOf(jsonOf(file)), view);
