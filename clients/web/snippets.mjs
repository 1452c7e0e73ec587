// Code that gives the picture of a spec: for a shell, Python, a page, the command line. Pure.

import { flatten, removePath } from './paths.mjs';
import { withFormat } from './spec.mjs';

const quoted = (text) => `'${text.replaceAll("'", "'\\''")}'`;
const asPng = (spec) => removePath(spec, 'output.format');

export function curlCommand(origin, sceneId, spec, format = 'png') {
  const body = JSON.stringify(format === 'png' ? asPng(spec) : withFormat(spec, format));
  const type = format === 'png' ? 'image/png' : 'image/x-exr';
  return [
    `curl -sSf -X POST ${quoted(`${origin}/v1/scenes/${sceneId}/frames`)}`,
    `-H 'Content-Type: application/json' -H 'Accept: ${type}'`,
    `-d ${quoted(body)} -o frame.${format}`,
  ].join(' \\\n  ');
}

// Python's own library is enough for it.
export function pythonCode(origin, sceneId, spec) {
  return [
    'import json',
    'import urllib.request',
    '',
    `spec = json.loads(r'''${JSON.stringify(asPng(spec), null, 1).replaceAll("'''", "\\u0027\\u0027\\u0027")}''')`,
    'request = urllib.request.Request(',
    `    ${JSON.stringify(`${origin}/v1/scenes/${sceneId}/frames`)},`,
    '    data=json.dumps(spec).encode(),',
    '    headers={"Content-Type": "application/json", "Accept": "image/png"},',
    ')',
    'with urllib.request.urlopen(request) as reply, open("frame.png", "wb") as file:',
    '    file.write(reply.read())',
    '',
  ].join('\n');
}

// The address of a picture: what is a list of objects goes as JSON.
export function frameAddress(origin, sceneId, spec) {
  const { lights, nodes, volumes, ...plain } = asPng(spec);
  const lists = Object.entries({ lights, nodes, volumes }).filter(([, list]) => list?.length);
  const words = [...flatten(plain), ...lists].map(([key, value]) => [key, typeof value === 'string' ? value : JSON.stringify(value)]);
  return `${origin}/v1/scenes/${sceneId}/frame?${new URLSearchParams(words)}`;
}

export function imageTag(origin, sceneId, spec) {
  const address = frameAddress(origin, sceneId, spec).replaceAll('&', '&amp;').replaceAll('"', '&quot;');
  return `<img src="${address}" width="${spec.width}" height="${spec.height}" alt="">`;
}

// For the scene's file at hand; with this page's server it is drawn there.
export function cliCommand(origin, sceneId, spec) {
  return `echo ${quoted(JSON.stringify(asPng(spec)))} |\n  gnomon render scene.glb --spec - --server ${quoted(origin)} -o frame.png`;
}

export const kSnippets = { curl: curlCommand, python: pythonCode, img: imageTag, cli: cliCommand };
