// The server knows scenes by their hash alone; this browser remembers what the user called them.

const kKey = 'gnomon.sceneNames';

export function rememberName(id, name) {
  try {
    localStorage.setItem(kKey, JSON.stringify({ ...all(), [id]: name }));
  } catch {
    // Without storage the hash has to do.
  }
}

export const nameOf = (id) => all()[id] ?? `scene ${id.slice(0, 8)}`;

function all() {
  try {
    return JSON.parse(localStorage.getItem(kKey)) ?? {};
  } catch {
    return {};
  }
}
