"""CPU time until the error of a picture is what one wants: halflight beside Mitsuba 3.

    python time_to.py --halflight target/release/halflight --scenes FOLDER --references FOLDER

For each scene and each error (relMSE, mean((I - R)^2 / (R^2 + 0.01)) over pixels and channels), the CPU seconds
of each program, interpolated on log-log scales between the two measurements around that error:

  halflight   --error, which puts samples where they are needed; of the whole process, reading the scene and
              building the tree included, and in brackets without what `--spp 1` takes
  mitsuba     samples per pixel doubled until the error is reached; of rendering alone, after a warm-up; the
              better of direct lighting by MIS and by light samples, with each of the samplers

References are rendered by halflight, with another seed and a tenth of the least relMSE, unless
FOLDER/NAME.own.exr is there.
"""

import argparse
import json
import math
import os
import subprocess
import sys

import numpy as np

import compare


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--halflight", required=True, help="the program")
    parser.add_argument("--scenes", required=True, help="folder of scenes, as gen.py writes it")
    parser.add_argument("--references", required=True, help="folder of converged pictures; missing ones are made")
    parser.add_argument("--scene", action="append", help="only this one (may be repeated)")
    parser.add_argument("--error", action="append", type=float, help="relMSE (may be repeated; 1e-4 and 1e-5)")
    parser.add_argument("--seeds", type=int, default=3, help="pictures for each measurement")
    parser.add_argument("--most", type=float, default=300.0, help="no picture that takes more CPU seconds")
    parser.add_argument("--variant", default="llvm_ad_rgb", help="Mitsuba's variant")
    parser.add_argument("--sampler", action="append", help="Mitsuba's (may be repeated; multijitter and ldsampler)")
    return parser.parse_args()


def reference(options, mitsuba, name, scene):
    path = os.path.join(options.references, f"{name}.own.exr")
    if not os.path.exists(path):
        percent = 100 * math.sqrt(0.1 * min(options.error))
        command = [options.halflight, "render", scene, "--error", f"{percent}", "--seed", "987654", "-o", path]
        subprocess.run(command + ["--max-spp", "1048576"], check=True, capture_output=True)
    return compare.read_exr(mitsuba, path)


class Halflight:
    """Pictures of a chosen error."""

    def __init__(self, options, mitsuba, scene):
        self.options, self.mitsuba, self.scene = options, mitsuba, scene
        options.flag, options.spp = [], 1
        self.start = compare.with_halflight(options, mitsuba, scene, 1)[1]

    def render(self, error, seed):
        self.options.flag = ["--error", f"{100 * math.sqrt(error)}"]
        self.options.spp = None
        return compare.with_halflight(self.options, self.mitsuba, self.scene, seed)

    def measurements(self, goal, picture):
        """Errors asked for around the goal, until one is below it and one above."""
        asked, found = goal, []
        for _ in range(6):
            found.append(measure(lambda seed: self.render(asked, seed), self.options.seeds, picture))
            if min(e for e, _ in found) <= goal <= max(e for e, _ in found):
                break
            asked *= 0.5 if found[-1][0] > goal else 2.0
        return found


class Mitsuba:
    """One technique with one sampler."""

    def __init__(self, options, mitsuba, scene, technique, sampler):
        options.sampler, options.spp = sampler, 16
        self.options = options
        self.peer = compare.Mitsuba(mitsuba, options, scene, technique)

    def measurements(self, goal, picture):
        spp, found = 16, []
        while True:
            found.append(measure(lambda seed: self.peer.render(spp, seed), self.options.seeds, picture))
            if found[-1][0] <= goal or 2 * found[-1][1] > self.options.most:
                return found
            spp *= 2


def measure(render, seeds, picture):
    """Mean relMSE and CPU seconds."""
    results = [render(seed) for seed in range(1, seeds + 1)]
    error = np.mean([compare.relative_error(image, picture) for image, _ in results])
    return float(error), float(np.mean([seconds for _, seconds in results]))


def seconds_to(goal, found, start=0.0):
    """Interpolated between the measurements around the goal; beyond the last, as if relMSE fell as 1/time."""
    found = sorted(found)
    above = [f for f in found if f[0] >= goal]
    below = [f for f in found if f[0] < goal]
    if above and below:
        (e0, t0), (e1, t1) = above[0], below[-1]
        t0, t1 = max(t0 - start, 1e-3), max(t1 - start, 1e-3)
        return math.exp(np.interp(math.log(goal), [math.log(e1), math.log(e0)], [math.log(t1), math.log(t0)])), ""
    error, seconds = above[0] if above else below[-1]
    return (seconds - start) * error / goal, " extrapolated"


def compare_scene(options, mitsuba, name):
    scene = os.path.abspath(os.path.join(options.scenes, f"{name}.xml"))
    picture = reference(options, mitsuba, name, scene)
    own = Halflight(options, mitsuba, scene)
    peers = {
        f"{technique}, {sampler}": Mitsuba(options, mitsuba, scene, technique, sampler)
        for technique in ("mis", "light")
        for sampler in options.sampler_names
    }
    for goal in options.error:
        found = own.measurements(goal, picture)
        whole, remark = seconds_to(goal, found)
        rendering, _ = seconds_to(goal, found, own.start)
        best, who = min((seconds_to(goal, peer.measurements(goal, picture)), who) for who, peer in peers.items())
        yield {
            "scene": name,
            "relMSE": goal,
            "halflight": whole,
            "rendering": rendering,
            "remark": remark.strip(),
            "mitsuba": best[0],
            "configuration": who + best[1],
            "ratio": best[0] / whole,
            "ratio_rendering": best[0] / rendering,
        }


def main():
    options = arguments()
    options.error = options.error or [1e-4, 1e-5]
    options.sampler_names = options.sampler or ["multijitter", "ldsampler"]
    import mitsuba

    mitsuba.set_variant(options.variant)
    # Counts that a sampler rounds are rounded for all.
    mitsuba.set_log_level(mitsuba.LogLevel.Error)
    names = options.scene or sorted(f[:-4] for f in os.listdir(options.scenes) if f.endswith(".xml"))
    print("scene    relMSE   halflight (rendering)  mitsuba CPU s  ratio (rendering)  Mitsuba's configuration")
    for name in names:
        for row in compare_scene(options, mitsuba, name):
            print(
                f"{row['scene']:<8} {row['relMSE']:.0e}  {row['halflight']:9.2f} ({row['rendering']:9.2f})"
                f"  {row['mitsuba']:13.2f}  {row['ratio']:5.2f} ({row['ratio_rendering']:9.2f})"
                f"  {row['configuration']} {row['remark']}",
                flush=True,
            )
            print(json.dumps(row), file=sys.stderr, flush=True)


if __name__ == "__main__":
    main()
