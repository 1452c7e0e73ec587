// In the browser: draws a scene with three.js, and reads back S and the view depth of every pixel.
import * as THREE from 'three';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';
import { SunLight } from 'three/addons/lights/SunLight.js';

const kRadians = Math.PI / 180;
let loaded;
let renderer;

// White, lit by N.L of the triangle itself, so that every pixel that faces the light gets some; masks stay. Alpha is
// given over to the view depth.
function plainMaterial(material) {
  if (material.transparent) throw new Error('Blended surfaces are not compared.');
  const masked = material.alphaTest > 0;
  const plain = new THREE.MeshLambertMaterial({
    flatShading: true, side: material.side, alphaTest: material.alphaTest, opacity: material.opacity,
    map: masked ? material.map : null, vertexColors: masked && material.vertexColors,
  });
  plain.onBeforeCompile = (shader) => {
    shader.fragmentShader = shader.fragmentShader.replace(
      '#include <dithering_fragment>', 'gl_FragColor.a = vViewPosition.z;');
  };
  return plain;
}

// Once a page: loads the scene and makes everything in it cast and receive.
async function load(url, width, height) {
  const gltf = await new GLTFLoader().loadAsync(url);
  const lights = [];
  const materials = new Map();
  gltf.scene.traverse((object) => {
    if (object.isLight) lights.push(object);
    if (!object.isMesh) return;
    object.castShadow = true;
    object.receiveShadow = true;
    if (!materials.has(object.material)) materials.set(object.material, plainMaterial(object.material));
    object.material = materials.get(object.material);
  });
  for (const light of lights) light.removeFromParent();
  gltf.scene.updateMatrixWorld(true);
  loaded = { gltf, bounds: new THREE.Box3().setFromObject(gltf.scene, true) };
  const canvas = document.createElement('canvas');
  document.body.append(canvas);
  renderer = new THREE.WebGLRenderer({ canvas, antialias: false, alpha: true, preserveDrawingBuffer: true });
  renderer.setSize(width, height);
  renderer.setClearColor(0x000000, 0);
  renderer.shadowMap.enabled = true; // its type stays what it is
  return { revision: THREE.REVISION, graphics: graphicsName() };
}

function graphicsName() {
  const gl = renderer.getContext();
  return gl.getParameter(gl.getExtension('WEBGL_debug_renderer_info').UNMASKED_RENDERER_WEBGL);
}

function cornersOf({ min, max }) {
  const corners = [];
  for (const x of [min.x, max.x]) {
    for (const y of [min.y, max.y]) for (const z of [min.z, max.z]) corners.push(new THREE.Vector3(x, y, z));
  }
  return corners;
}

// The spec's camera; its far plane just holds the scene.
function cameraOf({ camera: { node, eye, target, perspective } }, aspect) {
  let camera = new THREE.PerspectiveCamera();
  if (node) {
    camera.copy(loaded.gltf.cameras.find(({ name }) => name === node), false);
    loaded.gltf.cameras.find(({ name }) => name === node).matrixWorld.decompose(
      camera.position, camera.quaternion, camera.scale);
  } else {
    camera.position.fromArray(eye);
    camera.lookAt(new THREE.Vector3().fromArray(target));
    camera.fov = perspective.fovYDegrees;
    camera.near = perspective.near ?? camera.position.distanceTo(new THREE.Vector3().fromArray(target)) / 1000;
  }
  camera.updateMatrixWorld(true);
  const depths = cornersOf(loaded.bounds).map((corner) => -camera.worldToLocal(corner).z);
  camera.far = Math.max(1.01 * Math.max(...depths), 2 * camera.near);
  camera.aspect = aspect;
  camera.updateProjectionMatrix();
  return camera;
}

// From the scene towards the light: azimuth from north (-Z) over east, or against the way that it travels.
function towardsLight({ direction, sun }) {
  if (direction) return new THREE.Vector3().fromArray(direction).negate().normalize();
  const [azimuth, elevation] = [sun.azimuthDegrees * kRadians, sun.elevationDegrees * kRadians];
  return new THREE.Vector3(Math.sin(azimuth) * Math.cos(elevation), Math.sin(elevation),
    -Math.cos(azimuth) * Math.cos(elevation));
}

// The least box along the light that holds the scene.
function fitBox(light) {
  const { camera } = light.shadow;
  light.updateMatrixWorld(true);
  light.target.updateMatrixWorld(true);
  light.shadow.updateMatrices(light);
  const seen = new THREE.Box3().setFromPoints(
    cornersOf(loaded.bounds).map((corner) => corner.applyMatrix4(camera.matrixWorldInverse)));
  const margin = 0.001 * seen.getSize(new THREE.Vector3()).length();
  Object.assign(camera, {
    left: seen.min.x - margin, right: seen.max.x + margin, bottom: seen.min.y - margin, top: seen.max.y + margin,
    near: -seen.max.z - margin, far: -seen.min.z + margin,
  });
  camera.updateProjectionMatrix();
}

// One that shines on the middle of the scene from just outside of it.
function directionalLight(towards, settings) {
  const light = new THREE.DirectionalLight(0xffffff, 1);
  const sphere = loaded.bounds.getBoundingSphere(new THREE.Sphere());
  light.target.position.copy(sphere.center);
  light.position.copy(sphere.center).addScaledVector(towards, 1.1 * sphere.radius);
  if (settings.mapSize) light.shadow.mapSize.set(settings.mapSize, settings.mapSize);
  if (settings.fitBox) fitBox(light);
  const { camera } = light.shadow;
  const texel = Math.max(camera.right - camera.left, camera.top - camera.bottom) / light.shadow.mapSize.x;
  if (settings.normalBiasTexels) light.shadow.normalBias = settings.normalBiasTexels * texel;
  return light;
}

// The add-on's cascades; they end where the camera does.
function sunLight(towards, settings, far) {
  const light = new SunLight(0xffffff, 1);
  light.position.copy(towards);
  if (settings.mapSize) light.shadow.mapSize.set(settings.mapSize, settings.mapSize);
  if (settings.toCameraFar) light.shadow.camera.far = far;
  return light;
}

function read(scene, camera, target) {
  const { width, height } = target;
  renderer.setRenderTarget(target);
  renderer.clear();
  renderer.render(scene, camera);
  const rows = new Float32Array(4 * width * height);
  renderer.readRenderTargetPixels(target, 0, 0, width, height, rows);
  renderer.setRenderTarget(null);
  return rows;
}

// S and depth, the first row on top. A pixel without light, with or without shadows, has S = 0.
function divided(lit, shaded, width, height) {
  const out = new Float32Array(2 * width * height);
  for (let y = 0; y < height; ++y) {
    for (let x = 0; x < width; ++x) {
      const from = 4 * ((height - 1 - y) * width + x);
      const to = 2 * (y * width + x);
      out[to] = lit[from] > 0 ? shaded[from] / lit[from] : 0;
      out[to + 1] = lit[from + 3];
    }
  }
  return out;
}

const median = (values) => values.sort((a, b) => a - b)[values.length >> 1];

// Whole frames with their shadow maps, into 8 bits; one pixel is read so that all is done.
function timesOf(scene, camera, width, height, repeats) {
  const target = new THREE.WebGLRenderTarget(width, height);
  const pixel = new Uint8Array(4);
  const times = [];
  for (let i = 0; i <= repeats; ++i) {
    const begin = performance.now();
    renderer.setRenderTarget(target);
    renderer.clear();
    renderer.render(scene, camera);
    renderer.readRenderTargetPixels(target, 0, 0, 1, 1, pixel);
    if (i > 0) times.push(performance.now() - begin);
  }
  renderer.setRenderTarget(null);
  target.dispose();
  return median(times);
}

function base64(floats) {
  const bytes = new Uint8Array(floats.buffer);
  let text = '';
  for (let i = 0; i < bytes.length; i += 0x8000) text += String.fromCharCode(...bytes.subarray(i, i + 0x8000));
  return btoa(text);
}

function draw({ spec, width, height, settings, repeats }) {
  const scene = new THREE.Scene();
  const camera = cameraOf(spec, width / height);
  const towards = towardsLight(spec.lights[0]);
  const light = settings.cascades ? sunLight(towards, settings, camera.far) : directionalLight(towards, settings);
  scene.add(loaded.gltf.scene, light);
  if (light.target) scene.add(light.target);
  const target = new THREE.WebGLRenderTarget(width, height, { type: THREE.FloatType });
  target.depthTexture = new THREE.DepthTexture(width, height, THREE.FloatType);

  light.castShadow = false;
  const lit = read(scene, camera, target);
  light.castShadow = true;
  const shaded = read(scene, camera, target);
  const milliseconds = timesOf(scene, camera, width, height, repeats);
  target.dispose();
  light.dispose();
  return { pixels: base64(divided(lit, shaded, width, height)), milliseconds };
}

window.gnomonBench = { load, draw };
