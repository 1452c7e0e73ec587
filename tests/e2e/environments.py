"""Pictures of all directions, made here."""


def hdr(above, below, height=8):
    """A Radiance picture of two colors, as mantissas and a common exponent: (128, 128, 128, 129) is 1 each."""
    rows = [above] * (height // 2) + [below] * (height - height // 2)
    texels = b"".join(bytes(color) * (2 * height) for color in rows)
    return f"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y {height} +X {2 * height}\n".encode() + texels


RED = hdr((200, 20, 20, 129), (40, 4, 4, 129))
