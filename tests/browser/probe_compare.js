// The compare page: numbers, sorting, plot, viewer.

function requiredPaths() {
  const fields = [
    'name', 'options', 'efficiency.relative', 'efficiency.low', 'efficiency.high', 'efficiency_trimmed.relative', 'relmse',
    'relmse_trimmed', 'mse', 'mape', 'smape', 'slope', 'slope_low', 'slope_high', 'build_seconds', 'seconds', 'samples',
    'mean_rgb', 'checkpoints.6.relmse'
  ];
  const rest = [
    'scene', 'version', 'machine.cpu', 'machine.threads', 'settings.seeds', 'settings.options', 'settings.command',
    'settings.eps', 'reference.source', 'reference.samples', 'reference.relmse', 'warnings.0', 'warnings.1',
    'variants.0.work.paths', 'variants.0.work.shadow_rays', 'variants.0.error_parts.SurfaceIndirect',
    'variants.3.health.non_finite', 'variants.1.least_samples', 'variants.1.most_samples'
  ];
  return [...RESULTS.variants.flatMap((_, i) => fields.map((field) => `variants.${i}.${field}`)), ...rest];
}

/** Values of a column in the order of the rows. */
function column(field) {
  return all('section .table tbody tr')
      .flatMap((row) => all('[data-path]', row))
      .filter((span) => new RegExp(`^variants\\.\\d+\\.${field}$`).test(span.dataset.path))
      .map((span) => JSON.parse(span.dataset.value));
}

function checkTable() {
  const table = one('[aria-label=Variants]'),
        header = (label) => all('thead button', table).find((button) => button.textContent === label);
  const efficiencies = RESULTS.variants.map((v) => v.efficiency.relative), samples = RESULTS.variants.map((v) => v.samples);
  const falling = (a, b) => b - a;
  check(
      'sorted by efficiency', column('efficiency\\.relative').join() === [...efficiencies].sort(falling).join(),
      column('efficiency\\.relative'));
  const rendered = () => all('tbody tr', table).map((row) => JSON.parse(one('[data-path$=\'.samples\']', row).dataset.value));
  header('samples').click();
  check('a click sorts', rendered().join() === [...samples].sort(falling).join(), rendered());
  header('samples').click();
  check('a second click turns it round', rendered().join() === [...samples].sort(falling).reverse().join(), rendered());
  all('thead button', table).filter((button) => button.textContent === 'efficiency, trimmed')[0].click();
  const last = all('tbody tr', table).at(-1);
  check(
      'what is missing comes last', one('[data-path$=\'efficiency_trimmed.relative\']', last).textContent === '–',
      last.textContent);
  check('the sorted column is announced', one('[aria-sort=descending]', table).textContent.includes('trimmed'));
}

async function checkPlot() {
  const holder = one('.plot');
  check('a line for each variant', all('polyline', holder).length === RESULTS.variants.length);
  check('bands', all('polygon', holder).every((band) => band.getAttribute('points').split(' ').length === 14));
  check('guides', all('.plot .guide').length >= 2);
  const points = () => one('polyline', holder).getAttribute('points'), byTime = points();
  one('[aria-label=\'Error against\'] [data-value=samples]').click();
  check(
      'time and samples are switched', points() !== byTime && one('.plot svg').getAttribute('aria-label').includes('samples'));
  one('[aria-label=\'Error against\'] [data-value=seconds]').click();
  // Equal error times time lies on one guide: a series of slope -1 is parallel to them on equal axes.
  const guide = one('.plot .guide'),
        [x1, y1, x2, y2] = ['x1', 'y1', 'x2', 'y2'].map((name) => Number(guide.getAttribute(name)));
  const decades = (scaleRange) => Math.log10(scaleRange[1] / scaleRange[0]);
  const series = new ErrorPlot(
      [{name: 'ideal', checkpoints: [{seconds: 1, samples: 1, relmse: 1}, {seconds: 100, samples: 100, relmse: 0.01}]}]);
  const ideal = one('polyline', series.root).getAttribute('points').split(/[ ,]/).map(Number),
        own = one('.plot .guide', series.root);
  const slope = (a, b, c, d) => (d - b) / (c - a),
        of = (line) => slope(...['x1', 'y1', 'x2', 'y2'].map((name) => Number(line.getAttribute(name))));
  check(
      'guides have slope -1',
      Math.abs(slope(...ideal) / of(own) - 1) < 1e-6 && slope(x1, y1, x2, y2) > 0 && decades([1, 10]) === 1,
      `${slope(...ideal)} ${of(own)}`);
  const marks = one('polyline', holder).getAttribute('points').split(' ')[3].split(',').map(Number),
        box = holder.getBoundingClientRect();
  holder.dispatchEvent(new PointerEvent('pointermove', {clientX: box.left + marks[0], clientY: box.top + marks[1]}));
  const target = RESULTS.variants[0].checkpoints[3];
  check(
      'hovering shows values', !one('.tip').hidden && one('.tip').textContent.includes(formatNumber(target.relmse)),
      one('.tip').textContent);
  one('.legend button').click();
  check('the legend hides a line', all('polyline', holder).length === RESULTS.variants.length - 1);
  one('.legend button').click();
}

async function checkViewer() {
  const root = one('.viewer'), canvas = one('.window'), state = root.dataset;
  activeViewer.resize();
  await settle();
  check('a variant is shown first', state.picture === 'tree-binary', state.picture);
  check(
      'linear values survive',
      activeViewer.reference &&
          (await activeViewer.reference.load(), activeViewer.reference.color(0, 0).join() === '0.25,0.5,2'));
  const first = fingerprint(canvas);
  for (const [key, name] of [['0', 'reference'], ['2', 'tree'], ['5', '<\/script><b>&"\''], ['1', 'tree-binary']]) {
    press(key);
    await settle();
    check(
        `key ${key} flips to its picture`, state.picture === name && one('.tabs [aria-pressed=true]').dataset.picture === name,
        state.picture);
    check(`key ${key} changes the canvas`, (fingerprint(canvas) === first) === (key === '1'));
  }
  await checkExposure(canvas, state);
  await checkZoom(canvas, state);
  await checkWipe(canvas, state);
  await checkError(canvas, state);
  await checkSamples(canvas, state);
}

async function checkExposure(canvas, state) {
  press('0');
  await settle();
  const before = shown(canvas, 0.9, 0.1),
        srgb = (c) => Math.round(255 * (c <= 0.0031308 ? 12.92 * c : 1.055 * c ** (1 / 2.4) - 0.055));
  const {view, reference} = activeViewer, pixel = view.pixelAt(0.9 * view.width, 0.1 * view.height),
               color = reference.color(pixel.x, pixel.y);
  check('sRGB of the linear value', before.every((c, k) => Math.abs(c - srgb(color[k])) <= 1), `${before} for ${color}`);
  press(']');
  press(']');
  await settle();
  const after = shown(canvas, 0.9, 0.1);
  check(
      'exposure by keys', state.stops === '1' && after.every((c, k) => Math.abs(c - srgb(2 * color[k])) <= 1),
      `${state.stops}: ${after}`);
  const range = one('input.exposure');
  range.value = '-2';
  range.dispatchEvent(new Event('input'));
  await settle();
  check(
      'exposure by its slider',
      state.stops === '-2' && shown(canvas, 0.9, 0.1).every((c, k) => Math.abs(c - srgb(color[k] / 4)) <= 1),
      shown(canvas, 0.9, 0.1));
  press('\\');
}

async function checkZoom(canvas, state) {
  press('1');
  await settle();
  const fitted = Number(state.scale), before = fingerprint(canvas), box = canvas.getBoundingClientRect();
  const {view} = activeViewer, under = () => view.toPicture(0.3 * view.width, 0.4 * view.height), spot = under();
  canvas.dispatchEvent(new WheelEvent(
      'wheel', {deltaY: -800, clientX: box.left + 0.3 * box.width, clientY: box.top + 0.4 * box.height, cancelable: true}));
  await settle();
  check('the wheel zooms', Math.abs(Number(state.scale) / fitted - 4) < 0.01 && fingerprint(canvas) !== before, state.scale);
  check(
      'what is under the pointer stays', Math.hypot(under().x - spot.x, under().y - spot.y) < 0.15,
      `${under().x} ${under().y} not ${spot.x} ${spot.y}`);
  const zoomed = fingerprint(canvas), left = view.left;
  for (const [type, u] of [['pointerdown', 0.5], ['pointermove', 0.4], ['pointerup', 0.4]]) point(canvas, type, u, 0.5);
  await settle();
  check(
      'a drag moves the picture', Math.abs(left - view.left - 0.1 * box.width) < 1 && fingerprint(canvas) !== zoomed,
      `${left} ${view.left}`);
  const scale = Number(state.scale);
  point(canvas, 'pointerdown', 0.4, 0.5);
  point(canvas, 'pointerdown', 0.6, 0.5, {pointerId: 2});
  point(canvas, 'pointermove', 0.8, 0.5, {pointerId: 2});
  for (const pointerId of [1, 2]) point(canvas, 'pointerup', 0.5, 0.5, {pointerId});
  check('a pinch zooms', Math.abs(Number(state.scale) / scale - 2) < 0.02, state.scale / scale);
  press('-');
  check('keys zoom', Number(state.scale) < 2 * scale);
  const top = view.top;
  press('ArrowDown', canvas);
  check('arrows move', view.top === top - 40, view.top);
  press('f');
  await settle();
  point(canvas, 'pointerleave', 0, 0);
  await settle();
  check('f fits again', Math.abs(Number(state.scale) - fitted) < 1e-9 && fingerprint(canvas) === before);
}

async function checkWipe(canvas, state) {
  press('2');
  await settle();
  const own = shown(canvas, 0.25, 0.5);
  press('0');
  await settle();
  const reference = [shown(canvas, 0.25, 0.5), shown(canvas, 0.75, 0.45)];
  press('2');
  press('w');
  await settle();
  check(
      'w wipes against the reference',
      state.mode === 'wipe' && shown(canvas, 0.25, 0.5).join() === own.join() &&
          shown(canvas, 0.75, 0.45).join() === reference[1].join());
  const divider = one('.divider'), place = () => {
    const line = divider.getBoundingClientRect(), window = canvas.getBoundingClientRect();
    return ((line.left + line.right) / 2 - window.left) / window.width;
  };
  check('the line is drawn', divider.getClientRects().length === 1 && Math.abs(place() - 0.5) < 0.005, place());
  check(
      'the line names its sides',
      one('.side.left', divider).textContent === 'tree' && one('.side.right', divider).textContent === 'reference',
      divider.textContent);
  for (const [type, u] of [['pointerdown', 0.5], ['pointermove', 0.1], ['pointerup', 0.1]]) point(canvas, type, u, 0.5);
  await settle();
  check(
      'the line can be dragged',
      Math.abs(Number(state.wipe) - 0.1) < 0.01 && Math.abs(place() - 0.1) < 0.01 &&
          shown(canvas, 0.25, 0.5).join() === reference[0].join(),
      state.wipe);
  check('a drag gives the line the focus', document.activeElement === divider, document.activeElement.className);
  await checkWipeKeys(divider, state);
  await checkSides(canvas, state);
  press('w');
  await settle();
  check('without a wipe there is no line', divider.getClientRects().length === 0);
}

async function checkWipeKeys(divider, state) {
  const {view} = activeViewer, left = view.left;
  for (const key of ['End', 'PageDown', 'ArrowLeft', 'ArrowUp', 'ArrowRight']) press(key, divider);
  check('keys move the line', Math.abs(Number(state.wipe) - 0.91) < 1e-9, state.wipe);
  check('and nothing else', view.left === left);
  check(
      'the line says where it is',
      divider.getAttribute('aria-valuenow') === '91' &&
          divider.getAttribute('aria-valuetext') === '91 %, tree left, reference right' && divider.tabIndex === 0 &&
          divider.getAttribute('role') === 'slider' && divider.getAttribute('aria-label') === 'Line of the wipe',
      divider.getAttribute('aria-valuetext'));
  press('End', divider);
  press('End', divider);
  check('the line stays in the window', state.wipe === '1', state.wipe);
  press('ArrowLeft', divider);
  await settle();
}

/** Any two pictures, chosen by name. */
async function checkSides(canvas, state) {
  const [left, right] = ['left', 'right'].map((side) => one(`[aria-label='Picture on the ${side}']`));
  const choose = (select, name) => {
    select.value = activeViewer.pictures.findIndex((picture) => picture.name === name);
    select.dispatchEvent(new Event('change'));
  };
  activeViewer.set({wipe: 0.5});
  choose(left, 'power');
  choose(right, 'tree');
  await settle();
  const sides = [shown(canvas, 0.25, 0.5), shown(canvas, 0.75, 0.45)];
  check('the sides are chosen', state.picture === 'power' && activeViewer.other.name === 'tree', state.picture);
  one('[aria-label=\'Swap the sides\']').click();
  await settle();
  check(
      'the sides are swapped',
      state.picture === 'tree' && activeViewer.other.name === 'power' && shown(canvas, 0.25, 0.5).join() !== sides[0].join(),
      state.picture);
  press('w');
  await settle();
  check('and are the pictures themselves', shown(canvas, 0.75, 0.45).join() === sides[1].join(), shown(canvas, 0.75, 0.45));
  press('3');
  press('w');
  await settle();
  check('no picture is wiped against itself', activeViewer.current !== activeViewer.other, state.picture);
}

async function checkError(canvas, state) {
  press('3');
  press('e');
  await settle();
  check('the error map is shown', state.mode === 'error' && !one('.error-legend').hidden);
  const {view, reference, current} = activeViewer, [u, v] = [0.703, 0.206],
                          pixel = view.pixelAt(u * view.width, v * view.height);
  const target = reference.color(pixel.x, pixel.y), color = current.color(pixel.x, pixel.y);
  const error = color.reduce((sum, c, k) => sum + (c - target[k]) ** 2 / (target[k] ** 2 + 0.01), 0) / 3;
  const expected = errorColor((Math.log10(error) + 4) / 5), seen = shown(canvas, u, v);
  check(
      'its colours are the relative squared error', seen.every((c, k) => Math.abs(c - expected[k]) <= 2),
      `${seen} not ${expected} for ${error}`);
  point(canvas, 'pointermove', u, v);
  await settle();
  const text = one('.readout').textContent;
  check(
      'values under the pointer',
      text.includes(`x ${pixel.x + 7}, y ${pixel.y + 3}`) && text.includes(color.map(formatNumber).join('  ')) &&
          text.includes(formatNumber(error)),
      text);
  press('0');
  await settle();
  check('the reference has no error', shown(canvas, u, v).join() === ERROR_COLORS[0].join(), shown(canvas, u, v));
  press('5');
  press('e');
  await settle();
  const broken = shown(canvas, (view.left + 5.5 * view.scale) / view.width, (view.top + 0.5 * view.scale) / view.height);
  check('a pixel that is not finite is marked', broken.join() === '0,255,0', broken);
}

/** Samples are no light: false colours with a scale of their own, at any exposure, and no error. */
async function checkSamples(canvas, state) {
  const [ofErrors, ofSamples] = all('.viewer .error-legend'), {view} = activeViewer;
  check('no scale of samples beside light', ofSamples.hidden);
  press('6');
  for (const mode of ['error', 'picture']) {
    activeViewer.set({mode, stops: 2});
    await settle();
    const [u, v] = [0.703, 0.206], pixel = view.pixelAt(u * view.width, v * view.height);
    const samples = 32 * (1 + (Math.floor(pixel.x / 8) + Math.floor(pixel.y / 8)) % 11);
    const expected = errorColor((Math.log2(samples) - 4) / 8), seen = shown(canvas, u, v);
    check(
        `samples a pixel in false colours, mode ${mode}`,
        state.picture === 'tree samples' && seen.every((c, k) => Math.abs(c - expected[k]) <= 2),
        `${seen} not ${expected} for ${samples}`);
    check('the scale of samples alone', ofErrors.hidden && !ofSamples.hidden);
    point(canvas, 'pointermove', u, v);
    await settle();
    const text = one('.readout').textContent;
    check('their number under the pointer', text.includes(`tree samples  ${samples}reference`), text);
  }
  activeViewer.set({stops: 0});
  press('1');
  await settle();
  check('and no scale beside light again', ofSamples.hidden && ofErrors.hidden);
}

run(async () => {
  checkNumbers(requiredPaths());
  checkTable();
  await checkPlot();
  await checkViewer();
  one('.theme [data-value=dark]').click();
  check(
      'dark by the switch', getComputedStyle(document.body).backgroundColor === 'rgb(21, 24, 28)',
      getComputedStyle(document.body).backgroundColor);
  one('.theme [data-value=light]').click();
  check(
      'light by the switch', getComputedStyle(document.body).backgroundColor === 'rgb(251, 250, 247)',
      getComputedStyle(document.body).backgroundColor);
  one('.theme [data-value=auto]').click();
  check(
      'the sheet shows all pictures',
      all('.sheet canvas').length === 7 && new Set(all('.sheet canvas').map(fingerprint)).size === 7);
});
