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
async function bundle(folder) {
  await build({
    entryPoints: [...new Set(kEngines.map(({ page }) => path.join(import.meta.dirname, `${page}.mjs`)))],
    outdir: folder, bundle: true, minify: true, format: 'iife', logLevel: 'error',
  });
}

const milliseconds = (begin) => performance.now() - begin;

// Gives what makes the contestants for a scene.
export async function chromiumContestants({ executable, work }) {
  const bundles = path.join(work, 'bundles');
  await bundle(bundles);

  function contestant({ name, says, page: script, variant }, scene, antialias) {
    async function openPage(server, browser) {
      const page = await newPage(browser, name);
      await page.goto(server.origin);
      await page.addScriptTag({ url: `/pages/${script}.js` });
      const setup = setupOf(scene, { url: `/scenes/${path.basename(scene.file)}`, antialias, variant });
      return { page, about: await page.evaluate((given) => window.speed.open(given), setup) };
    }
    const serving = () => serve(kHtml, { '/pages/': bundles, '/scenes/': path.dirname(scene.file) });

    async function open() {
      const server = await serving();
      const browser = await launchChromium(executable);
      const { page, about } = await openPage(server, browser);
      return {
        about: { ...about, chromium: browser.version() },
        turn: (turn) => page.evaluate((given) => window.speed.turn(given), turn),
        async picture(file) {
          const url = await page.evaluate(() => window.speed.picture(0));
          fs.writeFileSync(file, Buffer.from(url.slice(url.indexOf(',') + 1), 'base64'));
        },
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
