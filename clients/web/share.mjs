// Taking the picture along: files, a link, code that asks for the same.

import { renderFile } from './api.mjs';
import { kSnippets } from './snippets.mjs';
import { withFormat } from './spec.mjs';

export async function download(sceneId, spec, format) {
  const contentType = format === 'exr' ? 'image/x-exr' : 'image/png';
  saveFile(await renderFile(sceneId, withFormat(spec, format), contentType), `gnomon-${spec.views[0]}.${format}`);
}

export function saveFile(file, name) {
  const link = document.createElement('a');
  link.href = URL.createObjectURL(file);
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 60_000);
}

// `what`: a key of kSnippets, or link.
export function copySnippet(what, sceneId, spec) {
  if (what === 'link') return copyText(location.href);
  const origin = new URL('.', location.href).href.replace(/\/$/, '');
  return copyText(kSnippets[what](origin, sceneId, spec));
}

// The clipboard proper needs a secure page; a selected text area does without.
async function copyText(text) {
  try {
    await navigator.clipboard.writeText(text);
    return true;
  } catch {
    const area = document.createElement('textarea');
    area.value = text;
    area.className = 'offstage';
    document.body.append(area);
    area.select();
    const copied = document.execCommand('copy');
    area.remove();
    return copied;
  }
}
