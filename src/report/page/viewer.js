// A window on pictures of one size: one at a time, two with a wipe between them, or the error against the reference.

class Viewer {
  /** `pictures`: the reference first, if there is one. `eps`: of the relative squared error. */
  constructor(pictures, eps) {
    const reference = pictures.find((picture) => picture.name === 'reference') ?? null;
    Object.assign(this, {pictures, reference, eps, mode: 'picture', stops: 0, wipe: 0.5, pixel: null});
    this.current = pictures.find((picture) => picture !== reference) ?? pictures[0];
    this.other = reference ?? pictures[0];
    this.before = this.other;
    this.view = new View(this.current.width, this.current.height);
    this.cache = new Map();
    this.listeners = [];
    this.canvas = element(
        'canvas',
        {class: 'window', tabindex: 0, role: 'img', style: `aspect-ratio: ${this.current.width} / ${this.current.height}`});
    this.divider = wipeDivider(this);
    this.root = element(
        'div', {class: 'viewer'}, pictureTabs(this), element('div', {class: 'stage'}, this.canvas, this.divider), readout(this),
        viewerControls(this));
    listenToPointer(this);
    new ResizeObserver(() => requestAnimationFrame(() => this.resize())).observe(this.canvas);
  }

  /** Changes fields of the state ("mode", "stops", ...), then draws. */
  set(change) {
    if (change.current && change.current !== this.current) this.before = this.current;
    if ('stops' in change) change.stops = Math.min(Math.max(change.stops, -10), 10);
    if ('wipe' in change) change.wipe = Math.min(Math.max(change.wipe, 0), 1);
    if (change.mode === 'wipe' && !change.other && this.current === this.other) change.other = this.before;
    if (change.mode === 'error' && !this.reference) change.mode = 'picture';
    Object.assign(this, change);
    this.update();
  }

  /** The pictures that what is shown is made of. */
  needed() {
    return [this.current, ...(this.mode === 'wipe' ? [this.other] : []), ...(this.mode === 'error' ? [this.reference] : [])];
  }

  /** Waits for the pictures it needs, draws in the next frame. */
  update() {
    this.tellListeners();
    this.ready =
        Promise.all(this.needed().map((picture) => picture.load())).then(() => requestAnimationFrame(() => this.draw()), () => {
          this.canvas.replaceWith(
              element('p', {class: 'note bad'}, 'The pictures cannot be unfolded: this needs a browser of 2023 or later.'));
        });
    return this.ready;
  }

  tellListeners() {
    Object.assign(
        this.root.dataset,
        {picture: this.current.name, mode: this.mode, stops: this.stops, wipe: this.wipe, scale: this.view.scale});
    const shown = this.mode === 'wipe' ? `${this.current.name} left, ${this.other.name} right` :
        this.mode === 'error' ? `error of ${this.current.name}` :
                                this.current.name;
    this.canvas.setAttribute('aria-label', `${shown}, exposure ${this.stops} EV, zoom ${formatNumber(this.view.scale)}`);
    this.canvas.style.touchAction = this.view.fitted ? 'pan-y' : 'none';
    for (const listener of this.listeners) listener();
  }

  resize() {
    const ratio = window.devicePixelRatio || 1, box = this.canvas.getBoundingClientRect();
    if (!box.width) return;
    this.canvas.width = Math.round(box.width * ratio);
    this.canvas.height = Math.round(box.height * ratio);
    this.view.resize(box.width, box.height);
    this.draw();  // at once: a canvas is emptied by its new size
    this.update();
  }

  /** The canvas of a picture as it is shown now, painted once for each exposure. */
  painted(picture, kind) {
    const holdsData = picture.kind !== 'light';
    const key = holdsData ? 'data' : kind === 'error' ? 'error' : this.stops, kept = this.cache.get(picture);
    if (kept?.key === key) return kept.canvas;
    const canvas = holdsData ? dataMap(picture) :
        kind === 'error'     ? errorMap(picture, this.reference, this.eps) :
                               toned(picture, toneTable(this.stops));
    this.cache.set(picture, {key, canvas});
    return canvas;
  }

  draw() {
    if (this.needed().some((picture) => !picture.halves))
      return;  // another choice was made meanwhile; it draws when it is ready
    const context = this.canvas.getContext('2d'), {view} = this, ratio = this.canvas.width / view.width;
    context.setTransform(1, 0, 0, 1, 0, 0);
    context.clearRect(0, 0, this.canvas.width, this.canvas.height);
    context.setTransform(ratio * view.scale, 0, 0, ratio * view.scale, ratio * view.left, ratio * view.top);
    context.imageSmoothingEnabled = ratio * view.scale < 1;
    if (this.mode === 'wipe')
      this.drawWipe(context);
    else
      context.drawImage(this.painted(this.current, this.mode), 0, 0);
    if (this.pixel && view.scale >= 6) {
      context.lineWidth = 1.5 / view.scale;
      context.strokeStyle = '#fff';
      context.strokeRect(this.pixel.x, this.pixel.y, 1, 1);
    }
  }

  /** Current left of the line, other right of it. The line stands at a share of the window, whatever the zoom. */
  drawWipe(context) {
    const {view} = this, line = view.toPicture(this.wipe * view.width, 0).x;
    const parts = [[this.other, line, this.current.width], [this.current, 0, line]];
    for (const [picture, from, to] of parts) {
      context.save();
      context.beginPath();
      context.rect(from, 0, Math.max(to - from, 0), picture.height);
      context.clip();
      context.drawImage(this.painted(picture, 'picture'), 0, 0);
      context.restore();
    }
  }
}
