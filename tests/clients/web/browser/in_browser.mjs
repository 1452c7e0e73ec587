// The page as people meet it: in a real browser, with the shipped server behind it.
// usage: node in_browser.mjs GNOMON DEMO CHROMIUM

import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';

import { isSharp, openPage, startBrowser, startServer } from './setup.mjs';

const [gnomon, demo, executable] = process.argv.slice(2);
const slowness = Number(process.env.GNOMON_SLOWNESS ?? 1);
const kFirstPaintMs = 300 * slowness;
const kTimesALine = 4; // where the browser alone is slow: of its first paint of a line of text
const kOrbitMs = 2000;
const kLeastPictures = 6; // a machine that does nothing else shows twenty and more

let server;
let browser;
let open; // the page that most tests share
before(async () => {
  server = await startServer(gnomon, demo);
  browser = await startBrowser(executable);
  open = await openPage(browser, server.origin);
});
after(async () => {
  await browser?.close();
  server?.stop();
});

const change = async (act) => {
  const before = await open.page.getAttribute('#picture', 'src');
  await act();
  await open.page.waitForFunction((src) => document.querySelector('#picture').src !== src, before);
  await isSharp(open.page);
};
const firstPaint = (page) =>
  page.evaluate(() => new Promise((resolve) => {
    new PerformanceObserver((list) => list.getEntriesByName('first-contentful-paint').forEach((entry) => resolve(entry.startTime)))
      .observe({ type: 'paint', buffered: true });
  }));
const firstPaintOfALine = async () => {
  const context = await browser.newContext();
  const page = await context.newPage();
  await page.goto(`${server.origin}/livez`);
  const paint = await firstPaint(page);
  await context.close();
  return paint;
};
const section = (title) => open.page.locator('details', { has: open.page.locator('summary h2', { hasText: new RegExp(`^${title}$`) }) });
const unfold = (title) => section(title).evaluate((node) => (node.open = true));

test('it is painted at once, small, and comes from this server alone', async () => {
  const paints = [];
  const paintsOfALine = [];
  for (let i = 0; i < 3; i += 1) {
    paintsOfALine.push(await firstPaintOfALine());
    const { page, close } = await openPage(browser, server.origin);
    paints.push(await firstPaint(page));
    await close();
  }
  const latest = Math.max(kFirstPaintMs, kTimesALine * Math.min(...paintsOfALine));
  const told = `first paints after ${paints.map(Math.round)} ms, of a line after ${paintsOfALine.map(Math.round)} ms`;
  console.log(`# ${told}`);
  assert.ok(Math.min(...paints) < latest, told);
  const own = open.fetched.filter(({ url }) => url.protocol === 'http:' && !url.pathname.startsWith('/v1/'));
  const bytes = own.reduce((sum, file) => sum + file.bytes, 0);
  assert.ok(bytes > 50_000 && bytes < 165_000, `${bytes} bytes`);
  assert.deepEqual(open.fetched.filter(({ url }) => url.protocol.startsWith('http') && url.origin !== server.origin), []);
});

test('the picture follows the hand, and at rest is sharp and as large as its place', async () => {
  const { page } = open;
  const box = await page.locator('#stage').boundingBox();
  await page.evaluate(() => {
    window.pictures = 0;
    new MutationObserver(() => (window.pictures += 1)).observe(document.querySelector('#picture'), { attributeFilter: ['src'] });
  });
  const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
  await page.mouse.move(x, y);
  await page.mouse.down();
  const began = Date.now();
  for (let i = 0; Date.now() - began < kOrbitMs; i += 1) await page.mouse.move(x + 120 * Math.sin(i / 25), y + 10 * Math.sin(i / 17));
  const pictures = await page.evaluate(() => window.pictures);
  await page.mouse.up();
  console.log(`# ${((1000 * pictures) / kOrbitMs).toFixed(1)} pictures a second while it is turned`);
  assert.ok(pictures >= kLeastPictures / slowness, `${pictures} pictures`);
  await page.waitForFunction(() => {
    const [image, place] = [document.querySelector('#picture'), document.querySelector('#stage')];
    return image.naturalWidth === place.clientWidth && image.naturalHeight === place.clientHeight; // no stripe beside it
  });
  assert.ok(!(await page.locator('#busy').isVisible()));
});

test('the error is measured, and stands beside the picture', async () => {
  await open.page.locator('.error-card button').click();
  await open.page.locator('.error-card dt', { hasText: 'Wrong' }).waitFor();
  assert.match(await open.page.locator('.error-card').innerText(), /Wrong\s(0|< 0\.01) %/); // rays, which auto chooses; the view is where the hand left it
  await change(() => open.page.locator('label', { hasText: /^Maps$/ }).locator('input').check());
  await open.page.locator('.error-card button').click();
  await open.page.waitForFunction(() => /Texel[^%]*px[^%]*%/.test(document.querySelector('.error-card').innerText));
});

test('two settings are compared, and the handle moves by keys', async () => {
  const { page } = open;
  await page.click('#compare');
  await page.locator('.compare-a[src]').waitFor();
  await change(() => page.locator('label', { hasText: /^VSM$/ }).locator('input').check());
  await page.waitForFunction(() => /differ/.test(document.querySelector('.compare-says').textContent) && !document.querySelector('.compare.waiting'));
  assert.ok(Number.parseFloat(await page.locator('.compare-says').innerText()) > 0);
  await page.locator('.compare-handle').focus();
  await page.keyboard.press('ArrowRight');
  assert.equal(await page.getAttribute('.compare-handle', 'aria-valuenow'), '52');
  await page.keyboard.press('Escape');
  assert.ok(await page.locator('.compare').isHidden());
});

test('the plan lies over the picture, and the atlas has names', async () => {
  const { page } = open;
  await page.click('#plan');
  await page.locator('.plan-lines line').nth(20).waitFor({ state: 'attached' });
  await page.locator('.plan-map polygon').nth(5).waitFor();
  await page.click('#plan');
  await page.locator('.plan-map').waitFor({ state: 'hidden' });
  await change(() => page.selectOption('[aria-label="More views"]', 'atlas'));
  assert.match(await page.locator('.plan-tile').first().getAttribute('aria-label'), /Light 0, tile \d: \d+ × \d+ texels/);
  await change(() => page.keyboard.press('1'));
});

test('lights are added, edited and taken away', async () => {
  const { page } = open;
  await change(() => page.getByRole('button', { name: '+ Spot' }).click());
  assert.equal(await page.locator('.light-row:visible').count(), 2);
  const row = page.locator('.light-row').nth(1);
  await change(() => row.locator('input[role=switch]').uncheck());
  await page.waitForFunction(() => location.hash.includes('lights[1].shadow.enabled=false'));
  await change(() => row.getByRole('button', { name: 'Remove' }).click());
  assert.equal(await page.locator('.light-row:visible').count(), 1);
});

test('a node is found and hidden', async () => {
  await unfold('Nodes');
  await open.page.locator('.node').first().waitFor();
  await open.page.fill('[type=search]', 'gnomon');
  const seen = open.page.getByRole('button', { name: 'Seen by the camera: gnomon' });
  await change(() => seen.click());
  assert.equal(await seen.getAttribute('aria-pressed'), 'false');
  await change(() => open.page.getByRole('button', { name: 'All as in the file' }).click());
  assert.equal(await seen.getAttribute('aria-pressed'), 'true');
});

test('an evaluation draws a chart, and a point of it is taken', async () => {
  const { page } = open;
  await unfold('Evaluation');
  await page.locator('select', { has: page.locator('option', { hasText: '640 × 360' }) }).selectOption('640x360');
  await isSharp(page);
  await section('Evaluation').getByRole('button', { name: 'Measure' }).click();
  await page.locator('.chart .best').first().waitFor();
  assert.ok((await page.locator('.chart .point').count()) > 3);
  await change(async () => {
    await page.getByRole('button', { name: /^rayTraced.*wrong/ }).focus();
    await page.keyboard.press('Enter');
  });
  await page.waitForFunction(() => location.hash.includes('shadow.technique=rayTraced'));
});

test('a refused value is told beside its control', async () => {
  const { page } = open;
  const exposure = page.getByLabel('Exposure, exact');
  await exposure.fill('99');
  await page.locator('.refused .problem', { hasText: '-32..32' }).waitFor();
  await change(() => exposure.fill('0.5'));
  assert.equal(await page.locator('.refused').count(), 0);
  open.complaints.splice(0, open.complaints.length, ...open.complaints.filter((text) => !/status of 400/.test(text)));
});

test('keys alone reach everything, and what they reach has a name and is seen', async () => {
  const { page } = open;
  await page.locator('#stage').focus();
  await change(() => page.keyboard.press('ArrowLeft'));
  await page.locator('#copy-menu summary').focus();
  await page.keyboard.press('Enter');
  await page.keyboard.press('Tab');
  assert.equal(await page.evaluate(() => document.activeElement.id), 'copy-link');
  await page.keyboard.press('Escape');
  assert.equal(await page.evaluate(() => document.querySelector('#copy-menu').open), false);
  const nameless = await page.evaluate(() => {
    const parts = [...document.querySelectorAll('button, input:not([type=file]), select, summary, [tabindex="0"]')];
    const named = (node) => node.ariaLabel || node.title || node.textContent.trim() || [...(node.labels ?? [])].some((label) => label.textContent.trim());
    return parts.filter((node) => !named(node)).map((node) => node.outerHTML);
  });
  assert.deepEqual(nameless, []);
  await page.keyboard.press('Tab');
  assert.notEqual(await page.evaluate(() => getComputedStyle(document.activeElement).outlineStyle), 'none');
});

test('it fits a phone, in light colors', async () => {
  const { page, complaints, close } = await openPage(browser, server.origin, { viewport: { width: 390, height: 844 }, colorScheme: 'light', hasTouch: true });
  assert.ok((await page.evaluate(() => document.documentElement.scrollWidth)) <= 390);
  const [red] = (await page.evaluate(() => getComputedStyle(document.querySelector('.panel')).backgroundColor)).match(/\d+/g);
  assert.ok(Number(red) > 200);
  assert.deepEqual(complaints, []);
  await close();
});

test('the browser has nothing to complain of', () => assert.deepEqual(open.complaints, []));
