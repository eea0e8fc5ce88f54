"""Writes built-in scenes for Mitsuba 3, with indirect light: a box, and a room lit by a sky through portals.

    python paths.py --halflight target/release/halflight FOLDER

What Mitsuba does not have is made into what it has: the sky's sun is left out, and Phong surfaces are matte.
"""

import argparse
import os
import re
import subprocess

SCENES = {"cornell": (256, 256), "gallery": (320, 240)}


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--halflight", required=True, help="the program")
    parser.add_argument("--max-depth", type=int, default=8, help="segments between camera and light; -1: any number")
    parser.add_argument("folder", help="where the scenes go")
    return parser.parse_args()


def resized(text, size):
    for name, pixels in zip(("width", "height"), size):
        text = re.sub(rf'(<integer name="{name}" value=)"\d+"', rf'\1"{pixels}"', text, count=1)
    return text


def main():
    options = arguments()
    os.makedirs(options.folder, exist_ok=True)
    path = f'<integrator type="path"><integer name="max_depth" value="{options.max_depth}"/></integrator>'
    for name, size in SCENES.items():
        file = os.path.join(options.folder, f"{name}.xml")
        subprocess.run([options.halflight, "export", name, "-o", file], check=True)
        with open(file, encoding="utf-8") as scene:
            text = scene.read()
        text = text.replace('<integrator type="direct"/>', path)
        phong = r'<bsdf type="phong">\s*<rgb name="diffuse_(reflectance" value=".*?"/>).*?</bsdf>'
        text = re.sub(phong, r'<bsdf type="diffuse"><rgb name="\1</bsdf>', text, flags=re.DOTALL)
        text = re.sub(r'<emitter type="directional">.*?</emitter>', "", text, flags=re.DOTALL)
        with open(file, "w", encoding="utf-8") as scene:
            scene.write(resized(text, size))


if __name__ == "__main__":
    main()
