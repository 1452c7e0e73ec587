// The report as Markdown. Pure.

const kExact = 'Gnomon cpu, exact';

const digits = (value) => (value < 100 ? value.toPrecision(3) : value.toFixed(0));
const time = (value) => (value === undefined ? '' : digits(value));

function ratio(value, unit) {
  return value === undefined ? '' : (value / unit).toFixed(value < 9.95 * unit ? 1 : 0);
}

const exactOf = ({ rows }) => rows.find(({ name }) => name === kExact);

// How many times the fastest of this kind takes Gnomon's exact frame, or that row's time of the same key.
export function timesExact(scene, kind, key) {
  const all = scene.rows.filter((row) => row.kind === kind && row[key] !== undefined).map((row) => row[key]);
  return all.length ? Math.min(...all) / exactOf(scene)[key] : undefined;
}

function summary(scenes) {
  const columns = [
    ['fastest cascaded, warm', 'cascaded', 'warm'], ['the same, 4x', 'cascaded', 'warm4x'],
    ['the same, cold', 'cascaded', 'cold'], ['VTK, warm', 'kept map', 'warm'], ['VTK, 4x', 'kept map', 'warm4x'],
    ['VTK, cold', 'kept map', 'cold'],
  ];
  const lines = scenes.map((scene) => {
    const cells = columns.map(([, kind, key]) => ratio(timesExact(scene, kind, key), 1));
    return `| ${scene.scene} | ${cells.map((cell) => (cell ? `**${cell}**` : '')).join(' | ')} |`;
  });
  const heads = columns.map(([head]) => head).join(' | ');
  return [`| scene | ${heads} |`, `|---|${'---|'.repeat(columns.length)}`, ...lines].join('\n');
}

function times(scenes) {
  const lines = scenes.flatMap((scene) => scene.rows.map((row) => {
    const exact = exactOf(scene);
    const cells = ['warm', 'warm4x', 'cold'].flatMap((key) => [time(row[key]), ratio(row[key], exact[key])]);
    return `| ${scene.scene} | ${row.name} | ${row.says} | ${[...cells, time(row.coldPage)].join(' | ')} |`;
  }));
  return ['| scene | renderer | shadows | warm, ms | x exact | 4x, ms | x exact | cold, ms | x exact | new page, ms |',
    '|---|---|---|---|---|---|---|---|---|---|', ...lines].join('\n');
}

function versionsText(versions) {
  const programs = new Map();
  for (const { name, version, chromium, graphics, window } of versions) {
    programs.set(name.split(',')[0], version);
    if (chromium) programs.set('Chromium', chromium);
    if (graphics) programs.set('WebGL 2', graphics.includes('SwiftShader') ? 'SwiftShader' : graphics);
    if (window) programs.set('VTK\'s window', `\`${window}\``);
  }
  return [...programs].map(([name, version]) => `${name} ${version}`).join(', ');
}

export function markdownOf(report) {
  const { machine, cores, frames, coldRounds, loadBefore, loadAfter, versions, absent, scenes } = report;
  const { width, height } = scenes[0];
  const missing = Object.entries(absent).map(([name, reason]) => `\n\n${name} is not in the table: ${reason}.`).join('');
  return `# Times of other renderers

Made by \`tests/bench/other_renderers/run BUILD OUTPUT speed\`.

<!-- readme -->

How many times another renderer takes the time of Gnomon's exact frame by \`cpu\`: the fastest of those with cascades, in a
headless Chromium, and VTK, which keeps one shadow map while the camera moves:

${summary(scenes)}

Medians of ${frames} warm frames and of ${coldRounds} cold ones, ${width} x ${height}, in turns on one machine without a \
GPU: ${machine}, ${cores} cores; load average before ${loadBefore.toFixed(2)}, after ${loadAfter.toFixed(2)}, this run's \
own included. ${versionsText(versions)}.${missing}

${times(scenes)}

<!-- /readme -->

\`warm\`: no antialiasing. \`4x\`: MSAA of the engines' canvas, and Gnomon's default. A warm frame of Gnomon is a request over
HTTP on a kept connection up to the last byte of its PNG; one of the others ends when a pixel of it was read back, without
PNG or HTTP. The camera moves along its orbit, so that maps are drawn anew in each frame; VTK's needs not be. \`cold\`: from
the start of \`gnomon render\` to its end, with the PNG on disk; from the start of the browser's process to the last pixel
of the first frame read back, scripts and scene served by this machine; from the start of Python likewise. \`new page\`: the
same from a new page in the running browser. Cascades are of 2048 x 2048 texels and end where each scene's description
says. How each is set up: [the method](../../other_renderers/README.md).
`;
}
