// Where a picture lies in its window. Lengths are CSS pixels; picture coordinates are picture pixels.

class View {
  constructor(pictureWidth, pictureHeight) {
    Object.assign(this, {pictureWidth, pictureHeight, width: 1, height: 1, scale: 1, left: 0, top: 0, fitted: true});
  }

  get fitScale() { return Math.min(this.width / this.pictureWidth, this.height / this.pictureHeight); }

  resize(width, height) {
    const middle = this.toPicture(this.width / 2, this.height / 2);
    this.width = Math.max(width, 1);
    this.height = Math.max(height, 1);
    if (this.fitted) return this.fit();
    this.left = this.width / 2 - middle.x * this.scale;
    this.top = this.height / 2 - middle.y * this.scale;
    this.hold();
  }

  fit() {
    this.scale = this.fitScale;
    this.fitted = true;
    this.hold();
  }

  /** Enlarges by `factor`; what is at x, y of the window stays there. */
  zoomAt(factor, x, y) {
    const scale = Math.min(Math.max(this.scale * factor, Math.min(this.fitScale, 1) / 2), 64);
    this.left = x - (x - this.left) * (scale / this.scale);
    this.top = y - (y - this.top) * (scale / this.scale);
    this.scale = scale;
    this.fitted = false;
    this.hold();
  }

  pan(dx, dy) {
    this.left += dx;
    this.top += dy;
    this.hold();
  }

  /** A picture smaller than the window is centred; a larger one leaves no gap at its edges. */
  hold() {
    const held = (start, size, room) => (size <= room ? (room - size) / 2 : Math.min(0, Math.max(room - size, start)));
    this.left = held(this.left, this.pictureWidth * this.scale, this.width);
    this.top = held(this.top, this.pictureHeight * this.scale, this.height);
  }

  toPicture(x, y) { return {x: (x - this.left) / this.scale, y: (y - this.top) / this.scale}; }

  /** The pixel at x, y of the window, or null outside the picture. */
  pixelAt(x, y) {
    const p = this.toPicture(x, y), pixel = {x: Math.floor(p.x), y: Math.floor(p.y)};
    const inside = pixel.x >= 0 && pixel.y >= 0 && pixel.x < this.pictureWidth && pixel.y < this.pictureHeight;
    return inside ? pixel : null;
  }
}
