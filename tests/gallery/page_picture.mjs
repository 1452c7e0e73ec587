// Takes the README's picture of the web page, with the demo scene.
// usage: node page_picture.mjs GNOMON DEMO CHROMIUM OUTPUT, run where `tests/run -R web_page` has put setup.mjs

const [gnomon, demo, executable, output] = process.argv.slice(2);
const { isSharp, openPage, startBrowser, startServer } = await import(`${process.cwd()}/setup.mjs`);

const server = await startServer(gnomon, demo);
const browser = await startBrowser(executable);
const options = { viewport: { width: 1200, height: 700 } };
const { page } = await openPage(browser, `${server.origin}/#scene=${server.scene}`, options);
await isSharp(page);
await page.screenshot({ path: output });
await browser.close();
server.stop();
