// A volume as the page makes one. Pure.

import { fitOrbit, orbitInForce } from './orbit_math.mjs';
import { setPath } from './paths.mjs';

const kOpticalDepth = 4; // from the bottom to the top of a volume that is full everywhere
const rounded = (number) => Number(number.toPrecision(3));

export const isGrid = ({ name }) => /\.(npy|vdb)$/i.test(name);

// A cloud above what the camera turns about, in its view: white, its density growing with the values of the grid.
export function newVolume(state, file) {
  const { summary } = state;
  const { target, distance } = orbitInForce(state) ?? fitOrbit(summary.boundsMin, summary.boundsMax);
  const corner = (side, up) => [side, up, side].map((share, axis) => rounded(target[axis] + share * distance));
  const box = { min: corner(-0.18, 0.12), max: corner(0.18, 0.26) };
  const color = [1, 1, 1];
  const stops = [{ value: 0, color, extinction: 0 }, { value: 1, color, extinction: rounded(kOpticalDepth / (0.14 * distance)) }];
  return { file, box, transferFunction: stops };
}

// The state's volumes with a file that is shown as the one before was, if there was one.
export function withFile(state, file) {
  const { volumes } = state.spec;
  return volumes?.length ? setPath(volumes, '0.file', file) : [newVolume(state, file)];
}

// The volumes with full density at the greatest value of the grid.
export function scaledTo([, greatest], volumes) {
  return greatest > volumes[0].transferFunction[0].value ? setPath(volumes, '0.transferFunction.1.value', greatest) : volumes;
}
