// In the browser: Babylon.js, whose environment is filtered as it is loaded.
import { FreeCamera } from '@babylonjs/core/Cameras/freeCamera.js';
import { Engine } from '@babylonjs/core/Engines/engine.js';
import '@babylonjs/core/Engines/Extensions/engine.readTexture.js';
import { ImportMeshAsync } from '@babylonjs/core/Loading/sceneLoader.js';
import { HDRCubeTexture } from '@babylonjs/core/Materials/Textures/hdrCubeTexture.js';
import { RenderTargetTexture } from '@babylonjs/core/Materials/Textures/renderTargetTexture.js';
import { CubeMapToSphericalPolynomialTools } from '@babylonjs/core/Misc/HighDynamicRange/cubemapToSphericalPolynomial.js';
import { Color4 } from '@babylonjs/core/Maths/math.color.js';
import { Vector3 } from '@babylonjs/core/Maths/math.vector.js';
import { Scene } from '@babylonjs/core/scene.js';
import '@babylonjs/core/Helpers/sceneHelpers.js';
import '@babylonjs/loaders/glTF/2.0/index.js';
import { offer, turnedRows } from './frames.mjs';

const radians = (degrees) => degrees * Math.PI / 180;
const kTextureTypeFloat = 1; // Constants.TEXTURETYPE_FLOAT
const kFaceSide = 256; // filtering takes some seconds without a GPU

// Else the diffuse light of texels above 4096 is lost, and with it most of a sun.
CubeMapToSphericalPolynomialTools.MAX_HDRI_VALUE = Infinity;

async function open(canvas, setup) {
  const { width, height, camera: given } = setup;
  const engine = new Engine(canvas, false, { stencil: false }, false);
  const scene = new Scene(engine);
  scene.useRightHandedSystem = true;
  scene.clearColor = new Color4(0, 0, 0, 0);
  // Materials leave tone mapping and sRGB to a post process, of which there is none: the target is linear.
  scene.imageProcessingConfiguration.applyByPostProcess = true;
  await ImportMeshAsync(setup.model, scene);
  for (const light of [...scene.lights]) light.dispose();
  const environment = new HDRCubeTexture(setup.environment, scene, kFaceSide, false, true, false, true);
  environment.rotationY = Math.PI / 2 + radians(setup.rotationDegrees);
  scene.environmentTexture = environment;

  const camera = new FreeCamera('camera', Vector3.FromArray(given.eye), scene);
  Object.assign(camera, { fov: radians(given.fovYDegrees), minZ: given.near, maxZ: given.far });
  camera.setTarget(Vector3.FromArray(given.target));
  scene.activeCamera = camera;
  const target = new RenderTargetTexture('linear', { width, height }, scene, {
    generateMipMaps: false, type: kTextureTypeFloat, samples: 4,
  });
  camera.outputRenderTarget = target;
  await scene.whenReadyAsync();
  function render() {
    engine.beginFrame();
    scene.render();
    engine.endFrame();
  }
  for (let i = 0; i < 3; ++i) render();
  return {
    version: Engine.Version,
    async draw() {
      render();
      await target.readPixels(0, 0, null, true, false, 0, 0, 1, 1);
    },
    async read() {
      render();
      return turnedRows(await target.readPixels(), width, height);
    },
  };
}

offer(open);
