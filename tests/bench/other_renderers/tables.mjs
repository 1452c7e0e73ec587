// The report as Markdown. Pure.

const percent = (share) => (100 * share).toFixed(share > 0 && share < 5e-5 ? 4 : 3);

function rowText({ renderer, settings, texels, metrics, milliseconds, normalBiasTexels }, unit) {
  const name = normalBiasTexels === undefined ? settings : `${settings}, normalBias ${normalBiasTexels} texels`;
  const millions = texels ? (texels / 2 ** 20).toFixed(2) : '-';
  const { misclassified, falseShadow, falseLit, interior, edgeDisplacement } = metrics;
  const shares = [misclassified, falseShadow, falseLit, interior].map(percent).join(' | ');
  const edge = edgeDisplacement ? edgeDisplacement.mean.toFixed(2) : '-';
  return `| ${renderer} | ${name} | ${millions} | ${shares} | ${edge} | ${(milliseconds / unit).toFixed(2)} |`;
}

function commonTable({ rows }) {
  const unit = rows.find(({ settings }) => settings === 'hard map').milliseconds; // of the first device
  const drawn = rows.filter(({ refused }) => !refused);
  return ['| renderer | settings | texels, 2^20 | misclassified % | false shadow % | false lit % | interior % '
    + '| edges off, px | time, x Gnomon\'s hard map |', '|---|---|---|---|---|---|---|---|---|',
  ...drawn.map((row) => rowText(row, unit))].join('\n');
}

const kColumns = {
  'Gnomon, cpu': ['default map', 'hard map', 'rayTraced'],
  'Gnomon, gl': ['default map', 'hard map', 'rayTraced', 'shadowVolume'],
  'three.js': ['DirectionalLight as constructed', 'DirectionalLight, box around the scene', 'DirectionalLight tuned',
    'SunLight as constructed', 'SunLight tuned'],
};

function hardTable(cases) {
  const columns = Object.entries(kColumns)
    .flatMap(([renderer, all]) => all.map((settings) => ({ renderer, settings })));
  const lines = cases.map(({ name, rows }) => {
    const cells = columns.map((column) => {
      const row = rows.find((each) => each.renderer === column.renderer && each.settings === column.settings);
      if (!row) return '-'; // the machine has no such device
      return row.refused ? 'refused' : percent(row.metrics.misclassified);
    });
    return `| ${name} | ${cells.join(' | ')} |`;
  });
  const heads = columns.map(({ renderer, settings }) => `${renderer}: ${settings}`);
  return [`| case | ${heads.join(' | ')} |`, `|---|${columns.map(() => '---').join('|')}|`, ...lines].join('\n');
}

function alignmentText(cases) {
  const most = (key) => percent(Math.max(...cases.map((one) => one[key])));
  const left = Math.max(...cases.map(({ receivers, receiversLeftOut }) =>
    (receivers ? receiversLeftOut / (receivers + receiversLeftOut) : 0)));
  const offset = Math.max(...cases.map(({ surfaceOffset }) => surfaceOffset));
  return `Surfaces lie ${offset.toFixed(2)} pixels' widths or less apart in the median of every picture. Of none do `
    + `more than ${most('coverageDiffers')} % of the pixels show a surface in one renderer only, or more than `
    + `${most('surfaceDiffers')} % another surface; such pixels do not count, at most ${percent(left)} % of `
    + 'a picture\'s receivers.';
}

export function markdownOf(report) {
  const [common, ...hard] = report.cases;
  const graphics = report.threejs.graphics.includes('SwiftShader') ? 'SwiftShader' : report.threejs.graphics;
  const devices = Object.entries(report.gnomon.devices).map(([name, by]) => `${name} is ${by}`).join(', ');
  const about = `Gnomon by its devices (${devices}); three.js r${report.threejs.revision} in headless Chromium `
    + `${report.chromium.split('.')[0]}, WebGL 2 on ${graphics}; both on ${report.cores} cores. ${common.says}, `
    + `${common.width} x ${common.height}, antialiasing none:`;
  return `# Against another renderer

Made by \`tests/bench/other_renderers/run\`.

<!-- readme -->

${about}

${commonTable(common)}

<!-- /readme -->

Both draw one GLB with one camera and one sun, and both are held against the same exact reference, pixel by pixel.
${alignmentText(report.cases)}

## Hard cases: misclassified receivers, %

${hardTable(hard)}
`;
}
