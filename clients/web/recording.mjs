// What a recording shows: the animation that is chosen, once, or else a turn around the scene. Pure.

const kFramesPerSecond = 30;
const kTurnSeconds = 6;

// The sequence of a recording, from the spec of the present picture and the orbit in force, which may be null.
export function recordedSequence({ spec, summary, orbit, lens }) {
  const clip = spec.animation && summary.animations[spec.animation.index];
  const frames = clip?.durationSeconds > 0 ? clipFrames(clip.durationSeconds) : orbit && turnFrames(orbit.azimuthDegrees);
  if (!frames) return null;
  const camera = clip ? spec.camera : { ...lens, orbit };
  return { spec: { ...spec, camera }, frames, framesPerSecond: kFramesPerSecond };
}

const clipFrames = (seconds) => each(Math.max(2, Math.round(seconds * kFramesPerSecond)), (at) => ({ animation: { timeSeconds: Number((at * seconds).toFixed(4)) } }));
const turnFrames = (azimuth) => each(kTurnSeconds * kFramesPerSecond, (at) => ({ camera: { orbit: { azimuthDegrees: (azimuth + 360 * at) % 360 } } }));

// The last frame lies one step before the first one of the next round, so that a player may repeat it.
const each = (count, patch) => Array.from({ length: count }, (_, i) => patch(i / count));
