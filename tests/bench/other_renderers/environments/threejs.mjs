// In the browser: three.js, whose environment is filtered by its PMREMGenerator.
import * as THREE from 'three';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';
import { HDRLoader } from 'three/addons/loaders/HDRLoader.js';
import { offer, turnedRows } from './frames.mjs';

const radians = (degrees) => degrees * Math.PI / 180;

async function open(canvas, setup) {
  const { width, height, camera: given } = setup;
  const renderer = new THREE.WebGLRenderer({ canvas, antialias: false, alpha: true });
  renderer.setSize(width, height, false);
  renderer.setClearColor(0x000000, 0);
  renderer.toneMapping = THREE.NoToneMapping;
  const { scene: model } = await new GLTFLoader().loadAsync(setup.model);
  const lights = [];
  model.traverse((object) => object.isLight && lights.push(object));
  for (const light of lights) light.removeFromParent();
  const scene = new THREE.Scene();
  scene.add(model);
  scene.environment = await new HDRLoader().setDataType(THREE.FloatType).loadAsync(setup.environment);
  scene.environment.mapping = THREE.EquirectangularReflectionMapping;
  scene.environmentRotation.y = -radians(setup.rotationDegrees);

  const camera = new THREE.PerspectiveCamera(given.fovYDegrees, width / height, given.near, given.far);
  camera.position.fromArray(given.eye);
  camera.lookAt(new THREE.Vector3().fromArray(given.target));
  // What is drawn into a target stays linear.
  const target = new THREE.WebGLRenderTarget(width, height, { type: THREE.FloatType, samples: 4 });
  function render() {
    renderer.setRenderTarget(target);
    renderer.clear();
    renderer.render(scene, camera);
  }
  return {
    version: THREE.REVISION,
    draw() {
      render();
      renderer.readRenderTargetPixels(target, 0, 0, 1, 1, new Float32Array(4));
    },
    read() {
      render();
      const pixels = new Float32Array(4 * width * height);
      renderer.readRenderTargetPixels(target, 0, 0, width, height, pixels);
      return turnedRows(pixels, width, height);
    },
  };
}

offer(open);
