// Error against time or samples, a line for each variant.

const SERIES_COLORS = 8;
const DASHES = [null, '7 4', '2 3'];  // beyond eight lines colours come again, dashed
const FILTERED_DASHES = ['7 4', '7 4 2 4', '2 6'];
const MARKERS =
    ['M-4 0a4 4 0 1 0 8 0a4 4 0 1 0-8 0z', 'M-3.5-3.5h7v7h-7z', 'M0-4.6l4.3 7.7h-8.6z', 'M0-4.8l4.8 4.8-4.8 4.8-4.8-4.8z'];

const seriesColor = (i) => `var(--series-${i % SERIES_COLORS})`;
const marker = ({index, filtered}, x, y) =>
    svg('path',
        {class: filtered ? 'marker hollow' : 'marker', d: MARKERS[index % MARKERS.length], transform: `translate(${x} ${y})`});
const isPositive = (value) => typeof value === 'number' && value > 0;

/** The place of a variant among those that are as rendered: a denoised one shares its colour and mark with the other. */
function seriesIndex(variants, variant) {
  const own = variants.filter((v) => !v.as_rendered), place = own.findIndex((v) => v.name === variant.as_rendered);
  return place < 0 ? own.indexOf(variant) : place;
}

class ErrorPlot {
  constructor(variants) {
    this.series = variants.map((variant) => ({
                                 name: variant.name,
                                 index: seriesIndex(variants, variant),
                                 filtered: Boolean(variant.as_rendered),
                                 shown: true,
                                 points: variant.checkpoints ?? []
                               }));
    this.tip = element('div', {class: 'tip', hidden: true});
    this.holder = element('div', {class: 'plot'});
    this.choice = segmented('Error against', [['seconds', 'Time'], ['samples', 'Samples']], (field) => this.show(field));
    this.note = element('p', {class: 'note'});
    this.root = element('div', {}, this.choice.group, this.holder, this.legend(), this.note);
    this.holder.addEventListener('pointermove', (event) => this.hover(event));
    this.holder.addEventListener('pointerleave', () => {
      this.tip.hidden = true;
    });
    const follow = () => {
      if (!this.printing && this.holder.clientWidth !== this.width) this.show(this.field);
    };
    new ResizeObserver(() => requestAnimationFrame(follow)).observe(this.holder);
    for (const event of ['beforeprint', 'afterprint'])
      window.addEventListener(event, () => this.print(event === 'beforeprint'));
    this.show('seconds');
  }

  print(printing) {
    this.printing = printing;
    this.show(this.field);
  }

  legend() {
    const keys = this.series.map((series) => {
      const sample = svg(
          'svg',
          {width: 34, height: 14, viewBox: '0 0 34 14', 'aria-hidden': 'true', style: `color: ${seriesColor(series.index)}`},
          svg('line', {class: 'line', x1: 1, x2: 33, y1: 7, y2: 7, 'stroke-dasharray': this.dash(series)}),
          marker(series, 17, 7));
      const button = element(
          'button', {
            type: 'button',
            'aria-pressed': 'true',
            onclick: () => {
              series.shown = !series.shown;
              button.setAttribute('aria-pressed', String(series.shown));
              this.show(this.field);
            }
          },
          sample, series.name);
      return button;
    });
    const guide =
        svg('svg', {width: 34, height: 14, 'aria-hidden': 'true'}, svg('line', {class: 'guide', x1: 1, x2: 33, y1: 3, y2: 11}));
    return element(
        'div', {class: 'legend', role: 'group', 'aria-label': 'Lines shown'}, keys, element('span', {}, guide, 'slope −1'));
  }

  dash({index, filtered}) {
    const dashes = filtered ? FILTERED_DASHES : DASHES;
    return dashes[Math.floor(index / SERIES_COLORS) % dashes.length];
  }

  /** Points that have a place on logarithmic axes. */
  drawable(series) { return series.points.filter((p) => isPositive(p[this.field]) && isPositive(p.relmse)); }

  frame(width, height) {
    const points = this.series.flatMap((series) => this.drawable(series));
    const xDomain = logDomain(points.map((p) => p[this.field]));
    const yDomain = logDomain(points.flatMap((p) => [p.relmse, p.relmse_low, p.relmse_high].filter(isPositive)));
    const edges = {left: 58, right: width - 12, top: 30, bottom: height - 46};
    return {
      ...edges,
      xDomain,
      yDomain,
      x: logScale(xDomain, edges.left, edges.right),
      y: logScale(yDomain, edges.bottom, edges.top)
    };
  }

  show(field) {
    this.field = field;
    this.choice.press(field);
    const all = this.series.flatMap((series) => series.points),
          left = all.length - this.series.flatMap((s) => this.drawable(s)).length;
    this.note.textContent = `Bands: the spread over the seeds. ${
        field === 'seconds' ?
            'Time is render time; build time stands in the table. ' :
            ''}${this.series.some((series) => series.filtered) ? 'Dashed: denoised, with the time that took. ' : ''}${
        left ? `${left} of ${all.length} points are not above zero (below the reference's own noise) and not drawn.` : ''}`;
    if (all.length === left) return this.holder.replaceChildren(element('p', {class: 'note'}, 'There is nothing to plot.'));
    this.width = this.holder.clientWidth;
    const width = this.printing ? 720 : Math.max(this.width || 720, 280),
          height = Math.round(Math.min(Math.max(0.55 * width, 280), 520));
    const frame = this.frame(width, height);
    const title = field === 'seconds' ? 'render time in seconds' : 'samples a pixel';
    const shown = this.series.filter((series) => series.shown);
    const drawing =
        svg('svg', {
          viewBox: `0 0 ${width} ${height}`,
          role: 'img',
          'aria-label': `relMSE against ${title}, both logarithmic; the numbers stand in the table below`
        },
            axes(frame, title, 'relMSE'), slopeGuides(frame), shown.map((series) => this.band(series, frame)),
            shown.map((series) => this.line(series, frame)));
    this.near =
        shown.flatMap((series) => this.drawable(series).map((p) => ({series, p, x: frame.x(p[field]), y: frame.y(p.relmse)})));
    this.holder.replaceChildren(drawing, this.tip);
  }

  /** Between relmse_low and relmse_high; an end at or below zero goes to the lower edge. */
  band(series, frame) {
    const points = this.drawable(series).filter((p) => isPositive(p.relmse_high));
    const place = (p, value) => `${frame.x(p[this.field])},${isPositive(value) ? frame.y(value) : frame.bottom}`;
    const outline = [...points.map((p) => place(p, p.relmse_high)), ...points.reverse().map((p) => place(p, p.relmse_low))];
    return svg('polygon', {class: 'band', points: outline.join(' '), style: `color: ${seriesColor(series.index)}`});
  }

  line(series, frame) {
    const places = this.drawable(series).map((p) => [frame.x(p[this.field]), frame.y(p.relmse)]);
    return svg(
        'g', {style: `color: ${seriesColor(series.index)}`},
        svg('polyline', {class: 'line', points: places.join(' '), 'stroke-dasharray': this.dash(series)}),
        places.map(([x, y]) => marker(series, x, y)));
  }

  /** Values of the nearest point within 40 pixels. */
  hover(event) {
    const box = this.holder.getBoundingClientRect(), x = event.clientX - box.left, y = event.clientY - box.top;
    const distance = (place) => Math.hypot(place.x - x, place.y - y);
    const nearest = (this.near ?? []).reduce((best, place) => (!best || distance(place) < distance(best) ? place : best), null);
    this.tip.hidden = !nearest || distance(nearest) > 40;
    if (this.tip.hidden) return;
    const {p, series} = nearest;
    const rows = [
      ['relMSE', formatNumber(p.relmse)], ['from, to', `${formatNumber(p.relmse_low)}, ${formatNumber(p.relmse_high)}`],
      ['time', formatSeconds(p.seconds)], ['samples', formatNumber(p.samples)]
    ];
    this.tip.replaceChildren(
        element('strong', {style: `color: ${seriesColor(series.index)}`}, series.name),
        element('dl', {}, rows.flatMap(([name, value]) => [element('dt', {}, name), element('dd', {}, value)])));
    this.tip.style.left = `${Math.min(nearest.x + 12, Math.max(box.width - 190, 0))}px`;
    this.tip.style.top = `${Math.max(nearest.y - 30, 0)}px`;
  }
}

/** The numbers behind the plot. */
function checkpointTable(variants) {
  const fields = [
    ['seconds', 'seconds'], ['samples', 'samples'], ['mse', 'MSE'], ['relmse', 'relMSE'], ['relmse_low', 'from'],
    ['relmse_high', 'to']
  ];
  const rows = variants.flatMap(
      (variant, i) =>
          (variant.checkpoints ?? [])
              .map(
                  (_, k) => element(
                      'tr', {}, element('th', {scope: 'row', class: 'text'}, k ? '' : variant.name),
                      fields.map(([field]) => element('td', {}, datum(`variants.${i}.checkpoints.${k}.${field}`))))));
  return element(
      'details', {class: 'numbers'}, element('summary', {}, 'The points as numbers'),
      element(
          'div', {class: 'table', tabindex: 0, role: 'region', 'aria-label': 'Points of the plot'},
          element(
              'table', {},
              element(
                  'thead', {},
                  element(
                      'tr', {}, element('th', {scope: 'col', class: 'text'}, 'variant'),
                      fields.map(([, label]) => element('th', {scope: 'col'}, label)))),
              element('tbody', {}, rows))));
}
