// Logarithmic axes.

/** value -> place between `from` and `to`. */
function logScale([low, high], from, to) {
  const a = Math.log10(low), b = Math.log10(high);
  return (value) => from + ((Math.log10(value) - a) / (b - a)) * (to - from);
}

/** The range of the values, at least half a decade, and a little more at both ends. */
function logDomain(values) {
  const logs = values.map(Math.log10);
  const low = Math.min(...logs), high = Math.max(...logs), more = Math.max(0.06 * (high - low), (0.5 - (high - low)) / 2);
  return [10 ** (low - more), 10 ** (high + more)];
}

/** Powers of ten in the range; 2 and 5 between them when there are few. */
function logTicks([low, high]) {
  const ticks = [];
  const steps = high / low < 200 ? [1, 2, 5] : [1];
  for (let decade = Math.floor(Math.log10(low)); 10 ** decade <= high; ++decade) {
    for (const step of steps) {
      const value = Number(`${step}e${decade}`);
      if (value >= low && value <= high) ticks.push(value);
    }
  }
  return ticks;
}

function tickText(value) { return value >= 0.01 && value < 10000 ? String(value) : value.toExponential(0).replace('e+', 'e'); }

/** Grid lines, numbers and titles. frame: {x, y (scales), xDomain, yDomain, left, right, top, bottom}. */
function axes(frame, xTitle, yTitle) {
  const {x, y, left, right, top, bottom} = frame;
  const vertical = logTicks(frame.xDomain)
                       .map(
                           (value) =>
                               [svg('line', {class: 'grid', x1: x(value), x2: x(value), y1: top, y2: bottom}),
                                svg('text', {x: x(value), y: bottom + 18, 'text-anchor': 'middle'}, tickText(value))]);
  const horizontal = logTicks(frame.yDomain)
                         .map(
                             (value) =>
                                 [svg('line', {class: 'grid', x1: left, x2: right, y1: y(value), y2: y(value)}),
                                  svg('text', {x: left - 8, y: y(value) + 4, 'text-anchor': 'end'}, tickText(value))]);
  return svg(
      'g', {class: 'axes'}, vertical.flat(), horizontal.flat(),
      svg('text', {class: 'title', x: (left + right) / 2, y: bottom + 38, 'text-anchor': 'middle'}, xTitle),
      svg('text', {class: 'title', x: left - 46, y: top - 10}, yTitle));
}

/** Dashed lines of slope -1, a decade apart: along one, error x cost is constant. */
function slopeGuides(frame) {
  const {x, y, xDomain, yDomain} = frame;
  const first = Math.ceil(Math.log10(xDomain[0] * yDomain[0])), last = Math.floor(Math.log10(xDomain[1] * yDomain[1]));
  const lines = [];
  for (let k = first; k <= last; ++k) {
    const ends = xDomain.map((end) => Math.min(Math.max(end, 10 ** k / yDomain[1]), 10 ** k / yDomain[0]));
    lines.push(
        svg('line', {class: 'guide', x1: x(ends[0]), y1: y(10 ** k / ends[0]), x2: x(ends[1]), y2: y(10 ** k / ends[1])}));
  }
  return svg('g', {}, lines);
}
