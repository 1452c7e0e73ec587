// usage: compare.mjs BIN SCENES HARD_CASES CHROMIUM WORK OUTPUT    see README.md
import { execFileSync } from 'node:child_process';
import fs from 'node:fs';
import os from 'node:os';
import path from 'node:path';
import { startDrawing } from './draw.mjs';
import { markdownOf } from './tables.mjs';

const [bin, scenes, hardCases, executable, work, output] = process.argv.slice(2);
const kRepeats = 5;

// Texels are what the maps of the settings have. Of those of one name, the one with the fewest misclassified receivers
// stands: what a patient user would end with.
const kSettings = [
  { name: 'DirectionalLight as constructed', texels: 512 ** 2 },
  { name: 'DirectionalLight, box around the scene', texels: 512 ** 2, fitBox: true },
  ...[0, 0.5, 1, 2].map((normalBiasTexels) => ({
    name: 'DirectionalLight tuned', texels: 2048 ** 2, fitBox: true, mapSize: 2048, normalBiasTexels,
  })),
  { name: 'SunLight as constructed', texels: 2 * 1024 ** 2, cascades: true },
  { name: 'SunLight tuned', texels: 2 * 2048 ** 2, cascades: true, mapSize: 2048, toCameraFar: true },
];

function casesOf() {
  const listed = JSON.parse(fs.readFileSync(path.join(import.meta.dirname, 'cases.json')));
  const hard = listed.hard.map((name) => {
    const { says, scene, spec } = JSON.parse(fs.readFileSync(path.join(hardCases, `${name}.json`)));
    return { name, says, scene, spec };
  });
  return [listed.common, ...hard].map(({ name, says, scene, spec }) => ({
    name, says, scene,
    spec: { width: spec.width ?? 320, height: spec.height ?? 180, camera: spec.camera, lights: spec.lights },
  }));
}

function measured(one, pictures) {
  const spec = path.join(work, `${one.name}.json`);
  fs.writeFileSync(spec, JSON.stringify(one.spec));
  const args = ['--scene', path.join(scenes, `${one.scene}.glb`), '--spec', spec, '--repeats', String(kRepeats)];
  for (const [name, file] of Object.entries(pictures)) args.push('--picture', `${name}=${file}`);
  return JSON.parse(execFileSync(path.join(bin, 'measure_shadow'), args, { stdio: ['ignore', 'pipe', 'inherit'] }));
}

function leastWrong(rows) {
  const best = new Map();
  for (const row of rows) {
    const known = best.get(row.settings);
    if (!known || row.metrics.misclassified < known.metrics.misclassified) best.set(row.settings, row);
  }
  return [...best.values()];
}

async function compare(browser, one) {
  const { width, height } = one.spec;
  const { drawn, revision, graphics } = await browser.draw(
    one.scene, { width, height, spec: one.spec, repeats: kRepeats }, kSettings);
  const pictures = {};
  drawn.forEach(({ pixels }, i) => {
    pictures[i] = path.join(work, `${one.name}.${i}.f32`);
    fs.writeFileSync(pictures[i], pixels);
  });
  const { own, others, devices, ...about } = measured(one, pictures);
  const theirs = others.map(({ name, metrics }) => {
    const { name: settings, texels, normalBiasTexels } = kSettings[name];
    return {
      renderer: 'three.js', settings, texels, ...(normalBiasTexels !== undefined && { normalBiasTexels }), metrics,
      milliseconds: drawn[name].milliseconds,
    };
  });
  const ours = own.map(({ name, device, texels, refused, metrics, milliseconds }) => (
    { renderer: `Gnomon, ${device}`, settings: name, texels, refused, metrics, milliseconds }));
  const { name, says, scene } = one;
  const rows = [...ours, ...leastWrong(theirs)];
  return { devices, revision, graphics, result: { name, says, scene, ...about, rows } };
}

fs.mkdirSync(work, { recursive: true });
fs.mkdirSync(output, { recursive: true });
const browser = await startDrawing({ executable, scenes });
const report = { cores: os.cpus().length, chromium: browser.version, cases: [] };
try {
  for (const one of casesOf()) {
    const { devices, revision, graphics, result } = await compare(browser, one);
    Object.assign(report, { gnomon: { devices }, threejs: { revision, graphics } });
    report.cases.push(result);
    console.error(one.name);
  }
} finally {
  await browser.close();
}
const rounded = (key, value) => (Number.isInteger(value) || !Number.isFinite(value) ? value : +value.toPrecision(6));
const lines = ({ rows: all, ...one }) => `${JSON.stringify(one, rounded).slice(0, -1)},"rows":[\n${
  all.map((row) => `  ${JSON.stringify(row, rounded)}`).join(',\n')}]}`;
const { cases, ...about } = report;
fs.writeFileSync(path.join(output, 'other_renderers.json'),
  `${JSON.stringify(about).slice(0, -1)},"cases":[\n${cases.map(lines).join(',\n')}]}\n`);
fs.writeFileSync(path.join(output, 'other_renderers.md'), markdownOf(report));
