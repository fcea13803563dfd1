// The compare page with --denoise: what differs from that without.

function checkCurves() {
  const lines = all('.plot polyline'), color = (line) => getComputedStyle(line).stroke;
  const dashed = lines.map((line) => line.hasAttribute('stroke-dasharray'));
  check('denoised lines are dashed', dashed.join() === 'false,true,false,true', dashed);
  check(
      'in the colour of the rendered ones',
      color(lines[0]) === color(lines[1]) && color(lines[2]) === color(lines[3]) && color(lines[0]) !== color(lines[2]),
      lines.map(color));
  const hollow = all('.plot .marker.hollow').length, points = RESULTS.variants[1].checkpoints.length;
  check('with hollow marks', hollow === 2 * points, hollow);
  check('the page says so', one('.plot').nextElementSibling.nextElementSibling.textContent.includes('Dashed: denoised'));
  check('hollow in the table too', all('[aria-label=Variants] .dot.hollow').length === 2);
}

async function checkWipe() {
  const canvas = one('.window'), state = one('.viewer').dataset;
  activeViewer.resize();
  await settle();
  check(
      'it opens with noisy and denoised side by side',
      state.mode === 'wipe' && state.picture === 'tree-binary' && activeViewer.other.name === 'tree-binary denoised',
      `${state.mode} ${state.picture}`);
  check('under a line', one('.divider').getClientRects().length === 1);
  const halves = [shown(canvas, 0.25, 0.5), shown(canvas, 0.75, 0.45)];
  const alone = [];
  for (const [key, u, v] of [['1', 0.25, 0.5], ['2', 0.75, 0.45]]) {
    activeViewer.set({mode: 'picture'});
    press(key);
    await settle();
    alone.push(shown(canvas, u, v));
  }
  check('each side is its picture', halves.join() === alone.join(), `${halves} not ${alone}`);
}

run(async () => {
  checkNumbers(['variants.1.checkpoints.5.relmse', 'variants.3.efficiency.relative']);
  checkCurves();
  await checkWipe();
});
