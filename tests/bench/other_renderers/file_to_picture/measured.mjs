// Wall time and processor time, of this process and of all that descend from it.
import { execFileSync } from 'node:child_process';
import fs from 'node:fs';

// The numbers of /proc/PID/stat that count here: whose child it is, and the ticks of itself and of the children that it
// has waited for.
export function parsedStat(text) {
  const fields = text.slice(text.lastIndexOf(')') + 2).split(' ');
  return { parent: Number(fields[1]), ticks: fields.slice(11, 15).map(Number).reduce((a, b) => a + b, 0) };
}

// The ticks of a process and of all its descendants. `stats`: by process id.
export function ticksOfTree(stats, root) {
  const children = new Map();
  for (const [id, { parent }] of stats) children.set(parent, [...(children.get(parent) ?? []), id]);
  const of = (id) => (children.get(id) ?? []).reduce((sum, child) => sum + of(child), stats.get(id)?.ticks ?? 0);
  return of(root);
}

function allStats() {
  const stats = new Map();
  for (const name of fs.readdirSync('/proc')) {
    if (!/^\d+$/.test(name)) continue;
    try {
      stats.set(Number(name), parsedStat(fs.readFileSync(`/proc/${name}/stat`, 'utf8')));
    } catch {
      // It has ended meanwhile.
    }
  }
  return stats;
}

const kTicksPerSecond = Number(execFileSync('getconf', ['CLK_TCK']));
const processorMs = () => 1000 * ticksOfTree(allStats(), process.pid) / kTicksPerSecond;

// What `action` gives, and the milliseconds that it took: `wall`, and `processor` of all cores together.
export async function measured(action) {
  const before = processorMs();
  const begin = performance.now();
  const value = await action();
  const wall = performance.now() - begin;
  return { value, wall, processor: processorMs() - before };
}
