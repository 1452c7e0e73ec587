// What moves and what is chosen, on the page in a real browser: clips, variants, targets, and that the last picture is
// that of the last settings.
// usage: node moves_in_browser.mjs GNOMON DEMO CHROMIUM

import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import fs from 'node:fs';
import os from 'node:os';
import path from 'node:path';
import { after, before, test } from 'node:test';

import { movingScene } from './moving_scene.mjs';
import { isSharp, openPage, startBrowser, startServer } from './setup.mjs';

const [gnomon, demo, executable] = process.argv.slice(2);

let server;
let browser;
let open;
before(async () => {
  server = await startServer(gnomon, demo);
  browser = await startBrowser(executable);
  open = await openPage(browser, server.origin, { viewport: { width: 700, height: 500 }, permissions: ['clipboard-read', 'clipboard-write'] });
  await change(() => open.page.setInputFiles('#files', { name: 'moving.gltf', mimeType: 'model/gltf+json', buffer: movingScene }));
  await open.page.evaluate(() => document.querySelectorAll('details:not(#copy-menu)').forEach((node) => (node.open = true)));
});
after(async () => {
  await browser?.close();
  server?.stop();
});

async function change(act) {
  const src = await open.page.getAttribute('#picture', 'src');
  await act();
  await open.page.waitForFunction((before) => document.querySelector('#picture').src !== before, src);
  await isSharp(open.page);
}

const pixelsOf = (image) => {
  const canvas = document.createElement('canvas');
  [canvas.width, canvas.height] = [image.naturalWidth, image.naturalHeight];
  const context = canvas.getContext('2d');
  context.drawImage(image, 0, 0);
  const { data } = context.getImageData(0, 0, canvas.width, canvas.height);
  return Array.from(data, (byte) => String.fromCharCode(byte)).join(''); // numbers one by one take seconds to come over
};
const pixelsIn = async (image) => Buffer.from(await image.evaluate(pixelsOf), 'latin1');
const shownPixels = () => pixelsIn(open.page.locator('#picture'));

// What the command that the page copies draws.
async function pixelsByCurl() {
  await open.page.locator('#copy-menu summary').click();
  await open.page.click('#copy-curl');
  await open.page.locator('#toast.shown', { hasText: 'curl command copied' }).waitFor();
  const command = await open.page.evaluate(() => navigator.clipboard.readText());
  const folder = fs.mkdtempSync(path.join(os.tmpdir(), 'gnomon-curl-'));
  try {
    execFileSync('sh', ['-c', command], { cwd: folder });
    const url = `data:image/png;base64,${fs.readFileSync(path.join(folder, 'frame.png')).toString('base64')}`;
    const page = await browser.newPage();
    await page.setContent(`<img src="${url}">`);
    await page.locator('img').evaluate((image) => image.decode());
    const pixels = await pixelsIn(page.locator('img'));
    await page.close();
    return pixels;
  } finally {
    fs.rmSync(folder, { recursive: true });
  }
}

const scrubber = () => open.page.getByRole('slider', { name: 'Time', exact: true });
const control = (label) => open.page.locator('label', { hasText: new RegExp(`^${label}`) });
const share = (pixels, wanted) => {
  let found = 0;
  for (let i = 0; i < pixels.length; i += 4) found += wanted(pixels[i], pixels[i + 1], pixels[i + 2]) ? 1 : 0;
  return (4 * found) / pixels.length;
};

test('a material variant is chosen', async () => {
  const isBlue = (r, g, b) => b > 1.5 * r && b > 60 && b > 1.5 * g;
  const isRed = (r, g, b) => r > 1.5 * b && r > 60 && r > 1.5 * g;
  const red = await shownPixels();
  await change(() => open.page.locator('select', { has: open.page.locator('option[value=blue]') }).selectOption('blue'));
  const blue = await shownPixels();
  assert.ok(share(red, isRed) > 0.003 && share(blue, isRed) < 0.001, `${share(red, isRed)} and ${share(blue, isRed)} of the picture are red`);
  assert.ok(share(blue, isBlue) > share(red, isBlue) + 0.003);
});

test('the copied curl command draws the picture that is shown', async () => {
  assert.deepEqual(await pixelsByCurl(), await shownPixels());
});

test('a clip plays, is halted, and scrubbed', async () => {
  const { page } = open;
  await change(() => page.locator('select', { has: page.locator('option', { hasText: 'slide' }) }).selectOption('0'));
  const atStart = await shownPixels();
  const seen = new Set();
  await page.getByRole('button', { name: 'Play' }).click();
  while (seen.size < 4) seen.add(await page.getAttribute('#picture', 'src'));
  await page.getByRole('button', { name: 'Pause' }).click();
  await scrubber().fill('1');
  await page.waitForFunction(() => location.hash.includes('animation.timeSeconds=1'));
  await isSharp(page);
  const aside = await shownPixels();
  assert.notDeepEqual(aside, atStart);
  assert.deepEqual(aside, await pixelsByCurl());
});

// A video in a page of its own: {duration, size}, and its pictures at some times as pixels.
async function played(file, times) {
  const page = await browser.newPage();
  try {
    await page.setContent(`<video muted src="data:video/webm;base64,${file.toString('base64')}"></video>`);
    const video = page.locator('video');
    const told = await video.evaluate(async (node) => {
      if (node.readyState < 1) await new Promise((resolve, reject) => Object.assign(node, { onloadedmetadata: resolve, onerror: () => reject(new Error(node.error.message)) }));
      return { duration: node.duration, size: [node.videoWidth, node.videoHeight] };
    });
    const pictures = [];
    for (const time of times) {
      const pixels = await video.evaluate(async (node, seconds) => {
        const isThere = (shown) => shown <= seconds && seconds < shown + 1 / 30 + 1e-3;
        const presented = new Promise((resolve) => {
          const next = () => node.requestVideoFrameCallback((now, { mediaTime }) => (isThere(mediaTime) ? resolve() : next()));
          next();
        });
        node.currentTime = seconds;
        await presented; // `seeked` may come while the frame before is still the one that is drawn
        const context = Object.assign(document.createElement('canvas'), { width: node.videoWidth, height: node.videoHeight }).getContext('2d');
        context.drawImage(node, 0, 0);
        const { data } = context.getImageData(0, 0, node.videoWidth, node.videoHeight);
        return Array.from(data, (byte) => String.fromCharCode(byte)).join('');
      }, time);
      pictures.push(Buffer.from(pixels, 'latin1'));
    }
    return { ...told, pictures };
  } finally {
    await page.close();
  }
}

const meanDifference = (one, other) => {
  assert.equal(one.length, other.length);
  let sum = 0;
  for (let i = 0; i < one.length; i += 1) sum += Math.abs(one[i] - other[i]);
  return (4 / 3) * (sum / one.length); // alpha is the same everywhere
};

test('the clip is recorded, and plays in its colors for as long as it takes', async () => {
  const { page } = open;
  const [download] = await Promise.all([page.waitForEvent('download'), page.click('#record')]);
  assert.equal(download.suggestedFilename(), 'gnomon.webm');
  const file = fs.readFileSync(await download.path());
  const [{ width, height }] = [await page.locator('#picture').evaluate((image) => ({ width: image.naturalWidth, height: image.naturalHeight }))];
  const { duration, size, pictures } = await played(file, [0.2, 1.5, 0.51]); // the last one lies behind
  console.log(`# ${file.length} bytes of ${duration} s`);
  assert.deepEqual([duration, size], [2, [width, height]]);
  for (const [i, seconds] of [0.2, 1.5, 0.5].entries()) {
    await change(() => scrubber().fill(String(seconds)));
    const difference = meanDifference(pictures[i], await shownPixels());
    assert.ok(difference < 2, `${difference} of 255 at ${seconds} s`);
  }
  assert.ok(meanDifference(pictures[0], pictures[1]) > 0.05, 'what moves is seen to move');
});

test('no late picture takes the place of a newer one', async () => {
  const { page } = open;
  let held = 0;
  await page.route('**/frames', async (route) => {
    held += 1;
    if (held % 2) await new Promise((resolve) => setTimeout(resolve, 250)); // every other reply is late
    await route.continue().catch(() => {}); // abandoned meanwhile
  });
  for (const seconds of ['0.2', '0.4', '1.6', '0.7']) {
    const asked = page.waitForRequest('**/frames');
    await scrubber().fill(seconds);
    await asked;
  }
  await isSharp(page);
  await page.unroute('**/frames', { behavior: 'wait' });
  assert.ok(held > 2);
  assert.deepEqual(await shownPixels(), await pixelsByCurl());
});

test('view Motion shows what has moved, and nothing at rest', async () => {
  const { page } = open;
  const isColored = (r, g, b) => Math.max(r, g, b) - Math.min(r, g, b) > 8;
  await change(() => page.locator('[aria-label="More views"]').selectOption('motion'));
  const still = share(await shownPixels(), isColored);
  assert.equal(still, 0, `${still} of the picture`);
  await change(() => scrubber().fill('0.1'));
  const shown = await shownPixels();
  const moved = share(shown, isColored);
  assert.ok(moved > 0.003 && moved < 0.5, `${moved} of the picture, where the board alone moves`);
  assert.deepEqual(await pixelsByCurl(), shown, 'what is copied is what is shown');
  await page.locator('#stage').focus(); // a number's key chooses a view, but not in a control
  await change(() => page.keyboard.press('1'));
});

test('a target is set, and what it led to is kept', async () => {
  const { page } = open;
  await change(() => control('Error').locator('input[type=radio]').check());
  await page.locator('.fact', { hasText: /settings were measured/ }).waitFor();
  await change(() => page.getByRole('button', { name: 'Keep these settings' }).click());
  await page.waitForFunction(() => location.hash.includes('shadow.') && !location.hash.includes('quality'));
});

test('the browser has nothing to complain of', () => assert.deepEqual(open.complaints, []));
