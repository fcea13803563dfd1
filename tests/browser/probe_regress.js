// The regress page: numbers, failures first, a case that opens, its pictures.

function requiredPaths() {
  const fields = ['name', 'status', 'seconds', 'samples', 'message'];
  return [
    'suite', 'version', 'seed', 'seconds', 'passed', 'failed', 'machine.cpu',
    ...RESULTS.cases.flatMap((_, i) => fields.map((field) => `cases.${i}.${field}`)),
    ...RESULTS.cases.flatMap(
        (c, i) => c.tests.flatMap(
            (_, k) => ['what', 'same', 'verdict', 'worst_p', 'mean_difference', 'uniformity_p'].map(
                (field) => `cases.${i}.tests.${k}.${field}`)))
  ];
}

const statuses = () => all('.table tbody .badge').map((badge) => badge.textContent);

async function checkCase() {
  const rows = () => all('.table > table > tbody > tr:not(.detail)');
  check(
      'failures are open',
      rows().slice(0, 3).every(
          (row) => one('.opener', row).getAttribute('aria-expanded') === 'true' && !row.nextSibling.hidden));
  check('the others are not', rows().slice(3).every((row) => row.nextSibling.hidden));
  const detail = rows()[1].nextSibling, canvas = one('.window', detail), viewer = one('.viewer', detail);
  one('.tabs button', viewer).focus();
  viewer.dispatchEvent(new PointerEvent('pointerenter'));
  activeViewer.resize();
  await settle();
  const render = fingerprint(canvas);
  check('the render is shown first', viewer.dataset.picture === 'render', viewer.dataset.picture);
  press('0');
  await settle();
  check(
      '0 shows the reference', viewer.dataset.picture === 'reference' && fingerprint(canvas) !== render,
      viewer.dataset.picture);
  press('x');
  await settle();
  check('x goes back', viewer.dataset.picture === 'render' && fingerprint(canvas) === render, viewer.dataset.picture);
  press('e');
  await settle();
  check('e shows the error', viewer.dataset.mode === 'error' && fingerprint(canvas) !== render);
  const closed = rows()[6];
  one('.opener', closed).click();
  check('a click opens a case', !closed.nextSibling.hidden && all('.tests tbody tr', closed.nextSibling).length === 3);
  all('thead button').find((button) => button.textContent === 'case').click();
  check('a detail stays below its case', closed.nextSibling.className === 'detail' && !closed.nextSibling.hidden);
}

run(async () => {
  check('failures first', statuses().join() === 'crash,fail,fail,new,pass,pass,pass', statuses());
  check('the summary says so', one('.headline.bad').textContent === '4 passed, 3 failed', one('.headline').textContent);
  await checkCase();
  all('.opener[aria-expanded=false]').forEach((button) => button.click());
  await pause(300);
  checkNumbers(requiredPaths());
});
