// That everybody can use the page on what they have, and that a scene begins anew: in a real browser, with the shipped
// server behind it.
// usage: node reach_in_browser.mjs GNOMON DEMO CHROMIUM

import assert from 'node:assert/strict';
import fs from 'node:fs';
import { createRequire } from 'node:module';
import { after, before, test } from 'node:test';

import { movingScene } from './moving_scene.mjs';
import { isSharp, openPage, startBrowser, startServer } from './setup.mjs';

const [gnomon, demo, executable] = process.argv.slice(2);
const axe = fs.readFileSync(createRequire(import.meta.url).resolve('axe-core/axe.min.js'), 'utf8');
const kDesktop = { viewport: { width: 1000, height: 640 } };
const kPhone = { viewport: { width: 390, height: 844 }, deviceScaleFactor: 2, hasTouch: true, isMobile: true };

let server;
let browser;
before(async () => {
  server = await startServer(gnomon, demo);
  browser = await startBrowser(executable);
});
after(async () => {
  await browser?.close();
  server?.stop();
});

const atScene = () => `${server.origin}/#scene=${server.scene}`;
async function change(page, act) {
  const src = await page.getAttribute('#picture', 'src');
  await act();
  await page.waitForFunction((before) => document.querySelector('#picture').src !== before, src);
  await isSharp(page);
}
const upload = (page) =>
  change(page, () => page.setInputFiles('#files', { name: 'moving.gltf', mimeType: 'model/gltf+json', buffer: movingScene }));
const pick = (page, id) => change(page, () => page.selectOption('#scene-list', id));
const unfold = (page) => page.evaluate(() => document.querySelectorAll('details:not(.menu)').forEach((node) => (node.open = true)));
const control = (page, label) => page.locator('.field', { has: page.locator('.label', { hasText: new RegExp(`^${label}`) }) }).locator('select');
const hash = (page) => page.evaluate(() => decodeURIComponent(location.hash));

// What axe finds; names that leave out what is seen are found only where they are asked for.
async function findings(page) {
  await page.evaluate(axe);
  const { violations } = await page.evaluate(() => axe.run(document, { rules: { 'label-content-name-mismatch': { enabled: true } }, resultTypes: ['violations'] }));
  return violations.flatMap(({ id, nodes }) => nodes.map(({ html, any, all, none }) => `${id}: ${html.slice(0, 120)}: ${[...any, ...all, ...none][0]?.message}`));
}

for (const colorScheme of ['dark', 'light']) {
  for (const [name, device] of Object.entries({ desktop: kDesktop, phone: kPhone })) {
    test(`everybody can read and name what is there: ${name}, ${colorScheme}`, async () => {
      const { page, complaints, close } = await openPage(browser, atScene(), { ...device, colorScheme });
      await unfold(page);
      await page.locator('.node').first().waitFor();
      await page.locator('.error-card button').click();
      await page.locator('.error-card dt', { hasText: 'Wrong' }).waitFor();
      await page.click('#plan');
      assert.deepEqual(await findings(page), []);
      assert.equal(await page.locator('main, [role=main]').count(), 1);
      assert.deepEqual(complaints, []);
      await close();
    });
  }
}

test('the page without a scene can be read, too', async () => {
  for (const colorScheme of ['dark', 'light']) {
    const context = await browser.newContext({ ...kDesktop, colorScheme });
    const page = await context.newPage();
    await page.route('**/v1/scenes?*', (route) => route.fulfill({ json: { scenes: [] } }));
    await page.goto(server.origin);
    await page.locator('#empty').waitFor();
    assert.deepEqual(await findings(page), []);
    await context.close();
  }
});

test('words over the picture can be read whatever it shows', async () => {
  for (const colorScheme of ['dark', 'light']) {
    const { page, close } = await openPage(browser, atScene(), { ...kDesktop, colorScheme });
    const least = await page.evaluate(() => {
      const numbers = (color) => color.match(/[\d.]+/g).map(Number);
      const luminance = (color) => color.map((part) => part / 255).map((s) => (s <= 0.04045 ? s / 12.92 : ((s + 0.055) / 1.055) ** 2.4)).reduce((sum, part, i) => sum + part * [0.2126, 0.7152, 0.0722][i], 0);
      const contrast = (a, b) => (Math.max(a, b) + 0.05) / (Math.min(a, b) + 0.05);
      const veilOf = (node) => {
        for (let at = node; at; at = at.parentElement) {
          const [r, g, b, alpha = 1] = numbers(getComputedStyle(at).backgroundColor);
          if (alpha > 0) return { rgb: [r, g, b], alpha };
        }
        return null;
      };
      const texts = document.querySelectorAll('.error-card dt, .error-card dd, .error-card button, .stage-tools button');
      return Math.min(...[...texts].flatMap((node) => {
        const { rgb, alpha } = veilOf(node);
        return [0, 255].map((behind) => contrast(luminance(numbers(getComputedStyle(node).color).slice(0, 3)), luminance(rgb.map((part) => part * alpha + behind * (1 - alpha)))));
      }));
    });
    assert.ok(least >= 4.5, `${colorScheme}: ${least}`);
    await close();
  }
});

test('a phone of two pixels a point gets two, and nothing beside the screen', async () => {
  const { page, close } = await openPage(browser, atScene(), kPhone);
  const size = await page.evaluate(() => {
    const [image, stage] = [document.querySelector('#picture'), document.querySelector('#stage')];
    return [image.naturalWidth, image.naturalHeight, 2 * stage.clientWidth, 2 * stage.clientHeight, document.documentElement.scrollWidth];
  });
  assert.deepEqual(size.slice(0, 2), size.slice(2, 4));
  assert.ok(size[4] <= 390);
  await close();
});

test('the first picture is as large as its place stays, and its card says something', async () => {
  const context = await browser.newContext(kDesktop);
  const page = await context.newPage();
  const sizes = [];
  await page.exposeFunction('sized', (height) => sizes.push(height));
  await page.addInitScript(() =>
    addEventListener('DOMContentLoaded', () => {
      const stage = document.querySelector('#stage');
      new ResizeObserver(() => window.sized(stage.clientHeight)).observe(stage);
      const card = () => document.querySelector('.error-card');
      window.blank = 0;
      new MutationObserver(() => (window.blank += card() && !card().hidden && !card().querySelector('dd') ? 1 : 0)).observe(document.body, { subtree: true, childList: true, attributes: true });
    }),
  );
  await page.goto(atScene());
  await isSharp(page);
  await page.locator('.stage-legend li').first().waitFor();
  await page.waitForTimeout(200);
  assert.equal(new Set(sizes).size, 1, sizes.join());
  assert.equal(await page.evaluate(() => window.blank), 0);
  assert.match(await page.locator('.error-card').innerText(), /Texel|Error/);
  await context.close();
});

test('the labels of the chart are whole', async () => {
  const { page, close } = await openPage(browser, `${atScene()}&width=160&height=90`, kDesktop);
  await unfold(page);
  await page.locator('details', { has: page.locator('h2', { hasText: /^Evaluation$/ }) }).getByRole('button', { name: 'Measure' }).click();
  await page.locator('.chart .best').first().waitFor();
  const cut = await page.evaluate(() => {
    const box = document.querySelector('.chart').getBoundingClientRect();
    const texts = [...document.querySelectorAll('.chart text')].map((node) => [node.textContent, node.getBoundingClientRect()]);
    const apart = (a, b) => a.right <= b.left || b.right <= a.left || a.bottom <= b.top || b.bottom <= a.top;
    const isCut = ([, { left, right, top, bottom }]) => left < box.left || right > box.right || top < box.top || bottom > box.bottom;
    const meets = ([, a], i) => texts.some(([, b], j) => j > i && !apart(a, b));
    return texts.filter((text, i) => isCut(text) || meets(text, i)).map(([words]) => words);
  });
  assert.deepEqual(cut, []);
  await close();
});

test('another scene begins with nothing of the one before', async () => {
  const { page, complaints, close } = await openPage(browser, atScene(), kDesktop);
  await upload(page);
  await unfold(page);
  const moving = await page.inputValue('#scene-list');
  await change(page, () => control(page, 'Animation').selectOption('0'));
  await change(page, () => control(page, 'Variant').selectOption('blue'));
  await page.locator('.node').first().waitFor();
  await change(page, () => page.getByRole('button', { name: 'Seen by the camera: board' }).click());
  await page.waitForFunction(() => /animation.*materialVariant/.test(location.hash));
  await change(page, () => page.locator('label', { hasText: /^VSM$/ }).locator('input').check());

  await pick(page, server.scene);
  await page.waitForFunction((id) => location.hash.includes(id), server.scene);
  assert.ok(await page.locator('#banner').isHidden());
  assert.doesNotMatch(await hash(page), /animation|materialVariant|nodes/);
  assert.match(await hash(page), /shadow\.filter\.type=vsm/); // what does not belong to a scene stays
  await page.locator('.node').first().waitFor();
  assert.equal(await page.locator('.node-switch[aria-pressed=false]').count(), 0);
  const demos = await page.locator('#picture').evaluate((image) => image.src);

  await pick(page, moving);
  assert.ok(await page.locator('#banner').isHidden());
  assert.doesNotMatch(await hash(page), /animation|materialVariant|nodes/);
  assert.notEqual(await page.locator('#picture').evaluate((image) => image.src), demos);
  assert.deepEqual(complaints, []);
  await close();
});

// A Radiance picture of one color: 16 x 8 texels of mantissas and a common exponent.
const red = Buffer.concat([Buffer.from('#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 8 +X 16\n'), Buffer.alloc(4 * 128, Buffer.from([200, 20, 20, 129]))]);

test('the first picture of all stands on a ground, and one that a link names is as the link says', async () => {
  for (const [address, expected] of [[server.origin, true], [atScene(), false]]) {
    const { page, complaints, close } = await openPage(browser, address, kDesktop);
    await page.waitForFunction(() => location.hash.includes('camera.'));
    assert.equal((await hash(page)).includes('ground.mode=catcher'), expected);
    assert.deepEqual(complaints, []);
    await close();
  }
});

test('a picture of all directions that comes with a model lights it, and so does one that is added', async () => {
  const { page, complaints, close } = await openPage(browser, atScene(), kDesktop);
  const model = { name: 'moving.gltf', mimeType: 'model/gltf+json', buffer: movingScene };
  const picture = (name) => ({ name, mimeType: 'image/vnd.radiance', buffer: red });
  const source = page.locator('.field', { has: page.locator('.label', { hasText: /^Source$/ }) });
  await change(page, () => page.setInputFiles('#files', [model, picture('red.hdr')]));
  await page.waitForFunction(() => location.hash.includes('environment.file=red.hdr'));
  await change(page, () => page.setInputFiles('#files', [picture('other.hdr')]));
  await page.waitForFunction(() => location.hash.includes('environment.file=other.hdr'));
  await change(page, () => source.locator('label', { hasText: /^Sky$/ }).click());
  await page.waitForFunction(() => location.hash.includes('environment.sky.sun.elevationDegrees'));
  await change(page, () => source.locator('label', { hasText: /^Studio$/ }).click());
  await page.waitForFunction(() => !location.hash.includes('environment'));
  assert.deepEqual(complaints, []);
  await close();
});

test('a scene as a whole is framed by the server, and turned from there', async () => {
  const { page, complaints, close } = await openPage(browser, atScene(), kDesktop);
  await upload(page);
  await page.waitForFunction(() => location.hash.includes('camera.orbit.azimuthDegrees') && !location.hash.includes('camera.orbit.distance'));
  await page.locator('#stage').focus();
  await change(page, () => page.keyboard.press('ArrowLeft'));
  await page.waitForFunction(() => location.hash.includes('camera.orbit.distance'));
  await change(page, () => page.keyboard.press('f'));
  await page.waitForFunction(() => !location.hash.includes('camera.orbit.distance'));
  assert.deepEqual(complaints, []);
  await close();
});

test('the page has every word of the server for tones and for what is seen of the surroundings', async () => {
  const { page, close } = await openPage(browser, atScene(), kDesktop);
  const { schemas } = (await (await fetch(`${server.origin}/openapi.json`)).json()).components;
  const partOf = (schema, step) => (schema.$ref ? schemas[schema.$ref.split('/').pop()] : schema).properties[step];
  for (const path of ['toneMapping', 'environment.background']) {
    const words = path.split('.').reduce(partOf, schemas.FrameSpec).enum;
    const offered = await page.evaluate(async (wanted) => {
      const { kSections } = await import('./fields.mjs');
      return kSections.flatMap(({ fields }) => fields).find((field) => field.path === wanted).choices.map(([value]) => value);
    }, path);
    assert.deepEqual(offered.sort(), words.sort());
  }
  await close();
});
