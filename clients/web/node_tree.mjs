// A scene's nodes as a tree, and the switches that a spec sets on them. Pure.

// [{node, name, parent, triangles}] -> roots [{…, children}], with the triangles of all below in `total`.
export function treeOf(nodes) {
  const byIndex = new Map(nodes.map((node) => [node.node, { ...node, children: [], total: node.triangles }]));
  const roots = [];
  for (const node of byIndex.values()) (byIndex.get(node.parent)?.children ?? roots).push(node);
  const add = (node) => (node.total += node.children.reduce((sum, child) => sum + add(child), 0));
  roots.forEach(add);
  return roots;
}

// At most `most` nodes whose name or index has the text.
export function found(nodes, text, most = 100) {
  const wanted = text.trim().toLowerCase();
  return nodes.filter(({ name, node }) => name.toLowerCase().includes(wanted) || String(node) === wanted).slice(0, most);
}

const entryOf = (entries, index) => (entries ?? []).findLast(({ node }) => node === index);

// What a switch is set to at a node itself, or nothing.
export const ownSwitch = (entries, index, key) => entryOf(entries, index)?.[key];

// What is in force there: the nearest setting up the tree; else visible and receiving, and casting where visible.
export function switchInForce(entries, path, key) {
  for (const index of [...path].reverse()) {
    const own = ownSwitch(entries, index, key);
    if (own !== undefined) return own;
  }
  return key === 'castShadow' ? switchInForce(entries, path, 'visible') : true;
}

// The entries with one switch of a node set, or taken back where `value` is undefined; without entries that say nothing.
export function withSwitch(entries, index, key, value) {
  const rest = (entries ?? []).filter(({ node }) => node !== index);
  const next = { ...entryOf(entries, index), node: index, [key]: value };
  if (value === undefined) delete next[key];
  return Object.keys(next).length > 1 ? [...rest, next] : rest;
}
