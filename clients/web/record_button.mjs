// The button that records a video. While it is drawn, the same button stops it.

import { recordVideo } from './api.mjs';
import { saveFile } from './share.mjs';

// `requestOf()`: {id, sequence}, or null where there is nothing to record.
export function attachRecording(button, { requestOf, toast, problems }) {
  const name = button.textContent;
  let work = null; // AbortController

  async function record({ id, sequence }) {
    work = new AbortController();
    button.textContent = 'Stop';
    try {
      saveFile(await recordVideo(id, sequence, work.signal), 'gnomon.webm');
      toast('WebM saved');
    } catch (error) {
      if (error.name !== 'AbortError') problems.show(error);
    }
    work = null;
    button.textContent = name;
  }

  button.onclick = () => {
    if (work) return work.abort();
    const asked = requestOf();
    return asked && record(asked);
  };
}
