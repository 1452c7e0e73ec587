// The page's key: asked for once, kept, sent again, and given up where nobody has one.

import assert from 'node:assert/strict';
import test from 'node:test';

import { cleanKey, createKeyHolder, tabStorage } from '../../../clients/web/key.mjs';

const storage = tabStorage; // Node has no sessionStorage, so that each is a new stand-in

// A server that knows one key, and counts what it is asked.
function serverWith(known) {
  const asked = [];
  const send = async (headers) => {
    asked.push(headers.Authorization ?? '');
    return { status: headers.Authorization === `Bearer ${known}` ? 200 : 401 };
  };
  return { asked, send };
}

test('a server without keys is sent none, and nobody is asked', async () => {
  const withKey = createKeyHolder(storage(), () => assert.fail('asked'));
  const reply = await withKey(async (headers) => ({ status: Object.keys(headers).length ? 500 : 200 }));
  assert.equal(reply.status, 200);
});

test('requests that wait are asked about once, and later ones bring the key', async () => {
  const { asked, send } = serverWith('secret');
  let times = 0;
  const withKey = createKeyHolder(storage(), async () => (++times, ' secret\n'));
  const replies = await Promise.all([withKey(send), withKey(send), withKey(send)]);
  assert.deepEqual(replies.map(({ status }) => status), [200, 200, 200]);
  assert.equal(times, 1);
  await withKey(send);
  assert.equal(asked.at(-1), 'Bearer secret');
  assert.equal(times, 1);
});

test('a wrong key is asked about again, and is not kept', async () => {
  const kept = storage();
  const { send } = serverWith('right');
  const told = [];
  const answers = ['wrong', 'right'];
  const withKey = createKeyHolder(kept, async (wasWrong) => (told.push(wasWrong), answers.shift()));
  assert.equal((await withKey(send)).status, 200);
  assert.deepEqual(told, [false, true]);
  assert.equal(kept.getItem('gnomon.key'), 'right');
});

test('who has no key gets the refusal', async () => {
  const { asked, send } = serverWith('secret');
  const withKey = createKeyHolder(storage(), async () => null);
  assert.equal((await withKey(send)).status, 401);
  assert.equal(asked.length, 1);
});

test('other refusals ask for nothing', async () => {
  const withKey = createKeyHolder(storage(), () => assert.fail('asked'));
  for (const status of [403, 429, 500]) assert.equal((await withKey(async () => ({ status }))).status, status);
});

test('what no header may hold is no key', () => {
  for (const bad of [null, '', '  ', 'two words', 'schlüssel', 'a\r\nb: c']) assert.equal(cleanKey(bad), null);
  assert.equal(cleanKey('0123-abc_='), '0123-abc_=');
});
