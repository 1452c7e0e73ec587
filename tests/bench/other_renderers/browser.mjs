// A headless Chromium with three.js in it.
import fs from 'node:fs/promises';
import http from 'node:http';
import path from 'node:path';
import { chromium } from 'playwright-core';

const kHere = import.meta.dirname;
const kTypes = { '.mjs': 'text/javascript', '.js': 'text/javascript', '.html': 'text/html' };
const kPage = `<!doctype html><meta charset="utf-8"><link rel="icon" href="data:,">
<script type="importmap">{"imports": {"three": "/node_modules/three/build/three.module.js",
"three/addons/": "/node_modules/three/examples/jsm/"}}</script>
<script type="module" src="/page.mjs"></script>`;

// Serves this folder, and the scenes' one as /scenes/.
async function serve(scenes) {
  const server = http.createServer(async ({ url }, response) => {
    if (url === '/') return response.setHeader('content-type', 'text/html').end(kPage);
    const file = url.startsWith('/scenes/') ? path.join(scenes, url.slice('/scenes/'.length)) : path.join(kHere, url);
    try {
      response.setHeader('content-type', kTypes[path.extname(file)] ?? 'application/octet-stream');
      response.end(await fs.readFile(file));
    } catch {
      response.writeHead(404).end();
    }
  });
  await new Promise((done) => server.listen(0, '127.0.0.1', done));
  return server;
}

// `draw(scene, tasks)`: all pictures of one scene, in a page of their own.
export async function startBrowser({ executable, scenes }) {
  const server = await serve(scenes);
  const browser = await chromium.launch({
    executablePath: executable,
    args: ['--no-sandbox', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--ignore-gpu-blocklist'],
  });

  async function draw(scene, { width, height, spec, repeats }, allSettings) {
    const page = await browser.newPage();
    page.setDefaultTimeout(300000);
    page.on('console', (message) => {
      if (message.type() !== 'log') console.error(`${scene}: ${message.text()}`);
    });
    page.on('pageerror', (error) => console.error(`${scene}: ${error}`));
    try {
      await page.goto(`http://127.0.0.1:${server.address().port}/`);
      await page.waitForFunction(() => window.gnomonBench);
      const about = await page.evaluate(
        ([url, w, h]) => window.gnomonBench.load(url, w, h), [`/scenes/${scene}.glb`, width, height]);
      const drawn = [];
      for (const settings of allSettings) {
        const task = { spec, width, height, repeats, settings };
        const { pixels, milliseconds } = await page.evaluate((each) => window.gnomonBench.draw(each), task);
        drawn.push({ pixels: Buffer.from(pixels, 'base64'), milliseconds });
      }
      return { ...about, drawn };
    } finally {
      await page.close();
    }
  }

  return {
    draw,
    version: browser.version(),
    async close() {
      await browser.close();
      server.close();
    },
  };
}
