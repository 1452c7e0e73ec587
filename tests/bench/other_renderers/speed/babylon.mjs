// In the browser: Babylon.js with its CascadedShadowGenerator.
import { FreeCamera } from '@babylonjs/core/Cameras/freeCamera.js';
import { Engine } from '@babylonjs/core/Engines/engine.js';
import { DirectionalLight } from '@babylonjs/core/Lights/directionalLight.js';
import { CascadedShadowGenerator } from '@babylonjs/core/Lights/Shadows/cascadedShadowGenerator.js';
import '@babylonjs/core/Lights/Shadows/shadowGeneratorSceneComponent.js';
import { ImportMeshAsync } from '@babylonjs/core/Loading/sceneLoader.js';
import { Color3, Color4 } from '@babylonjs/core/Maths/math.color.js';
import { Vector3 } from '@babylonjs/core/Maths/math.vector.js';
import { Scene } from '@babylonjs/core/scene.js';
import '@babylonjs/loaders/glTF/2.0/glTFLoader.js';
import '@babylonjs/loaders/glTF/2.0/Extensions/KHR_lights_punctual.js';
import { offer } from './frames.mjs';

function addShadows(light, camera, meshes, setup) {
  const shadows = new CascadedShadowGenerator(setup.mapSize, light, false, camera);
  shadows.numCascades = setup.cascades;
  shadows.usePercentageCloserFiltering = true;
  shadows.shadowMaxZ = setup.shadowDistance;
  shadows.bias = 0.0008;
  shadows.normalBias = setup.shadowDistance / 5000;
  for (const mesh of meshes) {
    shadows.addShadowCaster(mesh, false);
    if (!mesh.isAnInstance) mesh.receiveShadows = true;
  }
  shadows.freezeShadowCastersBoundingInfo = true;
  shadows.splitFrustum();
}

async function open(canvas, setup) {
  const engine = new Engine(canvas, setup.antialias, { antialias: setup.antialias, stencil: false }, false);
  const scene = new Scene(engine);
  scene.useRightHandedSystem = true;
  scene.clearColor = Color4.FromArray([...setup.background, 1]);
  const { meshes } = await ImportMeshAsync(setup.url, scene);
  for (const light of [...scene.lights]) light.dispose();

  const camera = new FreeCamera('camera', Vector3.FromArray(setup.eyes[0]), scene);
  camera.upVector = Vector3.FromArray(setup.camera.up);
  camera.fov = setup.camera.fovYDegrees * Math.PI / 180;
  camera.minZ = setup.camera.near;
  camera.maxZ = setup.camera.far;
  const target = Vector3.FromArray(setup.camera.target);
  camera.setTarget(target);
  scene.activeCamera = camera;

  const light = new DirectionalLight('sun', Vector3.FromArray(setup.towardsSun).normalize().negate(), scene);
  light.intensity = setup.sunIntensity;
  scene.ambientColor = new Color3(setup.ambient, setup.ambient, setup.ambient);
  for (const material of scene.materials) material.ambientColor = Color3.White();
  for (const mesh of meshes) mesh.freezeWorldMatrix();
  addShadows(light, camera, meshes.filter((mesh) => mesh.getTotalVertices() > 0), setup);
  await scene.whenReadyAsync();
  function draw(eye) {
    camera.position.fromArray(eye);
    camera.setTarget(target);
    engine.beginFrame();
    scene.render();
    engine.endFrame();
  }
  return { draw, version: Engine.Version };
}

offer(open);
