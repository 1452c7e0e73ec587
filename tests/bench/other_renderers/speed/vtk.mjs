// VTK as a contestant, where Python has it.
import { spawnSync } from 'node:child_process';
import fs from 'node:fs';
import path from 'node:path';
import readline from 'node:readline';
import { start, stop } from './children.mjs';
import { setupOf } from './scenes.mjs';

const kPythons = ['python3', '/usr/bin/python3'];
const kScript = path.join(import.meta.dirname, 'vtk_frames.py');

const hasVtk = (python) => spawnSync(python, ['-c', 'import vtkmodules.vtkIOImport'], { stdio: 'ignore' }).status === 0;

// A display of its own, since Debian's VTK draws through X even where no window is to be seen. Gives its name.
async function startDisplay() {
  const child = start('Xvfb', ['-displayfd', '3', '-screen', '0', '1280x1024x24'], {
    stdio: ['ignore', 'ignore', 'ignore', 'pipe'],
  });
  const number = await new Promise((done, fail) => {
    child.once('error', () => fail(new Error('neither DISPLAY nor Xvfb')));
    child.once('exit', () => fail(new Error('Xvfb ended')));
    child.stdio[3].once('data', (text) => done(String(text).trim()));
  });
  return { name: `:${number}`, close: () => child.kill() };
}

// The script, which answers a line by a line.
async function startFrames(python, display, setup) {
  const child = start(python, [kScript, setup], {
    stdio: ['pipe', 'pipe', 'ignore'], env: { ...process.env, DISPLAY: display },
  });
  const lines = readline.createInterface({ input: child.stdout })[Symbol.asyncIterator]();
  async function answer() {
    const { value, done } = await lines.next();
    if (done) throw new Error('VTK ended');
    return JSON.parse(value);
  }
  const about = await answer();
  return {
    about,
    ask(...words) {
      child.stdin.write(`${words.join(' ')}\n`);
      return answer();
    },
    close: () => stop(child),
  };
}

// Gives what makes the contestants for a scene. Without VTK there is none, and `absent` says why.
export async function vtkContestants({ work }) {
  const none = (absent) => ({ make: () => [], absent, close() {} });
  const python = kPythons.find(hasVtk);
  if (!python) return none('Python has no VTK (Debian package `python3-vtk9`)');
  let display;
  try {
    display = process.env.DISPLAY ? { name: process.env.DISPLAY, close() {} } : await startDisplay();
  } catch (problem) {
    return none(problem.message);
  }

  function make(scene, antialias) {
    const file = path.join(work, `vtk_${scene.name}${antialias ? '_4x' : ''}.json`);
    fs.writeFileSync(file, JSON.stringify(setupOf(scene, { url: scene.file, antialias })));
    async function open() {
      const frames = await startFrames(python, display.name, file);
      return {
        about: frames.about,
        turn: ({ first, count }) => frames.ask('turn', first, count),
        picture: (png) => frames.ask('picture', png),
        close: frames.close,
      };
    }
    async function cold() {
      const begin = performance.now();
      const frames = await startFrames(python, display.name, file);
      await frames.ask('first');
      const fromProcess = performance.now() - begin;
      await frames.close();
      return { fromProcess };
    }
    return [{ kind: 'kept map', name: 'VTK', says: '1 map, kept from frame to frame', open, cold }];
  }
  return { make, close: display.close };
}
