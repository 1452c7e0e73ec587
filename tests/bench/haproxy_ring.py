"""Where HAProxy's consistent hashing puts a key, and where it goes when that replica has enough: `balance hash` with
`hash-type consistent`, its default function and avalanche, and `hash-balance-factor`, as HAProxy 2.6 documents and does
them. tests/bench/fleet.py --check compares the places with those of the real program."""

import numpy

POINTS = 16  # on the ring for a weight of 1
MASK = 0xFFFFFFFF


def spread(values):
    """Bob Jenkins' avalanche of 32 bits (burtleburtle.net/bob/hash/integer.html), times a prime."""
    a = numpy.atleast_1d(numpy.asarray(values, dtype=numpy.uint64)) & MASK
    a = (a + 0x7ED55D16 + (a << 12)) & MASK
    a = (a ^ 0xC761C23C) ^ (a >> 19)
    a = (a + 0x165667B1 + (a << 5)) & MASK
    a = ((a + 0xD3A2646C) ^ (a << 9)) & MASK
    a = (a + 0xFD7046C5 + (a << 3)) & MASK
    a = (a ^ 0xB55A4F09) ^ (a >> 16)
    return (a * 3221225473) & MASK


def key_of(text):
    """SDBM's hash, spread."""
    a = 0
    for byte in text.encode():
        a = (byte + (a << 6) + (a << 16) - a) & MASK
    return int(spread(a)[0])


class Ring:
    """Replicas by number, from 1, with their weights, at their points."""

    def __init__(self, weights):
        self.numbers = sorted(weights)
        points = [spread(number * 4096 + numpy.arange(weights[number] * POINTS, dtype=numpy.uint64)) for number in self.numbers]
        owners = numpy.repeat(self.numbers, [len(each) for each in points])
        points = numpy.concatenate(points)
        order = numpy.argsort(points, kind="stable")
        self.points, self.owners = points[order], owners[order].tolist()

    def nearest(self, keys):
        """The index of the point that is nearest to each key; the lower one of two."""
        keys = numpy.asarray(keys, dtype=numpy.uint64)
        above = numpy.searchsorted(self.points, keys, side="left")
        size = len(self.points)
        below = (numpy.searchsorted(self.points, keys, side="right") - 1) % size
        above = above % size
        up = (self.points[above] - keys) & MASK
        down = (keys - self.points[below]) & MASK
        return numpy.where(down <= up, below, above)

    def walk(self, point, count):
        """The replicas from a point on, each once, at most so many."""
        owners, size, met = self.owners, len(self.owners), set()
        for step in range(size):
            owner = owners[(point + step) % size]
            if owner not in met:
                met.add(owner)
                yield owner
                if len(met) == count:
                    return

    def place(self, point, has_room):
        """The first replica with room from a point on; of none, the one of the point."""
        return next((each for each in self.walk(point, len(self.numbers)) if has_room(each)), self.owners[point])


def most_requests(index, replicas, total, factor):
    """How many requests the replica of an index may have while all have `total`, and one more comes: its part of `factor`
    percent of that, at least 1. Replicas of one weight."""
    all_ = ((total + 1) * factor + 99) // 100
    return max(1, (index + 1) * all_ // replicas - index * all_ // replicas)
