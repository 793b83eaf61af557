"""Strokes for hand-drawn looking sprites on a clear ground. Positions are in pixels, y grows downward."""
import numpy as np

from color import lift, ramp, rgb
from noise import N, X, Y, fbm, rng, roll
from tex import Tex


def sprite(name, rough=.8):
    return Tex(name, rough).empty()


def outline(t, m, amount=.35):
    """Darkens what already lies just right of and below a new part, so that parts read apart."""
    p = np.pad(m, 1)
    around = (p[:-2, 1:-1] | p[1:-1, :-2]) & ~m & (t.a > 0)
    t.rgb[around] *= 1 - amount


def curve(points, steps=60):
    """A smooth path through 2, 3 or 4 Bezier points."""
    u = np.linspace(0, 1, steps)[:, None]
    q = [np.repeat(np.asarray(a, float)[None], steps, 0) for a in points]
    while len(q) > 1:
        q = [a * (1 - u) + b * u for a, b in zip(q, q[1:])]
    return q[0]


def stroke(t, points, w0, w1, pal, tone=.5, gradient=.25, h=1.2, seam=True):
    """A tapering stroke; the left side is lit, the tip lighter than the root."""
    path = curve(points)
    best = np.full((N, N), 1e9)
    side, along = np.zeros((N, N)), np.zeros((N, N))
    for k, (x, y) in enumerate(path):
        u = k / (len(path) - 1)
        w = max((w0 + (w1 - w0) * u) / 2, .5)
        dx, dy = X + .5 - x, Y + .5 - y
        d = np.hypot(dx, dy) / w
        near = d < best
        best[near], side[near], along[near] = d[near], (dx / w)[near], u
    m = best < 1.02
    if seam:
        outline(t, m)
    f = tone - .5 * gradient + gradient * along - .13 * np.clip(side, -1, 1)
    t.shade(m, pal, np.clip(f, 0, .999))
    t.h[m] = h * np.sqrt(np.clip(1.05 - best[m] ** 2, 0, 1))
    return m


def leaf(t, x, y, angle, length, width, pal, tone=.5, rib=True, h=1.2):
    """A pointed leaf growing from x, y; angle 0 is right, 90 up."""
    a = np.radians(angle)
    c, s = np.cos(a), -np.sin(a)
    dx, dy = X + .5 - x, Y + .5 - y
    u, v = (dx * c + dy * s) / length, (-dx * s + dy * c) / (width / 2)
    m = (u > -.02) & (u < 1) & (abs(v) < np.maximum(np.sin(np.pi * np.clip(u, 0, 1) ** .8), .3))
    outline(t, m)
    lit = np.where(v * np.sign(c + 1e-6) < 0, .12, -.10)
    f = tone + lit + .14 * (u - .5)
    t.shade(m, pal, np.clip(f, 0, .999))
    if rib:
        t.shade(m & (abs(v) < 1.2 / width), pal, np.full_like(X, min(tone + .26, .99)))
    t.h[m] = h * (1 - np.clip(abs(v[m]), 0, 1) * .8)
    return m


def ball(t, x, y, r, pal, tone=.5, squash=1., h=2., e=None, contrast=.3):
    dx, dy = (X + .5 - x) / r, (Y + .5 - y) / (r * squash)
    d = dx * dx + dy * dy
    m = d < 1.05
    outline(t, m)
    t.shade(m, pal, np.clip(tone - contrast * (dx + dy) * .6 - .12 * d, 0, .999))
    t.h[m] = h * np.sqrt(np.clip(1.05 - d[m], 0, 1))
    if e is not None:
        t.glow(m, e)
    return m


def bloom(t, x, y, r, petals, pal, core, turn=0., depth=.35, core_r=.3, squash=1., tone=.6):
    """A flower head: petals round a core, each petal lit from the upper left."""
    dx, dy = X + .5 - x, (Y + .5 - y) / squash
    d, a = np.hypot(dx, dy), np.arctan2(dy, dx) + turn
    lobe = np.cos(petals * a)
    m = d < r * (1 - depth * .5 + depth * .5 * lobe)
    outline(t, m, .4)
    f = tone - .16 * (dx + dy) / r + .16 * lobe + .1 * (d / r - .5)
    t.shade(m, pal, np.clip(f, 0, .999))
    if core is not None:
        ball(t, x, y, max(r * core_r, .8), ramp(core, .14, .14, 5), .55, squash)
    t.h[m] = 1.5 - .6 * (d[m] / r)
    return m


def tuft(t, name, pal, count, height=(10, 26), width=2.2, spread=11, lean=9, base=32, x=16, tone=.5, droop=.25):
    """Grass: blades fanning out from a clump, the tall ones behind."""
    r = rng(name + "/tuft")
    blades = []
    for k in range(count):
        u = (k + .5) / count * 2 - 1
        hgt = height[0] + (height[1] - height[0]) * (1 - abs(u)) ** .7 * r.uniform(.7, 1.05)
        blades.append((hgt, u + r.uniform(-.15, .15)))
    for hgt, u in sorted(blades, reverse=True):
        x0 = x + u * spread * .75
        x1 = x0 + u * lean + r.uniform(-1.5, 1.5)
        top = base - hgt
        stroke(t, [(x0, base + .5), (x0 + (x1 - x0) * .2, base - hgt * .6), (x1, top + droop * abs(x1 - x0))], width, .8, pal,
               tone + r.uniform(-.14, .10), .42)
    return t


def shoots(t, name, pal, base, n, reach=7, height=(4, 9), width=3.):
    """Leaves at the foot of a stem."""
    r = rng(name + "/shoots")
    for k in range(n):
        side = -1 if k % 2 else 1
        a = 90 - side * r.uniform(28, 62)
        leaf(t, base, 31.5, a, r.uniform(*height), width, pal, .45 + r.uniform(-.08, .08))
    return t


def stalk(t, x0, x1, top, pal, w=1.7, base=32.5, bend=0.):
    return stroke(t, [(x0, base), (x0 + bend, (base + top) / 2), (x1, top)], w, max(w * .75, 1.2), pal, .5, .2)


def pal(color, dark=.2, light=.16, n=7):
    return ramp(color, dark, light, n)


GREEN = ramp("#5f9638", .22, .16, 8)
DEEP_GREEN = ramp("#3f7a40", .2, .16, 8)
OLIVE = ramp("#7f9440", .2, .16, 8)
