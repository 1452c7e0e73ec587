// The orbit camera: {target: [x, y, z], azimuthDegrees, elevationDegrees, distance}. Pure.
// Azimuth of the eye seen from the target, clockwise from north (-Z); elevation above the horizon.

const kRadians = Math.PI / 180;
const kSteepest = 89.5; // degrees: straight above, "up" has no direction
export const kFovYDegrees = 45; // the server's default lens

// The orbit that shows the whole box.
export function fitOrbit(boundsMin, boundsMax, aspect = 16 / 9) {
  const target = boundsMin.map((low, i) => (low + boundsMax[i]) / 2);
  const radius = Math.hypot(...boundsMin.map((low, i) => (boundsMax[i] - low) / 2)) || 1;
  const halfAngle = Math.min(kFovYDegrees / 2, Math.atan(Math.tan((kFovYDegrees / 2) * kRadians) * aspect) / kRadians);
  const distance = (radius / Math.sin(halfAngle * kRadians)) * 0.92;
  return { target, azimuthDegrees: 150, elevationDegrees: 22, distance };
}

export function turned(orbit, azimuthBy, elevationBy) {
  const elevation = orbit.elevationDegrees + elevationBy;
  return {
    ...orbit,
    azimuthDegrees: (((orbit.azimuthDegrees + azimuthBy) % 360) + 360) % 360,
    elevationDegrees: Math.min(kSteepest, Math.max(-kSteepest, elevation)),
  };
}

export const zoomed = (orbit, factor) => ({ ...orbit, distance: Math.min(1e7, Math.max(1e-4, orbit.distance * factor)) });

// Moves the target so that what is under the pointer follows it: right and down in pixels of a picture `height` high.
export function panned(orbit, rightPixels, downPixels, height) {
  const metres = (2 * orbit.distance * Math.tan((kFovYDegrees / 2) * kRadians)) / height;
  const { right, up } = basis(orbit);
  const target = orbit.target.map((at, i) => at - right[i] * rightPixels * metres + up[i] * downPixels * metres);
  return { ...orbit, target };
}

// The picture's right and up as directions in the world.
export function basis({ azimuthDegrees, elevationDegrees }) {
  const [sinA, cosA] = [Math.sin(azimuthDegrees * kRadians), Math.cos(azimuthDegrees * kRadians)];
  const [sinE, cosE] = [Math.sin(elevationDegrees * kRadians), Math.cos(elevationDegrees * kRadians)];
  return { right: [-cosA, 0, -sinA], up: [-sinA * sinE, cosE, cosA * sinE] };
}
