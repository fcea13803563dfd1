#!/usr/bin/env python3
"""Condense independent renders NAME.1.exr .. NAME.n.exr of one scene into the reference NAME.exr that the test reads.

    make_reference.py FOLDER_OF_RENDERS OUTPUT_FOLDER

A pixel of NAME.exr is a block of 8x8 pixels: R G B is its mean over all renders, Variance.* the variance of that mean
(the sum over the block's pixels of the variance between the n renders, / n / 64^2), Dof.* the degrees of freedom of
that variance: n - 1 a pixel where the pixels are alike, fewer where few of them hold most of the variance. Uses Python's standard library
only, so it reads just what pbrt writes here: float RGB scanlines, ZIP or uncompressed.
"""
import pathlib
import re
import struct
import sys
import zlib

BLOCK = 8


def read_exr(path):
    """{channel: row-major list} and the size of a float scanline image."""
    data = path.read_bytes()
    assert data[:8] == struct.pack("<II", 20000630, 2), f"{path}: not a plain scanline EXR"
    attributes, at = {}, 8
    while data[at]:
        name, kind = (data[at:].split(b"\0", 2))[:2]
        at += len(name) + len(kind) + 2
        (size,) = struct.unpack_from("<I", data, at)
        attributes[name.decode()] = data[at + 4:at + 4 + size]
        at += 4 + size
    names, channels = [], attributes["channels"]
    while channels[0]:
        name, rest = channels.split(b"\0", 1)
        assert struct.unpack_from("<I", rest)[0] == 2, f"{path}: channel {name} is not float"
        names.append(name.decode())
        channels = rest[16:]
    x0, y0, x1, y1 = struct.unpack("<4i", attributes["dataWindow"])
    width, height = x1 - x0 + 1, y1 - y0 + 1
    compression = attributes["compression"][0]
    rows_a_chunk = {0: 1, 2: 1, 3: 16}[compression]
    chunks = (height + rows_a_chunk - 1) // rows_a_chunk
    planes = {name: [0.0] * (width * height) for name in names}
    for offset in struct.unpack_from(f"<{chunks}Q", data, at + 1):
        y, size = struct.unpack_from("<iI", data, offset)
        raw = data[offset + 8:offset + 8 + size]
        rows = min(rows_a_chunk, y1 + 1 - y)
        if compression and size < rows * width * 4 * len(names):
            raw = unzip(raw)
        values = struct.unpack(f"<{len(raw) // 4}f", raw)
        for row in range(rows):
            for k, name in enumerate(names):
                start = (row * len(names) + k) * width
                planes[name][(y - y0 + row) * width:(y - y0 + row + 1) * width] = values[start:start + width]
    return planes, width, height


def unzip(raw):
    """OpenEXR's ZIP: deflate, then differences of bytes, then even and odd bytes apart."""
    b = bytearray(zlib.decompress(raw))
    for i in range(1, len(b)):
        b[i] = (b[i - 1] + b[i] - 128) & 255
    half = (len(b) + 1) // 2
    out = bytearray(len(b))
    out[0::2], out[1::2] = b[:half], b[half:]
    return bytes(out)


def write_exr(path, planes, width, height):
    """Uncompressed float scanlines."""
    def attribute(name, kind, value):
        return name.encode() + b"\0" + kind.encode() + b"\0" + struct.pack("<I", len(value)) + value

    names = sorted(planes)
    channels = b"".join(n.encode() + b"\0" + struct.pack("<IIii", 2, 0, 1, 1) for n in names) + b"\0"
    window = struct.pack("<4i", 0, 0, width - 1, height - 1)
    header = (struct.pack("<II", 20000630, 2) + attribute("channels", "chlist", channels) +
              attribute("compression", "compression", b"\0") + attribute("dataWindow", "box2i", window) +
              attribute("displayWindow", "box2i", window) + attribute("lineOrder", "lineOrder", b"\0") +
              attribute("pixelAspectRatio", "float", struct.pack("<f", 1)) +
              attribute("screenWindowCenter", "v2f", struct.pack("<2f", 0, 0)) +
              attribute("screenWindowWidth", "float", struct.pack("<f", 1)) + b"\0")
    row_bytes = width * 4 * len(names)
    first = len(header) + 8 * height
    table = struct.pack(f"<{height}Q", *(first + y * (row_bytes + 8) for y in range(height)))
    body = b""
    for y in range(height):
        body += struct.pack("<iI", y, row_bytes)
        for n in names:
            body += struct.pack(f"<{width}f", *planes[n][y * width:(y + 1) * width])
    path.write_bytes(header + table + body)


def block_statistics(renders, pixels):
    """Mean over `pixels` and `renders`, the variance of it, and that variance's degrees of freedom."""
    n, mean, variance, spread = len(renders), 0.0, 0.0, 0.0
    for i in pixels:
        values = [r[i] for r in renders]
        m = sum(values) / n
        v = sum((x - m) ** 2 for x in values) / (n - 1) / n
        mean += m
        variance += v
        spread += v * v / (n + 1)  # E[v^2] = (1 + 2/(n-1)) V^2
    dof = variance * variance / spread - 2 if spread > 0 else len(pixels) * (n - 1)
    return mean / len(pixels), variance / len(pixels) ** 2, dof


def condense(paths):
    images = [read_exr(p) for p in paths]
    _, width, height = images[0]
    assert width % BLOCK == 0 and height % BLOCK == 0
    planes = {}
    for c in "RGB":
        renders = [planes_of[c] for planes_of, _, _ in images]
        blocks = []
        for by in range(0, height, BLOCK):
            for bx in range(0, width, BLOCK):
                pixels = [(by + y) * width + bx + x for y in range(BLOCK) for x in range(BLOCK)]
                blocks.append(block_statistics(renders, pixels))
        planes[c], planes["Variance." + c], planes["Dof." + c] = (list(p) for p in zip(*blocks))
    return planes, width // BLOCK, height // BLOCK


def main():
    source, target = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
    scenes = {}
    for path in sorted(source.glob("*.exr")):
        if match := re.fullmatch(r"(.+)\.\d+", path.stem):
            scenes.setdefault(match[1], []).append(path)
    for name, paths in scenes.items():
        write_exr(target / f"{name}.exr", *condense(paths))


if __name__ == "__main__":
    main()
