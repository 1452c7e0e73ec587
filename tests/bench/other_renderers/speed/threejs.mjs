// In the browser: three.js, with cascades by its add-on CSM or its add-on SunLight, or with one map of the whole scene that
// is drawn once.
import * as THREE from 'three';
import { CSM } from 'three/addons/csm/CSM.js';
import { SunLight } from 'three/addons/lights/SunLight.js';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';
import { offer } from './frames.mjs';

const kTexelsOfBias = 1;

// Four lights, one a cascade, which the add-on moves along with the camera.
function cascadedLights(scene, camera, setup) {
  const csm = new CSM({
    camera, parent: scene, cascades: setup.cascades, shadowMapSize: setup.mapSize, maxFar: setup.shadowDistance,
    lightDirection: new THREE.Vector3(...setup.towardsSun).normalize().negate(), lightIntensity: setup.sunIntensity,
    lightMargin: setup.shadowDistance, lightFar: 4 * setup.shadowDistance,
  });
  for (const { shadow } of csm.lights) {
    shadow.normalBias = kTexelsOfBias * (shadow.camera.right - shadow.camera.left) / setup.mapSize;
  }
  scene.traverse((object) => {
    if (object.isMesh) csm.setupMaterial(object.material);
  });
  return () => csm.update();
}

function sunLight(scene, setup) {
  const light = new SunLight(0xffffff, setup.sunIntensity);
  light.position.set(...setup.towardsSun);
  light.castShadow = true;
  light.shadow.mapSize.set(setup.mapSize, setup.mapSize);
  light.shadow.camera.far = setup.shadowDistance;
  scene.add(light);
  return () => {};
}

function keptMap(scene, model, renderer, setup) {
  const { center, radius } = new THREE.Box3().setFromObject(model).getBoundingSphere(new THREE.Sphere());
  const light = new THREE.DirectionalLight(0xffffff, setup.sunIntensity);
  light.position.set(...setup.towardsSun).normalize().multiplyScalar(2 * radius).add(center);
  light.target.position.copy(center);
  light.castShadow = true;
  light.shadow.mapSize.set(setup.mapSize, setup.mapSize);
  light.shadow.normalBias = kTexelsOfBias * 2 * radius / setup.mapSize;
  Object.assign(light.shadow.camera, {
    left: -radius, right: radius, bottom: -radius, top: radius, near: radius, far: 3 * radius,
  });
  scene.add(light, light.target);
  renderer.shadowMap.autoUpdate = false;
  renderer.shadowMap.needsUpdate = true;
  return () => {};
}

async function open(canvas, setup) {
  const renderer = new THREE.WebGLRenderer({ canvas, antialias: setup.antialias });
  renderer.setPixelRatio(1);
  renderer.setSize(setup.width, setup.height, false);
  renderer.shadowMap.enabled = true;
  const scene = new THREE.Scene();
  scene.background = new THREE.Color().setRGB(...setup.background, THREE.SRGBColorSpace);
  const { scene: model } = await new GLTFLoader().loadAsync(setup.url);
  model.traverse((object) => {
    object.castShadow = true;
    object.receiveShadow = true;
    object.visible &&= !object.isLight;
  });
  scene.add(model, new THREE.AmbientLight(0xffffff, setup.ambient * setup.sunIntensity));

  const { fovYDegrees, near, far, target, up } = setup.camera;
  const camera = new THREE.PerspectiveCamera(fovYDegrees, setup.width / setup.height, near, far);
  camera.up.set(...up);
  const follow = {
    CSM: () => cascadedLights(scene, camera, setup),
    SunLight: () => sunLight(scene, setup),
    kept: () => keptMap(scene, model, renderer, setup),
  }[setup.variant]();
  function draw(eye) {
    camera.position.set(...eye);
    camera.lookAt(...target);
    camera.updateMatrixWorld();
    follow();
    renderer.render(scene, camera);
  }
  return { draw, version: `r${THREE.REVISION}` };
}

offer(open);
