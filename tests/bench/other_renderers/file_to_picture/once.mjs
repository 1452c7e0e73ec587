// Programs that draw one picture and end.
import { start } from '../speed/children.mjs';

export async function runOnce(program, args, env = {}) {
  const child = start(program, args, { stdio: 'ignore', env: { ...process.env, ...env } });
  const [code, signal] = await new Promise((done, fail) => {
    child.once('error', fail);
    child.once('exit', (...how) => done(how));
  });
  if (code !== 0) throw new Error(`${program} ended with ${code ?? signal}`);
}
