"""PNGs of 8 bits a channel: read, put side by side, and written small, with a palette of their own."""

import struct
import zlib


class Picture:
    """Rows of RGB bytes."""

    def __init__(self, width, height, rows):
        self.width, self.height, self.rows = width, height, rows


def _unfiltered(data, height, stride, step):
    """The rows of a PNG's image data (PNG specification, section 9)."""
    before, rows = bytes(stride), []
    for y in range(height):
        kind, row = data[y * (stride + 1)], bytearray(data[y * (stride + 1) + 1 : (y + 1) * (stride + 1)])
        for i in range(stride if kind else 0):
            left = row[i - step] if i >= step else 0
            above = before[i]
            if kind == 1:
                guess = left
            elif kind == 2:
                guess = above
            elif kind == 3:
                guess = (left + above) // 2
            else:
                corner = before[i - step] if i >= step else 0
                p = left + above - corner
                guess = min((abs(p - left), 0, left), (abs(p - above), 1, above), (abs(p - corner), 2, corner))[2]
            row[i] = (row[i] + guess) & 255
        rows.append(bytes(row))
        before = row
    return rows


def read(data):
    """A Picture of a grey, RGB or RGBA PNG without interlace; its alpha is dropped."""
    assert data[:8] == b"\x89PNG\r\n\x1a\n", "no PNG"
    at, packed = 8, b""
    while at < len(data):
        length, kind = struct.unpack(">I4s", data[at : at + 8])
        body = data[at + 8 : at + 8 + length]
        if kind == b"IHDR":
            width, height, depth, color, _, _, interlace = struct.unpack(">IIBBBBB", body)
        elif kind == b"IDAT":
            packed += body
        at += 12 + length
    channels = {0: 1, 2: 3, 4: 2, 6: 4}[color]
    assert depth == 8 and not interlace, "8 bits a channel and no interlace are read"
    rows = _unfiltered(zlib.decompress(packed), height, width * channels, channels)
    if channels < 3:
        return Picture(width, height, [bytes(v for v in row[::channels] for _ in range(3)) for row in rows])
    if channels == 4:
        rows = [b"".join(row[i : i + 3] for i in range(0, len(row), 4)) for row in rows]
    return Picture(width, height, rows)


def sheet(pictures, columns, gap=4):
    """Pictures of one size on white, row by row."""
    width, height = pictures[0].width, pictures[0].height
    assert all((p.width, p.height) == (width, height) for p in pictures), "pictures of one size"
    between = b"\xff" * (3 * gap)
    rows = []
    for first in range(0, len(pictures), columns):
        line = pictures[first : first + columns]
        missing = columns - len(line)
        if rows:
            rows += [b"\xff" * len(rows[0])] * gap
        rows += [between.join([p.rows[y] for p in line] + [b"\xff" * (3 * width)] * missing) for y in range(height)]
    return Picture(len(rows[0]) // 3, len(rows), rows)


def _palette(counts, size):
    """color -> index, and the palette: boxes of colors are halved at their median, the widest first (Heckbert, "Color
    Image Quantization for Frame Buffer Display", 1982)."""

    def spread(box):
        sides = [max(c[k] for c in box) - min(c[k] for c in box) for k in range(3)]
        return max(sides), sides.index(max(sides))

    boxes = [(spread(list(counts)), list(counts))]
    while len(boxes) < size:
        index = max(range(len(boxes)), key=lambda i: boxes[i][0][0] * sum(counts[c] for c in boxes[i][1]) ** 0.5)
        (side, axis), box = boxes[index]
        if side == 0:
            break
        box.sort(key=lambda c: c[axis])
        half, seen = sum(counts[c] for c in box) / 2, 0
        for cut in range(1, len(box)):
            seen += counts[box[cut - 1]]
            if seen >= half:
                break
        boxes[index] = (spread(box[:cut]), box[:cut])
        boxes.append((spread(box[cut:]), box[cut:]))
    index_of, colors = {}, []
    for _, box in boxes:
        weight = sum(counts[c] for c in box)
        colors.append(bytes(round(sum(c[k] * counts[c] for c in box) / weight) for k in range(3)))
        index_of.update((c, len(colors) - 1) for c in box)
    return index_of, colors


def write(picture, colors=144):
    """The bytes of a PNG with a palette."""
    counts = {}
    for row in picture.rows:
        for i in range(0, len(row), 3):
            c = (row[i], row[i + 1], row[i + 2])
            counts[c] = counts.get(c, 0) + 1
    index_of, palette = _palette(counts, colors)
    lines = bytearray()
    for row in picture.rows:
        lines += b"\0" + bytes(index_of[tuple(row[i : i + 3])] for i in range(0, len(row), 3))
    return _file(picture, 3, [(b"PLTE", b"".join(palette))], lines)


def write_whole(picture):
    """The bytes of a PNG with every color that the picture has."""
    return _file(picture, 2, [], b"".join(b"\0" + row for row in picture.rows))


def _file(picture, color, chunks, lines):
    head = struct.pack(">IIBBBBB", picture.width, picture.height, 8, color, 0, 0, 0)
    chunks = [(b"IHDR", head), *chunks, (b"IDAT", zlib.compress(bytes(lines), 9)), (b"IEND", b"")]
    return b"\x89PNG\r\n\x1a\n" + b"".join(
        struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body)) for kind, body in chunks)
