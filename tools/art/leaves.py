"""Leaves: clusters of small leaf shapes with see-through gaps between them."""
import numpy as np

from color import blend, gray, lift, ramp, rgb
from noise import N, X, Y, fbm, points, rng, roll, wrap
from tex import Tex, add


def leaf_shape(dx, dy, angle, length, width, kind):
    """Mask, position along and across the leaf for wrapped offsets."""
    c, s = np.cos(angle), np.sin(angle)
    u, v = (dx * c + dy * s) / length, (-dx * s + dy * c) / width
    if kind == "needle":
        return (abs(u) < 1) & (abs(v) < 1), u, v
    if kind == "round":
        return u * u + v * v < 1, u, v
    if kind == "lobed":
        a = np.arctan2(v, u)
        return np.hypot(u, v) < .72 + .3 * np.cos(5 * a), u, v
    if kind == "fan":
        a = np.arctan2(v, u)
        return (np.hypot(u, v) < 1) & (abs(a) < 1.0) & ((np.floor(a * 5) % 2) == 0), u, v
    return (abs(v) < (1 - u * u) * (1 - .25 * u)) & (abs(u) < 1), u, v


def leaves(name, pal, kind="oval", count=(34, 40, 26), size=3.3, thin=.52, spread=.9, hang=None, gaps=True, bloom=None, rough=.75, fill=False):
    """Three layers from dark and deep to light and near; each leaf has a midrib, a lit and a shaded half."""
    t = Tex(name, rough)
    t.a[:] = 0
    t.bump = .45
    r = rng(name)
    n = len(pal)
    if fill:
        t.fill(.12 + .1 * fbm(name + "/under", 6, 6, 2), pal)
        t.a[:] = 1
    for layer, k in enumerate(count):
        g = int(np.ceil(np.sqrt(k)))
        pts = points(f"{name}/{layer}", g, g, 1.0)
        r.shuffle(pts)
        for x, y in pts[:k]:
            dx, dy = wrap(X - x), wrap(Y - y)
            angle = r.uniform(0, 2 * np.pi) if hang is None else hang + r.normal(0, spread)
            length = size * r.uniform(.8, 1.15)
            m, u, v = leaf_shape(dx, dy, angle, length, max(length * thin, .75), kind)
            tone = .20 + .21 * layer + r.uniform(-.08, .08)
            lit = np.where(v * np.cos(angle) - u * np.sin(angle) * .3 < 0, .13, -.05)
            f = tone + lit - .012 * (dx + dy) + (.1 * (abs(v) < .22) if size > 2.6 else 0)
            edge = m & ~roll(m, -1, -1)
            # A dark seam below each leaf keeps the leaves apart when seen from far away.
            seam = roll(m, 1, 1) & ~m & (t.a > 0)
            t.rgb[seam] = pal[max(0, layer - 1)]
            t.shade(m, pal, np.clip(f, 0, .999))
            t.shade(edge, pal, np.clip(f - .16, 0, .999))
            t.h[m] = 1.2 * layer + (1 - v[m] ** 2) * .8
    close_pinholes(t, pal)
    if bloom:
        colors, number, radius = bloom
        flowers(t, name, colors, number, radius)
    return t


def close_pinholes(t, pal, least=4):
    """Gaps of a pixel or two only flicker in the distance: they become shadow; the larger ones stay open."""
    clear = t.a == 0
    label = np.where(clear, np.arange(N * N).reshape(N, N), -1)
    for _ in range(40):
        best = label
        for dx, dy in ((1, 0), (-1, 0), (0, 1), (0, -1)):
            best = np.maximum(best, np.where(clear, roll(label, dx, dy), -1))
        if (best == label).all():
            break
        label = best
    sizes = np.bincount(label[clear], minlength=N * N) if clear.any() else np.zeros(N * N, int)
    small = clear & (sizes[np.maximum(label, 0)] < least)
    t.put(small, pal[0])


def flowers(t, name, color, number, radius):
    r = rng(name + "/bloom")
    pal = ramp(color, .14, .14, 5)
    for x, y in points(name + "/bl", int(np.sqrt(number) + .5), int(np.sqrt(number) + .5), 1.):
        dx, dy = wrap(X - x), wrap(Y - y)
        d = np.hypot(dx, dy)
        a = np.arctan2(dy, dx) + r.uniform(0, 6)
        m = d < radius * (.75 + .35 * np.cos(5 * a))
        t.put(roll(m, 1, 1) & ~m & (t.a > 0), t.rgb * .7)
        t.shade(m, pal, np.clip(.6 - .1 * (dx + dy) / radius, 0, .99), h=4.)
        t.put(d < .8, lift(color, .22))


GREENS = {
    "spruce_leaves": (blend("#12261e", "#234434", "#356049", "#4f7d58", "#74986a", n=8), dict(kind="needle", size=3.6, thin=.2, count=(70, 70, 50), hang=1.1, spread=.7)),
    "birch_leaves": (blend("#3d5f28", "#587e35", "#759843", "#93b152", "#b9cc72", n=8), dict(size=2.8, thin=.62, count=(44, 50, 36))),
    "cherry_leaves": (blend("#c0709a", "#d88bb0", "#eaa6c4", "#f5c0d4", "#fcdde6", n=8), dict(kind="lobed", size=3.0, thin=1.0, count=(30, 36, 26))),
    "pale_oak_leaves": (blend("#4a5048", "#636b60", "#7e877a", "#9aa394", "#bcc3b4", n=8), {}),
    "azalea_leaves": (blend("#26401a", "#41632a", "#5d8438", "#82a64a", "#aecb6c", n=8), dict(size=2.9, thin=.7)),
    "flowering_azalea_leaves": (blend("#26401a", "#41632a", "#5d8438", "#82a64a", "#aecb6c", n=8), dict(size=2.9, thin=.7, bloom=("#d863b8", 12, 2.4))),
    "redwood_leaves": (blend("#152a1c", "#27482c", "#3f693a", "#5f8a48", "#8bab5e", n=8), dict(kind="needle", size=3.0, thin=.24, count=(80, 80, 60))),
    "cypress_leaves": (blend("#1f3422", "#365138", "#50714c", "#71905f", "#9bb47c", n=8), dict(kind="needle", size=2.6, thin=.3, count=(80, 90, 70), hang=1.57, spread=.4)),
    "palm_leaves": (blend("#1c3d1c", "#2f6327", "#4b8a33", "#76ad45", "#b0cf66", n=8), dict(kind="needle", size=6.5, thin=.13, count=(40, 44, 26), hang=.7, spread=.5)),
    "pine_leaves": (blend("#142a20", "#254a31", "#3a6a3d", "#5a8b4b", "#86ab60", n=8), dict(kind="needle", size=4.2, thin=.18, count=(64, 64, 40))),
    "shrub_leaves": (blend("#2a3a1a", "#465c28", "#677f38", "#8fa24c", "#bdc672", n=8), dict(kind="round", size=2.0, thin=.8, count=(64, 64, 49))),
    "yellow_birch_leaves": (blend("#8c6416", "#b3841f", "#d3a02c", "#e8bd44", "#f5d970", n=8), dict(size=2.8, thin=.62, count=(44, 50, 36))),
    "orange_birch_leaves": (blend("#8a3414", "#b04c1c", "#d26a28", "#e88a3a", "#f6b060", n=8), dict(size=2.8, thin=.62, count=(44, 50, 36))),
    "rafflesia_leaves": (blend("#143022", "#1f4e33", "#357244", "#5b9757", "#95bd78", n=8), dict(size=4.6, thin=.55, count=(20, 22, 14))),
}
for _n, (_pal, _kw) in GREENS.items():
    add(_n, leaves, _pal, **_kw)
add("oak_leaves", leaves, gray(.34, .98, 8), kind="lobed", size=3.7, thin=.75, count=(26, 30, 20))
add("jungle_leaves", leaves, gray(.32, .98, 8), size=4.4, thin=.5, count=(28, 30, 20))
add("acacia_leaves", leaves, gray(.36, .98, 8), kind="round", size=1.9, thin=.6, count=(64, 70, 49))
add("dark_oak_leaves", leaves, gray(.30, .92, 8), kind="lobed", size=4.0, thin=.75, count=(28, 32, 22))
add("mangrove_leaves", leaves, gray(.34, .96, 8), size=3.4, thin=.6, count=(36, 40, 26))
