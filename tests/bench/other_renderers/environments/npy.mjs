// NumPy's own file format, version 1.0, of 32-bit floats.
import fs from 'node:fs';

export function arrayBytes(floats, shape) {
  const text = `{'descr': '<f4', 'fortran_order': False, 'shape': (${shape.join(', ')},), }`;
  const padded = text.padEnd(Math.ceil((text.length + 11) / 64) * 64 - 11) + '\n';
  const head = Buffer.from(`\x93NUMPY\x01\x00..${padded}`, 'latin1');
  head.writeUInt16LE(padded.length, 8);
  return Buffer.concat([head, floats]);
}

export const saveArray = (file, floats, shape) => fs.writeFileSync(file, arrayBytes(floats, shape));
