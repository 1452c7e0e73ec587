// The server's routes that the page uses. Addresses are relative, so that a proxy may serve the page below a path.

import { createEventReader } from './event_reader.mjs';
import { createKeyHolder, tabStorage } from './key.mjs';
import { askForKey } from './key_dialog.mjs';

const withKey = createKeyHolder(tabStorage(), askForKey);

// fetch, with the key that the server may ask for.
const call = (address, options = {}) =>
  withKey((key) => fetch(address, { ...options, headers: { ...options.headers, ...key } }));

// A refusal: every problem of an application/problem+json reply, or one made of whatever came instead.
export class Refusal extends Error {
  constructor(status, title, problems, retryAfterSeconds = 0) {
    super(title);
    this.status = status;
    this.problems = problems; // [{pointer, detail, limit, actual}]
    this.retryAfterSeconds = retryAfterSeconds;
  }
}

// The server's scenes, page by page: each a list of summaries, ascending by id.
export async function* scenePages() {
  let after = '';
  do {
    const { scenes, next } = await json(await call(`v1/scenes?limit=1000${after}`, { headers: { Accept: 'application/json' } }));
    yield scenes;
    after = next && `&after=${next}`;
  } while (after);
}

export async function capabilities() {
  return json(await call('v1/capabilities', { headers: { Accept: 'application/json' } }));
}

// The frame's report with its pictures as data: {report, images: [{view, contentType, data}]}.
export async function renderFrame(sceneId, spec, signal) {
  return json(await postFrame(sceneId, spec, 'application/json', signal));
}

// The frame's file as a Blob, PNG or EXR.
export async function renderFile(sceneId, spec, contentType) {
  return blob(await postFrame(sceneId, spec, contentType));
}

// Decides a frame without drawing it: its PlanReport.
export async function planFrame(sceneId, spec, signal) {
  return json(await post(`v1/scenes/${sceneId}/plan`, spec, 'application/json', signal));
}

// The first nodes of a scene's file: {nodes: [{node, name, parent, triangles}], next}.
export async function sceneNodes(sceneId) {
  return json(await call(`v1/scenes/${sceneId}/nodes?limit=10000`, { headers: { Accept: 'application/json' } }));
}

// Bakes the light maps of a spec; `onStep` gets {light, share, done, of} as it proceeds. Stops where the signal says so.
export const bakeAhead = (sceneId, spec, onStep, signal) =>
  followed(`v1/scenes/${sceneId}/bakes`, spec, { progress: onStep }, signal);

// Measures the variants of a request ({spec, variants | sweep, repeats}); `listeners` get the events `progress`
// ({done, of, variant}) and `row`. Its EvaluationReport.
export const evaluate = (sceneId, request, listeners, signal) =>
  followed(`v1/scenes/${sceneId}/evaluations`, request, listeners, signal);

// Work reported by events, until the one with its result.
async function followed(address, body, listeners, signal) {
  const reply = await post(address, body, 'text/event-stream', signal);
  if (!reply.ok) throw await refusalIn(reply);
  const last = {};
  const read = createEventReader((name, data) => (listeners[name] ? listeners[name](JSON.parse(data)) : (last[name] = data)));
  const pieces = reply.body.pipeThrough(new TextDecoderStream()).getReader();
  for (let piece = await pieces.read(); !piece.done; piece = await pieces.read()) read(piece.value);
  if (last.result) return JSON.parse(last.result);
  throw last.problem ? refusalOf(400, null, last.problem) : new Refusal(0, 'The work has ended without a result.', []);
}

// A sequence as a WebM Blob. Refused where a problem has ended it, which the file ends with.
export async function recordVideo(sceneId, sequence, signal) {
  const file = await blob(await post(`v1/scenes/${sceneId}/sequences`, sequence, 'video/webm', signal));
  const [, end, reply] = /GNOMON_(REPORT|PROBLEM).*?(\{".*)/s.exec(await file.slice(-kTailBytes).text()) ?? [];
  if (end === 'REPORT') return file;
  throw end ? refusalOf(400, null, reply) : new Refusal(0, 'The video ended too early.', []);
}
const kTailBytes = 4e6; // a report is shorter

// What was baked, as a Blob: PNG, EXR or GLB.
export async function bakeFile(sceneId, key, contentType) {
  return blob(await call(`v1/scenes/${sceneId}/bakes/${key}`, { headers: { Accept: contentType } }));
}

// Uploads a scene: one .glb or .gltf, or a .gltf and the files that it names. `onShare` gets 0..1 as it proceeds.
// XMLHttpRequest, because fetch reports no progress of a request body.
export async function uploadScene(files, onShare) {
  const upload = uploadBody(files);
  const { status, retryAfter, text } = await withKey((key) => sendUpload(upload, key, onShare));
  if (status === 200 || status === 201) return JSON.parse(text);
  throw refusalOf(status, retryAfter, text);
}

function sendUpload({ body, contentType }, key, onShare) {
  return new Promise((resolve, reject) => {
    const request = new XMLHttpRequest();
    request.open('POST', 'v1/scenes');
    if (contentType) request.setRequestHeader('Content-Type', contentType);
    for (const [name, value] of Object.entries(key)) request.setRequestHeader(name, value);
    request.upload.onprogress = (event) => event.lengthComputable && onShare(event.loaded / event.total);
    request.onerror = () => reject(new Refusal(0, 'The server can’t be reached.', []));
    request.onload = () =>
      resolve({ status: request.status, retryAfter: request.getResponseHeader('Retry-After'), text: request.responseText });
    request.send(body);
  });
}

function uploadBody(files) {
  const model = files.find(({ name }) => /\.(glb|gltf)$/i.test(name));
  if (!model) throw new Refusal(0, 'None of these files is a .glb or a .gltf.', []);
  if (files.length === 1) {
    return { body: model.file, contentType: /\.glb$/i.test(model.name) ? 'model/gltf-binary' : 'model/gltf+json' };
  }
  const folder = model.name.slice(0, model.name.lastIndexOf('/') + 1);
  const form = new FormData();
  form.append('scene', model.file, model.name.slice(folder.length));
  for (const part of files) {
    if (part !== model) form.append('file', part.file, part.name.replace(folder, ''));
  }
  return { body: form, contentType: null }; // the browser writes the boundary
}

const postFrame = (sceneId, spec, accept, signal) => post(`v1/scenes/${sceneId}/frames`, spec, accept, signal);

function post(address, body, accept, signal) {
  return call(address, {
    method: 'POST',
    headers: { 'Content-Type': 'application/json', Accept: accept },
    body: JSON.stringify(body),
    signal,
  });
}

async function json(reply) {
  if (reply.ok) return reply.json();
  throw await refusalIn(reply);
}

async function blob(reply) {
  if (reply.ok) return reply.blob();
  throw await refusalIn(reply);
}

const refusalIn = async (reply) => refusalOf(reply.status, reply.headers.get('Retry-After'), await reply.text());

function refusalOf(status, retryAfter, body) {
  try {
    const { title, detail, problems } = JSON.parse(body);
    return new Refusal(status, problems?.length ? title : (detail ?? title), problems ?? [], Number(retryAfter) || 0);
  } catch {
    return new Refusal(status, `The server answered ${status}.`, [], Number(retryAfter) || 0);
  }
}
