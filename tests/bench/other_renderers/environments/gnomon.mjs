// Gnomon's own frame, as linear numbers, from a server, so that later frames are warm as the other engines' are.
import fs from 'node:fs';
import path from 'node:path';
import { measured } from '../file_to_picture/measured.mjs';
import { stop } from '../speed/children.mjs';
import { startServer } from '../speed/gnomon.mjs';

// Nothing but the environment and what glows lights it. `step`: turns the camera by so little that no pixel shows it, since the
// same frame again comes from memory.
export function specOf({ width, height, rotationDegrees, camera, gnomon }, environment, step = 0) {
  const { eye: [x, ...rest], target, fovYDegrees, near, far } = camera;
  return {
    width, height, lights: [], ambient: { intensity: 0 },
    camera: { eye: [x + step * 1e-6 * (far - near), ...rest], target, perspective: { fovYDegrees, near, far } },
    environment: { file: environment, rotationDegrees, ...gnomon },
    output: { format: 'npy', arrayColors: 'linear' },
  };
}

// The files that the model names.
export function namedFiles(file) {
  if (!file.endsWith('.gltf')) return [];
  const { buffers = [], images = [] } = JSON.parse(fs.readFileSync(file));
  return [...buffers, ...images].map(({ uri }) => uri).filter((uri) => uri && !uri.startsWith('data:'));
}

async function reply(response) {
  const body = Buffer.from(await response.arrayBuffer());
  if (!response.ok) throw new Error(`${response.status} ${body}`);
  return body;
}

async function upload(origin, { modelFile, environmentFile }) {
  const form = new FormData();
  form.append('scene', new Blob([fs.readFileSync(modelFile)]), path.basename(modelFile));
  for (const name of namedFiles(modelFile)) {
    const bytes = fs.readFileSync(path.join(path.dirname(modelFile), decodeURIComponent(name)));
    form.append(decodeURIComponent(name), new Blob([bytes]), name);
  }
  const environment = path.basename(environmentFile);
  form.append(environment, new Blob([fs.readFileSync(environmentFile)]), environment);
  return JSON.parse(await reply(await fetch(`${origin}/v1/scenes`, { method: 'POST', body: form }))).id;
}

export async function drawByGnomon(program, device, folder, engine, setup) {
  const { child, origin } = await startServer(program, device);
  try {
    const id = await upload(origin, setup);
    const draw = async (step) => reply(await fetch(`${origin}/v1/scenes/${id}/frames`, {
      method: 'POST', headers: { 'content-type': 'application/json' },
      body: JSON.stringify(specOf(setup, path.basename(setup.environmentFile), step)),
    }));
    fs.writeFileSync(path.join(folder, `${engine}.npy`), await draw(0));
    const times = [];
    const { processor } = await measured(async () => {
      for (let i = 0; i <= setup.frames; ++i) {
        const begin = performance.now();
        await draw(i + 1);
        if (i > 0) times.push(performance.now() - begin);
      }
    });
    const { version } = JSON.parse(await reply(await fetch(`${origin}/v1/capabilities`)));
    return { version, times, processor: processor / (setup.frames + 1) };
  } finally {
    await stop(child);
  }
}
