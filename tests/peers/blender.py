#!/usr/bin/env python3
"""CPU time until the error of a picture is what one wants, by Cycles, with its light tree; direct light only.

    python blender.py --scenes FOLDER --references FOLDER --scene rect

Wants `bpy` (Blender as a Python module) and the references of time_to.py. For each scene and each error
(relMSE, as there), samples per pixel are doubled until the error is reached; the CPU seconds are those of
rendering alone, after a first picture of one sample has built what is kept, and interpolated on log-log
scales. Reads what gen.py writes: meshes, balls, cubes, rectangles and disks, matte or of rough metal, one sky.
Blender's z is up, Mitsuba's y.
"""

import argparse
import math
import os
import resource
import tempfile
import xml.etree.ElementTree as ElementTree

import bpy
import numpy as np
from mathutils import Matrix, Vector

Y_UP = Matrix(((1, 0, 0, 0), (0, 0, -1, 0), (0, 1, 0, 0), (0, 0, 0, 1)))


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--scenes", required=True, help="folder of scenes, as gen.py writes it")
    parser.add_argument("--references", required=True, help="folder of NAME.own.exr")
    parser.add_argument("--scene", action="append", required=True, help="its name (may be repeated)")
    parser.add_argument("--error", action="append", type=float, help="relMSE (may be repeated; 1e-4)")
    parser.add_argument("--most", type=float, default=300.0, help="no picture that takes more CPU seconds")
    parser.add_argument("--threshold", type=float, default=0.0, help="of Cycles' adaptive sampling; 0: uniform")
    return parser.parse_args()


# ---------------------------------------------------------------- reading


def numbers(text):
    return [float(word) for word in text.replace(",", " ").split()]


def colour(node):
    return numbers(node.find("rgb").get("value"))


def place(node):
    """Mitsuba's transform, for Blender's axes."""
    total = Matrix.Identity(4)
    for step in node.find("transform") if node.find("transform") is not None else ():
        x, y, z = (float(step.get(axis, step.get("value", 0 if step.tag != "scale" else 1))) for axis in "xyz")
        if step.tag == "scale":
            one = Matrix.Diagonal((x, y, z, 1))
        elif step.tag == "rotate":
            one = Matrix.Rotation(math.radians(float(step.get("angle"))), 4, Vector((x, y, z)))
        else:
            one = Matrix.Translation((x, y, z))
        total = one @ total
    return Y_UP @ total


def ball(node):
    point = node.find("point")
    centre = Y_UP @ Vector([float(point.get(axis)) for axis in "xyz"])
    return centre, float(node.find("float").get("value"))


def linked(name, data):
    thing = bpy.data.objects.new(name, data)
    bpy.context.scene.collection.objects.link(thing)
    return thing


def add_black(name, to_world, make):
    """What a lamp hides: Blender's own hide nothing, and are not there from behind."""
    make()
    thing = bpy.context.object
    thing.name, thing.matrix_world = name, to_world
    thing.data.materials.append(matte((0, 0, 0)))


def add_light(node, radiance):
    """A lamp of that radiance: Blender wants its power (W)."""
    kind, strongest = node.get("type"), max(radiance)
    lamp = bpy.data.lights.new("lamp", "POINT" if kind == "sphere" else "AREA")
    lamp.color = [channel / strongest for channel in radiance]
    thing = linked("lamp", lamp)
    if kind == "sphere":
        thing.location, radius = ball(node)
        lamp.shadow_soft_size, lamp.use_soft_falloff = radius, False
        lamp.energy = strongest * math.pi * 4 * math.pi * radius**2
        inside = Matrix.Translation(thing.location)
        add_black("ball", inside, lambda: bpy.ops.mesh.primitive_ico_sphere_add(subdivisions=5, radius=0.999 * radius))
        return
    to_world = place(node)
    width, height = (2 * to_world.col[axis].xyz.length for axis in (0, 1))
    lamp.shape, lamp.size, lamp.size_y = "RECTANGLE" if kind == "rectangle" else "ELLIPSE", width, height
    area = width * height * (1 if kind == "rectangle" else math.pi / 4)
    lamp.energy = strongest * math.pi * area
    # Blender's lamps shine along −z, Mitsuba's along +z.
    turned = to_world.to_3x3().normalized() @ Matrix.Diagonal((1, -1, -1))
    thing.matrix_world = Matrix.Translation(to_world.translation) @ turned.to_4x4()
    behind = Matrix.Translation(-1e-4 * width * to_world.col[2].xyz.normalized()) @ to_world
    if kind == "rectangle":
        add_black("back", behind, lambda: bpy.ops.mesh.primitive_plane_add(size=2))
    else:
        add_black("back", behind, lambda: bpy.ops.mesh.primitive_circle_add(vertices=256, fill_type="NGON"))


def material(bsdf):
    if bsdf.get("type") == "diffuse":
        return matte(colour(bsdf))
    made, shader = shaded("ShaderNodeBsdfAnisotropic", colour(bsdf))
    shader.distribution = "GGX"
    shader.inputs["Roughness"].default_value = math.sqrt(float(bsdf.find("float").get("value")))
    return made


def matte(reflectance):
    return shaded("ShaderNodeBsdfDiffuse", reflectance)[0]


def shaded(kind, reflectance):
    """A material of one BSDF, and that."""
    made = bpy.data.materials.new("material")
    made.use_nodes = True
    nodes = made.node_tree.nodes
    nodes.clear()
    shader = nodes.new(kind)
    shader.inputs["Color"].default_value = (*reflectance, 1)
    made.node_tree.links.new(shader.outputs[0], nodes.new("ShaderNodeOutputMaterial").inputs["Surface"])
    return made, shader


def add_surface(node, folder):
    kind = node.get("type")
    if kind == "sphere":
        centre, radius = ball(node)
        bpy.ops.mesh.primitive_ico_sphere_add(subdivisions=7, radius=radius)
        to_world = Matrix.Translation(centre)
        for face in bpy.context.object.data.polygons:
            face.use_smooth = True
    else:
        to_world = place(node)
        if kind == "ply":
            bpy.ops.wm.ply_import(filepath=os.path.join(folder, node.find("string").get("value")))
        elif kind == "cube":
            bpy.ops.mesh.primitive_cube_add(size=2)
        else:
            bpy.ops.mesh.primitive_plane_add(size=2)
    thing = bpy.context.object
    thing.matrix_world = to_world
    thing.data.materials.clear()
    thing.data.materials.append(material(node.find("bsdf")))


def add_sky(root, folder):
    world = bpy.data.worlds.new("world")
    bpy.context.scene.world = world
    world.use_nodes = True
    background, sky = world.node_tree.nodes["Background"], root.find("emitter")
    background.inputs["Strength"].default_value = 0 if sky is None else 1
    if sky is not None:
        image = world.node_tree.nodes.new("ShaderNodeTexEnvironment")
        image.image = bpy.data.images.load(os.path.join(folder, sky.find("string").get("value")))
        world.node_tree.links.new(image.outputs[0], background.inputs["Color"])


def add_camera(root):
    sensor = root.find("sensor")
    look = sensor.find(".//lookat")
    eye, target = (Y_UP @ Vector(numbers(look.get(key))) for key in ("origin", "target"))
    camera = bpy.data.cameras.new("camera")
    camera.sensor_fit, camera.angle = "VERTICAL", math.radians(float(sensor.find("float").get("value")))
    thing = linked("camera", camera)
    thing.location, thing.rotation_euler = eye, (target - eye).to_track_quat("-Z", "Y").to_euler()
    bpy.context.scene.camera = thing
    return [int(sensor.find(f".//integer[@name='{key}']").get("value")) for key in ("width", "height")]


def load(path, threshold):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    root, folder = ElementTree.parse(path).getroot(), os.path.dirname(os.path.abspath(path))
    for node in root.findall("shape"):
        emitter = node.find("emitter")
        if emitter is None:
            add_surface(node, folder)
        else:
            add_light(node, colour(emitter))
    add_sky(root, folder)
    scene = bpy.context.scene
    render, cycles = scene.render, scene.cycles
    render.engine = "CYCLES"
    render.resolution_x, render.resolution_y = add_camera(root)
    render.resolution_percentage, render.use_persistent_data = 100, True
    render.image_settings.file_format, render.image_settings.color_depth = "OPEN_EXR", "32"
    scene.view_settings.view_transform = "Raw"
    cycles.max_bounces, cycles.use_denoising, cycles.use_light_tree = 0, False, True
    cycles.use_adaptive_sampling, cycles.adaptive_threshold = threshold > 0, threshold
    cycles.sample_clamp_direct, cycles.pixel_filter_type, cycles.filter_width = 0, "BOX", 1.0


# ---------------------------------------------------------------- measuring


def read(path):
    image = bpy.data.images.load(path, check_existing=False)
    image.colorspace_settings.name = "Non-Color"
    pixels = np.empty(image.size[0] * image.size[1] * 4, np.float32)
    image.pixels.foreach_get(pixels)
    pixels = pixels.reshape(image.size[1], image.size[0], 4)[..., :3].astype(np.float64)
    bpy.data.images.remove(image)
    return pixels


def rendered(samples, folder):
    """A picture, and the CPU seconds that it took."""
    scene, before = bpy.context.scene, resource.getrusage(resource.RUSAGE_SELF)
    scene.cycles.samples, scene.cycles.seed = samples, samples
    scene.render.filepath = os.path.join(folder, "picture.exr")
    bpy.ops.render.render(write_still=True)
    after = resource.getrusage(resource.RUSAGE_SELF)
    seconds = after.ru_utime - before.ru_utime + after.ru_stime - before.ru_stime
    return read(scene.render.filepath), seconds


def time_to(error, reference, most, folder):
    """CPU seconds to that relMSE, and the measurements (samples, relMSE, CPU s)."""
    samples, found = 4, []
    while True:
        picture, seconds = rendered(samples, folder)
        found.append((samples, float(((picture - reference) ** 2 / (reference**2 + 0.01)).mean()), seconds))
        if found[-1][1] <= error or 2 * seconds > most:
            break
        samples *= 2
    if found[-1][1] > error or len(found) < 2:
        return math.nan, found
    (_, e0, s0), (_, e1, s1) = found[-2:]
    share = math.log(e0 / error) / math.log(e0 / e1)
    return s0 * (s1 / s0) ** share, found


def main():
    options = arguments()
    with tempfile.TemporaryDirectory() as folder:
        for name in options.scene:
            load(os.path.join(options.scenes, f"{name}.xml"), options.threshold)
            reference = read(os.path.abspath(os.path.join(options.references, f"{name}.own.exr")))
            rendered(1, folder)
            for error in options.error or [1e-4]:
                seconds, found = time_to(error, reference, options.most, folder)
                steps = ", ".join(f"{n} spp {e:.2e} {s:.2f} s" for n, e, s in found)
                print(f"{name:8} {error:7.0e} {seconds:9.2f} CPU s   ({steps})", flush=True)


if __name__ == "__main__":
    main()
