// Mouse, touch and keys of a viewer.

/** The viewer that keys go to: the one last pointed at, focused or opened. */
let activeViewer = null;

function windowPoint(viewer, event) {
  const box = viewer.canvas.getBoundingClientRect();
  return {x: event.clientX - box.left, y: event.clientY - box.top};
}

function zoom(viewer, factor, point = {
  x: viewer.view.width / 2,
  y: viewer.view.height / 2
}) {
  viewer.view.zoomAt(factor, point.x, point.y);
  viewer.update();
}

function fitView(viewer) {
  viewer.view.fit();
  viewer.update();
}

function pan(viewer, dx, dy) {
  viewer.view.pan(dx, dy);
  viewer.set({pixel: viewer.view.pixelAt(viewer.view.width / 2, viewer.view.height / 2)});
}

/** One pointer drags the picture, or the line of a wipe when it starts near it; two pinch. */
class Drag {
  constructor(viewer) {
    this.viewer = viewer;
    this.points = new Map();
    this.onLine = false;
  }

  down(event) {
    const point = windowPoint(this.viewer, event), {viewer} = this;
    this.points.set(event.pointerId, point);
    this.onLine = isOnLine(viewer, point.x);
    if (this.onLine) {
      event.preventDefault();  // the canvas would take the focus, and with it the arrow keys
      viewer.divider.focus({preventScroll: true});
    }
    if (event.isTrusted) viewer.canvas.setPointerCapture(event.pointerId);
    viewer.set({pixel: viewer.view.pixelAt(point.x, point.y)});
  }

  move(event) {
    const {viewer, points} = this, point = windowPoint(viewer, event), last = points.get(event.pointerId);
    viewer.pixel = viewer.view.pixelAt(point.x, point.y);
    if (last && points.size === 2)
      this.pinch(event.pointerId, point);
    else if (last && this.onLine)
      viewer.wipe = Math.min(Math.max(point.x / viewer.view.width, 0), 1);
    else if (last)
      viewer.view.pan(point.x - last.x, point.y - last.y);
    if (last) points.set(event.pointerId, point);
    viewer.canvas.style.cursor = isOnLine(viewer, point.x) ? 'ew-resize' : '';
    viewer.update();
  }

  pinch(id, point) {
    const still = [...this.points].find(([other]) => other !== id)[1], last = this.points.get(id);
    const distance = (p) => Math.max(Math.hypot(p.x - still.x, p.y - still.y), 1);
    this.viewer.view.zoomAt(distance(point) / distance(last), (point.x + still.x) / 2, (point.y + still.y) / 2);
  }

  up(event) { this.points.delete(event.pointerId); }
}

function listenToPointer(viewer) {
  const {canvas} = viewer, drag = new Drag(viewer);
  canvas.addEventListener('pointerdown', (event) => drag.down(event));
  canvas.addEventListener('pointermove', (event) => drag.move(event));
  for (const end of ['pointerup', 'pointercancel']) canvas.addEventListener(end, (event) => drag.up(event));
  canvas.addEventListener('pointerleave', () => viewer.set({pixel: null}));
  canvas.addEventListener('wheel', (event) => {
    event.preventDefault();
    zoom(viewer, 2 ** (-event.deltaY / (event.deltaMode ? 12 : 400)), windowPoint(viewer, event));
  }, {passive: false});
  canvas.addEventListener('dblclick', () => fitView(viewer));
  const activate = () => {
    activeViewer = viewer;
  };
  viewer.root.addEventListener('pointerenter', activate);
  viewer.root.addEventListener('focusin', activate);
}

const toggled = (viewer, mode) => viewer.set({mode: viewer.mode === mode ? 'picture' : mode});

const VIEWER_KEYS = {
  w: (viewer) => toggled(viewer, 'wipe'),
  e: (viewer) => toggled(viewer, 'error'),
  x: (viewer) => viewer.set({current: viewer.before}),
  f: fitView,
  '+': (viewer) => zoom(viewer, Math.SQRT2),
  '=': (viewer) => zoom(viewer, Math.SQRT2),
  '-': (viewer) => zoom(viewer, Math.SQRT1_2),
  '[': (viewer) => viewer.set({stops: viewer.stops - 0.5}),
  ']': (viewer) => viewer.set({stops: viewer.stops + 0.5}),
  '\\': (viewer) => viewer.set({stops: 0}),
};

const CANVAS_KEYS = {
  // only while the picture has the focus: elsewhere arrows scroll the page
  ArrowLeft: (viewer) => pan(viewer, 40, 0),
  ArrowRight: (viewer) => pan(viewer, -40, 0),
  ArrowUp: (viewer) => pan(viewer, 0, 40),
  ArrowDown: (viewer) => pan(viewer, 0, -40),
};

/** 0: the reference; 1 to 9: the others in their order. */
function pictureOfKey(viewer, key) {
  if (!/^[0-9]$/.test(key)) return null;
  if (key === '0') return viewer.reference;
  return viewer.pictures.filter((picture) => picture !== viewer.reference)[Number(key) - 1] ?? null;
}

document.addEventListener('keydown', (event) => {
  const viewer = activeViewer;
  const typing = event.target instanceof Element && event.target.matches('select, textarea, input:not([type=range])');
  if (!viewer || typing || event.ctrlKey || event.metaKey || event.altKey) return;
  const picture = pictureOfKey(viewer, event.key);
  const action = VIEWER_KEYS[event.key] ?? (event.target === viewer.canvas ? CANVAS_KEYS[event.key] : null);
  if (picture)
    viewer.set({current: picture});
  else if (action)
    action(viewer);
  if (picture || action) event.preventDefault();
});
