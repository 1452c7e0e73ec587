// A volume as the page makes one. Pure.

import { setPath } from './paths.mjs';

const kOpticalDepth = 4; // from the bottom to the top of a volume that is full everywhere
const rounded = (number) => Number(number.toPrecision(3));

export const isGrid = ({ name }) => /\.(npy|vdb)$/i.test(name);

// A cloud above the middle of the scene, white, its density growing with the values of the grid.
export function newVolume({ boundsMin, boundsMax }, file) {
  const middle = (axis) => (boundsMin[axis] + boundsMax[axis]) / 2;
  const wide = Math.max(boundsMax[0] - boundsMin[0], boundsMax[2] - boundsMin[2]) || 1;
  const at = (sign) => [middle(0) + sign * 0.25 * wide, boundsMax[1] + (sign < 0 ? 0.05 : 0.25) * wide, middle(2) + sign * 0.25 * wide];
  const color = [1, 1, 1];
  const stops = [{ value: 0, color, extinction: 0 }, { value: 1, color, extinction: rounded(kOpticalDepth / (0.2 * wide)) }];
  return { file, box: { min: at(-1).map(rounded), max: at(1).map(rounded) }, transferFunction: stops };
}

// The volumes with a file that is shown as the one before was, if there was one.
export function withFile(volumes, summary, file) {
  return volumes?.length ? setPath(volumes, '0.file', file) : [newVolume(summary, file)];
}

// The volumes with full density at the greatest value of the grid.
export function scaledTo([, greatest], volumes) {
  return greatest > volumes[0].transferFunction[0].value ? setPath(volumes, '0.transferFunction.1.value', greatest) : volumes;
}
