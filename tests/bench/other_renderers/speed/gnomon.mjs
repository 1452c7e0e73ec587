// Gnomon's own rows, as contestants: a server over a kept connection, and `gnomon render`.
import fs from 'node:fs';
import http from 'node:http';
import path from 'node:path';
import readline from 'node:readline';
import { start, stop } from './children.mjs';
import { specOf } from './scenes.mjs';

const kTechniques = [
  { name: 'exact', says: '`rayTraced`', shadow: { technique: 'rayTraced' } },
  { name: 'shadow map', says: 'defaults', shadow: { technique: 'shadowMap' } },
];

// A server on a free port of this machine.
export async function startServer(program, device) {
  const child = start(program, ['serve', '--until-stdin-closes', '--port', '0', '--device', device],
                      { stdio: ['pipe', 'pipe', 'ignore'] });
  const lines = readline.createInterface({ input: child.stdout });
  for await (const line of lines) {
    const [, origin] = line.match(/^listening on (\S+)/) ?? [];
    if (origin) return { child, origin };
  }
  throw new Error(`no server for ${device}`);
}

// The body of the reply.
export function post(agent, url, type, body) {
  return new Promise((done, fail) => {
    const headers = { 'content-type': type, 'content-length': body.length, accept: 'image/png' };
    const request = http.request(url, { method: 'POST', agent, headers }, (response) => {
      const parts = [];
      response.on('data', (part) => parts.push(part));
      response.on('end', () => {
        const all = Buffer.concat(parts);
        if (response.statusCode < 300) done(all);
        else fail(new Error(`${url}: ${response.statusCode} ${all}`));
      });
    });
    request.on('error', fail);
    request.end(body);
  });
}

function contestant({ program, work, device, technique, scene, antialias }) {
  const settings = { shadow: technique.shadow, ...(!antialias && { antialiasing: 'none' }) };
  const specText = (frame) => Buffer.from(JSON.stringify(specOf(scene, frame, settings)));

  async function open() {
    const { child, origin } = await startServer(program, device);
    const agent = new http.Agent({ keepAlive: true, maxSockets: 1 });
    const { id } = JSON.parse(
      await post(agent, `${origin}/v1/scenes`, 'model/gltf-binary', fs.readFileSync(scene.file)));
    const draw = (spec) => post(agent, `${origin}/v1/scenes/${id}/frames`, 'application/json', spec);
    return {
      about: {},
      async turn({ first, count }) {
        const times = [];
        for (let frame = first; frame < first + count; ++frame) {
          const spec = specText(frame);
          const begin = performance.now();
          await draw(spec);
          times.push(performance.now() - begin);
        }
        return times;
      },
      async picture(file) {
        fs.writeFileSync(file, await draw(specText(0)));
      },
      async close() {
        agent.destroy();
        await stop(child);
      },
    };
  }

  // The process from its start to its end, with the PNG on disk.
  async function cold() {
    const spec = path.join(work, 'cold.json');
    fs.writeFileSync(spec, specText(0));
    const begin = performance.now();
    const child = start(program, ['render', scene.file, '--device', device, '--spec', spec, '-o',
      path.join(work, 'cold.png')], { stdio: 'ignore' });
    const code = await new Promise((done) => child.once('exit', done));
    if (code !== 0) throw new Error(`gnomon render ended with ${code}`);
    return { fromProcess: performance.now() - begin };
  }
  return { kind: 'gnomon', name: `Gnomon ${device}, ${technique.name}`, says: technique.says, open, cold };
}

// Gives what makes the contestants for a scene.
export function gnomonContestants({ program, work }) {
  return (scene, antialias) => ['cpu', 'gl'].flatMap((device) => (
    kTechniques.map((technique) => contestant({ program, work, device, technique, scene, antialias }))));
}
