// Records a video, from the button that also stops it. Loaded when it is first pressed.

import { recordVideo } from './api.mjs';
import { recordedSequence } from './recording.mjs';
import { saveFile } from './share.mjs';

let work = null; // AbortController

// `seen`: what recordedSequence takes.
export async function toggleRecording(button, seen, { toast, problems }) {
  if (work) return work.abort();
  const sequence = recordedSequence(seen);
  if (!sequence) return;
  const name = button.textContent;
  work = new AbortController();
  button.textContent = 'Stop';
  try {
    saveFile(await recordVideo(seen.summary.id, sequence, work.signal), 'gnomon.webm');
    toast('WebM saved');
  } catch (error) {
    if (error.name !== 'AbortError') problems.show(error);
  }
  work = null;
  button.textContent = name;
}
