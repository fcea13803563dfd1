// The pictures of the page: unfolded when first looked at, kept as half floats.

/** The number behind each of the 65536 bit patterns of a half float (IEEE 754 binary16). */
const HALF_TO_FLOAT = Float32Array.from({length: 65536}, (_, bits) => {
  const sign = bits & 0x8000 ? -1 : 1, exponent = (bits >> 10) & 31, fraction = bits & 1023;
  if (exponent === 31) return fraction ? NaN : sign * Infinity;
  return exponent ? sign * (1 + fraction / 1024) * 2 ** (exponent - 15) : sign * fraction * 2 ** -24;
});

function bytesOfBase64(text) {
  const characters = atob(text);
  const bytes = new Uint8Array(characters.length);
  for (let i = 0; i < bytes.length; ++i) bytes[i] = characters.charCodeAt(i);
  return bytes;
}

async function inflate(bytes) {
  const stream = new DecompressionStream('deflate');
  const writer = stream.writable.getWriter();
  writer.write(bytes).then(() => writer.close()).catch(() => {});  // the reader below meets the same failure
  return new Uint8Array(await new Response(stream.readable).arrayBuffer());
}

/** Of each of three planes first all high bytes, then all low ones -> three planes of 16-bit patterns. */
function unshuffle(bytes, pixels) {
  const halves = new Uint16Array(3 * pixels);
  for (let k = 0; k < 3; ++k) {
    const high = 2 * k * pixels, low = high + pixels;
    for (let i = 0; i < pixels; ++i) halves[k * pixels + i] = (bytes[high + i] << 8) | bytes[low + i];
  }
  return halves;
}

/** One embedded picture; `halves` is null until load() is done. */
class Picture {
  constructor(script) {
    this.script = script;
    this.group = script.dataset.group;
    this.name = script.dataset.name;
    this.kind = script.dataset.kind;
    this.planes = this.kind === 'light' ? 3 : 1;
    this.x = Number(script.dataset.x);
    this.y = Number(script.dataset.y);
    this.width = Number(script.dataset.width);
    this.height = Number(script.dataset.height);
    this.halves = null;
    this.loading = null;
  }

  load() {
    this.loading ??= inflate(bytesOfBase64(this.script.textContent)).then((bytes) => {
      this.halves = unshuffle(bytes, this.width * this.height);
    });
    return this.loading;
  }

  /** [R, G, B], linear, at pixel x, y. */
  color(x, y) {
    const pixels = this.width * this.height, i = y * this.width + x;
    return [0, 1, 2].map((k) => HALF_TO_FLOAT[this.halves[k * pixels + i]]);
  }
}

/** The pictures of one group, the reference first, the others as they come. */
function picturesOf(group) {
  const all = [...document.querySelectorAll('script.picture')]
                  .map((script) => new Picture(script))
                  .filter((picture) => picture.group === group);
  const isReference = (picture) => picture.name === 'reference';
  return [...all.filter(isReference), ...all.filter((picture) => !isReference(picture))];
}
