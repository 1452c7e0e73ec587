// Gnomon's own rows: `gnomon render`, and `gnomon serve` over HTTP.
import fs from 'node:fs';
import http from 'node:http';
import path from 'node:path';
import { post, startServer } from '../speed/gnomon.mjs';
import { stop } from '../speed/children.mjs';
import { specOf } from '../speed/scenes.mjs';
import { runOnce } from './once.mjs';

const kTechniques = [
  { name: 'exact', shadows: 'exact', shadow: { technique: 'rayTraced' } },
  { name: 'shadow map', shadows: '4 cascades', shadow: { technique: 'shadowMap' } },
];

const specText = (scene, frame, shadow) => Buffer.from(JSON.stringify(specOf(scene, frame, { shadow })));

async function once({ program, work, shadow }, scene, file) {
  const spec = path.join(work, 'spec.json');
  fs.writeFileSync(spec, specText(scene, 0, shadow));
  await runOnce(program, ['render', scene.file, '--device', 'cpu', '--spec', spec, '-o', file]);
}

async function serve({ program, shadow }) {
  const { child, origin } = await startServer(program, 'cpu');
  const agent = new http.Agent({ keepAlive: true, maxSockets: 1 });
  async function open(scene) {
    const { id } = JSON.parse(
      await post(agent, `${origin}/v1/scenes`, 'model/gltf-binary', fs.readFileSync(scene.file)));
    const url = `${origin}/v1/scenes/${id}/frames`;
    return async (frame, file) => (
      fs.writeFileSync(file, await post(agent, url, 'application/json', specText(scene, frame, shadow))));
  }
  async function close() {
    agent.destroy();
    await stop(child);
  }
  return { open, close };
}

export function gnomonContestants({ program, work }) {
  return kTechniques.flatMap(({ name, shadows, shadow }) => [
    { name: `gnomon render, ${name}`, once: (...of) => once({ program, work, shadow }, ...of) },
    { name: `gnomon serve, ${name}`, start: () => serve({ program, shadow }) },
  ].map((each) => ({ ...each, program: `Gnomon, ${name}`, shadows })));
}
