// What is drawn: camera paths, and the same frames as Gnomon's specs. Pure.

const radians = (degrees) => degrees * Math.PI / 180;
const minus = (a, b) => a.map((value, i) => value - b[i]);
const dot = (a, b) => a.reduce((sum, value, i) => sum + value * b[i], 0);
const cross = ([ax, ay, az], [bx, by, bz]) => [ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx];

// The point turned about the axis through the origin, counter-clockwise as seen against it (Rodrigues).
export function turned(point, axis, degrees) {
  const length = Math.hypot(...axis);
  const unit = axis.map((value) => value / length);
  const [cosine, sine] = [Math.cos(radians(degrees)), Math.sin(radians(degrees))];
  const sideways = cross(unit, point);
  const along = dot(unit, point) * (1 - cosine);
  return point.map((value, i) => value * cosine + sideways[i] * sine + unit[i] * along);
}

// Where the camera stands in each frame of the scene's orbit about its target.
export function eyesOf({ camera: { eye, target, up }, orbit_frames: frames, orbit_step_deg: step }) {
  const arm = minus(eye, target);
  return Array.from({ length: frames }, (_, frame) => (
    turned(arm, up, frame * step).map((value, i) => target[i] + value)));
}

// What every other engine gets: lengths in metres, `url` being where it finds the GLB.
export function setupOf(scene, { url, antialias, variant }) {
  const { eye, target, up, fovy_deg: fovYDegrees, near, far } = scene.camera;
  return {
    url, antialias, variant, width: scene.width, height: scene.height,
    camera: { eye, target, up, fovYDegrees, near, far }, eyes: eyesOf(scene),
    towardsSun: scene.sun.direction_to_light, sunIntensity: 3, ambient: scene.ambient, background: scene.background,
    cascades: scene.cascades, mapSize: scene.map_size, shadowDistance: scene.shadow_distance,
  };
}

// Gnomon's request for the frame: nothing but camera and sun is set, and what `settings` has.
export function specOf(scene, frame, settings) {
  const { target, up, fovy_deg: fovYDegrees, near, far } = scene.camera;
  return {
    width: scene.width, height: scene.height,
    camera: { eye: eyesOf(scene)[frame], target, up, perspective: { fovYDegrees, near, far } },
    lights: [{ type: 'directional', direction: scene.sun.direction_to_light.map((value) => -value) }],
    ...settings,
  };
}

// The frames of each turn: the first of them are drawn and not counted, three when a contestant has just begun, then
// one. All frames differ.
export function turnsOf({ rounds, counted, frames }) {
  const turns = [];
  for (let first = 0, round = 0; round < rounds; ++round) {
    const uncounted = round === 0 ? 3 : 1;
    turns.push({ first, uncounted, count: uncounted + counted });
    first += uncounted + counted;
    if (first > frames) throw new Error(`${rounds} turns need more than the ${frames} frames of the orbit`);
  }
  return turns;
}

export function median(values) {
  const sorted = [...values].sort((a, b) => a - b);
  const middle = sorted.length >> 1;
  return sorted.length % 2 ? sorted[middle] : (sorted[middle - 1] + sorted[middle]) / 2;
}
