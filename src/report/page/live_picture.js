// A picture of a render that goes on, asked for anew when there is a later one.

/** Planes of half floats, low byte first; one plane is shown as grey. */
function planesOfHalves(buffer, pixels) {
  const view = new DataView(buffer), halves = new Uint16Array(3 * pixels), own = view.byteLength / 2;
  for (let i = 0; i < own; ++i) halves[i] = view.getUint16(2 * i, true);
  for (let i = own; i < halves.length; i += own) halves.copyWithin(i, 0, own);
  return halves;
}

/** As the viewer takes them. The old picture stays until a later one is there. */
class LivePicture {
  constructor({name, kind, planes, x, y, width, height}) {
    Object.assign(this, {name, kind, planes, x, y, width, height, halves: null, url: null, loading: null});
  }

  isOfSize({width, height}) { return this.width === width && this.height === height; }
  isLike(other) { return this.name === other.name && this.planes === other.planes && this.isOfSize(other); }

  /** There is a later one at `url`. */
  renew(url) {
    this.url = url;
    this.loading = null;
  }

  /** Resolves to whether what is shown is the latest. */
  load() {
    if (!this.url) return Promise.resolve(false);
    this.loading ??= this.fetch(this.url);
    return this.loading;
  }

  async fetch(url) {
    try {
      const answer = await fetch(url), buffer = answer.ok ? await answer.arrayBuffer() : null;
      const pixels = this.width * this.height;
      if (url !== this.url) return false;
      if (buffer?.byteLength !== 2 * this.planes * pixels) return this.miss();
      this.halves = planesOfHalves(buffer, pixels);
      this.changed?.();
      return true;
    } catch {
      return this.miss();
    }
  }

  /** There is a later one, too much is asked for at once, or the program is gone. */
  miss() {
    this.loading = null;
    return false;
  }

  /** [R, G, B], linear, at pixel x, y. */
  color(x, y) {
    const pixels = this.width * this.height, i = y * this.width + x;
    return [0, 1, 2].map((k) => HALF_TO_FLOAT[this.halves[k * pixels + i]]);
  }
}
