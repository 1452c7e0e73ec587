// The orbit camera: {target: [x, y, z], azimuthDegrees, elevationDegrees, distance}. Pure.
// Azimuth of the eye seen from the target, clockwise from north (-Z); elevation above the horizon.

const kRadians = Math.PI / 180;
const kSteepest = 89.5; // degrees: straight above, "up" has no direction
export const kFovYDegrees = 45; // the server's default lens

// The server frames the scene where target and distance are left to it.
export const kWholeScene = { azimuthDegrees: 150, elevationDegrees: 22 };

// An orbit that shows the whole box.
export function fitOrbit(boundsMin, boundsMax, aspect = 16 / 9) {
  const target = boundsMin.map((low, i) => (low + boundsMax[i]) / 2);
  const radius = Math.hypot(...boundsMin.map((low, i) => (boundsMax[i] - low) / 2)) || 1;
  const halfAngle = Math.min(kFovYDegrees / 2, Math.atan(Math.tan((kFovYDegrees / 2) * kRadians) * aspect) / kRadians);
  const distance = radius / Math.sin(halfAngle * kRadians);
  return { ...kWholeScene, target, distance };
}

// The orbit that looks the way that an eye and a target do. The target of a glTF camera is only a direction: what is
// turned about is the point of the line of sight that is abreast of `centre`, where that lies among the surfaces in view.
export function orbitFromView({ eye, target }, depthRange, centre) {
  const toEye = eye.map((at, i) => at - target[i]);
  const length = Math.hypot(...toEye) || 1;
  const away = toEye.map((part) => part / length);
  const [near, far] = depthRange[1] > 0 ? depthRange : [length, length];
  const abreast = eye.reduce((sum, at, i) => sum + (at - centre[i]) * away[i], 0);
  const distance = abreast > near && abreast < far ? abreast : Math.sqrt(Math.max(near, 1e-3) * far);
  const orbit = {
    target: eye.map((at, i) => at - away[i] * distance),
    azimuthDegrees: Math.atan2(away[0], -away[2]) / kRadians,
    elevationDegrees: Math.asin(away[1]) / kRadians,
    distance,
  };
  return turned(orbit, 0, 0);
}

// The user's orbit, else the one that the frame of this camera amounts to; null before there is one.
export function orbitInForce({ spec, report, summary, cameraShown }) {
  const own = spec.camera?.orbit;
  if (own?.target && own.distance) return own;
  const shown = report?.spec.camera;
  return shown?.eye && summary && cameraShown === spec.camera ? orbitFromView(shown, report.depthRange, centreOf(summary)) : null;
}

const centreOf = ({ boundsMin, boundsMax }) => boundsMin.map((low, i) => (low + boundsMax[i]) / 2);

export function turned(orbit, azimuthBy, elevationBy) {
  const elevation = orbit.elevationDegrees + elevationBy;
  return {
    ...orbit,
    azimuthDegrees: (((orbit.azimuthDegrees + azimuthBy) % 360) + 360) % 360,
    elevationDegrees: Math.min(kSteepest, Math.max(-kSteepest, elevation)),
  };
}

export const zoomed = (orbit, factor) => ({ ...orbit, distance: Math.min(1e7, Math.max(1e-4, orbit.distance * factor)) });

// Moves the target so that what is under the pointer follows it: right and down as shares of the picture's height.
export function panned(orbit, rightBy, downBy, fovYDegrees = kFovYDegrees) {
  const metres = 2 * orbit.distance * Math.tan((fovYDegrees / 2) * kRadians); // of the picture's height at the target
  const { right, up } = basis(orbit);
  const target = orbit.target.map((at, i) => at - right[i] * rightBy * metres + up[i] * downBy * metres);
  return { ...orbit, target };
}

// The picture's right and up as directions in the world.
export function basis({ azimuthDegrees, elevationDegrees }) {
  const [sinA, cosA] = [Math.sin(azimuthDegrees * kRadians), Math.cos(azimuthDegrees * kRadians)];
  const [sinE, cosE] = [Math.sin(elevationDegrees * kRadians), Math.cos(elevationDegrees * kRadians)];
  return { right: [-cosA, 0, -sinA], up: [-sinA * sinE, cosE, cosA * sinE] };
}
