// The key that a server may ask for. It is kept for the tab, and goes to no other place than this page's server.

const kName = 'gnomon.key';

const headersFor = (key) => (key ? { Authorization: `Bearer ${key}` } : {});

// sessionStorage, or a substitute until the page is left where the browser refuses it.
export function tabStorage() {
  try {
    return sessionStorage;
  } catch {
    const held = new Map();
    return {
      getItem: (name) => held.get(name) ?? null,
      setItem: (name, value) => held.set(name, value),
      removeItem: (name) => held.delete(name),
    };
  }
}

// What a header may hold: a secret pasted with a line's end still counts.
export function cleanKey(text) {
  const key = (text ?? '').trim();
  return /^[\x21-\x7e]+$/.test(key) ? key : null;
}

// Gives `withKey(send)`: the reply to `send(headers)`, which has a status. After a 401 a key is asked for, once for all
// requests that wait, and the request is sent again. `ask(wasWrong)` resolves to a key, or to null where there is none:
// then the 401 is the reply. `storage` is like sessionStorage.
export function createKeyHolder(storage, ask) {
  let asking = null;

  async function another(refused) {
    const kept = storage.getItem(kName);
    if (kept && kept !== refused) return kept; // given while this request was on its way
    storage.removeItem(kName);
    asking ??= ask(Boolean(refused)).finally(() => (asking = null));
    const key = cleanKey(await asking);
    if (key) storage.setItem(kName, key);
    return key;
  }

  return async function withKey(send) {
    let key = storage.getItem(kName);
    let reply = await send(headersFor(key));
    while (reply.status === 401) {
      key = await another(key);
      if (!key) return reply;
      reply = await send(headersFor(key));
    }
    return reply;
  };
}
