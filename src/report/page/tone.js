// Linear colour to what a canvas shows: sRGB at an exposure, and false colour for errors.

const NOT_FINITE = [0, 255, 0];  // green marks NaN and infinity

/** 8-bit sRGB (IEC 61966-2-1) of each half float after `stops`; -1 where it is not finite. */
function toneTable(stops) {
  const gain = 2 ** stops;
  return Int16Array.from(HALF_TO_FLOAT, (value) => {
    if (!Number.isFinite(value)) return -1;
    const c = Math.min(Math.max(value * gain, 0), 1);
    return Math.round(255 * (c <= 0.0031308 ? 12.92 * c : 1.055 * c ** (1 / 2.4) - 0.055));
  });
}

/** A canvas of the picture's size, filled by paint(data, pixels). */
function paintedCanvas(picture, paint) {
  const canvas = element('canvas', {width: picture.width, height: picture.height});
  const context = canvas.getContext('2d');
  const image = context.createImageData(picture.width, picture.height);
  paint(image.data, picture.width * picture.height);
  context.putImageData(image, 0, 0);
  return canvas;
}

function toned(picture, table) {
  const halves = picture.halves;
  return paintedCanvas(picture, (data, pixels) => {
    for (let i = 0, o = 0; i < pixels; ++i, o += 4) {
      const r = table[halves[i]], g = table[halves[pixels + i]], b = table[halves[2 * pixels + i]];
      const finite = r >= 0 && g >= 0 && b >= 0;
      data[o] = finite ? r : NOT_FINITE[0];
      data[o + 1] = finite ? g : NOT_FINITE[1];
      data[o + 2] = finite ? b : NOT_FINITE[2];
      data[o + 3] = 255;
    }
  });
}

/** (x - r)^2 / (r^2 + eps), as in relMSE. */
function relativeSquaredError(x, r, eps) { return (x - r) ** 2 / (r * r + eps); }

// False colour over decades of the relative squared error, as in `tyndall diff -o`: black at 1e-4 and below, pale yellow at
// 10 and above; lightness rises all the way.
const ERROR_DECADES = [-4, 1];
// Of samples a pixel, in the same colours: powers of two.
const SAMPLE_OCTAVES = [4, 12];
const ERROR_COLORS = [[0, 0, 0], [84, 20, 128], [199, 46, 77], [250, 148, 26], [255, 250, 191]];

function errorColor(t) {
  const place = Math.min(Math.max(t, 0), 1) * (ERROR_COLORS.length - 1);
  const i = Math.min(Math.floor(place), ERROR_COLORS.length - 2), f = place - i;
  return ERROR_COLORS[i].map((c, k) => Math.round(c + f * (ERROR_COLORS[i + 1][k] - c)));
}

const ERROR_TABLE = Array.from({length: 256}, (_, i) => errorColor(i / 255));

/** value(i) of each pixel in false colour, over `range` of its logarithm. */
function falseColors(picture, value, log, [low, high]) {
  return paintedCanvas(picture, (data, pixels) => {
    for (let i = 0, o = 0; i < pixels; ++i, o += 4) {
      const v = value(i), t = (log(Math.max(v, 1e-30)) - low) / (high - low);
      data.set(Number.isFinite(v) ? ERROR_TABLE[Math.round(255 * Math.min(Math.max(t, 0), 1))] : NOT_FINITE, o);
      data[o + 3] = 255;
    }
  });
}

/** The picture's relative squared error, mean over the channels, in false colour. */
function errorMap(picture, reference, eps) {
  const a = picture.halves, b = reference.halves, pixels = picture.width * picture.height;
  return falseColors(picture, (i) => {
    let sum = 0;
    for (let j = i; j < 3 * pixels; j += pixels) sum += relativeSquaredError(HALF_TO_FLOAT[a[j]], HALF_TO_FLOAT[b[j]], eps);
    return sum / 3;
  }, Math.log10, ERROR_DECADES);
}

/** A picture that holds no light: errors, or samples. */
function dataMap(picture) {
  const value = (i) => HALF_TO_FLOAT[picture.halves[i]];
  return picture.kind === 'samples' ? falseColors(picture, value, Math.log2, SAMPLE_OCTAVES) :
                                      falseColors(picture, value, Math.log10, ERROR_DECADES);
}

/** The false colours from `low` to `high`, with a tick at each whole number between, and what they mean. */
function colorLegend([low, high], tick, text) {
  const stops = ERROR_COLORS.map((c) => `rgb(${c.join(' ')})`).join(', ');
  const ticks = Array.from({length: high - low + 1}, (_, i) => element('span', {}, tick(low + i)));
  return element(
      'div', {class: 'error-legend'},
      element('div', {class: 'error-bar', style: `background: linear-gradient(to right, ${stops})`}),
      element('div', {class: 'error-ticks', 'aria-hidden': 'true'}, ticks), element('p', {}, text));
}

/** The scale of errorMap, to stand below a picture. */
function errorLegend() {
  const [low, high] = ERROR_DECADES, ends = `black 1e${low} and below, pale yellow 1e${high} and above`;
  return colorLegend(
      ERROR_DECADES, (t) => `1e${t}`, `Relative squared error of a pixel, mean of R, G and B: ${ends}; green: not finite.`);
}

function sampleLegend() {
  const [low, high] = SAMPLE_OCTAVES.map((octave) => 2 ** octave);
  return colorLegend(
      SAMPLE_OCTAVES, (t) => String(2 ** t), `Samples of a pixel: black ${low} and below, pale yellow ${high} and above.`);
}
