// The picture on the stage. The next one is decoded before it takes the place of the last, so nothing flashes.

export function createPicture(image) {
  let shown = null;
  let latest = 0;

  async function show({ contentType, data }) {
    const turn = (latest += 1);
    const url = URL.createObjectURL(new Blob([Uint8Array.from(atob(data), (c) => c.charCodeAt(0))], { type: contentType }));
    const next = new Image();
    next.src = url;
    await next.decode();
    if (turn !== latest) return URL.revokeObjectURL(url);
    image.src = url;
    image.hidden = false;
    if (shown) URL.revokeObjectURL(shown);
    shown = url;
  }

  function clear() {
    latest += 1;
    image.hidden = true;
  }

  return { show, clear };
}
