"""A scene made of arrays alone: smoke of numpy noise between lights on a ring, over a floor. Writes smoke.png and smoke.exr.

    python3 docs/python/smoke_from_arrays.py --spp 32 --resolution 480x270 -o smoke
"""

import argparse

import numpy as np

import tyndall


def octaves(n, seed=1):
    """Noise of n^3 voxels in [0, 1]: random values at four spacings, interpolated."""
    rng = np.random.default_rng(seed)
    total = np.zeros((n, n, n))
    for octave in range(4):
        coarse = rng.random((4 * 2**octave + 1,) * 3)
        at = np.linspace(0, coarse.shape[0] - 1, n)
        for axis in range(3):
            low = np.minimum(at.astype(int), coarse.shape[axis] - 2)
            share = (at - low).reshape([-1 if a == axis else 1 for a in range(3)])
            coarse = np.take(coarse, low, axis) * (1 - share) + np.take(coarse, low + 1, axis) * share
        total += coarse / 2**octave
    return total / total.max()


def smoke(n=64):
    """A column that widens and thins upward."""
    x, y, z = np.meshgrid(*[np.linspace(-1, 1, n)] * 3, indexing="ij")
    height = (y + 1) / 2
    column = 1 - np.hypot(x, z) / (0.25 + 0.5 * height)
    return np.maximum(column + 1.2 * (octaves(n) - 0.7), 0) * (1.2 - height)


def make_scene(width, height):
    scene = tyndall.Scene()
    scene.resolution = width, height
    scene.camera = tyndall.Camera.look_at(eye=(0, 0.4, -4), target=(0, -0.1, 0), fov=40)
    scene.add_material("floor", (0.4, 0.4, 0.42))
    corners = [(-9, -1, -9), (9, -1, -9), (9, -1, 9), (-9, -1, 9)]
    scene.add_mesh(corners, [(0, 1, 2), (0, 2, 3)], material="floor")

    scene.add_medium(tyndall.GridMedium(name="smoke", density=smoke(), bounds=((-1, -1, -1), (1, 1, 1)), sigma_s=9, sigma_a=1, g=0.3))

    angles = np.linspace(0, 2 * np.pi, 24, endpoint=False)
    hues = 0.5 + 0.5 * np.cos(angles[:, None] + np.array([0, 2, 4]))
    scene.lights = [tyndall.PointLight((1.4 * np.cos(a), -0.6, 1.4 * np.sin(a)), I=0.5 * hue) for a, hue in zip(angles, hues)]
    return scene


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--spp", type=int, default=32)
    parser.add_argument("--resolution", default="480x270")
    parser.add_argument("-o", "--output", default="smoke")
    options = parser.parse_args()

    scene = make_scene(*map(int, options.resolution.split("x")))
    image = scene.render(spp=options.spp, progress=lambda p: print(f"{100 * p.fraction:3.0f} %", end="\r", flush=True))
    image.save(options.output + ".exr")
    image.save(options.output + ".png", exposure=1)
    print(f"{options.output}.png: {image.report['samples']} samples a pixel in {image.report['seconds']:.1f} s")


if __name__ == "__main__":
    main()
