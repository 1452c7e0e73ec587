// VTK as a contestant, where Python has it.
import { spawnSync } from 'node:child_process';
import fs from 'node:fs';
import path from 'node:path';
import { startAnswering } from './answering.mjs';
import { openDisplay } from './display.mjs';
import { setupOf } from './scenes.mjs';

const kPythons = ['python3', '/usr/bin/python3'];
const kScript = path.join(import.meta.dirname, 'vtk_frames.py');

const hasVtk = (python) => spawnSync(python, ['-c', 'import vtkmodules.vtkIOImport'], { stdio: 'ignore' }).status === 0;

// A Python that has VTK. Throws where there is none.
export function pythonWithVtk() {
  const python = kPythons.find(hasVtk);
  if (!python) throw new Error('Python has no VTK (Debian package `python3-vtk9`)');
  return python;
}

// The script with its scene loaded.
export function startVtk(python, display, { scene, antialias, work }) {
  const file = path.join(work, `vtk_${scene.name}${antialias ? '_4x' : ''}.json`);
  fs.writeFileSync(file, JSON.stringify(setupOf(scene, { url: scene.file, antialias })));
  return startAnswering(python, [kScript, file], { env: { DISPLAY: display } });
}

// Gives what makes the contestants for a scene. Without VTK there is none, and `absent` says why.
export async function vtkContestants({ work }) {
  let python;
  let display;
  try {
    python = pythonWithVtk();
    display = await openDisplay();
  } catch (problem) {
    return { make: () => [], absent: problem.message, close() {} };
  }

  function make(scene, antialias) {
    const startFrames = () => startVtk(python, display.name, { scene, antialias, work });
    async function open() {
      const frames = await startFrames();
      return {
        about: frames.about,
        turn: ({ first, count }) => frames.ask('turn', first, count),
        picture: (png) => frames.ask('picture', 0, png),
        close: frames.close,
      };
    }
    async function cold() {
      const begin = performance.now();
      const frames = await startFrames();
      await frames.ask('first');
      const fromProcess = performance.now() - begin;
      await frames.close();
      return { fromProcess };
    }
    return [{ kind: 'kept map', name: 'VTK', says: '1 map, kept from frame to frame', open, cold }];
  }
  return { make, close: display.close };
}
