// JSON merge patches (RFC 7396). Pure.

const isObject = (value) => value !== null && typeof value === 'object' && !Array.isArray(value);

export function merged(value, patch) {
  if (!isObject(patch)) return patch;
  const next = isObject(value) ? { ...value } : {};
  for (const [key, part] of Object.entries(patch)) {
    if (part === null) delete next[key];
    else next[key] = merged(next[key], part);
  }
  return next;
}
