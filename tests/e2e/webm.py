"""Reads the WebM files that the server and its clients write."""

import json
import struct

SEGMENT, TAGS, CLUSTER = 0x18538067, 0x1254C367, 0x1F43B675
HOLDS_ELEMENTS = (0x1A45DFA3, SEGMENT, 0x1549A966, 0x1654AE6B, 0xAE, 0xE0, 0x55B0, CLUSTER, TAGS, 0x7373, 0x67C8)
UNKNOWN = (1 << 56) - 1


def elements(data):
    """(id, content) of each element of an EBML, RFC 8794; contents that hold elements are lists."""
    found, at = [], 0
    while at < len(data):
        length = 9 - data[at].bit_length()
        name = int.from_bytes(data[at:at + length], "big")
        at += length
        length = 9 - data[at].bit_length()
        size = int.from_bytes(data[at:at + length], "big") - (1 << 7 * length)
        at += length
        content = data[at:] if size == UNKNOWN else data[at:at + size]
        assert size in (UNKNOWN, len(content)), "an element is cut off"
        at += len(content)
        found.append((name, elements(content) if name in HOLDS_ELEMENTS else content))
    return found


def all_of(tree, *path):
    """The contents at a path of ids, in order."""
    for name in path:
        tree = [content for each, content in tree if each == name]
        if name != path[-1]:
            tree = [element for content in tree for element in content]
    return tree


class Video:
    def __init__(self, data):
        tree = elements(data)
        self.duration = struct.unpack(">d", all_of(tree, SEGMENT, 0x1549A966, 0x4489)[0])[0] / 1000
        video = all_of(tree, SEGMENT, 0x1654AE6B, 0xAE, 0xE0)[0]
        self.size = tuple(int.from_bytes(all_of(video, name)[0], "big") for name in (0xB0, 0xBA))
        self.blocks = all_of(tree, SEGMENT, CLUSTER, 0xA3)
        self.times = [int.from_bytes(time, "big") for time in all_of(tree, SEGMENT, CLUSTER, 0xE7)]
        tags = zip(all_of(tree, SEGMENT, TAGS, 0x7373, 0x67C8, 0x45A3), all_of(tree, SEGMENT, TAGS, 0x7373, 0x67C8, 0x4487))
        self.tags = {name.decode(): json.loads(text) for name, text in tags}
