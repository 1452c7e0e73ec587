// Shows what the server refused beside the control that it points at; what points nowhere on the page goes to the banner.

import { element } from './dom.mjs';

export function createProblems(root, banner) {
  function clear() {
    banner.replaceChildren();
    banner.hidden = true;
    for (const slot of root.querySelectorAll('[data-pointer] > .problem')) slot.hidden = true;
    for (const field of root.querySelectorAll('.refused')) field.classList.remove('refused');
  }

  function show(error) {
    clear();
    const problems = error.problems ?? [];
    const rest = problems.filter((problem) => !showBeside(problem));
    if (problems.length && !rest.length) return;
    const title = element('p', {}, element('strong', {}, error.message || 'Something went wrong.'));
    const list = rest.map((problem) => element('li', {}, problem.pointer && element('code', {}, problem.pointer), ` ${sentence(problem)}`));
    banner.append(title, ...(list.length ? [element('ul', {}, ...list)] : []));
    banner.append(element('button', { class: 'quiet', type: 'button', 'aria-label': 'Dismiss', onclick: clear }, '×'));
    banner.hidden = false;
  }

  function showBeside(problem) {
    const field = nearest(problem.pointer ?? '');
    const slot = field?.querySelector(':scope > .problem');
    if (!slot || field.closest('[hidden]')) return false;
    field.closest('details')?.setAttribute('open', '');
    field.classList.add('refused');
    slot.textContent = sentence(problem);
    slot.hidden = false;
    field.scrollIntoView({ block: 'nearest' });
    return true;
  }

  // The field with this very place, or with one that holds it or is held by it.
  function nearest(pointer) {
    const fields = [...root.querySelectorAll('[data-pointer]')];
    for (let place = pointer; place; place = place.slice(0, place.lastIndexOf('/'))) {
      const found = fields.find((field) => field.dataset.pointer.split(' ').includes(place));
      if (found) return found;
    }
    return null;
  }

  return { show, clear };
}

export function sentence({ detail, limit, actual }) {
  return [detail, limit && `Allowed: ${limit}.`, actual && `Got: ${actual}.`].filter(Boolean).join(' ');
}
