// Where a clip stands that goes round. Pure.

export function wrappedTime(fromSeconds, milliseconds, durationSeconds) {
  if (!(durationSeconds > 0)) return 0;
  return (((fromSeconds + milliseconds / 1000) % durationSeconds) + durationSeconds) % durationSeconds;
}
