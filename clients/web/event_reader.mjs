// Server-sent events out of the pieces of a body. Pure.

// The function that takes the pieces, and calls `onEvent(name, data)` for each event that is whole.
export function createEventReader(onEvent) {
  let rest = '';
  return (piece) => {
    const blocks = (rest + piece).split('\n\n');
    rest = blocks.pop();
    for (const block of blocks) {
      const lines = block.split('\n');
      const valuesOf = (name) => lines.filter((line) => line.startsWith(`${name}: `)).map((line) => line.slice(name.length + 2));
      const data = valuesOf('data');
      if (data.length) onEvent(valuesOf('event')[0] ?? 'message', data.join('\n'));
    }
  };
}
