// The nodes as a tree with a search, each with switches: seen, casting, receiving.

import { sceneNodes } from './api.mjs';
import { count, element } from './dom.mjs';
import { found, ownSwitch, switchInForce, treeOf, withSwitch } from './node_tree.mjs';

const kSwitches = [
  ['visible', 'Seen', 'by the camera'],
  ['castShadow', 'Casts', 'shadows'],
  ['receiveShadow', 'Gets', 'shadows'],
];
const kMostRows = 300; // of one list; a search finds the rest

export function createNodesPanel(store) {
  let sceneId = null;
  let nodes = [];
  let parents = new Map();
  const shown = new Set(); // functions that bring a row up to date
  const search = element('input', { type: 'search', placeholder: 'Find a node', 'aria-label': 'Find a node', oninput: () => fill() });
  const list = element('ul', { class: 'nodes' });
  const note = element('p', { class: 'fact', role: 'status' });
  const reset = element('button', { type: 'button', onclick: () => store.clearSpec('nodes') }, 'All as in the file');

  async function load(id) {
    sceneId = id;
    nodes = [];
    search.value = '';
    try {
      const page = await sceneNodes(id);
      if (sceneId !== id) return;
      nodes = page.nodes;
      note.textContent = page.next === undefined ? '' : `The first ${count(nodes.length)} nodes.`;
    } catch (error) {
      note.textContent = error.message;
    }
    parents = new Map(nodes.map(({ node, parent }) => [node, parent]));
    fill();
  }

  function fill() {
    shown.clear();
    const text = search.value.trim();
    const rows = text ? found(nodes, text).map((node) => ({ ...node, children: [], total: node.triangles })) : treeOf(nodes);
    list.replaceChildren(...rows.slice(0, kMostRows).map(row));
    if (text) note.textContent = rows.length ? '' : 'No node has this name.';
    for (const update of shown) update();
  }

  function pathTo(index) {
    const path = [];
    for (let at = index; at !== undefined; at = parents.get(at)) path.unshift(at);
    return path;
  }

  function row(node) {
    const path = pathTo(node.node);
    const name = node.name || `node ${node.node}`;
    const below = element('ul', { hidden: true });
    const open = element('button', { type: 'button', class: 'twist', 'aria-expanded': 'false', 'aria-label': `What is below ${name}`, onclick: () => unfold() }, '›');
    if (!node.children.length) open.style.visibility = 'hidden';
    const switches = kSwitches.map(([key, text, says]) => {
      const button = element('button', { type: 'button', class: 'node-switch', title: `${text} ${says}`, 'aria-label': `${text} ${says}: ${name}`, onclick: () => flip(key) }, text);
      shown.add(() => {
        const on = switchInForce(store.state.spec.nodes, path, key);
        button.setAttribute('aria-pressed', String(on));
        button.classList.toggle('own', ownSwitch(store.state.spec.nodes, node.node, key) !== undefined);
      });
      return button;
    });

    function flip(key) {
      const on = switchInForce(store.state.spec.nodes, path, key);
      const entries = withSwitch(store.state.spec.nodes, node.node, key, undefined);
      const next = switchInForce(entries, path, key) === !on ? entries : withSwitch(entries, node.node, key, !on);
      if (next.length) store.setSpec('nodes', next);
      else store.clearSpec('nodes');
    }

    function unfold() {
      if (!below.childElementCount) below.append(...node.children.slice(0, kMostRows).map(row));
      below.hidden = !below.hidden;
      open.setAttribute('aria-expanded', String(!below.hidden));
      for (const update of shown) update();
    }

    const label = element('span', { class: 'node-name', title: `${name}, node ${node.node}, ${count(node.total)} triangles` }, name);
    return element('li', {}, element('div', { class: 'node' }, open, label, element('span', { class: 'unit' }, node.total ? count(node.total) : ''), ...switches), below);
  }

  const node = element('div', { 'data-pointer': '/nodes' }, search, list, note, element('div', { class: 'pair tail' }, reset), element('p', { class: 'problem', role: 'alert', hidden: true }));
  store.subscribe(({ summary, spec }, before) => {
    if (summary && summary.id !== sceneId) load(summary.id);
    reset.hidden = !spec.nodes?.length;
    if (spec.nodes !== before.spec.nodes) for (const update of shown) update();
  });
  return node;
}
