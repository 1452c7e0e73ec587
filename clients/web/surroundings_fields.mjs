// The controls of light from all around and of the ground, as fields.mjs has them.

import { hasOwnLight, litByFile, litByOwnLight, litBySky, litByStudio, sourceOf } from './surroundings_math.mjs';

const environmentFiles = ({ state }) => (state.summary?.environmentFiles ?? []).map((name) => [name, name]);
const source = (store) => sourceOf(store.state);
const isLitBy = (...sources) => (store) => sources.includes(source(store));

function chooseSource(kind, store) {
  const { state } = store;
  const first = environmentFiles(store)[0];
  if (kind === 'file' && !first) return store.update({ askPanorama: true });
  if (kind === 'light' && !hasOwnLight(state)) return store.update({});
  const lit = { file: () => litByFile(state, first[0]), sky: () => litBySky(state), light: () => litByOwnLight(state), studio: () => litByStudio(state) };
  store.update({ spec: lit[kind]() });
}

// A report says that it was taken out, where its lights have it.
const sunOfFile = (store) => (store.effective('environment.extractSun') === 'none' ? 'none' : 'auto');

const hasSkyShadows = (store) => store.effective('environment.shadows') === 'rays';

function chooseSkyShadows(on, store) {
  if (on) store.setSpec('environment.shadows', 'rays');
  else store.clearSpec('environment.shadows');
}

const groundMode = (store) => store.effective('ground.mode') ?? 'none';

function chooseGround(mode, store) {
  if (mode === 'none') store.clearSpec('ground');
  else store.setSpec('ground.mode', mode);
}

const isSurface = (store) => groundMode(store) === 'surface';

export const kSurroundings = {
  title: 'Surroundings',
  panel: 'surroundings',
  fields: [
    { path: 'environment', label: 'Source', whole: true, choices: [['studio', 'Studio', 'A neutral studio'], ['sky', 'Sky', 'A clear sky; its sun is set above'], ['file', 'Picture', 'An .hdr or .exr file of the upload'], ['light', 'glTF’s', 'The image-based light of the glTF, where it has one']], value: source, choose: chooseSource, keeps: true },
    { path: 'environment.file', label: 'File', says: 'An .hdr or .exr file of the upload', options: environmentFiles, choose: (file, store) => store.setSpec('environment.file', file), needs: isLitBy('file'), keeps: true },
    { path: 'environment.sky.turbidity', label: 'Haze', says: '2 = clear air in the mountains, 3 = a clear day, 10 = hazy', slider: [1, 10, 0.1], absent: 3, needs: isLitBy('sky') },
    { path: 'environment.rotationDegrees', label: 'Rotate', unit: '°', says: 'About the vertical axis, clockwise as seen from above', slider: [0, 360, 1], absent: 0, needs: isLitBy('file', 'light') },
    { path: 'environment.intensity', label: 'Intensity', says: 'Its light is multiplied by this', slider: [0, 4, 0.01], absent: 1, needs: isLitBy('file', 'light') },
    { path: 'environment.intensity', label: 'Intensity', says: 'Its light, in lux, is multiplied by this', log: true, slider: [1e-6, 1e-3, 0.01], absent: 3e-5, needs: isLitBy('sky') },
    { path: 'environment.background', label: 'Behind', says: 'What is seen of it behind the scene', choices: [['none', 'Nothing'], ['environment', 'Sharp'], ['blurred', 'Blurred']], absent: 'none', needs: isLitBy('file', 'sky', 'light') },
    { path: 'environment.extractSun', label: 'Its sun', says: 'What becomes of the brightest disc', choices: [['auto', 'A light', 'With a color, a size and a sharp shadow'], ['none', 'In the picture']], value: sunOfFile, needs: isLitBy('file', 'light') },
    { path: 'environment.shadows', label: 'Sky shadows', says: 'Rays find what the scene hides of this light', toggle: true, value: hasSkyShadows, choose: chooseSkyShadows },
    { path: 'environment.samples', label: 'Sky rays', says: 'A pixel, more where they disagree', choices: [[1, '1'], [2, '2'], [4, '4'], [8, '8'], [16, '16']], absent: 4, needs: hasSkyShadows },
    { path: 'ground', label: 'Ground', choices: [['none', 'None'], ['catcher', 'Shadow', 'A plane under the scene, invisible but for the shadows on it'], ['surface', 'Surface', 'A plane that is seen']], value: groundMode, choose: chooseGround, keeps: true },
    { path: 'ground.height', label: 'Height', unit: 'm', says: 'Of the ground; by itself it is below the lowest point that is seen', needs: (store) => groundMode(store) !== 'none' },
    { path: 'ground.color', label: 'Color', color: true, absent: [0.5, 0.5, 0.5], needs: isSurface },
    { path: 'ground.roughness', label: 'Roughness', says: '0 = a mirror, 1 = matt', slider: [0, 1, 0.01], absent: 1, needs: isSurface },
  ],
};
