// In the browser: Khronos' own viewer. It draws into the canvas alone, clipped at 1 and encoded by a power of 2.2; so three
// exposures together are the frame.
import { GltfState, GltfView } from '@khronosgroup/gltf-viewer/dist/gltf-viewer.module.js';
import { offer, turnedRows } from './frames.mjs';

const kExposures = [4, 0.5, 0.03125];
const kClipped = 250;
const radians = (degrees) => degrees * Math.PI / 180;

// How much less light cloth leaves to what lies below it: a table that the package lacks. Black = none less.
function blackPicture() {
  const canvas = document.createElement('canvas');
  Object.assign(canvas, { width: 1, height: 1 });
  canvas.getContext('2d').fillRect(0, 0, 1, 1);
  return canvas.toDataURL('image/png');
}

// What decodes KTX2 is a program of its own, which no model here needs.
const noDecoder = async () => ({ GL: { makeContextCurrent() {}, createContext() {} } });

// Columns. The viewer's own `lookAt` gives the inverse.
function worldFromCamera(eye, target) {
  const unit = (v) => v.map((value) => value / Math.hypot(...v));
  const cross = ([ax, ay, az], [bx, by, bz]) => [ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx];
  const back = unit(eye.map((value, i) => value - target[i]));
  const right = unit(cross([0, 1, 0], back));
  return Float32Array.from([...right, 0, ...cross(back, right), 0, ...back, 0, ...eye, 1]);
}

async function open(canvas, setup) {
  const { width, height, camera: given } = setup;
  const gl = canvas.getContext('webgl2', { antialias: true, alpha: true, preserveDrawingBuffer: true });
  const view = new GltfView(gl);
  const state = view.createState();
  const loader = view.createResourceLoader(noDecoder, noDecoder, setup.libraries);
  state.environment = await loader.loadEnvironment(setup.environment, { lut_sheen_E_file: blackPicture() });
  state.gltf = await loader.loadGltf(setup.model);
  state.sceneIndex = state.gltf.scene ?? 0;
  Object.assign(state.renderingParameters, {
    clearColor: [0, 0, 0, 0], usePunctual: false, renderEnvironmentMap: false, toneMap: GltfState.ToneMaps.NONE,
    environmentRotation: setup.rotationDegrees,
  });
  const camera = state.userCamera;
  camera.transform = worldFromCamera(given.eye, given.target);
  camera.setVerticalFoV(radians(given.fovYDegrees));
  Object.assign(camera.perspective, { znear: given.near, zfar: given.far, aspectRatio: width / height });
  function render(exposure) {
    state.renderingParameters.exposure = exposure;
    view.renderFrame(state, width, height);
  }
  function bytes() {
    const pixels = new Uint8Array(4 * width * height);
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
    return pixels;
  }
  for (let i = 0; i < 3; ++i) render(1);
  return {
    version: '1.1.0',
    draw() {
      render(1);
      gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
    },
    read() {
      const linear = new Float32Array(4 * width * height);
      for (const [k, exposure] of kExposures.entries()) {
        render(exposure);
        const pixels = bytes();
        for (let i = 0; i < linear.length; ++i) {
          if (k === 0 || linear[i] < 0) linear[i] = (pixels[i] / 255) ** 2.2 / exposure;
          if (pixels[i] >= kClipped && k + 1 < kExposures.length) linear[i] = -1; // the next exposure says
        }
      }
      return turnedRows(linear, width, height);
    },
  };
}

offer(open);
