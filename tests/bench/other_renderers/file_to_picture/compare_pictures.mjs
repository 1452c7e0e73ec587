// usage: compare_pictures.mjs BUILD CHROMIUM WORK OUTPUT SCENE...    see ../README.md
// SCENE: a description as of speed/own_scenes.json in a file of its own, its GLB beside it; or a name in that list
import fs from 'node:fs';
import os from 'node:os';
import path from 'node:path';
import { openDisplay } from '../speed/display.mjs';
import { median } from '../speed/scenes.mjs';
import { gnomonContestants } from './gnomon.mjs';
import { measured } from './measured.mjs';
import { blenderContestants, f3dContestants, threeContestants, vtkContestants } from './others.mjs';
import { markdownOf } from './tables.mjs';

const [build, executable, work, output, ...names] = process.argv.slice(2);
const kRounds = Number(process.env.ROUNDS ?? 3);
const kFurther = 4; // pictures of a round that count
const kLongest = 5000; // ms, after which no further one begins
const kLongestFirst = 20000; // ms; a program that takes longer for its first picture has no second round

const readJson = (file) => JSON.parse(fs.readFileSync(file));

function sceneOf(name) {
  if (name.endsWith('.json')) {
    const scene = readJson(name);
    return { ...scene, file: path.join(path.dirname(name), scene.glb) };
  }
  const scene = readJson(path.join(import.meta.dirname, '../speed/own_scenes.json')).find((own) => own.name === name);
  if (!scene) throw new Error(`no scene ${name}`);
  return { ...scene, file: path.join(build, scene.glb) };
}

// The mean of the frames from this one on. They have names of their own, so that none is written over another.
async function drawFurther(draw, from, fileOf) {
  const begin = performance.now();
  let count = 0;
  const { wall, processor } = await measured(async () => {
    for (; count < kFurther && performance.now() - begin < kLongest; ++count) {
      await draw(from + count, fileOf(from + count));
    }
  });
  return { wall: wall / count, processor: processor / count };
}

// A round of a contestant: `cold` from the program's start to the first picture on disk, `running` the part of it that a
// program took that ran already, `further` the mean of the further pictures. Each has `wall` and `processor`, in
// milliseconds.
async function drawRound({ once, start, startsWithScene }, scene, fileOf) {
  if (once) return { cold: await measured(() => once(scene, fileOf(0))) };
  const started = await measured(start);
  const program = started.value;
  try {
    const first = await measured(async () => {
      const draw = await program.open(scene);
      await draw(0, fileOf(0));
      return draw;
    });
    const draw = first.value;
    await draw(1, fileOf(1)); // does not count: programs still prepare themselves
    return {
      cold: { wall: started.wall + first.wall, processor: started.processor + first.processor },
      running: startsWithScene ? undefined : first,
      further: await drawFurther(draw, 2, fileOf),
    };
  } finally {
    await program.close();
  }
}

function mediansOf(rounds, key) {
  if (!rounds[0][key]) return undefined;
  const of = (kind) => median(rounds.map((round) => round[key][kind]));
  return { wall: of('wall'), processor: of('processor') };
}

// In each round all contestants take a turn. `absent` gets those that fail.
async function compare(scene, contestants, absent) {
  const rounds = new Map(contestants.map((contestant) => [contestant, []]));
  for (let round = 0; round < kRounds; ++round) {
    for (const [contestant, done] of rounds) {
      if (done.some(({ cold }) => cold.wall > kLongestFirst)) continue;
      console.error(`${scene.name}, round ${round + 1} of ${kRounds}: ${contestant.name}`);
      const name = `${scene.name}_${contestant.name.replace(/[ ,.]+/g, '_')}`;
      try {
        done.push(await drawRound(contestant, scene, (frame) => path.join(work, `${name}_${frame}.png`)));
      } catch ({ message }) {
        absent[contestant.name] = message.split('\n')[0];
        rounds.delete(contestant);
      }
    }
  }
  const rows = [...rounds].map(([{ name, program = name, shadows }, done]) => ({
    name, program, shadows,
    cold: mediansOf(done, 'cold'), running: mediansOf(done, 'running'), further: mediansOf(done, 'further'),
  }));
  return { scene: scene.name, width: scene.width, height: scene.height, rows };
}

// Those that are installed here; `absent` gets the others.
async function allContestants(display, absent) {
  const where = { work, executable, display, program: path.join(build, 'bin/gnomon') };
  const all = { three: threeContestants, VTK: vtkContestants, Blender: blenderContestants, F3D: f3dContestants };
  const present = gnomonContestants(where);
  for (const [name, contestantsOf] of Object.entries(all)) {
    try {
      present.push(...await contestantsOf(where));
    } catch ({ message }) {
      absent[name] = message;
      console.error(`Skipped: ${message}`);
    }
  }
  return present;
}

fs.mkdirSync(work, { recursive: true });
const scenes = names.map(sceneOf);
const display = await openDisplay();
const absent = {};
const report = {
  machine: os.cpus()[0].model.trim(), cores: os.cpus().length, rounds: kRounds, further: kFurther,
  loadBefore: os.loadavg()[0],
};
try {
  const contestants = await allContestants(display.name, absent);
  report.versions = [...new Set(contestants.map(({ version }) => version).filter(Boolean))];
  report.scenes = [];
  for (const scene of scenes) report.scenes.push(await compare(scene, contestants, absent));
} finally {
  display.close();
}
Object.assign(report, { absent, loadAfter: os.loadavg()[0] });
fs.writeFileSync(path.join(output, 'pictures.json'), `${JSON.stringify(report, null, 1)}\n`);
fs.writeFileSync(path.join(output, 'pictures.md'), markdownOf(report));
console.error(`Written to ${output}; pictures to look at: ${work}`);
