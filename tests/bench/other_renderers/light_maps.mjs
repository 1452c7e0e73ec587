// usage: node light_maps.mjs GNOMON SCENE CHROMIUM OUTPUT    puts three.js's picture of a baked scene beside our own
// Writes OUTPUT/light_maps.png: on the left `gnomon render` with technique lightMap, on the right three.js with the GLB of
// `gnomon bake` and no light but the map's. Both without tone mapping.
import { execFileSync } from 'node:child_process';
import fs from 'node:fs';
import path from 'node:path';
import { launchChromium, newPage, serve } from './browser.mjs';

const [gnomon, scene, chromium, output] = process.argv.slice(2);
const kView = { cameraName: 'close', width: 960, height: 540, background: [0.6, 0.66, 0.74], ambient: 0.3 };
const kBake = ['--set', 'shadow.technique=lightMap', '--set', 'shadow.lightMap.size=4096'];

const folder = fs.mkdtempSync(path.join(output, 'light-maps-'));
try {
  const own = path.join(folder, 'own.png');
  execFileSync(gnomon, ['bake', scene, '-o', path.join(folder, 'baked.glb'), ...kBake]);
  execFileSync(gnomon, ['render', scene, '-o', own, '--camera', kView.cameraName, '--size',
    `${kView.width}x${kView.height}`, '--set', 'toneMapping=none', '--set', 'environment.studio=even',
    '--set', `ambient.intensity=${kView.ambient}`, ...kBake]);

  const html = `<!doctype html><meta charset="utf-8"><link rel="icon" href="data:,">
<style>body { margin: 0; display: flex; background: #fff; gap: 4px } img, canvas { display: block }</style>
<script type="importmap">{"imports": {"three": "/node_modules/three/build/three.module.js",
"three/addons/": "/node_modules/three/examples/jsm/"}}</script>
<img src="/files/own.png"><script type="module" src="/light_map_page.mjs"></script>`;
  const server = await serve(html, { '/files/': folder, '/': import.meta.dirname });
  const browser = await launchChromium(chromium);
  try {
    const page = await newPage(browser, 'light maps');
    await page.setViewportSize({ width: 2 * kView.width + 4, height: kView.height });
    await page.goto(server.origin);
    await page.waitForFunction(() => window.gnomonLightMaps);
    const drawn = await page.evaluate((view) => window.gnomonLightMaps('/files/baked.glb', view), kView);
    if (drawn.mapped === 0) throw new Error('No mesh has a light map.');
    const file = path.join(output, 'light_maps.png');
    await page.screenshot({ path: file });
    console.log(`three.js r${drawn.revision}: ${drawn.mapped} of ${drawn.meshes} meshes have a light map; ${file}`);
  } finally {
    await browser.close();
    server.close();
  }
} finally {
  fs.rmSync(folder, { recursive: true });
}
