// What time goes into and error is made of: bars of shares that add up to 1.

const WORK_PARTS = {
  paths: 'paths',
  media: 'media',
  vertex_lights: 'lights at vertices',
  segment_lights: 'lights along segments',
  shadow_rays: 'shadow rays',
  sharing: 'sharing',
  guiding: 'guiding'
};

const ERROR_PARTS = {
  Emission: 'emission',
  SurfaceDirect: 'surfaces, direct',
  SurfaceIndirect: 'surfaces, indirect',
  VolumeDirect: 'media, direct',
  VolumeIndirect: 'media, indirect'
};

function formatPercent(value) { return typeof value === 'number' ? `${Number((100 * value).toPrecision(3))} %` : DASH; }

/** The shares of one variant side by side, in the order and the colours of `names`. */
function shareBar(shares, names) {
  const width = 220;
  let x = 0;
  const rects = Object.keys(names).map((name, i) => {
    const share = shares[name] ?? 0,
          rect = svg('rect', {x: x * width, y: 0, width: share * width, height: 12, fill: seriesColor(i)});
    x += share;
    return rect;
  });
  return svg('svg', {class: 'shares', viewBox: `0 0 ${width} 12`, width, height: 12, 'aria-hidden': 'true'}, rects);
}

function shareColumn(field, name, label, i) {
  return {
    label: [element('span', {class: 'dot', 'aria-hidden': 'true', style: `color: ${seriesColor(i)}`}), label],
    first: -1,
    key: (v) => v[field]?.[name],
    cell: (v) => datum(variantPath(v, `${field}.${name}`), formatPercent)
  };
}

/** A table of the shares in `field` of each variant that has them; null where none has. */
function shareTable(caption, field, names) {
  const rows = RESULTS.variants.filter((variant) => variant[field]);
  if (!rows.length) return null;
  const columns = [
    {label: 'variant', text: true, key: (v) => v.name, cell: (v) => datum(variantPath(v, 'name'), formatText)},
    {label: caption.toLowerCase(), text: true, key: () => 0, cell: (v) => shareBar(v[field], names)},
    ...Object.entries(names).map(([name, label], i) => shareColumn(field, name, label, i))
  ];
  return new SortableTable(caption, columns, rows).root;
}

function partsSection() {
  const work = shareTable('Time', 'work', WORK_PARTS), error = shareTable('Error', 'error_parts', ERROR_PARTS);
  if (!work && !error) return null;
  return section(
      'What time and error go into', work, error,
      element(
          'p', {class: 'note'},
          'Time by what rendering counted, at prices that are the same on every machine. Error as the variance from seed to seed of each kind of light, relative as relMSE is; from two seeds on.'));
}
