// Places in a chart of error over time, both in equal ratios. Pure.

// Decades that hold all values above zero: [low, high] as powers of ten.
export function decades(values, fallback) {
  const logs = values.filter((value) => value > 0).map(Math.log10);
  if (!logs.length) return fallback;
  const [low, high] = [Math.floor(Math.min(...logs)), Math.ceil(Math.max(...logs))];
  return high > low ? [low, high] : [low, low + 1];
}

// 0..1 along the decades; nothing above zero is 0, since it lies below all of them.
export function placeOf(value, [low, high]) {
  return value > 0 ? Math.min(1, Math.max(0, (Math.log10(value) - low) / (high - low))) : 0;
}

// Evaluation rows as points of a chart: x by milliseconds, null where they are not timed, y by error.
export function pointsOf(rows) {
  const measured = rows.filter(({ metrics }) => metrics);
  const x = decades(measured.map(({ milliseconds }) => milliseconds ?? 0), [0, 2]);
  const y = decades(measured.map(({ metrics }) => metrics.misclassified), [-4, -1]);
  const points = measured.map((row) => ({
    row,
    x: row.milliseconds === undefined ? null : placeOf(row.milliseconds, x),
    y: placeOf(row.metrics.misclassified, y),
  }));
  return { x, y, points };
}
