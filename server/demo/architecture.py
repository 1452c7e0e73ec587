"""The built parts of the demo scene, each a shapes.Mesh that stands on y = 0 unless it says otherwise."""

import math

from shapes import Mesh, box, lathe, prism, ring_segment, sphere

PLAZA_TOP = 0.45     # of the dial's disc, above the ground
LATITUDE = 48.0      # of the sundial, degrees
STYLE_FOOT = 2.6     # where the style meets the disc, south of the middle
STYLE_LENGTH = 4.7   # of the blade along the disc
BLADE_FOOT = 0.16    # height of the block under the blade


def plaza():
    """The round dial on two steps."""
    return lathe([(11.6, 0), (11.6, 0.15), (11.0, 0.15), (11.0, 0.3), (10.4, 0.3), (10.4, PLAZA_TOP - 0.03),
                  (10.37, PLAZA_TOP), (0, PLAZA_TOP)], 128)


def gnomon():
    """The blade: its upper edge points to the pole, its foot lies to the south. On the disc."""
    rise = math.tan(math.radians(LATITUDE))
    start = BLADE_FOOT / rise
    tip = STYLE_LENGTH * 0.97
    blade = prism([(start, BLADE_FOOT), (STYLE_LENGTH * 0.72, BLADE_FOOT), (STYLE_LENGTH, tip * rise),
                   (tip, tip * rise)], 0.24)
    mesh = Mesh()
    # The prism's x axis runs north once it is turned.
    mesh.append(blade, (0, PLAZA_TOP, STYLE_FOOT), 90)
    mesh.append(box(STYLE_LENGTH * 0.8, BLADE_FOOT, 0.8), (0, PLAZA_TOP, STYLE_FOOT - STYLE_LENGTH * 0.36), 90)
    return mesh


def hour_angle(hour):
    """Of an hour's line, degrees clockwise from north seen from above: tan = sin(latitude) tan(15 (hour - 12))."""
    sun = math.radians(15 * (hour - 12))
    return math.degrees(math.atan2(math.sin(math.radians(LATITUDE)) * math.sin(sun), math.cos(sun)))


def hour_marks():
    """A bar for each hour from 6 to 18 and a short one for each half, on the disc around the style's foot."""
    mesh = Mesh()
    for half_hour in range(12, 37):
        full = half_hour % 2 == 0
        angle = math.radians(hour_angle(half_hour / 2))
        sin, cos = math.sin(angle), -math.cos(angle)
        # Where the line from the foot meets the ring on which the marks stand.
        ring = 9.0
        along = -STYLE_FOOT * cos + math.sqrt(ring * ring - (STYLE_FOOT * sin) ** 2)

        def place(part, distance):
            mesh.append(part, (sin * distance, PLAZA_TOP, STYLE_FOOT + cos * distance), -math.degrees(angle))

        place(box(0.16 if full else 0.08, 0.05, 1.5 if full else 0.6), along)
        if half_hour % 6 == 0:
            place(box(0.44, 0.34, 0.44), along + 1.0)
    return mesh


def rings():
    """Two bands inlaid in the disc."""
    mesh = Mesh()
    for inner, outer in ((7.95, 8.07), (10.22, 10.3)):
        mesh.append(lathe([(outer, PLAZA_TOP), (outer, PLAZA_TOP + 0.02), (inner, PLAZA_TOP + 0.02),
                           (inner, PLAZA_TOP)], 96))
    return mesh


def column(height, radius):
    """Fluted and a little thinner at the top, with base and capital."""
    mesh = Mesh()
    mesh.append(box(radius * 2.9, radius * 0.45, radius * 2.9))
    base = [(1.38, 0.45), (1.44, 0.56), (1.38, 0.7), (1.18, 0.76), (1.16, 0.86), (1.28, 0.93), (1.28, 1.0), (1.1, 1.06)]
    mesh.append(lathe([(r * radius, y * radius) for r, y in base], 24))
    top = height - 0.95 * radius
    shaft = []
    for step in range(6):
        t = step / 5
        shaft.append((radius * (1.0 - 0.16 * t ** 1.6), 1.04 * radius + (top - 1.04 * radius) * t))
    mesh.append(lathe(shaft, 64, ripple=lambda angle: 1 - 0.055 * abs(math.sin(8 * angle))))
    neck = [(0.84, 0), (0.96, 0.05), (0.96, 0.12), (0.88, 0.16), (0.95, 0.3), (1.16, 0.46), (1.3, 0.55), (1.3, 0.6)]
    mesh.append(lathe([(r * radius, top + y * radius) for r, y in neck], 24))
    mesh.append(box(radius * 2.75, radius * 0.35, radius * 2.75), (0, top + 0.6 * radius, 0))
    return mesh


def court():
    """Gravel around the dial."""
    return lathe([(18.0, 0.0), (18.0, 0.015), (0.0, 0.015)], 96)


def walk(radius, arc):
    """The slabs under the columns, 0.12 m high."""
    return ring_segment([(radius - 1.6, 0.0), (radius + 1.6, 0.0), (radius + 1.6, 0.12), (radius - 1.6, 0.12)], 64, arc)


def entablature(radius, bottom, arc):
    """The beam over a ring of columns: three courses, each wider than the one below."""
    mesh = Mesh()
    y = bottom
    for half_width, height in ((0.42, 0.34), (0.47, 0.34), (0.62, 0.2)):
        mesh.append(ring_segment([(radius - half_width, y), (radius + half_width, y), (radius + half_width, y + height),
                                  (radius - half_width, y + height)], 64, arc))
        y += height
    return mesh


def baluster():
    """0.72 m high."""
    profile = [(0.08, 0.0), (0.08, 0.05), (0.05, 0.09), (0.1, 0.27), (0.085, 0.4), (0.042, 0.56), (0.08, 0.66),
               (0.08, 0.72)]
    return lathe(profile, 10)


def balustrade(length, spacing=0.36):
    """Along X, with a post at each end."""
    mesh = Mesh()
    mesh.append(box(length, 0.18, 0.34))
    mesh.append(box(length, 0.12, 0.3), (0, 0.9, 0))
    for x in (-length / 2, length / 2):
        mesh.append(box(0.44, 1.16, 0.44), (x, 0, 0))
        mesh.append(box(0.56, 0.08, 0.56), (x, 1.16, 0))
    count = int((length - 0.7) / spacing)
    post = baluster()
    for i in range(count + 1):
        mesh.append(post, ((i - count / 2) * spacing, 0.18, 0))
    return mesh


def pergola(length, width, height):
    """Posts, two beams along Z, rafters across and thin slats along over them."""
    mesh = Mesh()
    posts = 4
    for side in (-1, 1):
        for i in range(posts):
            mesh.append(box(0.2, height, 0.2), (side * width / 2, 0, (i / (posts - 1) - 0.5) * (length - 0.8)))
        mesh.append(box(0.16, 0.24, length), (side * width / 2, height, 0))
    rafters = int(length / 0.55)
    for i in range(rafters + 1):
        mesh.append(box(width + 1.2, 0.16, 0.07), (0, height + 0.24, (i / rafters - 0.5) * (length - 0.2)))
    slats = int(width / 0.22)
    for i in range(slats + 1):
        mesh.append(box(0.04, 0.04, length), ((i / slats - 0.5) * width, height + 0.4, 0))
    return mesh


def bench():
    mesh = Mesh()
    for z in (-0.8, 0.8):
        mesh.append(box(0.42, 0.42, 0.12), (0, 0, z))
    for i in range(4):
        mesh.append(box(0.1, 0.05, 2.1), (-0.18 + 0.12 * i, 0.42, 0))
    return mesh


def pedestal():
    """1.0 m high, under a sphere."""
    mesh = Mesh()
    mesh.append(box(0.8, 0.12, 0.8))
    mesh.append(box(0.6, 0.74, 0.6), (0, 0.12, 0))
    mesh.append(box(0.76, 0.1, 0.76), (0, 0.86, 0))
    mesh.append(lathe([(0.26, 0.96), (0.26, 0.99), (0.2, 1.0), (0, 1.0)], 24))
    return mesh


def ball():
    """Radius 0.45, centred on the origin."""
    return sphere(0.45, 20, 40)


def obelisk(height):
    """Four-sided, with a pyramid on top."""
    side = height * 0.11
    profile = [(side, 0), (side * 0.62, height * 0.9), (0, height)]
    mesh = Mesh().append(box(side * 2.2, height * 0.06, side * 2.2))
    # The lathe's corners lie on the axes; a turn of 45 degrees brings its sides there. Hard edges need crease 0.
    mesh.append(_faceted(profile), (0, height * 0.06, 0), 45)
    return mesh


def _faceted(profile):
    """A four-sided lathe with flat faces."""
    mesh = Mesh()
    for quarter in range(4):
        a, b = (math.radians(90 * (quarter + k)) for k in range(2))
        middle = (a + b) / 2
        for (r0, y0), (r1, y1) in zip(profile, profile[1:]):
            apothem = (r0 - r1) * math.cos(math.pi / 4)
            length = math.hypot(y1 - y0, apothem)
            out, up = (y1 - y0) / length, apothem / length
            normal = (math.sin(middle) * out, up, -math.cos(middle) * out)
            corners = [(math.sin(angle) * r, y, -math.cos(angle) * r) for angle, r, y in
                       ((b, r0, y0), (a, r0, y0), (a, r1, y1), (b, r1, y1))]
            if r1 > 0:
                mesh.flat_quad(corners, normal, ((0, 0), (r0, 0), (r0, -length), (0, -length)))
            else:
                mesh.triangle(*[mesh.vertex(corner, normal) for corner in corners[:3]])
    return mesh


def tower(height, radius):
    """Round, with a parapet of merlons."""
    mesh = Mesh()
    mesh.append(lathe([(radius * 1.12, 0), (radius, height * 0.12), (radius * 0.94, height * 0.86),
                       (radius * 1.14, height * 0.92), (radius * 1.14, height), (0, height)], 48))
    for i in range(12):
        mesh.append(ring_segment([(radius * 0.98, height), (radius * 1.14, height), (radius * 1.14, height * 1.08),
                                  (radius * 0.98, height * 1.08)], 4, (30 * i, 30 * i + 16)))
    return mesh
