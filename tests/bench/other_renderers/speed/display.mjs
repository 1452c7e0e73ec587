// The display of the environment or, without one, one of its own: Debian's VTK draws through X even where no window is to
// be seen.
import { start } from './children.mjs';

// Gives its name. Throws where there is no Xvfb.
export async function openDisplay() {
  if (process.env.DISPLAY) return { name: process.env.DISPLAY, close() {} };
  const child = start('Xvfb', ['-displayfd', '3', '-screen', '0', '1280x1024x24'], {
    stdio: ['ignore', 'ignore', 'ignore', 'pipe'],
  });
  const number = await new Promise((done, fail) => {
    child.once('error', () => fail(new Error('neither DISPLAY nor Xvfb')));
    child.once('exit', () => fail(new Error('Xvfb ended')));
    child.stdio[3].once('data', (text) => done(String(text).trim()));
  });
  return { name: `:${number}`, close: () => child.kill() };
}
