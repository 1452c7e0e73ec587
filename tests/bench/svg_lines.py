"""Lines as SVG, for charts of few points. Standard library only."""

import math
from html import escape

COLORS = ["#1b6ca8", "#c8502d", "#3f8f4f", "#8a4fa3", "#b08a1e", "#555555"]
WIDTH, HEIGHT, LEFT, RIGHT, TOP, BOTTOM = 620, 340, 64, 200, 34, 48


class Axis:
    """Values to pixels between two ends, linear or logarithmic, with its ticks."""

    def __init__(self, values, low, high, logarithmic, least=None, most=None):
        self.logarithmic = logarithmic
        self.low = min(values) if least is None else least
        self.high = max(values) if most is None else most
        if self.high <= self.low:
            self.high = self.low * 2 if self.low else 1
        self.pixels = low, high

    def share(self, value):
        if self.logarithmic:
            return math.log(value / self.low) / math.log(self.high / self.low)
        return (value - self.low) / (self.high - self.low)

    def at(self, value):
        low, high = self.pixels
        return low + self.share(value) * (high - low)

    def ticks(self):
        if self.logarithmic:
            first, last = math.floor(math.log10(self.low)), math.ceil(math.log10(self.high))
            steps = (1, 2, 5) if self.high / self.low < 100 else (1,)
            found = [factor * 10**each for each in range(first, last + 1) for factor in steps]
        else:
            step = 10 ** math.floor(math.log10((self.high - self.low) / 2))
            step = next(step * each for each in (1, 2, 5, 10) if (self.high - self.low) / (step * each) <= 6)
            found = [each * step for each in range(math.ceil(self.low / step), math.floor(self.high / step + 1e-9) + 1)]
        return [each for each in found if self.low * 0.9999 <= each <= self.high * 1.0001]


def number(value):
    for size, unit in ((1e6, "M"), (1e3, "k")):
        if value >= size:
            return f"{value / size:g}{unit}"
    return f"{value:.3g}"


def chart(path, title, x_label, y_label, series, log_x=False, log_y=False, least=None, most=None):
    """Writes lines, `series` being name -> [(x, y)], each with dots where its values are. `least` and `most` are of y."""
    xs = [x for points in series.values() for x, _ in points]
    ys = [y for points in series.values() for _, y in points]
    across = Axis(xs, LEFT, WIDTH - RIGHT, log_x)
    up = Axis(ys, HEIGHT - BOTTOM, TOP, log_y, least, most)
    parts = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" font-family="sans-serif" font-size="12">',
             f'<rect width="{WIDTH}" height="{HEIGHT}" fill="white"/>',
             f'<text x="{LEFT}" y="20" font-size="14" font-weight="bold">{escape(title)}</text>']  # fmt: skip
    for tick in across.ticks():
        x = across.at(tick)
        parts.append(f'<path d="M{x:.1f} {TOP}V{HEIGHT - BOTTOM}" stroke="#e4e4e4"/>'
                     f'<text x="{x:.1f}" y="{HEIGHT - BOTTOM + 16}" text-anchor="middle">{number(tick)}</text>')  # fmt: skip
    for tick in up.ticks():
        y = up.at(tick)
        parts.append(f'<path d="M{LEFT} {y:.1f}H{WIDTH - RIGHT}" stroke="#e4e4e4"/>'
                     f'<text x="{LEFT - 6}" y="{y + 4:.1f}" text-anchor="end">{number(tick)}</text>')  # fmt: skip
    middle = (LEFT + WIDTH - RIGHT) / 2
    parts.append(f'<text x="{middle}" y="{HEIGHT - 10}" text-anchor="middle">{escape(x_label)}</text>')
    parts.append(f'<text transform="translate(16 {HEIGHT / 2}) rotate(-90)" text-anchor="middle">{escape(y_label)}</text>')
    for order, (name, points) in enumerate(series.items()):
        color, dots = COLORS[order % len(COLORS)], [(across.at(x), up.at(y)) for x, y in points]
        line = " ".join(f"{x:.1f},{y:.1f}" for x, y in dots)
        parts.append(f'<polyline points="{line}" fill="none" stroke="{color}" stroke-width="2"/>')
        if len(dots) <= 30:
            parts += [f'<circle cx="{x:.1f}" cy="{y:.1f}" r="3" fill="{color}"/>' for x, y in dots]
        y = TOP + 8 + 18 * order
        parts.append(f'<path d="M{WIDTH - RIGHT + 10} {y}h16" stroke="{color}" stroke-width="3"/>'
                     f'<text x="{WIDTH - RIGHT + 32}" y="{y + 4}">{escape(name)}</text>')  # fmt: skip
    path.write_text("\n".join([*parts, "</svg>"]) + "\n")
