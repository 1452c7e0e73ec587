// Asks for the key of the server.

import { element } from './dom.mjs';

// Resolves to what was typed, or to null.
export function askForKey(wasWrong) {
  return new Promise((resolve) => {
    const input = element('input', { type: 'password', id: 'key', autocomplete: 'off', spellcheck: 'false' });
    const close = (value) => {
      dialog.remove();
      resolve(value);
    };
    const dialog = element(
      'dialog',
      { class: 'key-dialog', 'aria-labelledby': 'key-title', oncancel: () => close(null) },
      element('h2', { id: 'key-title' }, 'This server asks for a key'),
      element('p', { role: wasWrong ? 'alert' : null }, wasWrong ? 'It does not know this key. Is there another one?' : 'It is kept until this tab is closed.'),
      element('label', { for: 'key' }, 'Key'),
      input,
      element(
        'div',
        { class: 'pair' },
        element('button', { type: 'button', onclick: () => close(null) }, 'Cancel'),
        element('button', { type: 'button', class: 'primary', onclick: () => close(input.value) }, 'Use this key'),
      ),
    );
    input.addEventListener('keydown', (event) => event.key === 'Enter' && close(input.value));
    document.body.append(dialog);
    dialog.showModal();
    input.focus();
  });
}
