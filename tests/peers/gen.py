"""Writes the peer scenes: Mitsuba 3 XML, and the meshes and the sky that they use.

    python gen.py FOLDER
"""

import os
import sys

import numpy as np

# ---------------------------------------------------------------- meshes


def write_ply(path, vertices, faces):
    vertices, faces = np.asarray(vertices, np.float32), np.asarray(faces, np.int32)
    header = (
        "ply\nformat binary_little_endian 1.0\n"
        f"element vertex {len(vertices)}\nproperty float x\nproperty float y\nproperty float z\n"
        f"element face {len(faces)}\nproperty list uchar int vertex_indices\nend_header\n"
    )
    records = np.zeros(len(faces), dtype=[("count", "u1"), ("corners", "<i4", 3)])
    records["count"] = 3
    records["corners"] = faces
    with open(path, "wb") as file:
        file.write(header.encode() + vertices.tobytes() + records.tobytes())


def surface(point, n, m):
    """Triangles over a grid of n by m points of a function of (u, v) in the unit square."""
    u, v = np.meshgrid(np.linspace(0, 1, n), np.linspace(0, 1, m), indexing="ij")
    vertices = np.stack(point(u, v), -1).reshape(-1, 3)
    i, j = np.meshgrid(np.arange(n - 1), np.arange(m - 1), indexing="ij")
    a = (i * m + j).ravel()
    b = a + m
    return vertices, np.concatenate([np.stack([a, b, b + 1], -1), np.stack([a, b + 1, a + 1], -1)])


def knot():
    """A tube along a (2, 3) torus knot: 143 k triangles."""

    def centre(t):
        r = 0.75 + 0.35 * np.cos(3 * t)
        return np.stack([r * np.cos(2 * t), 0.35 * np.sin(3 * t), r * np.sin(2 * t)], -1)

    def point(u, v):
        t, s, step = u * 2 * np.pi, v * 2 * np.pi, 1e-4
        along = centre(t + step) - centre(t - step)
        along /= np.linalg.norm(along, axis=-1, keepdims=True)
        across = np.cross(along, np.array([0, 1.0, 0]))
        across /= np.linalg.norm(across, axis=-1, keepdims=True)
        p = centre(t) + 0.22 * (np.cos(s)[..., None] * across + np.sin(s)[..., None] * np.cross(along, across))
        return p[..., 0], p[..., 1] + 0.62, p[..., 2]

    vertices, faces = surface(point, 600, 120)
    return vertices, faces[:, ::-1]


def bumpy():
    """A ball with waves: 298 k triangles."""

    def point(u, v):
        theta, phi = v * np.pi, u * 2 * np.pi
        r = 1 + 0.06 * np.sin(14 * phi) * np.sin(11 * theta) ** 2 + 0.03 * np.sin(37 * theta)
        return r * np.sin(theta) * np.cos(phi), 1 + r * np.cos(theta), r * np.sin(theta) * np.sin(phi)

    return surface(point, 500, 300)


def terrain():
    """Hills: 318 k triangles."""

    def point(u, v):
        x, z = (u - 0.5) * 16, (v - 0.5) * 16
        return x, 0.35 * np.sin(1.7 * x) * np.cos(1.3 * z) + 0.12 * np.sin(5.1 * x + 1) * np.sin(4.7 * z), z

    vertices, faces = surface(point, 400, 400)
    return vertices, faces[:, ::-1]


def sky(width=1024, height=512):
    """A blue sky with a sun of 1.2 degrees and radiance 4000."""
    v, u = np.meshgrid((np.arange(height) + 0.5) / height, (np.arange(width) + 0.5) / width, indexing="ij")
    theta, phi = v * np.pi, u * 2 * np.pi
    d = np.stack([np.sin(theta) * np.sin(phi), np.cos(theta), -np.sin(theta) * np.cos(phi)], -1)
    sun = np.array([0.5, 0.55, 0.67])
    cos = (d @ (sun / np.linalg.norm(sun)))[..., None]
    up = np.clip(d[..., 1:2], 0, 1)
    above = np.array([0.35, 0.55, 1.0]) * (0.25 + 0.6 * (1 - up) ** 3)
    image = np.where(d[..., 1:2] > 0, above, np.array([0.12, 0.1, 0.08]))
    image = image + np.array([1.0, 0.8, 0.5]) * (0.8 * np.exp(-(1 - cos) * 30))
    image = np.where(cos > np.cos(np.radians(1.2)), np.array([1.0, 0.9, 0.7]) * 4000, image)
    return image.astype(np.float32)


# ---------------------------------------------------------------- XML


def head(eye, target, fov=40):
    return f"""<scene version="3.0.0">
  <integrator type="direct"/>
  <sensor type="perspective">
    <float name="fov" value="{fov}"/>
    <string name="fov_axis" value="y"/>
    <transform name="to_world"><lookat origin="{eye}" target="{target}" up="0, 1, 0"/></transform>
    <film type="hdrfilm">
      <integer name="width" value="320"/><integer name="height" value="240"/><rfilter type="box"/>
    </film>
    <sampler type="independent"><integer name="sample_count" value="16"/></sampler>
  </sensor>
"""


def rgb(name, r, g, b):
    return f'<rgb name="{name}" value="{r}, {g}, {b}"/>'


def diffuse(r, g, b):
    return f'<bsdf type="diffuse">{rgb("reflectance", r, g, b)}</bsdf>'


def metal(r, g, b, alpha):
    return (
        '<bsdf type="roughconductor"><string name="material" value="none"/>'
        f'<string name="distribution" value="ggx"/><float name="alpha" value="{alpha}"/>'
        f'{rgb("specular_reflectance", r, g, b)}</bsdf>'
    )


def light(r, g, b):
    return f'<emitter type="area">{rgb("radiance", r, g, b)}</emitter>'


def shape(kind, inner, transform="", parameters=""):
    if transform:
        transform = f'<transform name="to_world">{transform}</transform>'
    return f'  <shape type="{kind}">{parameters}{transform}{inner}</shape>\n'


def ball(centre, radius, inner):
    x, y, z = centre
    parameters = f'<point name="center" x="{x}" y="{y}" z="{z}"/><float name="radius" value="{radius}"/>'
    return shape("sphere", inner, parameters=parameters)


def mesh(file, inner):
    parameters = f'<string name="filename" value="{file}"/><boolean name="face_normals" value="true"/>'
    return shape("ply", inner, parameters=parameters)


def facing_down(scale, x, y, z):
    return f'<scale x="{scale}" y="{scale}"/><rotate x="1" angle="90"/><translate x="{x}" y="{y}" z="{z}"/>'


def still_life(third):
    """A floor, a knot, a cube and a ball of the given material."""
    cube = '<scale value="0.5"/><rotate y="1" angle="30"/><translate x="-2.1" y="0.5" z="0.3"/>'
    return (
        head("0, 3.2, 7", "0, 0.6, 0")
        + shape("rectangle", diffuse(0.6, 0.6, 0.6), '<rotate x="1" angle="-90"/><scale value="12"/>')
        + mesh("knot.ply", diffuse(0.7, 0.35, 0.2))
        + shape("cube", diffuse(0.3, 0.5, 0.7), cube)
        + ball((2.0, 0.7, 0.2), 0.7, third)
    )


GREEN = diffuse(0.35, 0.65, 0.3)


def rect():
    """Soft shadows of one rectangle: the plain case."""
    return still_life(GREEN) + shape("rectangle", light(12, 11, 9), facing_down(1.0, 0.5, 4.5, 1.0))


def disk():
    """The same under a disk."""
    return still_life(GREEN) + shape("disk", light(20, 18, 14), facing_down(0.9, -1.5, 3.4, 1.5))


def spheres():
    """Three coloured spheres, one of them 0.15 m above the floor, and a metal ball."""
    return (
        still_life(metal(0.5, 0.8, 0.5, 0.25))
        + ball((-1.2, 2.6, 2.0), 0.35, light(40, 12, 8))
        + ball((2.6, 1.9, 2.2), 0.15, light(40, 90, 200))
        + ball((0.2, 0.25, 2.6), 0.1, light(120, 110, 60))
    )


def env():
    """A sky with a sun, and a metal ball."""
    emitter = '  <emitter type="envmap"><string name="filename" value="sky.exr"/></emitter>\n'
    return still_life(metal(0.8, 0.8, 0.8, 0.1)) + emitter


def veach():
    """Plates of four roughnesses under spheres of four sizes (after Veach and Guibas 1995)."""
    grey = diffuse(0.3, 0.3, 0.3)
    floor = '<rotate x="1" angle="-90"/><scale value="12"/><translate y="-0.6"/>'
    body = head("0, 4, 11", "0, 1.2, 0", 30) + shape("rectangle", grey, floor)
    body += shape("rectangle", grey, '<scale value="12"/><translate z="-4"/>')
    for i, alpha in enumerate((0.01, 0.03, 0.08, 0.2)):
        angle, y, z = -90 + (36 - i * 8.5), 1.75 - i * 0.55, -2.4 + i * 1.05
        plate = f'<scale x="3.2" y="0.45"/><rotate x="1" angle="{angle}"/><translate y="{y}" z="{z}"/>'
        body += shape("rectangle", metal(0.75, 0.75, 0.75, alpha), plate)
    lamps = ((0.033, (900, 300, 300)), (0.1, (98, 98, 33)), (0.3, (11, 14, 5.5)), (0.6, (1.4, 2.4, 3.5)))
    for i, (radius, radiance) in enumerate(lamps):
        body += ball((-2.9 + i * 1.9, 4.2, -1.8), radius, light(*radiance))
    return body


def many():
    """Hills under 300 small rectangles of many colours and directions."""
    random = np.random.default_rng(7)
    body = head("0, 5, 9", "0, 0, 0")
    body += mesh("terrain.ply", diffuse(0.6, 0.55, 0.5)) + mesh("bumpy.ply", diffuse(0.5, 0.5, 0.55))
    for _ in range(300):
        x, z = random.uniform(-7, 7, 2)
        y, size = random.uniform(0.7, 1.4), random.uniform(0.02, 0.08)
        radiance = random.uniform(0.1, 1, 3) * random.uniform(5, 60)
        tilt, turn = random.uniform(30, 150), random.uniform(0, 360)
        place = (
            f'<scale value="{size:.4f}"/><rotate x="1" angle="{tilt:.2f}"/><rotate y="1" angle="{turn:.2f}"/>'
            f'<translate x="{x:.4f}" y="{y:.4f}" z="{z:.4f}"/>'
        )
        body += shape("rectangle", light(*[round(float(c), 3) for c in radiance]), place)
    return body


SCENES = (rect, disk, spheres, env, veach, many)


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    folder = sys.argv[1]
    os.makedirs(folder, exist_ok=True)
    for make in (knot, bumpy, terrain):
        write_ply(os.path.join(folder, f"{make.__name__}.ply"), *make())
    import mitsuba

    mitsuba.set_variant("scalar_rgb")
    mitsuba.Bitmap(sky()).write(os.path.join(folder, "sky.exr"))
    for make in SCENES:
        with open(os.path.join(folder, f"{make.__name__}.xml"), "w", encoding="utf-8") as file:
            file.write(make() + "</scene>\n")


if __name__ == "__main__":
    main()
