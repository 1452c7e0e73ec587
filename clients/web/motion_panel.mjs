// What the file offers to choose: its scenes, material variants and animations, which play and are scrubbed here.

import { createControl } from './controls.mjs';
import { element } from './dom.mjs';

// Time within a looping clip.
export function wrappedTime(fromSeconds, milliseconds, durationSeconds) {
  if (!(durationSeconds > 0)) return 0;
  return (((fromSeconds + milliseconds / 1000) % durationSeconds) + durationSeconds) % durationSeconds;
}

export function createMotionPanel(store) {
  let playing = 0; // of requestAnimationFrame
  const clips = () => store.state.summary?.animations ?? [];
  const clip = () => clips()[store.state.spec.animation?.index];
  const count = () => store.state.summary?.scenes ?? 1;
  const fields = [
    { path: 'scene', label: 'Scene', says: 'Of the file', options: () => Array.from({ length: count() }, (_, i) => [String(i), `Scene ${i}`]), choose: (value) => store.setSpec('scene', Number(value)), needs: () => count() > 1, value: () => String(store.effective('scene') ?? store.state.summary?.defaultScene ?? 0) },
    { path: 'materialVariant', label: 'Variant', says: 'Material variant of the file', options: () => [['', 'As modelled'], ...(store.state.summary?.materialVariants ?? []).map((name) => [name, name])], choose: (name) => (name ? store.setSpec('materialVariant', name) : store.clearSpec('materialVariant')), needs: () => store.state.summary?.materialVariants?.length },
    { path: 'animation', label: 'Animation', options: () => [['', 'At rest'], ...clips().map(({ name }, i) => [String(i), name || `Animation ${i}`])], choose: chooseClip, needs: () => clips().length, value: () => String(store.state.spec.animation?.index ?? '') },
  ];
  const play = element('button', { type: 'button', 'aria-pressed': 'false', onclick: () => (playing ? stop() : start()) }, 'Play');
  const time = element('input', { type: 'range', min: 0, max: 1, step: 0.001, 'aria-label': 'Time', oninput: scrub });
  const readout = element('output', { class: 'readout' });
  const player = element('div', { class: 'pair player' }, play, time, readout);
  const none = element('p', { class: 'fact' }, 'This file has one scene, and no animations or variants.');

  const setTime = (seconds) => store.setSpec('animation.timeSeconds', Number(seconds.toFixed(4)));

  function scrub() {
    const seconds = time.valueAsNumber; // before the slider shows where it has stopped
    stop();
    setTime(seconds);
  }

  function chooseClip(index) {
    stop();
    if (index === '') store.clearSpec('animation');
    else store.setSpec('animation', { index: Number(index), timeSeconds: 0 });
  }

  function start() {
    const length = clip().durationSeconds;
    const from = store.state.spec.animation.timeSeconds ?? 0;
    const began = performance.now();
    const step = (now) => {
      if (!clip()) return stop();
      setTime(wrappedTime(from, now - began, length));
      playing = requestAnimationFrame(step);
    };
    playing = requestAnimationFrame(step);
    show();
  }

  function stop() {
    cancelAnimationFrame(playing);
    playing = 0;
    show();
  }

  function show() {
    const { spec } = store.state;
    player.hidden = !clip();
    none.hidden = fields.some(({ needs }) => needs(store));
    play.textContent = playing ? 'Pause' : 'Play';
    play.setAttribute('aria-pressed', String(Boolean(playing)));
    if (!clip()) return;
    const seconds = spec.animation.timeSeconds ?? 0;
    time.max = clip().durationSeconds || 1;
    time.value = seconds;
    time.style.setProperty('--to', `${(100 * seconds) / time.max}%`);
    readout.textContent = `${seconds.toFixed(2)} s`;
  }

  store.subscribe((state, before) => {
    if (playing && state.summary !== before.summary) stop();
    show();
  });
  return element('div', {}, ...fields.map((field) => createControl({ ...field, keeps: true }, store)), player, none);
}
