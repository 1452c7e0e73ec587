// A headless Chromium, and a server of what its pages load.
import fs from 'node:fs/promises';
import http from 'node:http';
import path from 'node:path';
import { chromium } from 'playwright-core';

const kTypes = { '.mjs': 'text/javascript', '.js': 'text/javascript', '.html': 'text/html', '.wasm': 'application/wasm' };

// Serves `html` as /, and each folder of `mounts`, e.g. {'/scenes/': FOLDER}, on a free port of this machine. Gives the
// origin, as http://HOST:PORT, and `close`.
export async function serve(html, mounts) {
  const server = http.createServer(async ({ url }, response) => {
    if (url === '/') return response.setHeader('content-type', 'text/html').end(html);
    const mount = Object.keys(mounts).find((prefix) => url.startsWith(prefix));
    try {
      const content = await fs.readFile(path.join(mounts[mount], url.slice(mount.length)));
      response.setHeader('content-type', kTypes[path.extname(url)] ?? 'application/octet-stream');
      response.end(content);
    } catch {
      response.writeHead(404).end();
    }
  });
  await new Promise((done) => server.listen(0, '127.0.0.1', done));
  return { origin: `http://127.0.0.1:${server.address().port}`, close: () => server.close() };
}

export function launchChromium(executable) {
  return chromium.launch({
    executablePath: executable,
    args: ['--no-sandbox', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--ignore-gpu-blocklist'],
  });
}

// A page whose messages are printed after `name`.
export async function newPage(browser, name) {
  const page = await browser.newPage();
  page.setDefaultTimeout(300000);
  page.on('console', (message) => {
    if (message.type() !== 'log') console.error(`${name}: ${message.text()}`);
  });
  page.on('pageerror', (error) => console.error(`${name}: ${error}`));
  return page;
}
