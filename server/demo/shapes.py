"""Meshes of simple shapes. Metres, +Y up, counter-clockwise fronts; texture coordinates are metres too, so that a
texture's size on the surface is set with Mesh.scale_uvs."""

import math
from array import array


class Mesh:
    """Vertices as flat arrays. Tangents and colors are either of every vertex or of none."""

    def __init__(self):
        self.positions, self.normals, self.uvs = array("f"), array("f"), array("f")
        self.colors, self.tangents = array("f"), array("f")
        self.indices = array("I")

    def vertex(self, position, normal, uv=(0.0, 0.0)):
        self.positions.extend(position)
        self.normals.extend(normal)
        self.uvs.extend(uv)
        return len(self.positions) // 3 - 1

    def triangle(self, a, b, c):
        self.indices.extend((a, b, c))

    def quad(self, a, b, c, d):
        self.indices.extend((a, b, c, a, c, d))

    def flat_quad(self, corners, normal, uvs=((0, 0), (1, 0), (1, 1), (0, 1))):
        """Four corners, counter-clockwise seen from where the normal points."""
        self.quad(*[self.vertex(corner, normal, uv) for corner, uv in zip(corners, uvs)])

    def append(self, other, offset=(0.0, 0.0, 0.0), yaw=0.0, scale=(1.0, 1.0, 1.0)):
        """Adds a copy: scaled (positively), turned by `yaw` degrees about +Y, then moved."""
        first = len(self.positions) // 3
        cos, sin = math.cos(math.radians(yaw)), math.sin(math.radians(yaw))
        sx, sy, sz = scale
        ox, oy, oz = offset
        p, n = other.positions, other.normals
        for i in range(0, len(p), 3):
            x, z = p[i] * sx, p[i + 2] * sz
            self.positions.extend((cos * x + sin * z + ox, p[i + 1] * sy + oy, cos * z - sin * x + oz))
            nx, ny, nz = n[i] / sx, n[i + 1] / sy, n[i + 2] / sz
            length = math.sqrt(nx * nx + ny * ny + nz * nz)
            nx, ny, nz = nx / length, ny / length, nz / length
            self.normals.extend((cos * nx + sin * nz, ny, cos * nz - sin * nx))
        self.uvs.extend(other.uvs)
        self.colors.extend(other.colors)
        self.indices.extend(index + first for index in other.indices)
        return self

    def scale_uvs(self, factor):
        for i, value in enumerate(self.uvs):
            self.uvs[i] = value * factor
        return self

    def paint(self, color_at):
        """Vertex colors, linear RGB, from a function of the position; or one color for all."""
        p = self.positions
        self.colors = array("f")
        for i in range(0, len(p), 3):
            self.colors.extend(color_at(p[i], p[i + 1], p[i + 2]) if callable(color_at) else color_at)
        return self


def box(width, height, depth):
    """Stands on y = 0, centred on the Y axis."""
    mesh = Mesh()
    x, z = width / 2, depth / 2
    faces = (((1, 0, 0), ((x, 0, z), (x, 0, -z), (x, height, -z), (x, height, z)), depth, height),
             ((-1, 0, 0), ((-x, 0, -z), (-x, 0, z), (-x, height, z), (-x, height, -z)), depth, height),
             ((0, 0, 1), ((-x, 0, z), (x, 0, z), (x, height, z), (-x, height, z)), width, height),
             ((0, 0, -1), ((x, 0, -z), (-x, 0, -z), (-x, height, -z), (x, height, -z)), width, height),
             ((0, 1, 0), ((-x, height, z), (x, height, z), (x, height, -z), (-x, height, -z)), width, depth),
             ((0, -1, 0), ((-x, 0, -z), (x, 0, -z), (x, 0, z), (-x, 0, z)), width, depth))
    for normal, corners, u, v in faces:
        mesh.flat_quad(corners, normal, ((0, v), (u, v), (u, 0), (0, 0)))
    return mesh


def grid(width, depth, columns, rows, height=None):
    """A surface over the XZ plane that faces up, with smooth normals; `height` is a function of x and z."""
    mesh = Mesh()
    step = 0.01
    for row in range(rows + 1):
        z = depth * (row / rows - 0.5)
        for column in range(columns + 1):
            x = width * (column / columns - 0.5)
            if height is None:
                mesh.vertex((x, 0.0, z), (0.0, 1.0, 0.0), (x, z))
                continue
            slope_x = (height(x + step, z) - height(x - step, z)) / (2 * step)
            slope_z = (height(x, z + step) - height(x, z - step)) / (2 * step)
            length = math.sqrt(slope_x * slope_x + 1 + slope_z * slope_z)
            mesh.vertex((x, height(x, z), z), (-slope_x / length, 1 / length, -slope_z / length), (x, z))
    for row in range(rows):
        for column in range(columns):
            a = row * (columns + 1) + column
            mesh.quad(a, a + columns + 1, a + columns + 2, a + 1)
    return mesh


def lathe(profile, segments, arc=(0.0, 360.0), crease=35.0, ripple=None):
    """Turns `profile`, points (radius, y) from the lowest outside upwards, about +Y. Neighbouring pieces that meet at
    more than `crease` degrees keep an edge. `arc` is in degrees clockwise from north seen from above; `ripple` is a
    function of the angle in radians that scales the radius."""
    mesh = Mesh()
    pieces = [(a, b) for a, b in zip(profile, profile[1:]) if a != b]
    slopes = []
    for (r0, y0), (r1, y1) in pieces:
        length = math.hypot(r1 - r0, y1 - y0)
        slopes.append(((y1 - y0) / length, (r0 - r1) / length))

    def joined(one, other):
        if not 0 <= one < len(slopes) or not 0 <= other < len(slopes):
            return None
        dot = slopes[one][0] * slopes[other][0] + slopes[one][1] * slopes[other][1]
        return slopes[other] if dot > math.cos(math.radians(crease)) else None

    start, end = (math.radians(a) for a in arc)
    run = 0.0
    for i, ((r0, y0), (r1, y1)) in enumerate(pieces):
        flat = abs(slopes[i][1]) > 0.9
        length = math.hypot(r1 - r0, y1 - y0)
        first = len(mesh.positions) // 3
        for (radius, y), neighbour, v in (((r0, y0), joined(i, i - 1), run),
                                          ((r1, y1), joined(i, i + 1), run + length)):
            out, up = (a + b for a, b in zip(slopes[i], neighbour or slopes[i]))
            norm = math.hypot(out, up)
            for segment in range(segments + 1):
                angle = start + (end - start) * segment / segments
                sin, cos = math.sin(angle), -math.cos(angle)
                r = radius * ripple(angle) if ripple else radius
                normal = _ripple_normal(angle, out / norm, up / norm, ripple)
                uv = (sin * r, cos * r) if flat else (angle * max(r0, r1), -v)
                mesh.vertex((sin * r, y, cos * r), normal, uv)
        run += length
        for segment in range(segments):
            a, b = first + segment, first + segments + 1 + segment
            if r0 > 1e-9:
                mesh.triangle(a, b, a + 1)
            if r1 > 1e-9:
                mesh.triangle(a + 1, b, b + 1)
    return mesh


def _ripple_normal(angle, out, up, ripple):
    sin, cos = math.sin(angle), -math.cos(angle)
    if not ripple:
        return (out * sin, up, out * cos)
    # The outline r(angle) has the normal (r, -r') in its own (outward, along) axes.
    along = -(ripple(angle + 1e-4) - ripple(angle - 1e-4)) / 2e-4
    length = math.hypot(ripple(angle), along)
    o, a = out * ripple(angle) / length, out * along / length
    return (o * sin - a * cos, up, o * cos + a * sin)


def ring_segment(profile, segments, arc):
    """A closed convex profile swept along an arc, with both ends shut."""
    mesh = lathe(profile + profile[:1], segments, arc)
    for degrees, order in ((arc[0], profile[::-1]), (arc[1], profile)):
        angle = math.radians(degrees)
        sign = 1 if degrees == arc[1] else -1
        normal = (sign * math.cos(angle), 0.0, sign * math.sin(angle))
        corners = [mesh.vertex((math.sin(angle) * r, y, -math.cos(angle) * r), normal, (r, -y)) for r, y in order]
        for i in range(1, len(corners) - 1):
            mesh.triangle(corners[0], corners[i], corners[i + 1])
    return mesh


def sphere(radius, rings, segments):
    """Centred on the origin."""
    turns = [math.pi * (ring / rings - 0.5) for ring in range(rings + 1)]
    profile = [(radius * math.cos(t), radius * math.sin(t)) for t in turns]
    profile[0], profile[-1] = (0.0, -radius), (0.0, radius)
    return lathe(profile, segments, crease=60.0)


def prism(outline, thickness):
    """A convex outline of (x, y), counter-clockwise seen from +Z, thick along Z and centred there."""
    mesh = Mesh()
    half = thickness / 2
    front = [mesh.vertex((x, y, half), (0, 0, 1), (x, -y)) for x, y in outline]
    back = [mesh.vertex((x, y, -half), (0, 0, -1), (-x, -y)) for x, y in outline]
    for i in range(1, len(outline) - 1):
        mesh.triangle(front[0], front[i], front[i + 1])
        mesh.triangle(back[0], back[i + 1], back[i])
    for (x0, y0), (x1, y1) in zip(outline, outline[1:] + outline[:1]):
        length = math.hypot(x1 - x0, y1 - y0)
        normal = ((y1 - y0) / length, (x0 - x1) / length, 0)
        mesh.flat_quad(((x0, y0, half), (x0, y0, -half), (x1, y1, -half), (x1, y1, half)), normal,
                       ((0, 0), (thickness, 0), (thickness, length), (0, length)))
    return mesh
