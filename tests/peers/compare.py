"""Renders the same scenes with halflight and with Mitsuba 3 and compares them with a reference.

    python compare.py --halflight target/release/halflight --scenes FOLDER --references FOLDER

For each scene, of SEEDS independent pictures by each program:

  relMSE       mean((I - R)^2 / (R^2 + 0.01)) over pixels and channels, averaged over the pictures
  mean ratio   mean of all pixels over that of the reference: 1 unless something is biased
  worst |z|    largest difference of a block of 8 x 8 pixels to the reference, in standard errors
               of that difference, as measured from the spread among the pictures
  beyond 4     blocks with |z| > 4; of 1200 blocks chance leaves 0.08
  CPU s        user and system time; for halflight of the whole process, reading the scene and
               building the tree included, for Mitsuba of rendering alone, after a warm-up
  efficiency   1 / (relMSE * CPU s), and halflight's over Mitsuba's
"""

import argparse
import json
import os
import re
import resource
import subprocess
import sys
import tempfile

import numpy as np

BLOCK = 8


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--halflight", required=True, help="the program")
    parser.add_argument("--scenes", required=True, help="folder of scenes, as gen.py writes it")
    parser.add_argument("--references", required=True, help="folder of converged EXR files; missing ones are made")
    parser.add_argument("--scene", action="append", help="only this one (may be repeated)")
    parser.add_argument("--spp", type=int, default=64, help="samples per pixel of each picture")
    parser.add_argument("--seeds", type=int, default=8, help="pictures by each program")
    parser.add_argument("--reference-spp", type=int, default=4096, help="samples per pixel of the references")
    parser.add_argument("--variant", default="llvm_ad_rgb", help="Mitsuba's variant")
    parser.add_argument("--sampler", default="multijitter", help="Mitsuba's sampler")
    parser.add_argument("--flag", action="append", default=[], help="passed on to halflight (may be repeated)")
    parser.add_argument("--json", action="store_true", help="one JSON object per line instead of a table")
    return parser.parse_args()


def cpu_seconds(who):
    usage = resource.getrusage(who)
    return usage.ru_utime + usage.ru_stime


def read_exr(mitsuba, path):
    bitmap = mitsuba.Bitmap(path).convert(mitsuba.Bitmap.PixelFormat.RGB, mitsuba.Struct.Type.Float32, False)
    return np.array(bitmap, dtype=np.float64)


def rounding_step(mitsuba, path):
    """Largest relative error of the numbers in a file."""
    half = mitsuba.Bitmap(path).component_format() == mitsuba.Struct.Type.Float16
    return 2.0**-11 if half else 2.0**-24


def with_halflight(options, mitsuba, scene, seed):
    with tempfile.TemporaryDirectory() as folder:
        out = os.path.join(folder, "out.exr")
        command = [options.halflight, "render", scene, "--seed", str(seed), "-o", out]
        command += ["--spp", str(options.spp)] if options.spp else []
        start = cpu_seconds(resource.RUSAGE_CHILDREN)
        done = subprocess.run(command + options.flag, capture_output=True, text=True, check=False)
        seconds = cpu_seconds(resource.RUSAGE_CHILDREN) - start
        if done.returncode != 0:
            raise RuntimeError(f"{' '.join(command)}: {done.stderr.strip()}")
        return read_exr(mitsuba, out), seconds


class Mitsuba:
    """A scene in Mitsuba."""

    # The product of several passes is one picture: a single one of 4096 spp takes too much memory.
    LARGEST_PASS = 256

    def __init__(self, mitsuba, options, scene, technique):
        self.mitsuba = mitsuba
        with open(scene, encoding="utf-8") as file:
            text = file.read()
        text = text.replace('type="independent"', f'type="{options.sampler}"')
        # An extension of halflight's: to Mitsuba portals would be walls.
        portal = r'<shape(?:(?!</shape>).)*<emitter type="portal"\s*(?:/|>\s*</emitter)>\s*</shape>'
        text = re.sub(portal, "", text, flags=re.DOTALL)
        if technique == "light":
            counts = '<integer name="emitter_samples" value="1"/><integer name="bsdf_samples" value="0"/>'
            text = text.replace('<integrator type="direct"/>', f'<integrator type="direct">{counts}</integrator>')
        # Beside the scene, because of the meshes that it names.
        with tempfile.NamedTemporaryFile("w", suffix=".xml", dir=os.path.dirname(scene)) as file:
            file.write(text)
            file.flush()
            self.scene = mitsuba.load_file(file.name)
        # Compilation of the kernels is not what is measured.
        self.render(min(options.spp, self.LARGEST_PASS), 999)

    def render(self, spp, seed):
        start = cpu_seconds(resource.RUSAGE_SELF)
        total, done = 0.0, 0
        while done < spp:
            step = min(self.LARGEST_PASS, spp - done)
            image = self.mitsuba.render(self.scene, spp=step, seed=seed * 1000 + done)
            total, done = total + step * np.array(image, dtype=np.float64)[:, :, :3], done + step
        return total / spp, cpu_seconds(resource.RUSAGE_SELF) - start


def relative_error(image, reference):
    return float(((image - reference) ** 2 / (reference**2 + 0.01)).mean())


def blocks(image):
    """Sums over blocks; what is left over at the right and the bottom is left out."""
    height, width = (n // BLOCK * BLOCK for n in image.shape)
    parts = image[:height, :width].reshape(height // BLOCK, BLOCK, width // BLOCK, BLOCK)
    return parts.sum(axis=(1, 3))


def pixel_variance(images):
    """Variance of one picture's pixels, of the average channel."""
    return np.var([image.mean(-1) for image in images], axis=0, ddof=1)


def block_differences(images, reference, reference_variance, rounding):
    """Differences of blocks to the reference in standard errors."""
    grey = reference.mean(-1)
    difference = blocks(np.mean([image.mean(-1) for image in images], axis=0) - grey)
    # The reference is noisy too, and rounded: where it is smooth, all pixels of a block alike.
    variance = blocks(pixel_variance(images) / len(images) + reference_variance)
    variance += (blocks(grey) * rounding) ** 2 / 3.0
    # What few samples have missed altogether has no spread; a ten-thousandth is no difference.
    variance += (blocks(grey + 0.01) * 1e-4) ** 2
    return difference / np.sqrt(variance)


def measure(results, reference, reference_variance, rounding):
    images = [image for image, _ in results]
    error = float(np.mean([relative_error(image, reference) for image in images]))
    seconds = float(np.mean([seconds for _, seconds in results]))
    z = block_differences(images, reference, reference_variance, rounding)
    worst = np.unravel_index(np.argmax(np.abs(z)), z.shape)
    return {
        "relMSE": error,
        "mean_ratio": float(np.mean(images) / reference.mean()),
        "worst_z": float(z[worst]),
        "worst_block": [int(worst[1]) * BLOCK, int(worst[0]) * BLOCK],
        "beyond_4": int((np.abs(z) > 4).sum()),
        "blocks": int(z.size),
        "cpu_seconds": seconds,
        "efficiency": 1.0 / (error * seconds),
    }


def compare(options, mitsuba, name):
    scene = os.path.abspath(os.path.join(options.scenes, f"{name}.xml"))
    with open(scene, encoding="utf-8") as file:
        has_paths = '<integrator type="path"' in file.read()
    techniques = ("mis",) if has_paths else ("mis", "light")
    peers = {technique: Mitsuba(mitsuba, options, scene, technique) for technique in techniques}
    path = os.path.join(options.references, f"{name}.exr")
    if not os.path.exists(path):
        image, _ = peers["mis"].render(options.reference_spp, 77)
        mitsuba.Bitmap(image.astype(np.float32)).write(path)
    reference, rounding = read_exr(mitsuba, path), rounding_step(mitsuba, path)

    seeds = range(1, options.seeds + 1)
    pictures = {
        f"mitsuba {technique}": [peer.render(options.spp, seed) for seed in seeds] for technique, peer in peers.items()
    }
    by_mis = [image for image, _ in pictures["mitsuba mis"]]
    reference_variance = pixel_variance(by_mis) * options.spp / options.reference_spp
    pictures["halflight"] = [with_halflight(options, mitsuba, scene, seed) for seed in seeds]

    rows = {who: measure(results, reference, reference_variance, rounding) for who, results in pictures.items()}
    best = max(row["efficiency"] for who, row in rows.items() if who != "halflight")
    for who, row in rows.items():
        yield {"scene": name, "who": who, **row, "ratio": row["efficiency"] / best}


def main():
    options = arguments()
    import mitsuba

    mitsuba.set_variant(options.variant)
    names = options.scene or sorted(f[:-4] for f in os.listdir(options.scenes) if f.endswith(".xml"))
    if not options.json:
        print("scene    program        relMSE     mean ratio  worst |z|  at         beyond 4    CPU s  efficiency  ratio")
    failed = False
    for name in names:
        try:
            for row in compare(options, mitsuba, name):
                if options.json:
                    print(json.dumps(row), flush=True)
                    continue
                at = "{:>3},{:<3}".format(*row["worst_block"])
                print(
                    f"{row['scene']:<8} {row['who']:<14} {row['relMSE']:.3e}  {row['mean_ratio']:10.6f}"
                    f"  {abs(row['worst_z']):9.2f}  {at}  {row['beyond_4']:>4} of {row['blocks']}"
                    f"  {row['cpu_seconds']:7.2f}  {row['efficiency']:10.1f}  {row['ratio']:5.2f}",
                    flush=True,
                )
        except RuntimeError as error:
            failed = True
            print(f"{name}: {error}", file=sys.stderr)
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()
