#!/usr/bin/python3
"""Writes the book's pictures as SVG (and, with rsvg-convert, as PNG): front, spine, back and the edges of the pages.

The emblem is computed, not drawn: the polhodes of this very book, that is the curves on which the tip of the angular velocity
moves over the inertia ellipsoid sum I_i w_i^2 = 1, each the cut with sum I_i^2 w_i^2 = L^2 (Landau & Lifshitz, Mechanics, section 37).
The separatrix L^2 = I_x, through the unstable axis x, is the red one. One unit is a thousandth of the scenes' unit of length.
"""
import math
import pathlib
import random
import subprocess

HERE = pathlib.Path(__file__).parent
YELLOW, INK, BLUE, CREAM, RED, PAPER = "#eeb32b", "#12294a", "#245a9c", "#f7f0dd", "#c8401c", "#e9dfc6"
SIZE = (1.878, 2.9085, 0.5)
I = [SIZE[1]**2 + SIZE[2]**2, SIZE[0]**2 + SIZE[2]**2, SIZE[0]**2 + SIZE[1]**2]  # x: middle, y: smallest, z: largest
SPACE = "\u2005"
COVER_W, COVER_H, SPINE_W = 1773, 2908.5, 600
FONT = 'font-family="Inter Display, Inter"'


def svg(name, width, height, pixels, body, background):
    text = (f'<svg xmlns="http://www.w3.org/2000/svg" width="{pixels[0]}" height="{pixels[1]}" '
            f'viewBox="0 0 {width} {height}" preserveAspectRatio="none">\n'
            f'<rect width="{width}" height="{height}" fill="{background}"/>\n{body}\n</svg>\n')
    (HERE / f"{name}.svg").write_text(text, encoding="utf-8")
    subprocess.run(["rsvg-convert", "-o", HERE / f"{name}.png", HERE / f"{name}.svg"], check=True)


def polhode(L2, sign, steps=240):
    """Points of one closed polhode; round z when L2 > I_x, round y when L2 < I_x."""
    x, a, c = 0, (1 if L2 > I[0] else 2), (2 if L2 > I[0] else 1)  # a: the other axis across, c: the circled axis
    left = abs(I[c] - L2)
    rx = math.sqrt(left / (I[x] * abs(I[c] - I[x])))
    ra = math.sqrt(left / (I[a] * abs(I[c] - I[a])))
    for k in range(steps + 1):
        w = [0.0, 0.0, 0.0]
        w[x] = rx * math.cos(2 * math.pi * k / steps)
        w[a] = ra * math.sin(2 * math.pi * k / steps)
        w[c] = sign * math.sqrt(max(0.0, (1 - I[x] * w[x]**2 - I[a] * w[a]**2) / I[c]))
        yield w


def separatrix(sign, steps=480):
    """One of the two ellipses through the unstable axis."""
    slope = sign * math.sqrt(I[1] * (I[0] - I[1]) / (I[2] * (I[2] - I[0])))  # w_z / w_y
    ry = 1 / math.sqrt(I[1] + I[2] * slope**2)
    for k in range(steps + 1):
        angle = 2 * math.pi * k / steps
        y = ry * math.sin(angle)
        yield [math.cos(angle) / math.sqrt(I[0]), y, slope * y]


def view_rows(yaw, pitch, roll):
    """Rows: right, up, towards the eye, in body coordinates."""
    eye = (math.cos(pitch) * math.cos(yaw), math.sin(pitch), math.cos(pitch) * math.sin(yaw))
    right = (-math.sin(yaw), 0.0, math.cos(yaw))
    right = tuple(-v for v in right)
    up = tuple(eye[(i + 1) % 3] * right[(i + 2) % 3] - eye[(i + 2) % 3] * right[(i + 1) % 3] for i in range(3))
    c, s = math.cos(roll), math.sin(roll)
    return (tuple(c * r + s * u for r, u in zip(right, up)), tuple(c * u - s * r for r, u in zip(right, up)), eye)


def emblem(cx, cy, scale, line, paper, ink, accent):
    rows = view_rows(math.radians(40), math.radians(24), math.radians(16))
    dot = lambda a, b: sum(p * q for p, q in zip(a, b))
    place = lambda w: (cx + scale * dot(rows[0], w), cy - scale * dot(rows[1], w))
    faces = lambda w: dot(rows[2], [I[i] * w[i] for i in range(3)]) > 0

    def visible_paths(points, stroke, width):
        paths, run = [], []
        for w in points:
            if faces(w):
                run.append(place(w))
            elif run:
                paths.append(run)
                run = []
        if run:
            paths.append(run)
        return "".join(
            f'<path d="M{" L".join(f"{x:.1f} {y:.1f}" for x, y in p)}" fill="none" stroke="{stroke}" '
            f'stroke-width="{width}" stroke-linejoin="round"/>\n' for p in paths if len(p) > 1)

    # The outline: the ellipsoid's shadow is the ellipse of the inverse inertia seen in the picture plane.
    a = sum(rows[0][i]**2 / I[i] for i in range(3))
    b = sum(rows[0][i] * rows[1][i] / I[i] for i in range(3))
    d = sum(rows[1][i]**2 / I[i] for i in range(3))
    mean, spread = (a + d) / 2, math.hypot((a - d) / 2, b)
    angle = -math.degrees(math.atan2(2 * b, a - d) / 2)
    r1, r2 = scale * math.sqrt(mean + spread), scale * math.sqrt(mean - spread)
    ellipse = f'<ellipse rx="{r1:.1f}" ry="{r2:.1f}" transform="translate({cx} {cy}) rotate({angle:.2f})"'
    out = [f'{ellipse} fill="{paper}"/>\n']
    out.append(f'<clipPath id="body">{ellipse}/></clipPath>\n<g clip-path="url(#body)">\n')
    for axis, inner, count in ((2, I[2], 5), (1, I[1], 6)):
        for k in range(1, count):
            # Evenly spaced in the angle from the circled axis, not in L^2.
            L2 = inner + (I[0] - inner) * (k / count)**2
            for sign in (1, -1):
                out.append(visible_paths(polhode(L2, sign), ink, line))
    for sign in (1, -1):
        out.append(visible_paths(separatrix(sign), accent, 2.3 * line))
    out.append("</g>\n")
    out.append(f'{ellipse} fill="none" stroke="{ink}" stroke-width="{1.7 * line}"/>\n')
    for axis in range(3):  # where the axes come out
        w = [0.0, 0.0, 0.0]
        w[axis] = 1 / math.sqrt(I[axis])
        w = w if faces(w) else [-v for v in w]
        x, y = place(w)
        out.append(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="{(2.6 if axis == 0 else 1.9) * line:.1f}" '
                   f'fill="{accent if axis == 0 else ink}"/>\n')
    return "".join(out)


def front():
    body = [f'<rect x="0" y="0" width="{COVER_W}" height="{COVER_H}" fill="{YELLOW}"/>',
            f'<rect x="0" y="2010" width="{COVER_W}" height="{COVER_H - 2010}" fill="{BLUE}"/>',
            f'<rect x="0" y="1985" width="{COVER_W}" height="30" fill="{RED}"/>',
            emblem(905, 1000, 1740, 15, CREAM, INK, RED),
            f'<text x="160" y="2340" {FONT} font-weight="700" font-size="292" letter-spacing="-4" fill="{CREAM}">Classical</text>',
            f'<text x="160" y="2640" {FONT} font-weight="700" font-size="292" letter-spacing="-4" fill="{CREAM}">Mechanics</text>']
    svg("front", COVER_W, COVER_H, (1024, 1536), "\n".join(body), YELLOW)


def back():
    sub = lambda n, gap: (f'<tspan dy="44" font-size="118">{n}</tspan><tspan dy="-44" dx="{gap}" '
                          f'font-size="176">\u200b</tspan>')
    line = lambda a, b, c: (f'I\u200a{sub(a, 10)}ω̇{sub(a, 46)}={SPACE}(I\u200a{sub(b, 44)}−{SPACE}I\u200a{sub(c, 8)}){SPACE}ω{sub(b, 34)}ω{sub(c, 0)}')
    rows = [line("x", "y", "z"), line("y", "z", "x"), line("z", "x", "y")]
    body = [f'<rect x="0" y="0" width="{COVER_W}" height="{COVER_H}" fill="{BLUE}"/>']
    for i, row in enumerate(rows):
        body.append(f'<text x="{COVER_W / 2}" y="{560 + 330 * i}" text-anchor="middle" {FONT} font-weight="600" '
                    f'font-size="176" fill="{CREAM if i else YELLOW}">{row}</text>')
    body.append(f'<rect x="160" y="1500" width="{COVER_W - 320}" height="16" fill="{YELLOW}"/>')
    for i, text in enumerate(("Throw this book.", "It will tumble", "about one axis", "of the three.")):
        body.append(f'<text x="160" y="{1790 + 225 * i}" {FONT} font-weight="600" font-size="190" fill="{CREAM}">{text}</text>')
    svg("back", COVER_W, COVER_H, (1024, 1536), "\n".join(body), BLUE)


def spine():
    body = [f'<rect x="0" y="290" width="{SPINE_W}" height="24" fill="{YELLOW}"/>',
            f'<rect x="0" y="{COVER_H - 314}" width="{SPINE_W}" height="24" fill="{YELLOW}"/>',
            f'<text transform="translate(232 {COVER_H / 2}) rotate(90)" text-anchor="middle" {FONT} font-weight="700" '
            f'font-size="196" fill="{YELLOW}">Classical Mechanics</text>']
    svg("spine", SPINE_W, COVER_H, (256, 1536), "\n".join(body), BLUE)


def pages():
    rng = random.Random(1)
    leaves = 64
    body = []
    for i in range(leaves):
        near_board = min(i + 0.5, leaves - i - 0.5) / leaves
        light = (0.90 + 0.10 * rng.random()) * (0.62 + 0.38 * min(1.0, near_board / 0.10))
        color = "#" + "".join(f"{round(255 * light * c):02x}" for c in (0.955, 0.915, 0.82))
        body.append(f'<rect x="0" y="{i * 4}" width="512" height="4" fill="{color}"/>')
    svg("pages", 512, 256, (512, 256), "\n".join(body), PAPER)


if __name__ == "__main__":
    front()
    back()
    spine()
    pages()
