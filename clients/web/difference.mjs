// Two pictures held against each other, pixel by pixel. Pure.

const kVisible = 8; // of 255: less is not counted

// `a` and `b`: RGBA bytes of the same size. Gives the difference as RGBA, black through red and yellow to white, the
// share of pixels that differ visibly, and the mean difference of 255.
export function differenceOf(a, b) {
  const map = new Uint8ClampedArray(a.length);
  let visible = 0;
  let sum = 0;
  for (let i = 0; i < a.length; i += 4) {
    const most = Math.max(Math.abs(a[i] - b[i]), Math.abs(a[i + 1] - b[i + 1]), Math.abs(a[i + 2] - b[i + 2]));
    if (most > kVisible) visible += 1;
    sum += most;
    const heat = most * 6; // a fifth of the range is bright already
    map[i] = heat;
    map[i + 1] = heat - 255;
    map[i + 2] = heat - 510;
    map[i + 3] = 255;
  }
  const pixels = a.length / 4 || 1;
  return { map, visible: visible / pixels, mean: sum / pixels };
}
