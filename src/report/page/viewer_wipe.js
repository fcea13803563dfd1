// The line of a wipe: keys move it where it has the focus; drags of it come from the canvas below (viewer_input.js).

const WIPE_KEYS = {
  ArrowLeft: -0.01,
  ArrowDown: -0.01,
  ArrowRight: 0.01,
  ArrowUp: 0.01,
  PageDown: -0.1,
  PageUp: 0.1,
  Home: -1,
  End: 1
};

/** Whether x of the window is on the line; a finger is broad. */
function isOnLine(viewer, x) { return viewer.mode === 'wipe' && Math.abs(x - viewer.wipe * viewer.view.width) < 20; }

function moveWipe(viewer, event) {
  const step = WIPE_KEYS[event.key];
  if (step === undefined || event.ctrlKey || event.metaKey || event.altKey) return;
  event.preventDefault();
  viewer.set({wipe: viewer.wipe + step * (event.shiftKey ? 10 : 1)});
}

/** A line with a grip, and the names of what stands left and right of it. */
function wipeDivider(viewer) {
  const [left, right] = ['left', 'right'].map((side) => element('span', {class: `side ${side}`}));
  const divider = element(
      'div', {
        class: 'divider',
        role: 'slider',
        tabindex: 0,
        'aria-label': 'Line of the wipe',
        'aria-orientation': 'horizontal',
        'aria-valuemin': 0,
        'aria-valuemax': 100,
        onkeydown: (event) => moveWipe(viewer, event)
      },
      element('span', {class: 'grip', 'aria-hidden': 'true'}), left, right);
  viewer.listeners.push(() => {
    const percent = Math.round(100 * viewer.wipe);
    divider.hidden = viewer.mode !== 'wipe';
    divider.style.left = `${100 * viewer.wipe}%`;
    divider.setAttribute('aria-valuenow', percent);
    divider.setAttribute('aria-valuetext', `${percent} %, ${viewer.current.name} left, ${viewer.other.name} right`);
    left.textContent = viewer.current.name;
    right.textContent = viewer.other.name;
  });
  return divider;
}

/** Which two pictures, of all that the viewer has. */
function wipeControl(viewer) {
  const choice = (side, field) => {
    const select = element(
        'select',
        {'aria-label': `Picture on the ${side}`, onchange: () => viewer.set({[field]: viewer.pictures[select.value]})},
        viewer.pictures.map((picture, i) => element('option', {value: i}, picture.name)));
    viewer.listeners.push(() => {
      select.value = viewer.pictures.indexOf(viewer[field]);
    });
    return select;
  };
  const swap = element(
      'button', {
        type: 'button',
        'aria-label': 'Swap the sides',
        title: 'Swap the sides',
        onclick: () => viewer.set({current: viewer.other, other: viewer.current})
      },
      '⇄');
  const row = element(
      'div', {class: 'control wipe'}, element('span', {}, 'Left'), choice('left', 'current'), swap, choice('right', 'other'),
      element('span', {}, 'right'));
  viewer.listeners.push(() => {
    row.hidden = viewer.mode !== 'wipe';
  });
  return row;
}
