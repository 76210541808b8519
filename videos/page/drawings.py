#!/usr/bin/python3
"""Writes the course page's drawings, the SVG files beside this script. Computed, not drawn; colors and widths are page.css's."""
import importlib.util
import itertools
import math
import pathlib

HERE = pathlib.Path(__file__).parent
spec = importlib.util.spec_from_file_location("cover", HERE.parents[1] / "textures" / "cover.py")
cover = importlib.util.module_from_spec(spec)
spec.loader.exec_module(cover)


def line(points, style, tag="polyline"):
    return f'<{tag} class="{style}" points="{" ".join(f"{x:.1f},{y:.1f}" for x, y in points)}"/>\n'


def dot(point, radius=3.2, style="dot"):
    return f'<circle class="{style}" cx="{point[0]:.1f}" cy="{point[1]:.1f}" r="{radius}"/>\n'


def word(x, y, text, style="small"):
    return f'<text class="{style}" x="{x:.0f}" y="{y:.0f}">{text}</text>\n'


def key(x, y, style, text):
    return line([(x, y), (x + 22, y)], style) + word(x + 29, y + 4, text)


def svg(name, width, height, label, *body):
    (HERE / f"{name}.svg").write_text(f'<svg class="drawing" viewBox="0 0 {width} {height}" role="img" aria-label="{label}">\n'
                                      f'{"".join(body)}</svg>\n', encoding="utf-8")


def euler(h_omega=0.5, steps=7, radius=62, cx=176, cy=134):
    """x' = -omega y, y' = omega x from (1, 0), by explicit Euler and in truth."""
    walk = [(1.0, 0.0)]
    for _ in range(steps):
        x, y = walk[-1]
        walk.append((x - h_omega * y, y + h_omega * x))
    place = lambda p: (cx + radius * p[0], cy - radius * p[1])
    truth = [(math.cos(n * h_omega), math.sin(n * h_omega)) for n in range(steps + 1)]
    svg("euler", 340, 214, "Steps of explicit Euler leave a circle along its tangents, in a spiral outwards.",
        f'<circle class="thin" cx="{cx}" cy="{cy}" r="{radius}"/>\n',
        line([place((0, 0)), place(walk[0])], "thin"), line([place((0, 0)), place(walk[-1])], "thin"),
        line(map(place, walk), "strong"), *(dot(place(p)) for p in walk), *(dot(place(p), 2.4, "full") for p in truth),
        word(cx + 24, cy + 15, "r₀", "letter"), word(cx - 92, cy - 14, "r₇", "letter"),
        word(cx + radius + 10, cy - 18, "the first step"), word(cx - 36, cy + radius + 15, "the true circle"))


def springs(yaw=math.radians(32), pitch=math.radians(22), size=(1.878, 2.9085, 0.9)):
    """All 28, with the book thicker than it is, so that one sees through."""
    def place(corner):
        x, y, z = (size[d] * (0.5 if corner >> d & 1 else -0.5) for d in range(3))
        x, z = x * math.cos(yaw) + z * math.sin(yaw), z * math.cos(yaw) - x * math.sin(yaw)
        return 92 + 58 * x, 106 - 58 * (y * math.cos(pitch) - z * math.sin(pitch))
    styles = {1: "strong", 2: "thin", 3: "dash"}  # by the number of axes along which the two ends differ
    pairs = sorted(itertools.combinations(range(8), 2), key=lambda pair: -(pair[0] ^ pair[1]).bit_count())
    svg("springs", 340, 214, "Eight particles at the corners of a book, every two of them joined by a spring.",
        *(line([place(i), place(j)], styles[(i ^ j).bit_count()]) for i, j in pairs), *(dot(place(i), 5) for i in range(8)),
        key(192, 82, "strong", "12 edges"), key(192, 106, "thin", "12 across a face"), key(192, 130, "dash", "4 through the middle"))


def blend(s=1.15, scale=33):
    """(1 - s^2) Id + s^2 R of the cover, turned about z."""
    body = []
    for n, degrees in enumerate((45, 90, 180)):
        c, sn = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
        rest = [(x * 0.939, y * 1.45425) for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
        turned = [(c * x - sn * y, sn * x + c * y) for x, y in rest]
        mixed = [tuple((1 - s * s) * p + s * s * q for p, q in zip(a, b)) for a, b in zip(rest, turned)]
        place = lambda p: (60 + 110 * n + scale * p[0], 88 - scale * p[1])
        body += [line(map(place, points), style, "polygon") for points, style in ((rest, "thin"), (turned, "dash"), (mixed, "strong"))]
        body += [dot(place(mixed[0])), word(50 + 110 * n, 184, f"{degrees}°")]
    svg("blend", 340, 214, "A book turned by 45, 90 and 180 degrees, and its blend with the unrotated book, which is larger.", *body,
        key(10, 204, "thin", "unrotated"), key(122, 204, "dash", "turned, R"), key(232, 204, "strong", "the blend"))


def polhodes(cx=150, cy=106, scale=178):
    """The emblem of the book's cover, with the names of its axes."""
    rows = cover.view_rows(math.radians(40), math.radians(24), math.radians(16))
    seen = lambda row, w: sum(a * b for a, b in zip(row, w))
    place = lambda w: (cx + scale * seen(rows[0], w), cy - scale * seen(rows[1], w))
    faces = lambda w: seen(rows[2], [i * v for i, v in zip(cover.I, w)]) > 0
    def visible(points, style):
        runs = itertools.groupby(points, faces)
        return "".join(line(map(place, run), style) for front, run in [(f, list(r)) for f, r in runs] if front and len(run) > 1)
    # The outline: the ellipsoid's shadow, sum of the semiaxes' pictures turned through all angles.
    axes = [place([1 / math.sqrt(i) if d == n else 0.0 for d in range(3)]) for n, i in enumerate(cover.I)]
    reach = lambda a: math.sqrt(sum(((x - cx) * math.cos(a) + (y - cy) * math.sin(a))**2 for x, y in axes))
    turn = lambda a: sum(((x - cx) * math.cos(a) + (y - cy) * math.sin(a)) * ((y - cy) * math.cos(a) - (x - cx) * math.sin(a)) for x, y in axes)
    outline = []
    for a in (2 * math.pi * k / 90 for k in range(91)):
        r, t = reach(a), turn(a) / reach(a)
        outline.append((cx + r * math.cos(a) - t * math.sin(a), cy + r * math.sin(a) + t * math.cos(a)))
    body = [line(outline, "thin")]
    for axis, count in ((2, 5), (1, 6)):
        for k, sign in itertools.product(range(1, count), (1, -1)):
            inner = cover.I[axis]
            body.append(visible(cover.polhode(inner + (cover.I[0] - inner) * (k / count)**2, sign, 60), "thin"))
    body += [visible(cover.separatrix(sign, 90), "strong") for sign in (1, -1)]
    for axis, name in enumerate("xyz"):
        w = [0.0, 0.0, 0.0]
        w[axis] = 1 / math.sqrt(cover.I[axis])
        x, y = place(w if faces(w) else [-v for v in w])
        body.append(dot((x, y)) + word(x + 8, y + (14 if name == "x" else -6), name, "letter"))
    svg("polhodes", 300, 214, "Rings about the axes y and z on an ellipsoid, and two curves that cross in the axis x.", *body)


euler()
springs()
blend()
polhodes()
