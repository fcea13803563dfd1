// Numbers as text. Each number of results.json is shown by datum(), which notes on the element where it stands there.

const DASH = '–';

/** Three significant digits, whole numbers in full; a dash for what is missing. */
function formatNumber(value) {
  if (typeof value !== 'number') return value === null || value === undefined ? DASH : String(value);
  if (Number.isInteger(value) && Math.abs(value) < 1e6) return String(value);
  const size = Math.abs(value);
  return size >= 1e-3 && size < 1e4 ? (size >= 1000 ? value.toFixed(0) : value.toPrecision(3)) : value.toExponential(2);
}

function formatSeconds(value) { return typeof value === 'number' ? `${formatNumber(value)} s` : DASH; }

function formatFactor(value) { return typeof value === 'number' ? `${formatNumber(value)}×` : DASH; }

function formatText(value) { return value === null || value === undefined || value === '' ? DASH : String(value); }

function formatList(value) { return Array.isArray(value) && value.length ? value.map(formatNumber).join(', ') : DASH; }

/** What stands at "variants.0.efficiency.low" of `object`; undefined where the path ends. */
function at(object, path) {
  return path.split('.').reduce((o, key) => (o === null || o === undefined ? undefined : o[key]), object);
}

const RESULTS = JSON.parse(document.getElementById('results').textContent);

/** <span> with the value at `path` of results.json; data-path and data-value (as JSON) say what it shows. */
function datum(path, format = formatNumber) {
  const value = at(RESULTS, path);
  const text = format(value);
  return element('span', {'data-path': path, 'data-value': value === undefined ? 'null' : JSON.stringify(value)}, text);
}

/** "1.2 [1.1, 1.3]" from three places; the brackets only where there are ends. */
function datumWithInterval(path, low, high, format = formatNumber) {
  const ends = typeof at(RESULTS, low) === 'number' || typeof at(RESULTS, high) === 'number';
  return [datum(path, format), ends ? element('small', {class: 'interval'}, ' [', datum(low), ', ', datum(high), ']') : null];
}
