// What stands around the window of a viewer: names above it, values under the pointer and controls below it.

/** The digit that shows a picture, or "" beyond nine. */
function keyOf(viewer, picture) {
  if (picture === viewer.reference) return '0';
  const place = viewer.pictures.filter((p) => p !== viewer.reference).indexOf(picture) + 1;
  return place <= 9 ? String(place) : '';
}

function pictureTabs(viewer) {
  const buttons = viewer.pictures.map((picture) => {
    const key = keyOf(viewer, picture);
    return element(
        'button', {
          type: 'button',
          'data-picture': picture.name,
          'aria-keyshortcuts': key || null,
          onclick: () => viewer.set({current: picture})
        },
        key ? element('kbd', {}, key) : null, picture.name);
  });
  viewer.listeners.push(
      () => buttons.forEach((button, i) => button.setAttribute('aria-pressed', String(viewer.pictures[i] === viewer.current))));
  return element('div', {class: 'tabs', role: 'group', 'aria-label': 'Picture'}, buttons);
}

function pixelText(viewer, picture) {
  const {x, y} = viewer.pixel;
  const color = picture.color(x, y), shown = color.slice(0, picture.planes ?? 3);
  const values = shown.map((c) => (Number.isFinite(c) ? formatNumber(c) : String(c)));
  const text = `${picture.name}  ${values.join('  ')}`;
  if (picture.kind !== 'light' || !viewer.reference?.halves || picture === viewer.reference) return text;
  const target = viewer.reference.color(x, y);
  const error = color.reduce((sum, c, k) => sum + relativeSquaredError(c, target[k], viewer.eps), 0) / 3;
  return `${text}   rel. sq. error ${formatNumber(error)}`;
}

/** Where the pixel under the pointer lies in the frame, of which the pictures may be a crop. */
function placeText(viewer) {
  const {pixel, current, reference} = viewer;
  if (pixel) return `x ${current.x + pixel.x}, y ${current.y + pixel.y}`;
  return `Point at a pixel to read its linear R, G, B${reference ? ' and its relative squared error' : ''}.`;
}

/** Linear R, G, B of the pixel under the pointer, of what is shown and of the reference. */
function readout(viewer) {
  const out = element('div', {class: 'readout'});
  viewer.listeners.push(() => {
    const wanted =
        [...new Set([viewer.current, viewer.mode === 'wipe' ? viewer.other : viewer.current, viewer.reference])].filter(
            Boolean);
    if (viewer.pixel)
      for (const picture of wanted) picture.load();
    const shown = viewer.pixel ? wanted.filter((picture) => picture.halves) : [];
    out.replaceChildren(
        element('span', {class: 'place'}, placeText(viewer)),
        ...shown.map((picture) => element('span', {}, pixelText(viewer, picture))));
  });
  return out;
}

function slider(label, attributes, changed) {
  const input =
      element('input', {type: 'range', 'aria-label': label, ...attributes, oninput: () => changed(Number(input.value))});
  return input;
}

function exposureControl(viewer) {
  const input = slider('Exposure in stops', {min: -10, max: 10, step: 0.1, class: 'exposure'}, (stops) => viewer.set({stops}));
  const value = element('output', {});
  viewer.listeners.push(() => {
    input.value = viewer.stops;
    value.textContent = `${viewer.stops > 0 ? '+' : ''}${viewer.stops.toFixed(1)} EV`;
  });
  return element('label', {class: 'control'}, element('span', {}, 'Exposure'), input, value);
}

function zoomButtons(viewer) {
  const value = element('output', {});
  viewer.listeners.push(() => {
    value.textContent = `${formatNumber(100 * viewer.view.scale)} %`;
  });
  const button = (label, text, action) =>
      element('button', {type: 'button', 'aria-label': label, title: label, onclick: action}, text);
  const actual = () => zoom(viewer, 1 / viewer.view.scale);
  return element(
      'div', {class: 'control zoom'}, button('Zoom out', '−', () => zoom(viewer, Math.SQRT1_2)),
      button('Zoom in', '+', () => zoom(viewer, Math.SQRT2)), button('Fit into the window', 'Fit', () => fitView(viewer)),
      button('One to one', '1:1', actual), value);
}

const KEY_HELP = [
  ['0', 'reference'], ['1–9', 'pictures'], ['x', 'back to the last'], ['w', 'wipe'], ['e', 'error'], ['[ ]', 'exposure'],
  ['\\', 'reset it'], ['+ −', 'zoom (or wheel, pinch)'], ['f', 'fit'], ['arrows', 'move, or the line of the wipe']
];

function keyHelp(viewer) {
  const keys = KEY_HELP.filter(([key]) => viewer.reference || !['0', 'e'].includes(key));
  return element('p', {class: 'keys'}, keys.map(([key, does]) => element('span', {}, element('kbd', {}, key), ` ${does}`)));
}

function viewerControls(viewer) {
  const choices = [['picture', 'Picture'], ['wipe', 'Wipe A|B'], ...(viewer.reference ? [['error', 'Error']] : [])];
  const modes = segmented('What is shown', choices, (mode) => viewer.set({mode}));
  const ofErrors = errorLegend(), ofSamples = sampleLegend();
  viewer.listeners.push(() => {
    modes.press(viewer.mode);
    const {kind} = viewer.current;
    ofErrors.hidden = kind === 'samples' || (viewer.mode !== 'error' && kind !== 'error');
    ofSamples.hidden = kind !== 'samples';
  });
  return element(
      'div', {class: 'controls'}, modes.group, exposureControl(viewer), zoomButtons(viewer), wipeControl(viewer), ofErrors,
      ofSamples, keyHelp(viewer));
}
