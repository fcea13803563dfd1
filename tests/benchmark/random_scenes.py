#!/usr/bin/env python3
"""Whether the defaults hold in scenes that nobody has looked at: random ones, error x time against other options.

Usage: random_scenes.py TYNDALL SEEDS [-- OPTIONS OF RENDER FOR ALL, such as --spp 24 --resolution 192x128]
SEEDS: of the scenes, as 1-40 or 3,17. TYNDALL: a program, or several separated by commas, to which the first is held.

A row a scene: processor time of the first program; error x time of each other program, and last of the first one's plain path
tracing with lights chosen at collisions, over that of the first: relMSE, and without the worst 0.2 % of pixels; by how many standard
errors the means of the first and of the plain renders differ; what is in the scene. The geometric means of the gains follow.
"""
import math
import os
import random
import resource
import subprocess
import sys
import tempfile

import numpy as np

from pfm import read_pfm

RENDERS = 3
EPSILON = 0.01  # of relMSE, as everywhere
PLAIN = "--media vertex --reuse off --joint off --guiding off --emission paths --budget fixed".split()


class Scene:
    """A hall or a plain with things, smoke of some kind and lights of some kind."""

    def __init__(self, seed):
        self.random = random.Random(seed * 7919 + 5)
        self.tags = []
        self.text = self.head() + "".join(f() for f in (self.walls, self.things, self.smoke, self.lights))

    def uniform(self, low, high):
        return self.random.uniform(low, high)

    def log_uniform(self, low, high):
        return math.exp(self.uniform(math.log(low), math.log(high)))

    def chance(self, p):
        return self.random.random() < p

    def rgb(self, low=0.1, high=0.9):
        return "%g %g %g" % tuple(self.uniform(low, high) for _ in range(3))

    def head(self):
        depth = self.random.choice([1, 2, 5, 8, 20, 40])
        self.tags.append(f"depth {depth}")
        pixels = self.random.choice(['"box" "float xradius" 0.5 "float yradius" 0.5', '"gaussian"'])
        lens = f' "float lensradius" {self.log_uniform(0.01, 0.15):g} "float focaldistance" {self.uniform(4, 7):g}'
        text = f'Film "rgb" "integer xresolution" 192 "integer yresolution" 128\nPixelFilter {pixels}\n'
        text += f'Integrator "volpath" "integer maxdepth" {depth}\n'
        text += f'LookAt {self.uniform(-1.5, 1.5):g} {self.uniform(0.6, 2.6):g} -6  0 {self.uniform(1, 1.6):g} 0  0 1 0\n'
        text += f'Camera "perspective" "float fov" {self.uniform(30, 60):g}{lens if self.chance(0.3) else ""}\n'
        self.outside = ""
        if self.chance(0.25):
            self.outside = "fog"
            self.tags.append("fog")
            text += medium("fog", "homogeneous", self.coefficients(self.log_uniform(0.01, 0.3), self.uniform(0.6, 0.99)),
                           self.uniform(-0.3, 0.9)) + 'MediumInterface "" "fog"\n'
        return text + "WorldBegin\n" + ('MediumInterface "fog" "fog"\n' if self.outside else "")

    def coefficients(self, sigma_t, albedo):
        tint = (1, self.uniform(0.5, 1), self.uniform(0.5, 1)) if self.chance(0.3) else (1, 1, 1)
        return [[sigma_t * part * t for t in tint] for part in (albedo, 1 - albedo)]

    def material(self):
        return self.random.choice([
            f'"diffuse" "rgb reflectance" [{self.rgb()}]', f'"diffuse" "rgb reflectance" [{self.rgb()}]',
            f'"conductor" "spectrum eta" "metal-Cu-eta" "spectrum k" "metal-Cu-k" "float roughness" {self.log_uniform(0.02, 0.6):g}',
            f'"coateddiffuse" "rgb reflectance" [{self.rgb()}] "float roughness" {self.log_uniform(0.01, 0.4):g}',
            f'"dielectric" "float eta" 1.5 "float roughness" {self.random.choice([0, self.log_uniform(0.02, 0.3)]):g}',
            f'"diffusetransmission" "rgb reflectance" [{self.rgb(0.1, 0.45)}] "rgb transmittance" [{self.rgb(0.1, 0.45)}]'])

    def walls(self):
        sides = [((-4, 0, -7), (4, 0, -7), (4, 0, 4), (-4, 0, 4))]
        if self.chance(0.6):
            sides += [((-4, 0, 4), (4, 0, 4), (4, 4, 4), (-4, 4, 4)), ((-4, 0, -7), (-4, 0, 4), (-4, 4, 4), (-4, 4, -7)),
                      ((4, 0, 4), (4, 0, -7), (4, 4, -7), (4, 4, 4)), ((-4, 4, -7), (-4, 4, 4), (4, 4, 4), (4, 4, -7))]
            sides = sides[:5 if self.chance(0.7) else 4]
        self.tags.append("hall" if len(sides) > 1 else "plain")
        return block(f'Material "diffuse" "rgb reflectance" [{self.rgb(0.2, 0.8)}]\n' + "".join(quad(s) for s in sides))

    def things(self):
        text = ""
        for _ in range(self.random.randrange(7)):
            x, z, r = self.uniform(-2.5, 2.5), self.uniform(-2, 3), self.uniform(0.15, 0.6)
            shape = f'Translate {x:g} {r + self.uniform(0, 1.5):g} {z:g}\nShape "sphere" "float radius" {r:g}\n'
            if self.chance(0.4):
                shape = box((x - r, 0, z - r), (x + r, self.uniform(0.5, 3), z + r))
            text += block(f"Material {self.material()}\n" + shape)
        return text

    def smoke(self):
        kind = self.random.choice(["puff", "puff", "puff", "two puffs", "ball", "cloud", "none"])
        sigma_t, albedo, g = self.log_uniform(0.5, 40), 1 - self.log_uniform(1e-3, 0.6), self.uniform(-0.4, 0.92)
        self.tags.append(kind if kind == "none" else f"{kind} {sigma_t:.2g} {albedo:.3f} {g:.2f}")
        inside = self.coefficients(sigma_t, albedo)
        if kind == "ball":
            skin = self.random.choice(['"interface"', '"dielectric" "float eta" 1.4'])
            return block(medium("b", "homogeneous", inside, g) + f'MediumInterface "b" "{self.outside}"\nMaterial {skin}\n'
                         f'Translate {self.uniform(-1, 1):g} 1.2 0\nShape "sphere" "float radius" {self.uniform(0.5, 1.1):g}\n')
        if kind == "cloud":
            return block("Translate -1 0.2 -1\nScale 2 2 2\n" + medium("c", "cloud", inside, g) + self.boundary("c", (0, 0, 0), (1, 1, 1)))
        places = {"puff": [0], "two puffs": [-1.3, 1.4]}.get(kind, [])
        return "".join(self.puff(f"p{i}", x, inside, g) for i, x in enumerate(places))

    def boundary(self, name, low, high):
        return f'MediumInterface "{name}" "{self.outside}"\nMaterial "interface"\n' + box(low, high)

    def puff(self, name, x, coefficients, g):
        """Blobs in a grid, thin at the edge."""
        n, blobs = 24, [[self.uniform(0.25, 0.75) for _ in range(3)] + [self.uniform(0.08, 0.25)] for _ in range(12)]
        at = (np.arange(n) + 0.5) / n
        z, y, u = np.meshgrid(at, at, at, indexing="ij")
        density = sum(np.exp(-((u - b[0]) ** 2 + (y - b[1]) ** 2 + (z - b[2]) ** 2) / (0.5 * b[3] ** 2)) for b in blobs)
        density[density < 0.05] = 0
        grid = " ".join(f"{v:.3g}" for v in density.ravel())
        fire = f' "float Lescale" [{grid}] "rgb Le" [{self.log_uniform(1, 20):g} 1 0.3]' if self.chance(0.25) else ""
        if fire:
            self.tags.append("burning")
        h = self.uniform(1.5, 3)
        return block(f"Translate {x - h / 2:g} 0.05 {-h / 2:g}\nScale {h:g} {h:g} {h:g}\n" +
                     medium(name, "uniformgrid", coefficients, g, f'"integer nx" {n} "integer ny" {n} "integer nz" {n} '
                            f'"float density" [{grid}]{fire}') + self.boundary(name, (0, 0, 0), (1, 1, 1)))

    def lights(self):
        kinds = self.random.choice([["points"], ["spots"], ["emitters"], ["sky", "sun"], ["sun"], ["sky"],
                                    ["points", "spots", "emitters"], ["emitters", "sky"]])
        self.tags.append("+".join(kinds))
        return "".join(getattr(self, k)() for k in kinds)

    def points(self):
        weights = [math.exp(1.5 * self.random.gauss(0, 1)) for _ in range(int(self.log_uniform(1, 3000)))]
        return "".join('LightSource "point" "point3 from" [%g %g %g] "rgb I" [%g %g %g]\n' %
                       (self.uniform(-3, 3), self.uniform(0.2, 3.6), self.uniform(-4, 3),
                        *[30 * w / sum(weights) * self.uniform(0.4, 1) for _ in range(3)]) for w in weights)

    def spots(self):
        n, text = int(self.log_uniform(1, 60)), ""
        for _ in range(n):
            x, z = self.uniform(-3, 3), self.uniform(-3, 3)
            text += 'LightSource "spot" "point3 from" [%g %g %g] "point3 to" [%g 0 %g] "float coneangle" %g "rgb I" [%g %g %g]\n' % (
                x, self.uniform(2, 3.8), z, x + self.uniform(-1, 1), z + self.uniform(-1, 1), self.uniform(10, 50),
                *[90 / n * self.uniform(0.4, 1) for _ in range(3)])
        return text

    def emitters(self):
        n, text = int(self.log_uniform(1, 200)), ""
        for _ in range(n):
            r = self.log_uniform(0.01, 0.2)
            L = 20 / (n * 4 * math.pi * r * r)
            text += block(f'AreaLightSource "diffuse" "rgb L" [{L:g} {0.8 * L:g} {0.6 * L:g}]\n'
                          f'Translate {self.uniform(-3, 3):g} {self.uniform(0.3, 3.6):g} {self.uniform(-3, 3):g}\n'
                          f'Shape "sphere" "float radius" {r:g}\n')
        return text

    def sun(self):
        return (f'LightSource "distant" "point3 from" [{self.uniform(-1, 1):g} {self.uniform(0.3, 1.2):g} {self.uniform(-1.3, 0.2):g}] '
                f'"point3 to" [0 0 0] "rgb L" [{self.rgb(1, 3)}]\n')

    def sky(self):
        return f'LightSource "infinite" "rgb L" [{self.rgb(0.2, 1)}]\n'


def block(text):
    return "AttributeBegin\n" + text + "AttributeEnd\n"


def quad(points):
    return 'Shape "bilinearmesh" "point3 P" [%s]\n' % "  ".join("%g %g %g" % p for p in (points[0], points[1], points[3], points[2]))


def box(low, high):
    (a, b, c), (x, y, z) = low, high
    corners = [(a, b, c), (x, b, c), (x, y, c), (a, y, c), (a, b, z), (x, b, z), (x, y, z), (a, y, z)]
    return ('Shape "trianglemesh" "point3 P" [%s] "integer indices" [0 2 1 0 3 2 4 5 6 4 6 7 0 1 5 0 5 4 3 7 6 3 6 2 0 4 7 0 7 3 1 2 6 1 6 5]\n' %
            "  ".join("%g %g %g" % p for p in corners))


def medium(name, kind, coefficients, g, more=""):
    (s, a) = (" ".join(f"{v:g}" for v in c) for c in coefficients)
    return f'MakeNamedMedium "{name}" "string type" "{kind}" "rgb sigma_s" [{s}] "rgb sigma_a" [{a}] "float g" {g:g} {more}\n'


def renders(program, scene, first_seed, options):
    """Pictures, and processor seconds of one."""
    pictures, before = [], resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "picture.pfm")
        for seed in range(first_seed, first_seed + RENDERS):
            subprocess.run([program, "render", scene, "--seed", str(seed), "--quiet", "-o", path, *options], check=True,
                           stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            pictures.append(read_pfm(path))
    return np.stack(pictures), (resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before) / RENDERS


def errors(pictures, mean):
    """relMSE, and without the worst 0.2 % of pixels; what is dark by a tenth of the mean of all."""
    each = np.sort((pictures.var(axis=0, ddof=1) / (mean**2 + EPSILON * mean.mean() ** 2)).mean(axis=2).ravel())
    return np.array([each.mean(), each[:int(len(each) * 0.998)].mean()])


def row(programs, seed, options):
    scene = Scene(seed)
    with tempfile.NamedTemporaryFile("w", suffix=".pbrt") as file:
        file.write(scene.text)
        file.flush()
        done = [renders(p, file.name, 100 * i + 1, options) for i, p in enumerate(programs)]
        done.append(renders(programs[0], file.name, 1001, options + PLAIN))
    mean = np.mean([pictures.mean(axis=0) for pictures, _ in done], axis=0)
    products = [errors(pictures, mean) * seconds for pictures, seconds in done]
    gains = [p / products[0] for p in products[1:]]
    totals = [pictures.mean(axis=(1, 2, 3)) for pictures in (done[0][0], done[-1][0])]
    off = (totals[0].mean() - totals[1].mean()) / math.sqrt(sum(t.var(ddof=1) / RENDERS for t in totals) + 1e-30)
    print(f"{seed:4} {done[0][1]:7.2f} s  " + "  ".join("%5.2f (%5.2f)" % tuple(g) for g in gains) + f" {off:6.1f}  " +
          ", ".join(scene.tags), flush=True)
    return gains


def main():
    words = sys.argv[1:]
    options = words[words.index("--") + 1:] if "--" in words else ["--spp", "24"]
    words = words[:words.index("--")] if "--" in words else words
    if len(words) != 2:
        sys.exit(__doc__)
    seeds = []
    for part in words[1].split(","):
        first, _, last = part.partition("-")
        seeds += range(int(first), int(last or first) + 1)
    gains = np.array([row(words[0].split(","), seed, options) for seed in seeds])
    print("geometric means: " + "  ".join("%.2f (%.2f)" % tuple(g) for g in np.exp(np.log(gains).mean(axis=0))))


if __name__ == "__main__":
    main()
