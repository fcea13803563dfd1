// The page of a regression suite.

const STATUSES = ['crash', 'timeout', 'error', 'fail', 'stopped', 'new', 'updated', 'pass'];  // the worst first
const GOOD = new Set(['new', 'updated', 'pass']);

const casePath = (item, field) => `cases.${RESULTS.cases.indexOf(item)}.${field}`;
const badge = (item) => element('span', {class: `badge ${item.status}`}, datum(casePath(item, 'status'), formatText));

function smallest(item, field) {
  const values = (item.tests ?? []).map((test) => test[field]).filter((value) => typeof value === 'number');
  return values.length ? Math.min(...values) : null;
}

/** "3 of 4" tests that agree. */
function testsCell(item) {
  const tests = item.tests ?? [], same = tests.filter((test) => test.same).length;
  return tests.length ? element('span', {class: same < tests.length ? 'bad' : null}, `${same} of ${tests.length}`) : DASH;
}

const CASE_COLUMNS = [
  {label: 'case', text: true, key: (c) => c.name, cell: (c) => [datum(casePath(c, 'name'), formatText)]},
  {label: 'status', text: true, key: (c) => STATUSES.indexOf(c.status), cell: badge},
  {label: 'time', first: -1, key: (c) => c.seconds, cell: (c) => datum(casePath(c, 'seconds'), formatSeconds)},
  {label: 'samples', first: -1, key: (c) => c.samples, cell: (c) => datum(casePath(c, 'samples'))},
  {
    label: 'tests',
    title: 'Layers that agree with the reference',
    key: (c) => (c.tests ?? []).filter((t) => !t.same).length,
    first: -1,
    cell: testsCell
  },
  {
    label: 'worst p',
    title: 'Smallest p-value of a block',
    key: (c) => smallest(c, 'worst_p'),
    cell: (c) => formatNumber(smallest(c, 'worst_p'))
  },
  {label: 'message', wide: true, key: (c) => c.message, cell: (c) => datum(casePath(c, 'message'), formatText)},
];

function testTable(item) {
  const labels = ['layer', '', 'alarms', 'blocks', 'worst p', 'mean difference', 'uniformity p', 'verdict'];
  const rows = (item.tests ?? []).map((test, k) => {
    const path = (field) => casePath(item, `tests.${k}.${field}`);
    const percent = (values) =>
        (Array.isArray(values) ? values.map((v) => (typeof v === 'number' ? `${formatNumber(100 * v)} %` : DASH)).join(', ') :
                                                                            DASH);
    const same = (value) => (value === true ? 'same' : value === false ? 'differs' : DASH);
    return element(
        'tr', {}, element('th', {scope: 'row', class: 'text'}, datum(path('what'), formatText)),
        element('td', {class: test.same ? 'good' : 'bad'}, datum(path('same'), same)),
        ['alarms', 'blocks', 'worst_p'].map((field) => element('td', {}, datum(path(field)))),
        element('td', {}, datum(path('mean_difference'), percent)), element('td', {}, datum(path('uniformity_p'))),
        element('td', {class: 'text wide'}, datum(path('verdict'), formatText)));
  });
  if (!rows.length) return null;
  return element(
      'table', {class: 'tests'},
      element(
          'thead', {},
          element(
              'tr', {},
              labels.map(
                  (label) =>
                      element('th', {scope: 'col', class: ['layer', 'verdict'].includes(label) ? 'text' : null}, label)))),
      element('tbody', {}, rows));
}

/** The tests of a case and its pictures. */
function caseDetail(item) {
  const pictures = picturesOf(item.name);
  if (!pictures.length)
    return element('div', {class: 'case'}, testTable(item), element('p', {class: 'note'}, 'This case left no pictures.'));
  const viewer = new Viewer(pictures, 0.01);
  activeViewer = viewer;
  const errors = viewer.reference ? pictures.filter((picture) => picture !== viewer.reference) : [];
  const sheet = new Sheet(viewer, (picture) => picture.name, errors);
  return element('div', {class: 'case'}, testTable(item), element('div', {class: 'case-pictures'}, viewer.root, sheet.root));
}

/** A bar of the statuses, each as wide as its share of the cases. */
function statusBar() {
  const count = (status) => RESULTS.cases.filter((item) => item.status === status).length;
  const present = STATUSES.filter(count);
  return element(
      'div', {},
      element(
          'div', {class: 'status-bar', 'aria-hidden': 'true'},
          present.map((status) => element('span', {class: status, style: `flex-grow: ${count(status)}`}))),
      element(
          'p', {class: 'status-counts'},
          present.map(
              (status) => element('span', {}, element('span', {class: `badge ${status}`}, status), ` ${count(status)} `))));
}

function header() {
  const failed = RESULTS.failed !== 0 || RESULTS.stopped > 0;
  return element(
      'header', {}, element('div', {class: 'brand'}, 'Tyndall regress', themeSwitch()),
      element('h1', {}, datum('suite', formatText)),
      element('p', {class: `headline ${failed ? 'bad' : 'good'}`}, datum('passed'), ' passed, ', datum('failed'), ' failed',
          RESULTS.stopped ? [', ', datum('stopped'), ' stopped'] : null),
      element(
          'p', {class: 'subtitle'}, `${RESULTS.cases.length} cases in `, datum('seconds', formatSeconds), ', seed ',
          datum('seed')),
      statusBar());
}

function settingsFacts() {
  return factList('Settings', [
    ['seed', datum('seed')], ['level: chance of a false alarm in the whole suite', datum('family_level')]
  ]);
}

function regressPage() {
  RESULTS.cases ??= [];
  const table = new SortableTable('Cases', CASE_COLUMNS, RESULTS.cases, caseDetail);
  document.getElementById('page').append(
      ...[header(), warningList('warnings'),
          section(
              'Cases',
              element(
                  'p', {class: 'note'},
                  'Failures first. A click on a case opens its tests and pictures: 0 shows the reference, 1 the render, e the error.'),
              table.root),
          section('How it was measured', element('div', {class: 'fact-lists'}, settingsFacts(), machineFacts()), commandLine('command'))]
          .filter(Boolean));
  table.sort(1, 1);
  const failures = table.entries.filter(({row}) => !GOOD.has(row.status));
  failures.slice(0, 5).forEach((entry) => entry.open(true));
}

regressPage();
