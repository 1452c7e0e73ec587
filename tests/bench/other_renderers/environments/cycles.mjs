// The judge: Blender's Cycles, in a process of its own.
import { execFileSync } from 'node:child_process';
import fs from 'node:fs';
import path from 'node:path';

export function drawByCycles(folder, setup) {
  const drawn = path.join(folder, 'Cycles');
  execFileSync(process.env.BLENDER ?? 'blender', ['--background', '--factory-startup', '--python-exit-code', '1', '--python',
    path.join(import.meta.dirname, 'cycles.py'), '--', path.join(folder, 'setup.json'), drawn],
  { stdio: ['ignore', 'ignore', 'inherit'] });
  const { version, milliseconds } = JSON.parse(fs.readFileSync(`${drawn}.json`));
  return { version, times: [milliseconds] };
}
