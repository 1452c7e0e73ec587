"""Capital letters, digits and a few signs of five rows, drawn into rows of RGB bytes at twice their size."""

SCALE = 2
LINE_HEIGHT = 7 * SCALE

# Each glyph is its five rows, from the top; small letters are drawn as capitals, what is missing as a box.
GLYPHS = {
    "A": "010 101 111 101 101", "B": "110 101 110 101 110", "C": "011 100 100 100 011", "D": "110 101 101 101 110",
    "E": "111 100 110 100 111", "F": "111 100 110 100 100", "G": "0111 1000 1011 1001 0111", "H": "101 101 111 101 101",
    "I": "1 1 1 1 1", "J": "001 001 001 101 010", "K": "101 101 110 101 101", "L": "100 100 100 100 111",
    "M": "10001 11011 10101 10001 10001", "N": "1001 1101 1011 1001 1001", "O": "010 101 101 101 010",
    "P": "110 101 110 100 100", "Q": "0110 1001 1001 1010 0101", "R": "110 101 110 101 101", "S": "011 100 010 001 110",
    "T": "111 010 010 010 010", "U": "101 101 101 101 111", "V": "101 101 101 101 010",
    "W": "10001 10001 10101 11011 10001", "X": "101 101 010 101 101", "Y": "101 101 010 010 010",
    "Z": "111 001 010 100 111", "0": "111 101 101 101 111", "1": "01 11 01 01 01", "2": "110 001 010 100 111",
    "3": "110 001 010 001 110", "4": "101 101 111 001 001", "5": "111 100 110 001 110", "6": "011 100 110 101 010",
    "7": "111 001 010 010 010", "8": "010 101 010 101 010", "9": "010 101 011 001 110", " ": "00 00 00 00 00",
    ".": "0 0 0 0 1", ",": "0 0 0 1 1", ":": "0 1 0 1 0", "-": "00 00 11 00 00", "_": "000 000 000 000 111",
    "/": "001 001 010 100 100", '"': "101 101 000 000 000", "'": "1 1 0 0 0", "(": "01 10 10 10 01", ")": "10 01 01 01 10",
}  # fmt: skip
BOX = "111 101 101 101 111"


def draw_text(rows, x, y, text, color):
    """Writes from the upper left corner (x, y); what leaves the rows is cut off."""
    width = len(rows[0]) // 3
    for sign in text.upper():
        glyph = GLYPHS.get(sign, BOX).split()
        for i in range(len(glyph) * SCALE):
            for j in range(len(glyph[0]) * SCALE):
                if glyph[i // SCALE][j // SCALE] == "1" and x + j < width and y + i < len(rows):
                    rows[y + i][3 * (x + j) : 3 * (x + j) + 3] = color
        x += (len(glyph[0]) + 1) * SCALE
