// The frame loop, with a server that answers when the test says so.

import assert from 'node:assert/strict';
import test from 'node:test';

import { createFrameLoop } from '../../../clients/web/frame_loop.mjs';

function harness() {
  const asked = []; // {draft, signal, answer(frame), refuse(error)}
  const shown = [];
  const failed = [];
  const loop = createFrameLoop({
    render: (draft, scale, signal) =>
      new Promise((resolve, reject) => {
        asked.push({ draft, signal, answer: () => resolve({ name: asked.length }), refuse: reject });
        signal.addEventListener('abort', () => reject(Object.assign(new Error(), { name: 'AbortError' })));
      }),
    show: (frame, draft) => shown.push(draft ? 'draft' : 'sharp'),
    fail: (error) => failed.push(error.message),
    busy: () => {},
  });
  return { loop, asked, shown, failed };
}

const turn = () => new Promise((resolve) => setImmediate(resolve));

test('one request is out; what changed meanwhile is asked for once', async (t) => {
  t.mock.timers.enable({ apis: ['setTimeout'] });
  const { loop, asked, shown } = harness();
  loop.changed();
  loop.changed();
  loop.changed();
  assert.equal(asked.length, 1);
  assert.ok(asked[0].draft);
  asked[0].answer();
  await turn();
  assert.equal(asked.length, 2);
  assert.deepEqual(shown, ['draft']);
});

test('a settled change is asked for sharp at once', async () => {
  const { loop, asked, shown } = harness();
  loop.changed({ settled: true });
  assert.deepEqual(asked.map(({ draft }) => draft), [false]);
  asked[0].answer();
  await turn();
  assert.deepEqual(shown, ['sharp']);
  assert.equal(asked.length, 1);
});

test('a sharp picture that is out is abandoned when the state changes', async () => {
  const { loop, asked, failed } = harness();
  loop.changed({ settled: true });
  loop.changed();
  assert.ok(asked[0].signal.aborted);
  await turn();
  assert.deepEqual(asked.map(({ draft }) => draft), [false, true]);
  assert.deepEqual(failed, []);
});

test('what is refused is told once and not asked for again', async () => {
  const { loop, asked, failed } = harness();
  loop.changed({ settled: true });
  asked[0].refuse(new Error('no'));
  await turn();
  assert.deepEqual(failed, ['no']);
  assert.equal(asked.length, 1);
  loop.changed({ settled: true });
  assert.equal(asked.length, 2);
});

test('a busy server is asked again after the time that it names', async (t) => {
  t.mock.timers.enable({ apis: ['setTimeout'] });
  const { loop, asked, failed } = harness();
  loop.changed({ settled: true });
  asked[0].refuse(Object.assign(new Error('busy'), { retryAfterSeconds: 2 }));
  await turn();
  t.mock.timers.tick(1999);
  assert.equal(asked.length, 1);
  t.mock.timers.tick(1);
  assert.equal(asked.length, 2);
  assert.deepEqual(failed, []);
});
