// Pictures by three.js in a headless Chromium.
import { launchChromium, newPage, serve } from './browser.mjs';

const kPage = `<!doctype html><meta charset="utf-8"><link rel="icon" href="data:,">
<script type="importmap">{"imports": {"three": "/node_modules/three/build/three.module.js",
"three/addons/": "/node_modules/three/examples/jsm/"}}</script>
<script type="module" src="/page.mjs"></script>`;

// `draw(scene, tasks)`: all pictures of one scene, in a page of their own.
export async function startDrawing({ executable, scenes }) {
  const server = await serve(kPage, { '/scenes/': scenes, '/': import.meta.dirname });
  const browser = await launchChromium(executable);

  async function draw(scene, { width, height, spec, repeats }, allSettings) {
    const page = await newPage(browser, scene);
    try {
      await page.goto(server.origin);
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
