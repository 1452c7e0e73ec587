// A .gltf of one file: a board over a floor that goes to the side and back in two seconds, and is red or blue.

const floats = (...numbers) => Buffer.from(new Float32Array(numbers).buffer);
const pieces = [
  floats(-3, 0, 3, 3, 0, 3, 3, 0, -3, -3, 0, -3), // the floor
  floats(-0.7, 0.2, 0, 0.7, 0.2, 0, 0.7, 1.6, 0, -0.7, 1.6, 0), // the board
  Buffer.from(new Uint16Array([0, 1, 2, 0, 2, 3]).buffer),
  floats(0, 1, 2),
  floats(0, 0, 0, 1.5, 0, 0, 0, 0, 0),
];
const bufferViews = pieces.map((piece, i) => ({
  buffer: 0,
  byteOffset: pieces.slice(0, i).reduce((sum, { length }) => sum + length, 0),
  byteLength: piece.length,
}));
const kFloat = 5126;
const kUint16 = 5123;
const colored = (name, ...baseColorFactor) => ({ name, doubleSided: true, pbrMetallicRoughness: { baseColorFactor, metallicFactor: 0 } });
const mesh = (position, primitive) => ({ primitives: [{ attributes: { POSITION: position }, indices: 2, ...primitive }] });

export const movingScene = Buffer.from(
  JSON.stringify({
    asset: { version: '2.0' },
    extensionsUsed: ['KHR_materials_variants'],
    extensions: { KHR_materials_variants: { variants: [{ name: 'blue' }] } },
    scenes: [{ nodes: [0, 1] }],
    nodes: [{ name: 'floor', mesh: 0 }, { name: 'board', mesh: 1 }],
    meshes: [
      mesh(0, { material: 0 }),
      mesh(1, { material: 1, extensions: { KHR_materials_variants: { mappings: [{ material: 2, variants: [0] }] } } }),
    ],
    materials: [colored('grey', 0.6, 0.6, 0.6, 1), colored('red', 0.8, 0.05, 0.05, 1), colored('blue', 0.05, 0.1, 0.9, 1)],
    animations: [
      {
        name: 'slide',
        samplers: [{ input: 3, output: 4 }],
        channels: [{ sampler: 0, target: { node: 1, path: 'translation' } }],
      },
    ],
    accessors: [
      { bufferView: 0, componentType: kFloat, count: 4, type: 'VEC3', min: [-3, 0, -3], max: [3, 0, 3] },
      { bufferView: 1, componentType: kFloat, count: 4, type: 'VEC3', min: [-0.7, 0.2, 0], max: [0.7, 1.6, 0] },
      { bufferView: 2, componentType: kUint16, count: 6, type: 'SCALAR' },
      { bufferView: 3, componentType: kFloat, count: 3, type: 'SCALAR', min: [0], max: [2] },
      { bufferView: 4, componentType: kFloat, count: 3, type: 'VEC3' },
    ],
    bufferViews,
    buffers: [
      {
        byteLength: pieces.reduce((sum, { length }) => sum + length, 0),
        uri: `data:application/octet-stream;base64,${Buffer.concat(pieces).toString('base64')}`,
      },
    ],
  }),
);
