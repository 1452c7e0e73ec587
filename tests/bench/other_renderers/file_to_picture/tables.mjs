// The report as Markdown. Pure.

const kOnce = 'gnomon render, exact';
const kServed = 'gnomon serve, exact';
const kWhat = ['cold', 'running', 'further'];

const digits = (value) => (value < 100 ? value.toPrecision(3) : value.toFixed(0));
const ratioText = (value) => (value < 9.95 ? value.toFixed(1) : value.toFixed(0));

// What the row's `what` is divided by: Gnomon's exact picture, by the command where a program has to start.
function unitOf({ rows }, what) {
  const name = what === 'cold' ? kOnce : kServed;
  return rows.find((row) => row.name === name)[what];
}

// How many times Gnomon's exact picture the row takes; undefined where the program has no such way.
export function ratioOf(scene, row, what, kind) {
  return row[what] && row[what][kind] / unitOf(scene, what)[kind];
}

// Both ends of the ratios over all scenes.
function rangeOf(scenes, program, [what, kind]) {
  const ratios = scenes.flatMap((scene) => {
    const row = scene.rows.find((each) => each.program === program && each[what]);
    return row ? [ratioOf(scene, row, what, kind)] : [];
  });
  if (!ratios.length) return '';
  const [low, high] = [Math.min(...ratios), Math.max(...ratios)].map(ratioText);
  return low === high ? low : `${low} to ${high}`;
}

// A row a program; where it is there in two forms, each figure is that of the first form that has it.
function summary(scenes) {
  const programs = new Map(scenes.flatMap((scene) => scene.rows.map(({ program, shadows }) => [program, shadows])));
  const columns = [
    ['first picture', 'cold', 'wall'], ['first: processor', 'cold', 'processor'],
    ['first, program running', 'running', 'wall'],
    ['each further picture', 'further', 'wall'], ['further: processor', 'further', 'processor'],
  ];
  const lines = [...programs].map(([program, shadows]) => (
    `| ${program} | ${shadows} | ${columns.map(([, ...of]) => rangeOf(scenes, program, of)).join(' | ')} |`));
  return [`| program | shadows | ${columns.map(([head]) => head).join(' | ')} |`,
    `|---|---|${'---|'.repeat(columns.length)}`, ...lines].join('\n');
}

function cellsOf(scene, row, what) {
  if (!row[what]) return ['', '', ''];
  const ratio = (kind) => ratioText(ratioOf(scene, row, what, kind));
  return [digits(row[what].wall), ratio('wall'), ratio('processor')];
}

function details(scenes) {
  const lines = scenes.flatMap((scene) => scene.rows.map((row) => (
    `| ${scene.scene} | ${row.name} | ${kWhat.flatMap((what) => cellsOf(scene, row, what)).join(' | ')} |`)));
  const heads = ['first', 'running', 'further'].map((head) => `${head}, ms | x | x processor`).join(' | ');
  return [`| scene | program | ${heads} |`, `|---|---|${'---|'.repeat(9)}`, ...lines].join('\n');
}

export function markdownOf(report) {
  const { machine, cores, rounds, further, loadBefore, loadAfter, versions, absent, scenes } = report;
  const { width, height } = scenes[0];
  const missing = Object.entries(absent).map(([name, reason]) => `\n\n${name} is not in the table: ${reason}.`).join('');
  return `# From a file to a picture

Made by \`tests/bench/other_renderers/run BUILD OUTPUT pictures\`.

<!-- readme -->

${summary(scenes)}

Times as multiples of Gnomon's exact picture, the least and the most of ${scenes.map(({ scene }) => scene).join(', ')}. \
Medians of ${rounds} rounds in which all take a turn, ${width} x ${height}, one sun, PNG on disk; ${machine}, ${cores} \
cores, no GPU; load average before ${loadBefore.toFixed(2)}, after ${loadAfter.toFixed(2)}, this run's own included. \
${versions.join(', ')}.${missing}

${details(scenes)}

<!-- /readme -->

Gnomon's first picture is \`gnomon render\`'s in the first table, its others are \`gnomon serve\`'s. \`first picture\`: from
the start of the program, with the GLB on disk, to the PNG on disk. \`program running\`: the part of it after the program was
ready for a scene. \`further\`: the same scene, the camera moved along its orbit, the mean of up to ${further} pictures a
round. \`x\` compares times with Gnomon's exact picture, by \`gnomon render\` for a first picture and by \`gnomon serve\` for
the others; \`processor\` compares the seconds that all processes of the program spent on all cores together, which other
work on the machine changes less. How each is set up: [the method](../../other_renderers/README.md#pictures).
`;
}
