// usage: compare_speed.mjs BUILD SCENES CHROMIUM WORK OUTPUT    see ../README.md
import fs from 'node:fs';
import os from 'node:os';
import path from 'node:path';
import { gnomonContestants } from './gnomon.mjs';
import { chromiumContestants } from './in_chromium.mjs';
import { median, turnsOf } from './scenes.mjs';
import { markdownOf } from './tables.mjs';
import { vtkContestants } from './vtk.mjs';

const [build, described, executable, work, output] = process.argv.slice(2);
const kRounds = 4;
const kCounted = 3; // of each turn
const kColdRounds = 3;

const readJson = (file) => JSON.parse(fs.readFileSync(file));

// Those that the folder describes, each with its GLB's path; without them, those that every build has.
function scenesOf() {
  if (fs.existsSync(described)) {
    const files = fs.readdirSync(described).filter((name) => name.endsWith('.json')).sort();
    return files.map((name) => readJson(path.join(described, name)))
      .map((scene) => ({ ...scene, file: path.join(described, scene.glb) }));
  }
  console.error(`${described} is absent; the demo and the city are drawn in its scenes' stead.`);
  return readJson(path.join(import.meta.dirname, 'own_scenes.json'))
    .map((scene) => ({ ...scene, file: path.join(build, scene.glb) }));
}

// Those that open; `absent` gets what the others say.
async function openAll(contestants, absent) {
  const opened = [];
  for (const contestant of contestants) {
    try {
      opened.push({ ...contestant, ...await contestant.open() });
    } catch ({ message }) {
      absent[contestant.name] = message.split('\n')[0];
    }
  }
  return opened;
}

// Milliseconds of a warm frame, by the contestant's name. In each round all draw a turn.
async function warmTimes(contestants, { label, frames, absent }) {
  const opened = await openAll(contestants, absent);
  const times = new Map(opened.map(({ name }) => [name, []]));
  const abouts = opened.map(({ name, about }) => ({ name, ...about }));
  try {
    for (const { name, picture } of opened) {
      await picture(path.join(work, 'pictures', `${label} ${name}.png`.replace(/[ ,.]+(?!png$)/g, '_')));
    }
    for (const turn of turnsOf({ rounds: kRounds, counted: kCounted, frames })) {
      for (const { name, turn: draw } of opened) {
        times.get(name).push(...(await draw(turn)).slice(turn.uncounted));
      }
    }
  } finally {
    for (const { close } of opened) await close();
  }
  return { abouts, times: Object.fromEntries([...times].map(([name, each]) => [name, median(each)])) };
}

async function coldTimes(contestants) {
  const times = Object.fromEntries(contestants.map(({ name }) => [name, []]));
  for (let round = 0; round < kColdRounds; ++round) {
    for (const { name, cold } of contestants) times[name].push(await cold());
  }
  const medianOf = (all, key) => (all[0][key] === undefined ? undefined : median(all.map((each) => each[key])));
  return Object.fromEntries(Object.entries(times).map(([name, all]) => (
    [name, { cold: medianOf(all, 'fromProcess'), coldPage: medianOf(all, 'fromPage') }])));
}

async function compare(scene, make, absent) {
  console.error(scene.name);
  const frames = scene.orbit_frames;
  const plain = await warmTimes(make(scene, false), { label: scene.name, frames, absent });
  const smooth = await warmTimes(make(scene, true), { label: `${scene.name} 4x`, frames, absent });
  const present = make(scene, false).filter(({ name }) => name in plain.times);
  const cold = await coldTimes(present);
  const rows = present.map(({ kind, name, says }) => (
    { kind, name, says, warm: plain.times[name], warm4x: smooth.times[name], ...cold[name] }));
  return { abouts: plain.abouts, result: { scene: scene.name, width: scene.width, height: scene.height, rows } };
}

fs.mkdirSync(path.join(work, 'pictures'), { recursive: true });
fs.mkdirSync(output, { recursive: true });
const gnomon = gnomonContestants({ program: path.join(build, 'bin/gnomon'), work });
const browsers = await chromiumContestants({ executable, work });
const vtk = await vtkContestants({ work });
const make = (...of) => [...gnomon(...of), ...browsers(...of), ...vtk.make(...of)];
const report = {
  machine: os.cpus()[0].model.trim(), cores: os.cpus().length, frames: kRounds * kCounted, coldRounds: kColdRounds,
  loadBefore: os.loadavg()[0], absent: vtk.absent ? { VTK: vtk.absent } : {}, scenes: [],
};
try {
  for (const scene of scenesOf()) {
    const { abouts, result } = await compare(scene, make, report.absent);
    report.scenes.push(result);
    report.versions = abouts.filter(({ version }) => version);
  }
} finally {
  vtk.close();
}
report.loadAfter = os.loadavg()[0];
fs.writeFileSync(path.join(output, 'speed.json'), `${JSON.stringify(report, null, 1)}\n`);
fs.writeFileSync(path.join(output, 'speed.md'), markdownOf(report));
console.error(`Written to ${output}; pictures to look at: ${path.join(work, 'pictures')}`);
