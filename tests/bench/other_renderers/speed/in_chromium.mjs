// The engines that run in a headless Chromium, as contestants.
import fs from 'node:fs';
import path from 'node:path';
import { build } from 'esbuild';
import { launchChromium, newPage, serve } from '../browser.mjs';
import { setupOf } from './scenes.mjs';

const kEngines = [
  { name: 'three.js, CSM', page: 'threejs', variant: 'CSM', says: '4 cascades' },
  { name: 'three.js, SunLight', page: 'threejs', variant: 'SunLight', says: '2 cascades, all that it has' },
  { name: 'Babylon.js', page: 'babylon', says: '4 cascades' },
  { name: 'PlayCanvas', page: 'playcanvas', says: '4 cascades' },
];
const kHtml = '<!doctype html><meta charset="utf-8"><link rel="icon" href="data:,"><canvas></canvas>';

// Each engine with what its page needs of it, in one file, as a page that is to load fast has it.
export async function bundleEngines(folder) {
  await build({
    entryPoints: [...new Set(kEngines.map(({ page }) => path.join(import.meta.dirname, `${page}.mjs`)))],
    outdir: folder, bundle: true, minify: true, format: 'iife', logLevel: 'error',
  });
}

// What an engine's page and the scene come from: `bundles` is what `bundleEngines` has filled.
export const serveEngines = (bundles, scene) => (
  serve(kHtml, { '/pages/': bundles, '/scenes/': path.dirname(scene.file) }));

// A page of an engine with the scene loaded. `script`: of the engine, as 'threejs'.
export async function openEngine(server, browser, { name, script, variant, scene, antialias }) {
  const page = await newPage(browser, name);
  await page.goto(server.origin);
  await page.addScriptTag({ url: `/pages/${script}.js` });
  const setup = setupOf(scene, { url: `/scenes/${path.basename(scene.file)}`, antialias, variant });
  return { page, about: await page.evaluate((given) => window.speed.open(given), setup) };
}

// The frame, drawn and written as PNG.
export async function savePicture(page, frame, file) {
  const url = await page.evaluate((given) => window.speed.picture(given), frame);
  fs.writeFileSync(file, Buffer.from(url.slice(url.indexOf(',') + 1), 'base64'));
}

const milliseconds = (begin) => performance.now() - begin;

// Gives what makes the contestants for a scene.
export async function chromiumContestants({ executable, work }) {
  const bundles = path.join(work, 'bundles');
  await bundleEngines(bundles);

  function contestant({ name, says, page: script, variant }, scene, antialias) {
    const openPage = (server, browser) => openEngine(server, browser, { name, script, variant, scene, antialias });
    const serving = () => serveEngines(bundles, scene);

    async function open() {
      const server = await serving();
      const browser = await launchChromium(executable);
      const { page, about } = await openPage(server, browser);
      return {
        about: { ...about, chromium: browser.version() },
        turn: (turn) => page.evaluate((given) => window.speed.turn(given), turn),
        picture: (file) => savePicture(page, 0, file),
        async close() {
          await browser.close();
          server.close();
        },
      };
    }

    // Once from the start of the browser's process, and once more from a new page of the running browser.
    async function cold() {
      const server = await serving();
      const begin = performance.now();
      const browser = await launchChromium(executable);
      try {
        const { page } = await openPage(server, browser);
        await page.evaluate(() => window.speed.first());
        const fromProcess = milliseconds(begin);
        const again = performance.now();
        const { page: second } = await openPage(server, browser);
        await second.evaluate(() => window.speed.first());
        return { fromProcess, fromPage: milliseconds(again) };
      } finally {
        await browser.close();
        server.close();
      }
    }
    return { kind: 'cascaded', name, says, open, cold };
  }

  return (scene, antialias) => kEngines.map((engine) => contestant(engine, scene, antialias));
}
