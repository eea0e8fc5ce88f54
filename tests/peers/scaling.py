#!/usr/bin/env python3
"""How the cost of a picture grows: with triangles, lights, samples, pixels and threads.

    python scaling.py --halflight target/release/halflight --out FOLDER

Makes hilly ground of 10^3 to 10^7 triangles, and a field of 1 to 10^6 small lights above a floor; renders
them with one thread, unless threads are what is measured. Each time is the least of --repeats runs, of
which the program itself tells how long each part took. Prints tables, and draws FOLDER/scaling.svg.

  read      reading the scene's files (s; and how many MB/s)
  build     the tree, and the tables of the lights (s)
  sample    rendering, for each sample of a pixel (us)
  memory    largest resident memory of the process (MB; and bytes for each triangle beyond the first case)
"""

import argparse
import json
import os
import subprocess

import matplotlib

import gen
import numpy as np

matplotlib.use("svg")
from matplotlib import pyplot  # noqa: E402  (after the choice of what draws)


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--halflight", required=True, help="the program")
    parser.add_argument("--out", required=True, help="folder of scenes and of the plot")
    parser.add_argument("--repeats", type=int, default=3, help="runs for each measurement")
    parser.add_argument("--most", type=float, default=1e7, help="triangles")
    parser.add_argument("--most-lights", type=float, default=1e6, help="lights")
    return parser.parse_args()


# ---------------------------------------------------------------- scenes


def ground(folder, triangles):
    """Hills of about so many triangles under a rectangle of light."""
    side = max(2, round((triangles / 2) ** 0.5) + 1)

    def point(u, v):
        x, z = 16 * u - 8, 16 * v - 8
        return x, 0.35 * np.sin(1.7 * x) * np.cos(1.3 * z) + 0.12 * np.sin(7 * x + 2) * np.sin(6 * z), z

    vertices, faces = gen.surface(point, side, side)
    # Seen from above, corners go round counter-clockwise.
    gen.write_ply(os.path.join(folder, "ground.ply"), vertices, faces[:, ::-1])
    lamp = gen.shape("rectangle", gen.light(12, 11, 9), gen.facing_down(1, 0, 4.5, 0))
    return write(folder, gen.mesh("ground.ply", gen.diffuse(0.6, 0.6, 0.6)) + lamp)


def lamps(folder, count):
    """A floor under so many small triangles of light, of the same power in all."""
    random = np.random.default_rng(1)
    middle = random.uniform([-8, 1.5, -8], [8, 3, 8], (count, 3))
    corners = 0.05 * np.array([[0, 0, 0], [1, 0, 0], [0, 0, 1]])
    vertices = (middle[:, None, :] + corners).reshape(-1, 3)
    gen.write_ply(os.path.join(folder, "lamps.ply"), vertices, np.arange(3 * count).reshape(-1, 3))
    glow = 2e5 / count
    floor = gen.shape("rectangle", gen.diffuse(0.6, 0.6, 0.6), '<rotate x="1" angle="-90"/><scale value="8"/>')
    return write(folder, floor + gen.mesh("lamps.ply", gen.light(glow, glow, glow)))


def write(folder, body):
    path = os.path.join(folder, "scaling.xml")
    with open(path, "w", encoding="utf-8") as file:
        file.write(gen.head("0, 5, 11", "0, 0, 0") + body + "</scene>\n")
    return path


# ---------------------------------------------------------------- measuring


class Program:
    def __init__(self, options):
        self.options = options

    def once(self, scene, flags):
        """What the program says of one run, and the largest memory of its process (bytes)."""
        out = os.path.join(self.options.out, "scaling.exr")
        command = [self.options.halflight, "render", scene, "-o", out, "--json", "--quiet", *map(str, flags)]
        with subprocess.Popen(command, stdout=subprocess.PIPE) as process:
            said = process.stdout.read()
            _, status, usage = os.wait4(process.pid, 0)
            process.returncode = os.waitstatus_to_exitcode(status)
        if process.returncode != 0:
            raise SystemExit(f"failed: {' '.join(command)}")
        return json.loads(said), usage.ru_maxrss * 1024

    def measure(self, scene, width=320, spp=8, threads=1):
        flags = ["--width", width, "--height", width * 3 // 4, "--spp", spp, "--threads", threads]
        runs = [self.once(scene, flags) for _ in range(self.options.repeats)]
        least = lambda part: min(report["seconds"][part] for report, _ in runs)
        report = runs[0][0]
        return {
            "triangles": report["triangles"],
            "lights": report["lights"],
            "samples": report["samples"],
            "load": least("load"),
            "build": least("build"),
            "render": least("render"),
            "memory": min(memory for _, memory in runs),
        }


def decades(most):
    return [10**k for k in range(3, 10) if 10**k <= most]


def of_triangles(program, options):
    print(f"{'triangles':>10} {'read s':>8} {'MB/s':>6} {'build s':>8} {'sample us':>10} {'memory MB':>10} {'B/triangle':>11}")
    rows, first = [], None
    for count in decades(options.most):
        row = program.measure(ground(options.out, count))
        first = first or row
        size = os.path.getsize(os.path.join(options.out, "ground.ply"))
        more = row["triangles"] - first["triangles"]
        each = f"{(row['memory'] - first['memory']) / more:11.0f}" if more else ""
        print(
            f"{row['triangles']:10} {row['load']:8.3f} {size / row['load'] / 1e6:6.0f} {row['build']:8.3f}"
            f" {micro(row):10.3f} {row['memory'] / 1e6:10.0f} {each}",
            flush=True,
        )
        rows.append((row["triangles"], micro(row), row["build"]))
    return rows


def of_lights(program, options):
    print(f"\n{'lights':>10} {'build s':>8} {'sample us':>10}")
    rows = []
    for count in [1, 10, 100, *decades(options.most_lights)]:
        row = program.measure(lamps(options.out, count))
        print(f"{row['lights']:10} {row['build']:8.3f} {micro(row):10.3f}", flush=True)
        rows.append((row["lights"], micro(row), row["build"]))
    return rows


def of_samples(program, options):
    scene = ground(options.out, 100_000)
    print(f"\n{'spp':>10} {'pixels':>10} {'threads':>8} {'render s':>9} {'sample us':>10}")
    rows = []
    cases = [(320, 4**k, 1) for k in range(6)] + [(80 * 2**k, 4, 1) for k in range(6)] + [(640, 16, t) for t in (1, 2)]
    for width, spp, threads in cases:
        row = program.measure(scene, width, spp, threads)
        pixels = row["samples"] // spp
        print(f"{spp:10} {pixels:10} {threads:8} {row['render']:9.3f} {micro(row):10.3f}", flush=True)
        rows.append((row["samples"], micro(row), threads))
    return rows


def micro(row):
    """Microseconds for each sample."""
    return 1e6 * row["render"] / row["samples"]


# ---------------------------------------------------------------- drawing


def draw(path, triangles, lights, samples):
    figure, panels = pyplot.subplots(1, 3, figsize=(10.5, 3.4), layout="constrained")
    for panel, rows, label in zip(panels, (triangles, lights), ("triangles", "lights")):
        x, each, build = zip(*rows)
        panel.loglog(x, each, "o-", label="a sample (µs)")
        panel.loglog(x, build, "s--", color="0.5", label="building (s)")
        panel.set_xlabel(label)
        panel.legend(frameon=False)
    x, each, _ = zip(*sorted(row for row in samples if row[2] == 1))
    panels[2].loglog(x, each, "o", label="a sample (µs)")
    panels[2].set_xlabel("samples of the picture")
    panels[2].set_ylim(0.1, 10)
    panels[2].legend(frameon=False)
    for panel in panels:
        panel.grid(alpha=0.3)
        panel.spines[["top", "right"]].set_visible(False)
    figure.savefig(path)


def main():
    options = arguments()
    os.makedirs(options.out, exist_ok=True)
    program = Program(options)
    rows = [part(program, options) for part in (of_triangles, of_lights, of_samples)]
    draw(os.path.join(options.out, "scaling.svg"), *rows)


if __name__ == "__main__":
    main()
