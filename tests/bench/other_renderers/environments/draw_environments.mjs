// usage: draw_environments.mjs BUILD SHARED CHROMIUM WORK [CASE...]    see README.md
// Draws each case of cases.json with every engine that is here. In WORK/CASE each ENGINE leaves ENGINE.npy, rows from the top
// of R, G, B in linear light, and ENGINE.json, its version and times.
import fs from 'node:fs';
import path from 'node:path';
import { build as bundle } from 'esbuild';
import { launchChromium, newPage, serve } from '../browser.mjs';
import { measured } from '../file_to_picture/measured.mjs';
import { cameraOf } from './camera.mjs';
import { drawByCycles } from './cycles.mjs';
import { drawByGnomon } from './gnomon.mjs';
import { saveArray } from './npy.mjs';

const [build, shared, executable, work, ...chosen] = process.argv.slice(2);
const kPages = { 'three.js': 'threejs', 'Babylon.js': 'babylon' };
const kHtml = '<!doctype html><meta charset="utf-8"><link rel="icon" href="data:,"><canvas></canvas>';
const kLibraries = '/libraries/';

const nameOf = ({ name, environment, rotationDegrees = 0 }) => (
  [name, ...(environment ? [environment] : []), ...(rotationDegrees ? [rotationDegrees] : [])].join(' '));

// The models that a folder's list names, where it is here.
function modelsOf(folder) {
  const list = path.join(folder, 'manifest.json');
  if (!fs.existsSync(list)) return [];
  return JSON.parse(fs.readFileSync(list)).models.map(({ id, path: place }) => ({ id, file: path.join(folder, place) }));
}

// The files of a case: of this folder's own scene, of the build, or of the folders of gathered models.
function filesOf({ name, environment }) {
  const gathered = path.join(shared, 'khronos');
  const own = { spheres: path.join(work, 'spheres.glb'), demo: path.join(build, 'share/gnomon/demo.glb') };
  const models = [gathered, path.join(shared, 'assets')].flatMap((folder) => modelsOf(folder));
  const model = models.find(({ id }) => id === name);
  const environments = path.join(gathered, 'environments');
  const found = environment && fs.existsSync(environments) &&
    fs.readdirSync(environments).find((file) => file.startsWith(environment));
  return {
    modelFile: own[name] ?? model?.file,
    environmentFile: environment ? found && path.join(environments, found) : path.join(work, 'spheres.hdr'),
  };
}

function setupsOf({ cases, ...common }) {
  return cases.map((one) => ({ title: nameOf(one), ...common, rotationDegrees: 0, ...one, ...filesOf(one) }))
    .filter(({ name, title }) => !chosen.length || chosen.includes(name) || chosen.includes(title))
    .filter(({ title, modelFile, environmentFile }) => {
      const here = [modelFile, environmentFile].every((file) => file && fs.existsSync(file));
      if (!here) console.error(`${title}: left out, since its model or its environment is not here.`);
      return here;
    })
    .map((setup) => ({ ...setup, camera: cameraOf(setup.modelFile, setup.view) }));
}

async function drawInChromium(browser, script, setup) {
  const server = await serve(kHtml, {
    '/pages/': path.join(work, 'bundles'), '/model/': path.dirname(setup.modelFile),
    '/environment/': path.dirname(setup.environmentFile),
    [kLibraries]: path.join(import.meta.dirname, '../node_modules/@khronosgroup/gltf-viewer/dist/libs'),
  });
  const page = await newPage(browser, script);
  try {
    await page.goto(server.origin);
    await page.addScriptTag({ url: `/pages/${script}.js` });
    const about = await page.evaluate((given) => window.environments.open(given), {
      ...setup, model: `/model/${path.basename(setup.modelFile)}`,
      environment: `/environment/${path.basename(setup.environmentFile)}`, libraries: `${server.origin}${kLibraries}`,
    });
    const pixels = Buffer.from(await page.evaluate(() => window.environments.picture()), 'base64');
    const { value: times, processor } = await measured(
      () => page.evaluate((count) => window.environments.times(count), setup.frames));
    return { ...about, times, processor: processor / (setup.frames + 1), pixels };
  } finally {
    await page.close();
    server.close();
  }
}

const isChosen = (engine) => !process.env.ENGINES || process.env.ENGINES.split(';').includes(engine);

// Runs one engine, where it is to be drawn with; that it cannot draw something is said and does not end the others.
async function attempt(folder, engine, setup, draw) {
  if (!isChosen(engine)) return;
  try {
    const { pixels, ...about } = await draw();
    if (pixels) saveArray(path.join(folder, `${engine}.npy`), pixels, [setup.height, setup.width, 3]);
    fs.writeFileSync(path.join(folder, `${engine}.json`), JSON.stringify({ engine, ...about }));
  } catch (error) {
    console.error(`${setup.title}, ${engine}: ${error.message.split('\n').slice(0, 3).join(' ')}`);
  }
}

await bundle({
  entryPoints: Object.values(kPages).map((page) => path.join(import.meta.dirname, `${page}.mjs`)),
  outdir: path.join(work, 'bundles'), bundle: true, minify: true, format: 'iife', logLevel: 'error',
});
const drawn = setupsOf(JSON.parse(fs.readFileSync(path.join(import.meta.dirname, 'cases.json')))).map((setup) => {
  const folder = path.join(work, 'drawn', setup.title.replaceAll('/', ' '));
  fs.mkdirSync(folder, { recursive: true });
  fs.writeFileSync(path.join(folder, 'setup.json'), JSON.stringify(setup));
  return { setup, folder };
});
const browser = await launchChromium(executable);
try {
  for (const { setup, folder } of drawn) {
    for (const device of ['cpu', 'gl']) {
      const engine = `Gnomon, ${device}`;
      await attempt(folder, engine, setup, () => drawByGnomon(path.join(build, 'bin/gnomon'), device, folder, engine, setup));
    }
    for (const [engine, script] of Object.entries(kPages)) {
      await attempt(folder, engine, setup, () => drawInChromium(browser, script, setup));
    }
    console.error(setup.title);
  }
} finally {
  await browser.close();
}
if (isChosen('Cycles')) drawByCycles(drawn.map(({ folder }) => folder));
