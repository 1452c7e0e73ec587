// What of a spec belongs to its scene, and goes with it. Pure.

import { removePath } from './paths.mjs';

// Names and numbers of what is in the file, and lengths that were chosen for its size: in another scene they would mean
// something else, or nothing, for which the frame would be refused.
const kOfTheScene = [
  'camera', 'lights', 'nodes', 'animation', 'scene', 'materialVariant', 'motionFrom', 'volumes', 'debug',
  'environment.file', 'environment.light', 'shadow.depthRange', 'shadow.bias', 'shadow.filter.radius', 'ground.height', 'ground.size',
];

export const withoutScene = (spec) => kOfTheScene.reduce(removePath, spec);
