// What people use today: three.js in a headless Chromium, VTK, F3D and Blender.
import { spawnSync } from 'node:child_process';
import fs from 'node:fs';
import path from 'node:path';
import { launchChromium } from '../browser.mjs';
import { startAnswering } from '../speed/answering.mjs';
import { bundleEngines, openEngine, savePicture, serveEngines } from '../speed/in_chromium.mjs';
import { setupOf } from '../speed/scenes.mjs';
import { pythonWithVtk, startVtk } from '../speed/vtk.mjs';
import { runOnce } from './once.mjs';

const kThree = [
  { variant: 'CSM', shadows: '4 cascades' },
  { variant: 'kept', shadows: '1 map, drawn once' },
];
const kBlender = [
  { engine: 'CYCLES', name: 'Cycles', shadows: 'exact, 4 samples' },
  { engine: 'BLENDER_EEVEE', name: 'Eevee', shadows: '4 cascades, 4 samples' },
];
const kBlenderScript = path.join(import.meta.dirname, 'blender_frames.py');

// Throws with the package to install where the program is missing.
function versionOf(program, debianPackage) {
  const { status, stdout } = spawnSync(program, ['--version'], { encoding: 'utf8' });
  if (status !== 0) throw new Error(`there is no \`${program}\` (Debian package \`${debianPackage}\`)`);
  return stdout.match(/\d+(\.\d+)+/)[0];
}

async function startChromium({ executable, work }, variant) {
  const browser = await launchChromium(executable);
  const servers = [];
  return {
    async open(scene) {
      const server = await serveEngines(path.join(work, 'bundles'), scene);
      servers.push(server);
      const { page } = await openEngine(
        server, browser, { name: 'three.js', script: 'threejs', variant, scene, antialias: true });
      return (frame, file) => savePicture(page, frame, file);
    },
    async close() {
      await browser.close();
      servers.forEach((server) => server.close());
    },
  };
}

export async function threeContestants(where) {
  await bundleEngines(path.join(where.work, 'bundles'));
  const three = JSON.parse(fs.readFileSync(path.join(where.work, '../node_modules/three/package.json'))).version;
  const version = `three.js ${three}, Chromium ${versionOf(where.executable, 'chromium')}`;
  return kThree.map(({ variant, shadows }) => (
    { name: `three.js, ${variant}`, shadows, version, start: () => startChromium(where, variant) }));
}

// A program that is started with its scene: its first picture can't be told apart from its start.
async function startScript(startFrames) {
  let frames;
  return {
    async open(scene) {
      frames = await startFrames(scene);
      return (frame, file) => frames.ask('picture', frame, file);
    },
    close: () => frames?.close(),
  };
}

export function vtkContestants({ work, display }) {
  const python = pythonWithVtk();
  const asked = 'from vtkmodules.vtkCommonCore import vtkVersion; print(vtkVersion.GetVTKVersion())';
  const version = `VTK ${spawnSync(python, ['-c', asked], { encoding: 'utf8' }).stdout.trim()}`;
  return [false, true].map((antialias) => ({
    name: antialias ? 'VTK, 4 samples' : 'VTK, 1 sample', shadows: '1 map, drawn once', version, startsWithScene: true,
    start: () => startScript((scene) => startVtk(python, display, { scene, antialias, work })),
  }));
}

export function blenderContestants({ work, display }) {
  const version = versionOf('blender', 'blender');
  function startBlender(engine, scene) {
    const file = path.join(work, `blender_${scene.name}_${engine}.json`);
    fs.writeFileSync(file, JSON.stringify({ engine, ...setupOf(scene, { url: scene.file, antialias: true }) }));
    const args = ['--background', '--factory-startup', '--python', kBlenderScript, '--', file];
    return startAnswering('blender', args, { env: { DISPLAY: display }, answersAt: 3 });
  }
  return kBlender.map(({ engine, name, shadows }) => ({
    name: `Blender, ${name}`, shadows, version: `Blender ${version}`, startsWithScene: true,
    start: () => startScript((scene) => startBlender(engine, scene)),
  }));
}

export function f3dContestants({ display }) {
  const version = versionOf('f3d', 'f3d');
  async function once(scene, file) {
    const { eye, target, up, fovy_deg: fovY } = scene.camera;
    await runOnce('f3d', [
      scene.file, `--output=${file}`, `--resolution=${scene.width},${scene.height}`, '--dry-run', '--quiet',
      `--camera-position=${eye}`, `--camera-focal-point=${target}`, `--camera-view-up=${up}`,
      `--camera-view-angle=${fovY}`], { DISPLAY: display });
  }
  return [{ name: 'F3D', shadows: 'none', version: `F3D ${version}`, once }];
}
