"""Convergence of the media strategies on a scene, as a plot: relMSE against samples and against seconds.

    python3 docs/python/media_strategies.py volumes/plume_hall/plume_hall.pbrt --spp 64 --resolution 160x90 -o strategies.png
"""

import argparse

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

import tyndall

STRATEGIES = ("vertex", "closest", "integral", "product")


def plot(comparison, path):
    figure, both = plt.subplots(1, 2, figsize=(10, 4), sharey=True, layout="constrained")
    for axes, quantity in zip(both, ("samples", "seconds")):
        for name in comparison.methods:
            curve = comparison.curve(name)
            x = [point[quantity] for point in curve]
            axes.plot(x, [point["relmse"] for point in curve], marker=".", label=name)
            axes.fill_between(x, [point["relmse_low"] for point in curve], [point["relmse_high"] for point in curve], alpha=0.15)
        axes.set(xscale="log", yscale="log", xlabel="samples a pixel" if quantity == "samples" else "seconds")
        axes.grid(alpha=0.3)
    both[0].set_ylabel("relMSE")
    both[1].legend()
    figure.savefig(path, dpi=120)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scene")
    parser.add_argument("--spp", type=int, default=64)
    parser.add_argument("--seeds", type=int, default=5)
    parser.add_argument("--resolution", default="160x90")
    parser.add_argument("--reference-error", type=float, default=1e-3)
    parser.add_argument("-o", "--output", default="strategies.png")
    options = parser.parse_args()

    scene = tyndall.load(options.scene)
    scene.resolution = map(int, options.resolution.split("x"))
    comparison = scene.compare({name: {"media": name} for name in STRATEGIES}, spp=options.spp, seeds=options.seeds,
                               reference_error=options.reference_error,
                               progress=lambda fraction: print(f"{100 * fraction:3.0f} %", end="\r", flush=True))
    plot(comparison, options.output)
    print(comparison["verdict"])


if __name__ == "__main__":
    main()
