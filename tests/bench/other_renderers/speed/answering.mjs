// A process that answers each line of its input by a line of JSON, the first one unasked.
import readline from 'node:readline';
import { start, stop } from './children.mjs';

// `answersAt`: the file descriptor of the answers.
export async function startAnswering(program, args, { env, answersAt = 1 }) {
  const stdio = ['pipe', 'ignore', 'ignore', 'ignore'].slice(0, Math.max(3, answersAt + 1));
  stdio[answersAt] = 'pipe';
  const child = start(program, args, { stdio, env: { ...process.env, ...env } });
  const failed = new Promise((_, fail) => child.once('error', fail));
  failed.catch(() => {});
  const lines = readline.createInterface({ input: child.stdio[answersAt] })[Symbol.asyncIterator]();
  async function answer() {
    const { value, done } = await Promise.race([lines.next(), failed]);
    if (done) throw new Error(`${program} ended`);
    return JSON.parse(value);
  }
  const about = await answer();
  return {
    about,
    ask(...words) {
      child.stdin.write(`${words.join(' ')}\n`);
      return answer();
    },
    close: () => stop(child),
  };
}
