// The page of a comparison.

const variantPath = (variant, field) => `variants.${RESULTS.variants.indexOf(variant)}.${field}`;

const variantColor = (variant) => seriesColor(seriesIndex(RESULTS.variants, variant));

/** The interval of an efficiency as a bar with a dot, all rows on one logarithmic scale; a thin line marks 1. */
function intervalBar(variant, field) {
  const every = RESULTS.variants.flatMap((v) => [1, v[field]?.low, v[field]?.high, v[field]?.relative].filter(isPositive));
  const {low, high, relative} = variant[field] ?? {};
  if (!isPositive(relative)) return null;
  const x = logScale(logDomain(every), 0, 90);
  const range =
      isPositive(low) && isPositive(high) ? svg('line', {class: 'range', x1: x(low), x2: x(high), y1: 7, y2: 7}) : null;
  return svg(
      'svg', {
        class: 'bar',
        viewBox: '0 0 90 14',
        width: 90,
        height: 14,
        'aria-hidden': 'true',
        style: `color: ${variantColor(variant)}`
      },
      svg('line', {class: 'one', x1: x(1), x2: x(1), y1: 0, y2: 14}), range, svg('circle', {cx: x(relative), cy: 7, r: 4}));
}

function efficiencyColumn(field, label, title) {
  return {
    label,
    title,
    first: -1,
    key: (v) => v[field]?.relative,
    cell: (v) =>
        [intervalBar(v, field),
         datumWithInterval(
             variantPath(v, `${field}.relative`), variantPath(v, `${field}.low`), variantPath(v, `${field}.high`),
             formatFactor)]
  };
}

function numberColumn(field, label, title, format = formatNumber, first = 1) {
  return {label, title, first, key: (v) => v[field], cell: (v) => datum(variantPath(v, field), format)};
}

/** Variants with a word on their slope; the word is a footnote, for it would make the column or the row too large. */
const withSlopeNote = () => RESULTS.variants.filter((variant) => variant.slope_note);

function slopeCell(variant) {
  const number = withSlopeNote().indexOf(variant) + 1;
  return [
    datumWithInterval(variantPath(variant, 'slope'), variantPath(variant, 'slope_low'), variantPath(variant, 'slope_high')),
    number ? element('sup', {class: 'bad'}, String(number)) : null
  ];
}

function slopeNotes() {
  const rows = withSlopeNote().map(
      (variant, i) => element(
          'li', {}, element('sup', {}, String(i + 1)), ' slope of ', element('strong', {}, variant.name), ': ',
          datum(variantPath(variant, 'slope_note'), formatText)));
  return rows.length ? element('ul', {class: 'footnotes note'}, rows) : null;
}

/** A variant that rendered nothing has no picture, and its zeros say nothing. */
const gaveUp = (variant) => variant.image === null;

function secondsCell(variant) {
  if (gaveUp(variant)) return element('span', {class: 'bad'}, 'gave up');
  return datum(variantPath(variant, 'seconds'), formatSeconds);
}

function samplesCell(variant) {
  const mean = datum(variantPath(variant, 'samples'));
  if (!(variant.least_samples < variant.most_samples)) return mean;
  return datumWithInterval(
      variantPath(variant, 'samples'), variantPath(variant, 'least_samples'), variantPath(variant, 'most_samples'));
}

/** Counters that should be zero and are not. */
function healthCell(variant) {
  if (gaveUp(variant)) return element('span', {class: 'bad'}, 'gave up');
  const faults = Object.keys(variant.health ?? {}).filter((counter) => variant.health[counter] !== 0);
  if (!faults.length) return element('span', {class: 'quiet'}, variant.health ? 'no faults' : DASH);
  return faults.map(
      (counter) =>
          element('div', {class: 'bad'}, `${counter.replaceAll('_', ' ')} `, datum(variantPath(variant, `health.${counter}`))));
}

function nameCell(variant) {
  const dot = element('span', {
    class: variant.as_rendered ? 'dot hollow' : 'dot',
    'aria-hidden': 'true',
    style: `color: ${variantColor(variant)}`
  });
  return [
    dot, datum(variantPath(variant, 'name'), formatText),
    element('code', {}, datum(variantPath(variant, 'options'), formatText))
  ];
}

const VARIANT_COLUMNS = [
  {label: 'variant', text: true, title: 'Name and options', key: (v) => v.name, cell: nameCell},
  efficiencyColumn(
      'efficiency', 'efficiency', '1 / (MSE × time) relative to the first variant, with a 95 % interval over the seeds'),
  efficiencyColumn('efficiency_trimmed', 'efficiency, trimmed', 'The same for relMSE without the worst 0.1 % of pixels'),
  numberColumn('relmse', 'relMSE', 'Mean of (x − r)² / (r² + eps)'),
  numberColumn('relmse_trimmed', 'relMSE, trimmed', 'relMSE without the worst 0.1 % of pixels'),
  numberColumn('mse', 'MSE', 'Mean squared error'),
  numberColumn('mape', 'MAPE', 'Mean of |x − r| / (|r| + eps)'),
  numberColumn('smape', 'SMAPE', 'Mean of 2 |x − r| / (|x| + |r| + eps)'),
  {label: 'slope', title: 'Of log error against log time; −1 is Monte Carlo\'s', key: (v) => v.slope, cell: slopeCell},
  numberColumn('build_seconds', 'build', 'Time to build, not part of the efficiency', formatSeconds),
  {
    label: 'render',
    title: 'Render time of one seed, and of denoising where it is denoised',
    key: (v) => gaveUp(v) ? null : v.seconds,
    cell: secondsCell
  },
  {
    label: 'samples',
    title: 'Samples a pixel in that time; where pixels differ the mean, the least and the most',
    first: -1,
    key: (v) => v.samples,
    cell: samplesCell
  },
  {
    label: 'mean R, G, B',
    title: 'Mean colour of the picture, linear',
    key: (v) => v.mean_rgb?.[1],
    cell: (v) => datum(variantPath(v, 'mean_rgb'), formatList)
  },
  {
    label: 'health',
    text: true,
    title: 'Counts that should be zero',
    key: (v) => Object.values(v.health ?? {}).reduce((a, b) => a + b, 0),
    cell: healthCell
  },
];

/** The result in one sentence. */
function headline() {
  return RESULTS.verdict ? element('p', {class: 'headline'}, datum('verdict', formatText)) : null;
}

function header() {
  const {settings = {}} = RESULTS;
  return element(
      'header', {}, element('div', {class: 'brand'}, 'Tyndall compare', themeSwitch()),
      element('h1', {}, datum('scene', formatText)),
      element(
          'p', {class: 'subtitle'}, datum('variants.length'), ' variants, ', datum('settings.budget', formatText), ' each, ',
          datum('settings.width'), ' × ', datum('settings.height'), `, ${settings.seeds?.length ?? 0} seeds`),
      headline());
}

function settingsFacts() {
  return factList('Settings', [
    ['budget of each variant', datum('settings.budget', formatText)], ['seeds', datum('settings.seeds', formatList)],
    ['picture', [datum('settings.width'), ' × ', datum('settings.height')]], ['eps of relative errors', datum('settings.eps')],
    ['options for all', datum('settings.options', formatText)]
  ]);
}

function referenceFacts() {
  const noise = (subtracted) =>
      (subtracted === true      ? 'subtracted from the errors' :
           subtracted === false ? 'not subtracted' :
                                  DASH);
  return factList('Reference', [
    ['source', datum('reference.source', formatText)], ['file', datum('reference.file', formatText)],
    ['samples', datum('reference.samples')], ['seed', datum('reference.seed')],
    ['time', datum('reference.seconds', formatSeconds)], ['own relMSE', datum('reference.relmse')],
    ['own noise', datum('reference.noise_subtracted', noise)]
  ]);
}

/** Where a variant was denoised, the page opens with the wipe between both. */
function showDenoised(viewer) {
  const denoised = RESULTS.variants.find((variant) => variant.as_rendered);
  const picture = (name) => viewer.pictures.find((p) => p.name === name);
  const [left, right] = [picture(denoised?.as_rendered), picture(denoised?.name)];
  if (left && right) viewer.set({current: left, other: right, mode: 'wipe'});
}

function pictureSection() {
  const pictures = picturesOf('');
  if (!pictures.length) return null;
  const viewer = new Viewer(pictures, RESULTS.settings?.eps ?? 0.01);
  activeViewer = viewer;
  showDenoised(viewer);
  const caption = (picture) => {
    const i = RESULTS.variants.findIndex((variant) => variant.name === picture.name);
    return [element('strong', {}, picture.name), i < 0 ? null : element('span', {}, 'relMSE ', datum(`variants.${i}.relmse`))];
  };
  return section('Pictures', viewer.root, new Sheet(viewer, caption).root);
}

function comparePage() {
  const variants = RESULTS.variants ??= [];
  const table = new SortableTable('Variants', VARIANT_COLUMNS, variants);
  table.sort(1, -1);
  const plot = new ErrorPlot(variants);
  document.getElementById('page').append(
      ...[header(), warningList('warnings'), section('Convergence', plot.root, checkpointTable(variants)),
          section(
              'Results', table.root, slopeNotes(),
              element(
                  'p', {class: 'note'},
                  'Efficiency is 1 / (MSE × time) relative to the first variant, with a 95 % interval over the seeds; build time is not in it. A click on a header sorts.')),
          partsSection(), pictureSection(),
          section(
              'How it was measured', element('div', {class: 'fact-lists'}, settingsFacts(), referenceFacts(), machineFacts()),
              commandLine('settings.command'))]
          .filter(Boolean));
}

comparePage();
