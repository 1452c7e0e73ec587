// The files of a drop, folders walked: [{name: 'folder/model.gltf', file}].

export async function droppedFiles(transfer) {
  // Both lists must be read before the first await: a drop's data is gone afterwards.
  const entries = [...transfer.items].map((item) => item.webkitGetAsEntry?.()).filter(Boolean);
  if (!entries.length) return chosenFiles(transfer.files);
  return (await Promise.all(entries.map(walk))).flat();
}

export const chosenFiles = (list) => [...list].map((file) => ({ name: file.webkitRelativePath || file.name, file }));

async function walk(entry) {
  const name = entry.fullPath.replace(/^\//, '');
  if (entry.isFile) return [{ name, file: await new Promise((resolve, reject) => entry.file(resolve, reject)) }];
  const reader = entry.createReader();
  const found = [];
  for (;;) {
    const some = await new Promise((resolve, reject) => reader.readEntries(resolve, reject)); // at most 100 at once
    if (!some.length) break;
    found.push(...some);
  }
  return (await Promise.all(found.map(walk))).flat();
}
