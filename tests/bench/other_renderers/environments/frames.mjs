// In the browser: what every engine's page offers to the program that compares, as `window.environments`.

function base64(floats) {
  const bytes = new Uint8Array(floats.buffer, floats.byteOffset, floats.byteLength);
  let text = '';
  for (let i = 0; i < bytes.length; i += 0x8000) text += String.fromCharCode(...bytes.subarray(i, i + 0x8000));
  return btoa(text);
}

// R, G, B of rows that begin at the bottom, as WebGL reads them: the first row on top.
export function turnedRows(pixels, width, height) {
  const out = new Float32Array(3 * width * height);
  for (let y = 0; y < height; ++y) {
    for (let x = 0; x < width; ++x) {
      for (let c = 0; c < 3; ++c) out[3 * (y * width + x) + c] = pixels[4 * ((height - 1 - y) * width + x) + c];
    }
  }
  return out;
}

// `openEngine(canvas, setup)` loads model and environment and gives `draw()`, which ends when the last pixel is there,
// `read()`, which gives the drawn frame as R, G, B of linear light, and the engine's `version`.
export function offer(openEngine) {
  const canvas = document.querySelector('canvas');
  let engine;
  window.environments = {
    async open(setup) {
      Object.assign(canvas, { width: setup.width, height: setup.height });
      engine = await openEngine(canvas, setup);
      return { version: engine.version };
    },
    async picture() {
      return base64(await engine.read());
    },
    // Milliseconds of each frame; the first is not counted.
    async times(count) {
      const times = [];
      for (let i = 0; i <= count; ++i) {
        const begin = performance.now();
        await engine.draw();
        if (i > 0) times.push(performance.now() - begin);
      }
      return times;
    },
  };
}
