// In the browser: what every engine's page offers to the program that measures it, as `window.speed`.

// Ends when the last pixels are there: `width` x `height` of them, of the canvas itself.
function readPixels(gl, width, height) {
  const bound = gl.getParameter(gl.READ_FRAMEBUFFER_BINDING);
  gl.bindFramebuffer(gl.READ_FRAMEBUFFER, null);
  const pixels = new Uint8Array(4 * width * height);
  gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
  gl.bindFramebuffer(gl.READ_FRAMEBUFFER, bound);
  return pixels;
}

function graphicsName(gl) {
  return gl.getParameter(gl.getExtension('WEBGL_debug_renderer_info').UNMASKED_RENDERER_WEBGL);
}

// `openEngine(canvas, setup)` loads the scene of the setup (see scenes.mjs) and gives `draw(eye)`, which draws a frame
// into the canvas, and the engine's `version`.
export function offer(openEngine) {
  const canvas = document.querySelector('canvas');
  let setup;
  let draw;
  const gl = () => canvas.getContext('webgl2');
  window.speed = {
    async open(given) {
      setup = given;
      Object.assign(canvas, { width: setup.width, height: setup.height });
      const engine = await openEngine(canvas, setup);
      draw = engine.draw;
      return { version: engine.version, graphics: graphicsName(gl()) };
    },
    // The whole picture, to its last pixel.
    first() {
      draw(setup.eyes[0]);
      readPixels(gl(), setup.width, setup.height);
    },
    // Milliseconds of each frame; one pixel is read so that all is done. Nothing is shown between the frames.
    turn({ first, count }) {
      return setup.eyes.slice(first, first + count).map((eye) => {
        const begin = performance.now();
        draw(eye);
        readPixels(gl(), 1, 1);
        return performance.now() - begin;
      });
    },
    picture(frame) {
      draw(setup.eyes[frame]);
      return canvas.toDataURL('image/png');
    },
  };
}
