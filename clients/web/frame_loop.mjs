// Keeps the picture up with the state: at most one request is out, the newest state wins. While the state changes,
// drafts; once it has been still for a moment, the sharp picture. A sharp one that is out when the state changes is
// abandoned; a draft is let finish, so that there is something to see under a hand that never rests.

import { kDraftScales } from './spec.mjs';

const kStillMs = 180;
const kDraftGoalMs = 70; // a draft's size is steered towards this

// `render(draft: bool, scale, signal)` -> frame, or null where there is nothing to render.
// `show(frame, draft)`, `fail(error)`, `busy(bool)`.
export function createFrameLoop({ render, show, fail, busy }) {
  let version = 0; // of the state
  let changedAt = 0;
  let sharpVersion = -1; // of the state whose sharp picture came, or was refused
  let draftVersion = -1;
  let out = null; // {draft, abort}
  let timer = 0;
  let scale = 0.5;

  function changed({ settled = false } = {}) {
    version += 1;
    changedAt = settled ? -Infinity : performance.now();
    if (out && !out.draft) out.abort.abort();
    step();
  }

  function step() {
    clearTimeout(timer);
    if (out || sharpVersion === version) return;
    const wait = changedAt + kStillMs - performance.now();
    if (wait <= 0) ask(false);
    else if (draftVersion !== version) ask(true);
    else timer = setTimeout(step, wait);
  }

  async function ask(draft) {
    const asked = version;
    const mine = { draft, abort: new AbortController() };
    out = mine;
    busy(true);
    const began = performance.now();
    let pause = 0;
    try {
      const frame = await render(draft, scale, mine.abort.signal);
      if (frame) show({ ...frame, roundTripMs: performance.now() - began }, draft);
      if (draft) steer(performance.now() - began);
      done(draft, asked);
    } catch (error) {
      if (error.retryAfterSeconds) pause = error.retryAfterSeconds * 1000;
      else if (error.name !== 'AbortError') {
        done(draft, asked);
        sharpVersion = asked; // refused once is refused: only another state is worth asking
        fail(error);
      }
    }
    out = null;
    busy(sharpVersion !== version);
    if (pause) timer = setTimeout(step, pause);
    else step();
  }

  function done(draft, asked) {
    draftVersion = asked;
    if (!draft) sharpVersion = asked;
  }

  function steer(milliseconds) {
    scale = steered(scale, milliseconds);
  }

  return { changed };
}

// The scale of the next draft after one that took so long: far too slow jumps, a little too slow steps.
export function steered(scale, milliseconds) {
  const at = kDraftScales.indexOf(scale);
  const by = milliseconds > kDraftGoalMs * 3 ? -2 : milliseconds > kDraftGoalMs * 1.25 ? -1 : milliseconds < kDraftGoalMs * 0.6 ? 1 : 0;
  return kDraftScales[Math.min(kDraftScales.length - 1, Math.max(0, at + by))];
}
