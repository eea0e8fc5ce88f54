#!/usr/bin/env python3
"""Checks what `halflight render --error` promises: true error over target, scene by scene.

The true error comes from two converged pictures A and B of other seeds, whose own noise drops out:
mean((I - A)(I - B)) = (relMSE(I, A) + relMSE(I, B) - relMSE(A, B)) / 2.

    tests/promise.py target/release/halflight -s rect.xml cornell -t 5 2 1 -n 3 -r references

Prints one line for each scene and target: the ratios, what was estimated, how many of the intervals
held the truth, samples per pixel, and the samples that a uniform picture of the same error takes
(--uniform). Exit code 1 when a ratio is outside of 0.5 to 1.1; not for one below in a picture that had
little more than the fewest samples, since it cannot have fewer.
"""

import argparse
import json
import math
import pathlib
import subprocess
import sys
import tempfile


def run(*words):
    """Runs a command; returns its JSON. A picture that missed its target is a picture too."""
    done = subprocess.run([str(w) for w in words], capture_output=True, text=True, check=False)
    if done.returncode not in (0, 1):
        sys.exit(done.stderr)
    return json.loads(done.stdout)


def is_cheap(report):
    """True where half of the samples are those that every pixel gets."""
    samples = report["samples_per_pixel"]
    return samples["mean"] < 2 * samples["min"]


def holds(error, report):
    """True when the true error is in the interval that was stated."""
    return abs(error - report["relative_error"]) <= report["relative_error_interval"]


class Check:
    def __init__(self, options):
        self.options = options
        self.scratch = pathlib.Path(tempfile.mkdtemp())

    def render(self, scene, out, *goal, seed):
        size = ["--width", self.options.width, "--height", self.options.height]
        return run(self.options.halflight, "render", scene, *size, "-o", out, "--seed", seed, *goal, "--json")

    def relmse(self, a, b):
        return run(self.options.halflight, "compare", a, b, "--json")["relmse"]

    def references(self, scene):
        """Two converged pictures and what they differ by."""
        folder = pathlib.Path(self.options.references)
        folder.mkdir(exist_ok=True)
        files = [folder / f"{pathlib.Path(scene).stem}.{name}.exr" for name in "AB"]
        for seed, file in zip((1001, 1002), files):
            if not file.exists():
                self.render(scene, file, "--spp", self.options.reference_samples, seed=seed)
        return files, self.relmse(*files)

    def true_error(self, picture, references):
        (a, b), between = references
        return math.sqrt(max(0.5 * (self.relmse(picture, a) + self.relmse(picture, b) - between), 0.0))

    def uniform_samples(self, scene, references, error):
        """Samples per pixel that a uniform picture of that error takes, between powers of two."""
        out, before = self.scratch / "uniform.exr", None
        for power in range(1, 15):
            self.render(scene, out, "--spp", 1 << power, seed=0)
            now = self.true_error(out, references)
            if now <= error:
                if before is None or not now > 0.0:
                    return 1 << power
                return 2.0 ** (power - math.log(error / now) / math.log(before / now))
            before = now
        return math.nan

    def scene(self, scene):
        references, good = self.references(scene), True
        for target in self.options.targets:
            out, rows = self.scratch / "picture.exr", []
            for seed in range(self.options.seeds):
                goal = ["--error", target, "--adaptive", self.options.adaptive]
                report = self.render(scene, out, *goal, seed=seed)
                rows.append((100 * self.true_error(out, references) / target, report))
            ratios = [ratio for ratio, _ in rows]
            good &= all(ratio <= 1.1 and (ratio >= 0.5 or is_cheap(report)) for ratio, report in rows)
            held = sum(holds(ratio * target / 100, report) for ratio, report in rows)
            mean = lambda key: sum(key(report) for _, report in rows) / len(rows)
            samples = mean(lambda r: r["samples_per_pixel"]["mean"])
            estimated = mean(lambda r: 100 * r["relative_error"] / target)
            line = f"{pathlib.Path(scene).stem:12} {target:4g} %  true/target " + " ".join(f"{r:.2f}" for r in ratios)
            line += f"  estimated/target {estimated:.2f}  held {held}/{len(rows)}  {samples:.1f} spp"
            if self.options.uniform:
                error = target / 100 * sum(ratios) / len(ratios)
                line += f"  uniform {self.uniform_samples(scene, references, error):.1f} spp"
            print(line, flush=True)
        return good


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("halflight")
    parser.add_argument("-s", "--scenes", nargs="+", required=True)
    parser.add_argument("-t", "--targets", nargs="+", type=float, default=[5, 2, 1, 0.5])
    parser.add_argument("-n", "--seeds", type=int, default=3)
    parser.add_argument("-r", "--references", required=True, help="folder of references; made where missing")
    parser.add_argument("--reference-samples", type=int, default=8192)
    parser.add_argument("--adaptive", choices=["on", "off"], default="on")
    parser.add_argument("--width", type=int, default=96)
    parser.add_argument("--height", type=int, default=72)
    parser.add_argument("--uniform", action="store_true", help="also find the samples of a uniform picture")
    check = Check(parser.parse_args())
    results = [check.scene(scene) for scene in check.options.scenes]
    sys.exit(0 if all(results) else 1)


if __name__ == "__main__":
    main()
