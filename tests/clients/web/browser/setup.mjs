// A server with the demo, and a page of it in a headless Chromium.

import { spawn } from 'node:child_process';
import fs from 'node:fs';
import { createInterface } from 'node:readline';

import { chromium } from 'playwright-core';

const kArguments = ['--no-sandbox', '--disable-gpu', '--disable-quic', '--no-first-run', '--disable-background-networking', '--disable-component-update', '--disable-sync'];

// Gives {origin, scene, stop}.
export async function startServer(gnomon, demo) {
  const body = fs.readFileSync(demo); // before there is a server that would have to be stopped
  // The server refuses variables of its name that it does not know.
  const env = Object.fromEntries(Object.entries(process.env).filter(([name]) => !name.startsWith('GNOMON_')));
  const server = spawn(gnomon, ['serve', '--until-stdin-closes', '--port', '0', '--device', 'cpu'],
                       { env, stdio: ['pipe', 'pipe', 'ignore'] });
  const origin = await new Promise((resolve, reject) => {
    server.once('exit', () => reject(new Error('The server has ended.')));
    createInterface({ input: server.stdout }).on('line', (line) => {
      const found = /^listening on (http:\S+)/.exec(line);
      if (found) resolve(found[1]);
    });
  });
  const headers = { 'Content-Type': 'model/gltf-binary' };
  const reply = await fetch(`${origin}/v1/scenes`, { method: 'POST', headers, body });
  return { origin, scene: (await reply.json()).id, stop: () => server.kill('SIGTERM') };
}

export const startBrowser = (executablePath) => chromium.launch({ executablePath, args: kArguments });

// A page with what it complains of in `complaints`, and what it fetched in `fetched`: [{url, bytes}].
export async function openPage(browser, address, options) {
  const context = await browser.newContext({ viewport: { width: 900, height: 620 }, ...options });
  const page = await context.newPage();
  page.setDefaultTimeout(60_000);
  const complaints = [];
  const fetched = [];
  page.on('console', (message) => ['error', 'warning'].includes(message.type()) && complaints.push(message.text()));
  page.on('pageerror', (error) => complaints.push(error.stack));
  page.on('response', async (response) => {
    const bytes = await response.body().then((body) => body.length, () => 0);
    fetched.push({ url: new URL(response.url()), bytes });
  });
  await page.goto(address);
  await isSharp(page);
  return { page, complaints, fetched, close: () => context.close() };
}

// Waits until the picture is that of the present settings, and sharp.
export async function isSharp(page) {
  await page.waitForFunction(() => {
    const draft = document.querySelector('#stage').classList.contains('draft');
    return !draft && document.querySelector('#busy').hidden && !document.querySelector('#picture').hidden;
  });
}
