// Which picture is shown: the common ones as buttons, all others in a list; the digits choose, too.

import { choices } from './controls.mjs';
import { element } from './dom.mjs';
import { kDataViews, kDebugViews, kViews } from './fields.mjs';

export function createViewChoice(store, node) {
  const buttons = choices({ label: 'View', choices: kViews, choose: (view) => store.update({ view }) }, store, 'view');
  const groups = [['Data', kDataViews], ['Shadows of one light', kDebugViews]].map(([label, views]) =>
    element('optgroup', { label }, ...views.map(([value, text, says]) => element('option', { value, title: says }, text))),
  );
  const list = element(
    'select',
    { 'aria-label': 'More views', onchange: () => list.value && store.update({ view: list.value }) },
    element('option', { value: '' }, 'More views …'),
    ...groups,
  );
  node.append(buttons.node, list);
  store.subscribe(({ view }) => {
    buttons.show(view);
    list.value = kViews.some(([name]) => name === view) ? '' : view;
    list.classList.toggle('chosen', Boolean(list.value));
  });
  addEventListener('keydown', (event) => {
    if (event.target.closest?.('input, select, textarea') || event.ctrlKey || event.metaKey || event.altKey) return;
    const view = kViews[Number(event.key) - 1];
    if (view) store.update({ view: view[0] });
  });
}
