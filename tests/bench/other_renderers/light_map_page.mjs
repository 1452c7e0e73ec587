// In the browser: a GLB with light maps, drawn by three.js.
import * as THREE from 'three';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';

// All that a page needs to read MOZ_lightmap.
class LightMaps {
  constructor(parser) {
    this.parser = parser;
    this.name = 'MOZ_lightmap';
  }

  async extendMaterialParams(index, params) {
    const lightMap = this.parser.json.materials[index].extensions?.[this.name];
    if (!lightMap) return;
    const texture = (await this.parser.getDependency('texture', lightMap.index)).clone();
    texture.channel = lightMap.texCoord;
    texture.colorSpace = THREE.SRGBColorSpace;
    params.lightMap = texture;
    params.lightMapIntensity = lightMap.intensity ?? 1;
  }
}

// The picture from the file's camera of that name, besides the baked light lit by the surroundings alone; and how long
// the second frame took.
async function draw(url, { cameraName, width, height, background, ambient }) {
  const gltf = await new GLTFLoader().register((parser) => new LightMaps(parser)).loadAsync(url);
  const canvas = document.createElement('canvas');
  document.body.append(canvas);
  const renderer = new THREE.WebGLRenderer({ canvas, antialias: true, preserveDrawingBuffer: true });
  renderer.setPixelRatio(1);
  renderer.setSize(width, height);
  const scene = new THREE.Scene();
  scene.background = new THREE.Color().setRGB(...background, THREE.LinearSRGBColorSpace);
  scene.add(gltf.scene, new THREE.AmbientLight(0xffffff, Math.PI * ambient));
  gltf.scene.updateMatrixWorld(true);
  const holder = gltf.scene.getObjectByName(cameraName);
  const camera = holder.isCamera ? holder : holder.children.find((each) => each.isCamera);
  camera.aspect = width / height;
  camera.far = 10000;
  camera.updateProjectionMatrix();
  const frame = () => {
    const start = performance.now();
    renderer.render(scene, camera);
    renderer.getContext().readPixels(0, 0, 1, 1, 6408, 5121, new Uint8Array(4));
    return performance.now() - start;
  };
  frame();
  const milliseconds = frame();
  let mapped = 0, meshes = 0;
  gltf.scene.traverse((object) => {
    if (!object.isMesh) return;
    ++meshes;
    if (object.material.lightMap) ++mapped;
  });
  return { revision: THREE.REVISION, milliseconds, meshes, mapped, png: canvas.toDataURL('image/png') };
}

window.gnomonLightMaps = draw;
