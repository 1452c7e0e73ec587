// The judge: Blender's Cycles, in a process of its own, which draws one case after another.
import { execFileSync } from 'node:child_process';
import path from 'node:path';

// Each of `folders` has its setup.json.
export function drawByCycles(folders) {
  execFileSync(process.env.BLENDER ?? 'blender', ['--background', '--factory-startup', '--python-exit-code', '1', '--python',
    path.join(import.meta.dirname, 'cycles.py'), '--',
    ...folders.flatMap((folder) => [path.join(folder, 'setup.json'), path.join(folder, 'Cycles')])],
  { stdio: ['ignore', 'ignore', 'inherit'] });
}
