// The server's routes that the page uses. Addresses are relative, so that a proxy may serve the page below a path.

// A refusal: every problem of an application/problem+json reply, or one made of whatever came instead.
export class Refusal extends Error {
  constructor(status, title, problems, retryAfterSeconds = 0) {
    super(title);
    this.status = status;
    this.problems = problems; // [{pointer, detail, limit, actual}]
    this.retryAfterSeconds = retryAfterSeconds;
  }
}

export async function listScenes() {
  const { scenes } = await json(await fetch('v1/scenes', { headers: { Accept: 'application/json' } }));
  return scenes;
}

export async function capabilities() {
  return json(await fetch('v1/capabilities', { headers: { Accept: 'application/json' } }));
}

// The frame's report with its pictures as data: {report, images: [{view, contentType, data}]}.
export async function renderFrame(sceneId, spec, signal) {
  return json(await postFrame(sceneId, spec, 'application/json', signal));
}

// The frame's file as a Blob, PNG or EXR.
export async function renderFile(sceneId, spec, contentType) {
  const reply = await postFrame(sceneId, spec, contentType);
  if (!reply.ok) throw refusalOf(reply.status, reply.headers.get('Retry-After'), await reply.text());
  return reply.blob();
}

// Uploads a scene: one .glb or .gltf, or a .gltf and the files that it names. `onShare` is told 0..1 as it goes.
// XMLHttpRequest, because fetch tells nothing about a body that is on its way.
export function uploadScene(files, onShare) {
  const { body, contentType } = uploadBody(files);
  return new Promise((resolve, reject) => {
    const request = new XMLHttpRequest();
    request.open('POST', 'v1/scenes');
    if (contentType) request.setRequestHeader('Content-Type', contentType);
    request.upload.onprogress = (event) => event.lengthComputable && onShare(event.loaded / event.total);
    request.onerror = () => reject(new Refusal(0, 'The server can’t be reached.', []));
    request.onload = () => {
      const done = request.status === 200 || request.status === 201;
      if (done) resolve(JSON.parse(request.responseText));
      else reject(refusalOf(request.status, request.getResponseHeader('Retry-After'), request.responseText));
    };
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

function postFrame(sceneId, spec, accept, signal) {
  return fetch(`v1/scenes/${sceneId}/frames`, {
    method: 'POST',
    headers: { 'Content-Type': 'application/json', Accept: accept },
    body: JSON.stringify(spec),
    signal,
  });
}

async function json(reply) {
  if (reply.ok) return reply.json();
  throw refusalOf(reply.status, reply.headers.get('Retry-After'), await reply.text());
}

function refusalOf(status, retryAfter, body) {
  try {
    const { title, detail, problems } = JSON.parse(body);
    return new Refusal(status, problems?.length ? title : (detail ?? title), problems ?? [], Number(retryAfter) || 0);
  } catch {
    return new Refusal(status, `The server answered ${status}.`, [], Number(retryAfter) || 0);
  }
}
