// The page's state: one immutable value, replaced whole; subscribers are called.
//   sceneId  of the scene that is shown, or null
//   view     the picture that is shown: color, depth …
//   spec     the part of the FrameSpec that the user chose; what is absent is the server's default
//   summary  of the scene, or null
//   freshVolume  its file was just chosen: the values in it are to set the scale of its density
//   askPanorama  a picture of all directions is to be chosen
//   report   of the last frame, or null; its spec has every default resolved
//   cameraShown  the spec's camera of the last frame, or null

import { getPath, removePath, setPath } from './paths.mjs';

export function createStore(initial) {
  let state = initial;
  const listeners = new Set();
  const update = (change) => {
    const before = state;
    state = { ...state, ...change };
    for (const listener of listeners) listener(state, before);
  };
  return {
    get state() {
      return state;
    },
    update,
    subscribe(listener) {
      listeners.add(listener);
      listener(state, state);
    },
    setSpec: (path, value) => update({ spec: setPath(state.spec, path, value) }),
    clearSpec: (path) => update({ spec: removePath(state.spec, path) }),
    isSet: (path) => getPath(state.spec, path) !== undefined,
    // What is in force: the user's choice, else what the server resolved for the last frame.
    effective: (path) => getPath(state.spec, path) ?? getPath(state.report?.spec, path),
  };
}
