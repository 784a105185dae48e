"""Pictures that move, as SVG: lines whose ends go through a list of places, and parts that come and go. Python 3
alone; the same bytes every time."""
from concepts import Picture

PLACES = 1  # decimals of a pixel


def numbers(values):
    return ";".join(f"{value:.{PLACES}f}".removesuffix(".0") for value in values)


class View:
    """From the world (+Y up) to pixels, without perspective: a radius stays a radius."""

    def __init__(self, towards, middle, scale, center):
        x, y, z = towards  # where the camera looks
        long = (x * x + y * y + z * z) ** 0.5
        x, y, z = x / long, y / long, z / long
        flat = (x * x + z * z) ** 0.5
        self.right, self.up = (-z / flat, 0.0, x / flat), (-x * y / flat, flat, -z * y / flat)
        self.towards, self.middle, self.scale, self.center = (x, y, z), middle, scale, center

    def at(self, p):
        d = [float(a) - b for a, b in zip(p, self.middle)]
        x, y = (sum(a * b for a, b in zip(d, axis)) for axis in (self.right, self.up))
        return (self.center[0] + self.scale * x, self.center[1] - self.scale * y)

    def depth(self, p):
        return sum(float(a) * b for a, b in zip(p, self.towards))

    def faces(self, low, high):
        """Of a box, those that the camera sees: the shade of each (0 to 1), and its corners in pixels."""
        for axis in (1, 0, 2):
            side = high if self.towards[axis] < 0 else low
            i, j = [k for k in range(3) if k != axis]
            corners = []
            for u, v in ((low, low), (high, low), (high, high), (low, high)):
                corner = [0.0, 0.0, 0.0]
                corner[axis], corner[i], corner[j] = side[axis], u[i], v[j]
                corners.append(self.at(corner))
            yield (0.30, 0.62, 0.48)[(1, 0, 2).index(axis)], corners


class Film(Picture):
    """A picture of `frames` places in equal steps of time, shown again and again."""

    def __init__(self, width, height, title, seconds, frames):
        super().__init__(width, height, title)
        self.seconds, self.frames, self.lines = seconds, frames, 0

    def animated(self, name, values, calc=""):
        """What a part's attribute does, if it does anything."""
        return f'<animate attributeName="{name}" values="{values}"{calc} dur="{self.seconds:g}s" repeatCount="indefinite"/>'

    def capsule_through(self, ends, radius, color, edge=None):
        """An LSS that moves: per frame both ends, in pixels. An edge is drawn around it."""
        self.lines += 1
        name, first, parts = f"l{self.lines}", [], []
        for key, track in zip(("x1", "y1", "x2", "y2"), zip(*((*a, *b) for a, b in ends))):
            first.append(f'{key}="{numbers(track[:1])}"')
            if len(set(numbers([v]) for v in track)) > 1:
                parts.append(self.animated(key, numbers(track)))
        self.parts.append(f'<defs><line id="{name}" {" ".join(first)} stroke-linecap="round">{"".join(parts)}</line></defs>')
        if edge:
            self.parts.append(f'<use href="#{name}" stroke="{edge}" stroke-width="{2 * radius + 2:.1f}"/>')
        self.parts.append(f'<use href="#{name}" stroke="{color}" stroke-width="{2 * radius:.1f}"/>')

    def when(self, is_shown, draw):
        """What `draw` draws, in the frames that say so."""
        runs = [(0, bool(is_shown[0]))]
        for i, shown in enumerate(is_shown):
            if bool(shown) != runs[-1][1]:
                runs.append((i, bool(shown)))
        opacity = ";".join("1" if shown else "0" for _, shown in runs)
        times = ";".join(f"{i / self.frames:.4g}" for i, _ in runs)
        self.parts.append(f'<g opacity="{int(runs[0][1])}">')
        if len(runs) > 1:
            self.parts.append(self.animated("opacity", opacity, f' keyTimes="{times}" calcMode="discrete"'))
        draw()
        self.parts.append("</g>")
