// Values inside a spec by dotted path ("camera.orbit.azimuthDegrees"); a number steps into a list.
// Every function leaves what it is given as it is and gives a new value.

const isIndex = (step) => /^\d+$/.test(step);

export function getPath(value, path) {
  return path.split('.').reduce((node, step) => (node === null || node === undefined ? undefined : node[step]), value);
}

export function setPath(value, path, leaf) {
  const [step, ...rest] = path.split('.');
  const node = value ?? (isIndex(step) ? [] : {});
  const copy = Array.isArray(node) ? [...node] : { ...node };
  copy[step] = rest.length ? setPath(copy[step], rest.join('.'), leaf) : leaf;
  return copy;
}

// Takes away a leaf, and the objects that are empty without it. A list's elements stay.
export function removePath(value, path) {
  const [step, ...rest] = path.split('.');
  if (value === null || typeof value !== 'object' || !(step in value)) return value;
  const copy = Array.isArray(value) ? [...value] : { ...value };
  if (rest.length) copy[step] = removePath(copy[step], rest.join('.'));
  const gone = !rest.length || (isEmptyObject(copy[step]) && !Array.isArray(copy));
  if (gone) delete copy[step];
  return copy;
}

// {a: {b: [1, 2]}} -> [['a.b', [1, 2]]]: lists of plain numbers and words stay whole.
export function flatten(value, prefix = '') {
  return Object.entries(value).flatMap(([key, child]) => {
    const path = prefix ? `${prefix}.${key}` : key;
    const nested = isObject(child) || (Array.isArray(child) && child.some(isObject));
    return nested ? flatten(child, path) : [[path, child]];
  });
}

export const pointerOf = (path) => `/${path.replaceAll('.', '/')}`;

const isObject = (value) => value !== null && typeof value === 'object' && !Array.isArray(value);
const isEmptyObject = (value) => isObject(value) && Object.keys(value).length === 0;
