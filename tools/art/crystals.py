"""Crystals, buds, dripstone, stormlight."""
import numpy as np

from color import blend, lift, ramp, rgb
from noise import N, X, Y, Cells, fbm, loop, points, rng, roll, ss, value, wrap
from sprite import outline, pal, sprite
from tex import Tex, add


def prism(t, x, base, top, w, p, lean=0., tone=.5, e=0.):
    """A crystal with three visible faces and a pointed end."""
    up = (base - (Y + .5)) / (base - top)
    cx = x + lean * up
    half = w / 2 * np.clip(np.minimum(1, (1 - up) * (base - top) / (w * .9)), 0, 1)
    u = (X + .5 - cx) / np.maximum(half, .01)
    m = (up >= -.1) & (up <= 1) & (np.abs(u) <= 1.02) & (half > .3)
    outline(t, m, .45)
    tip = (1 - up) * (base - top) < w * .9
    face = np.where(u < -.35, .12, np.where(u < .4, .26, -.18)) + np.where(tip, .10, 0)
    t.shade(m, p, np.clip(tone + face - .22 + .16 * up, 0, .999), r=.15)
    t.h[m] = 2.2 * (1 - np.abs(u[m]))
    if e:
        t.glow(m, e)


def cluster(name, color, spec, down=False, e=.3, alpha=1.):
    t = sprite(name, .15)
    p = ramp(color, .24, .24, 9, shift=.03)
    for x, top, w, lean in spec:
        prism(t, x, 32.5, top, w, p, lean, .5, e)
    if alpha < 1:
        t.a[t.a > 0] = alpha
    if down:
        for k in ("rgb", "a", "h", "r"):
            setattr(t, k, getattr(t, k)[::-1].copy())
        t.e = None if t.e is None else t.e[::-1].copy()
    return t


def crystal_block(name, color):
    """Long facets seen through each other, bright along their edges."""
    t = Tex(name, .08)
    c = Cells(points(name, 4, 3, .95), sx=1.2, sy=.55, x=X + .35 * Y * 0 + 1.2 * fbm(name + "/x", 3, 3, 2), y=Y)
    c2 = Cells(points(name + "/2", 3, 3, .95), sx=.7, sy=1.1)
    f = .48 + c.per(name, -.18, .18) + c2.per(name + "2", -.10, .10) - .03 * c.vx - .012 * c.vy
    edge = (c.edge < .5)
    f = f + .26 * edge
    t.fill(np.clip(f, 0, .999), ramp(color, .2, .2, 9, shift=.03))
    t.h = c.per(name, 0, 1.) + .06 * c.vx
    t.a = np.where(edge, .86, np.round((.60 + .2 * (f - .4)) * 32) / 32)
    t.glow(np.ones_like(X, bool), .22)
    t.e += (t.rgb * .3) * edge[..., None]
    t.e = np.clip(t.e, 0, 1)
    return t


def drip(name, way, part):
    t = sprite(name, .75)
    p = ramp("#8a6b5c", .2, .16, 8)
    w0, w1 = {"tip": (6.5, .8), "tip_merge": (6.5, 4), "frustum": (10, 6.5), "middle": (13, 10), "base": (19, 13)}[part]
    up = (31.5 - Y) / 32
    half = (w0 + (w1 - w0) * up ** 1.2) / 2 + .5 * value("drip" + part, 6, 7)
    if part == "tip":
        half = np.where(up > .82, 0, (w0 * np.clip(1 - up / .86, 0, 1) ** .8 + .8) / 2 + .25 * value("drip", 6, 7))
    u = (X - 15.5) / np.maximum(half, .01)
    m = np.abs(u) < 1
    f = .55 - .3 * u + .16 * value("dripf" + part, 16, 2) + .1 * fbm("dripg", 6, 8, 2)
    t.shade(m, p, np.clip(f, 0, .99))
    t.h = np.where(m, 3 * np.sqrt(np.clip(1 - u * u, 0, 1)), 0)
    if way == "down":
        for k in ("rgb", "a", "h", "r"):
            setattr(t, k, getattr(t, k)[::-1].copy())
    return t


def stormlight(name):
    """A charge wandering inside glass: branching light over a deep blue core."""
    frames = []
    sx, sy = loop(name + "/x", 3, 3, 8), loop(name + "/y", 3, 3, 8)
    glowf = loop(name + "/g", 2, 2, 8)
    for k in range(8):
        t = Tex(name, .12)
        wx, wy = X + 4.5 * sx[k], Y + 4.5 * sy[k]
        v = np.abs(fbm(name + "/v", 3, 3, 2, wx, wy))
        arc = np.exp(-(v / .05) ** 2)
        f = .34 + .16 * glowf[k] + .62 * arc
        t.fill(np.clip(f, 0, .999), blend("#0a1440", "#1a3a8c", "#3a78dc", "#7cc4ff", "#d8f4ff", "#ffffff", n=9))
        t.glow(np.ones_like(X, bool), 1.)
        t.e *= np.clip(.45 + f, 0, 1)[..., None]
        t.h = .6 * glowf[k]
        frames.append(t)
    return frames


def shell(name):
    t = Tex(name, .3)
    c = Cells(points(name, 4, 4, .95))
    f = .45 + c.per(name, -.16, .16) - .03 * (c.vx + c.vy)
    t.fill(np.clip(f, 0, .99), blend("#0c1020", "#18203a", "#2a3658", "#4a5c84", n=7))
    m = (c.edge < .5) & (c.pair(name) < .5)
    t.put(m, rgb("#5ab0f0"))
    t.glow(m, .8)
    t.h = 1.6 * ss(0, 2.5, c.edge)
    return t


def tendril(name):
    t = sprite(name, .3)
    r = rng(name)
    p = blend("#1a3a8c", "#3a78dc", "#9ad8ff", "#ffffff", n=7)
    from sprite import stroke
    for x in (9, 16, 23):
        pts = [(x, -1)] + [(x + r.uniform(-5, 5), 6 + 6 * k) for k in range(3)] + [(x + r.uniform(-3, 3), 20 + r.uniform(0, 11))]
        for a, b in zip(pts, pts[1:]):
            t.glow(stroke(t, [a, b], 1.7, 1.3, p, .7, .2, seam=False), 1.)
    return t


BUDS = {"small_amethyst_bud": [(13, 26, 4, -1), (18.5, 27, 3.6, 1)], "medium_amethyst_bud": [(9, 25, 4, -2), (22, 24, 4.4, 2), (15.5, 19, 5.4, 0)],
        "large_amethyst_bud": [(7, 22, 4.6, -3), (24, 21, 5, 3), (12, 15, 5.4, -1), (18.5, 11, 6, 1)],
        "amethyst_cluster": [(5, 21, 4.6, -3), (26.5, 19, 5, 3), (10, 13, 5.6, -2), (21, 10, 6, 2), (15.5, 3, 7, 0), (14, 21, 4.4, -1)]}
for _n, _s in BUDS.items():
    add(_n, cluster, "#9a6ad8", _s)
    add(_n + "_down", cluster, "#9a6ad8", _s, True)
SHARD = [(6, 20, 5, -3), (26, 17, 5.4, 3), (11, 11, 6, -1.5), (20.5, 4, 7.4, 1.5), (15, 22, 5, 0)]
for _c, _h in (("magenta", "#d83cb0"), ("cyan", "#36c0dc"), ("green", "#48cc68")):
    add(_c + "_crystal", crystal_block, _h)
    add(_c + "_crystal_shard", cluster, _h, SHARD, e=.45)
    add(f"hanging_{_c}_crystal_shard", cluster, _h, SHARD, True, e=.45)
for _w in ("up", "down"):
    for _p in ("tip", "tip_merge", "frustum", "middle", "base"):
        add(f"pointed_dripstone_{_w}_{_p}", drip, _w, _p)
add("stormlight", stormlight)
add("stormlight_shell", shell)
add("stormlight_tendril", tendril)
