#!/usr/bin/env python3
"""Whether the error that a render says it has is the one it has: estimated relMSE against the variance over renders of other seeds.

Usage: error_estimates.py TYNDALL RENDERS SCENE.pbrt... [-- OPTIONS OF RENDER, such as --error 0.01 --resolution 160x90]

A row a scene: samples a pixel; estimated relMSE, its mean; the true one; their ratio; the least and the largest ratio of single
renders, each against its distance from the mean of the others; the same of the worst part of the picture, its mean estimate and
the true one; thousands of rays, and of reads of media, a render.
"""
import json
import os
import subprocess
import sys
import tempfile

import numpy as np

from pfm import read_pfm

EPSILON = 0.01  # of relMSE, as everywhere
BLOCK = 8  # pixels


def render(tyndall, scene, seed, options):
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "picture.pfm")
        command = [tyndall, "render", scene, "--seed", str(seed), "--progress", "none", "--json", "-o", path, *options]
        done = subprocess.run(command, check=True, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
        return read_pfm(path), json.loads(done.stdout)


def worst_part(errors):
    """The largest mean over a block of 8 x 8 pixels and the eight around it, weighted 4, 2 and 1, as src/session/allocation.h has it."""
    def pooled(values):
        height, width = (-(-n // BLOCK) for n in values.shape)
        padded = np.zeros((height * BLOCK, width * BLOCK))
        padded[:values.shape[0], :values.shape[1]] = values
        blocks = np.pad(padded.reshape(height, BLOCK, width, BLOCK).sum(axis=(1, 3)), 1)
        rows = blocks[:-2] + 2 * blocks[1:-1] + blocks[2:]
        return rows[:, :-2] + 2 * rows[:, 1:-1] + rows[:, 2:]
    return (pooled(errors) / pooled(np.ones_like(errors))).max()


def true_errors(pictures):
    """relMSE of the renders together, of its worst part, and of each by itself."""
    count, mean = len(pictures), pictures.mean(axis=0)
    variance = pictures.var(axis=0, ddof=1)
    # The square of the mean without its own noise.
    weight = 1 / (np.maximum(mean**2 - variance / count, 0) + EPSILON)
    # A render is count / (count - 1) times as far from the others' mean as from that of all.
    each = [((p - mean) ** 2 * weight).mean() * count / (count - 1) for p in pictures]
    errors = (variance * weight).mean(axis=2)
    return errors.mean(), worst_part(errors), np.array(each)


def row(tyndall, renders, scene, options):
    done = [render(tyndall, scene, seed, options) for seed in range(1, renders + 1)]
    true, true_worst, each = true_errors(np.stack([picture for picture, _ in done]))
    said = [summary for _, summary in done]
    estimated = np.array([s["relmse"]["estimated"] for s in said])
    worst = np.mean([s["relmse"]["worst"] for s in said])
    samples, rays, reads = (np.mean([sum(s[k] for k in keys) for s in said])
                            for keys in (["samples"], ["paths", "rays", "shadow_rays"], ["density_lookups"]))
    ratio = estimated / each
    name = os.path.splitext(os.path.basename(scene))[0]
    return (f"{name:24} {samples:7.1f} {estimated.mean():10.3e} {true:10.3e} {estimated.mean() / true:6.2f} "
            f"{ratio.min():6.2f} {ratio.max():6.2f} {worst:10.3e} {true_worst:10.3e} {rays / 1e3:9.0f} {reads / 1e3:9.0f}")


def main():
    words = sys.argv[1:]
    options = words[words.index("--") + 1:] if "--" in words else []
    words = words[:len(words) - len(options) - 1] if "--" in words else words
    if len(words) < 3 or not words[1].isdigit() or int(words[1]) < 2:
        sys.exit(__doc__)
    print(f"{'scene':24} {'spp':>7} {'estimated':>10} {'true':>10} {'ratio':>6} {'least':>6} {'most':>6} "
          f"{'worst':>10} {'true':>10} {'krays':>9} {'kreads':>9}")
    for scene in words[2:]:
        print(row(words[0], int(words[1]), scene, options), flush=True)


if __name__ == "__main__":
    main()
