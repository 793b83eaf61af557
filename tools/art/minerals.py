"""Ores: faceted gems and lumps set into the rock they are found in."""
import numpy as np

from color import blend, lift, ramp, rgb
from noise import N, X, Y, Cells, fbm, points, rng, roll, ss, value, wrap
from soil import SOILS
from stone import NATURAL
from tex import Tex, add

ORES = {"coal": ("#33343c", "lump"), "iron": ("#d8ac8c", "lump"), "copper": ("#d0704a", "lump"), "gold": ("#f6cf48", "lump"),
        "redstone": ("#d3211a", "grain"), "emerald": ("#2fd070", "gem"), "lapis": ("#2f5fc8", "grain"), "diamond": ("#6ae6e2", "gem")}
SPOTS = [(8, 7, 1.), (23, 6, .8), (27, 19, .95), (14, 18, 1.1), (5, 26, .7), (20, 28, .9)]


def gem(t, x, y, r, pal, kind, turn, glow=0.):
    dx, dy = wrap(X + .5 - x), wrap(Y + .5 - y)
    c, s = np.cos(turn), np.sin(turn)
    u, v = dx * c - dy * s, dx * s + dy * c
    if kind == "gem":
        # A cut stone: a hexagon standing on its point.
        d = np.maximum(np.abs(u) * 1.12, np.abs(u) * .56 + np.abs(v) * .80)
    elif kind == "lump":
        d = (np.abs(u) ** 1.5 + np.abs(v * 1.15) ** 1.5) ** (1 / 1.5) + .35 * value(f"lump{turn:.2f}", 8, 8)
    else:
        d = np.abs(u) + np.abs(v)
    m = d < r
    rim = (d < r + 1.1) & ~m
    t.rgb[rim & (dx + dy > 0)] *= 1.10
    t.rgb[rim & (dx + dy <= 0)] *= .62
    if kind == "gem":
        # Six facets, each of one tone, about a table that shines.
        sector = np.floor(((np.arctan2(v, u) + np.pi) / (2 * np.pi) * 6 + .5) % 6).astype(int)
        f = np.array([.56, .74, .62, .34, .14, .28])[sector]
        f = np.where(d < r * .5, .70, f)
    else:
        sector = np.floor((np.arctan2(dy, dx) + np.pi) / (2 * np.pi) * 5 + turn).astype(int) % 6
        face = np.array([.10, -.08, .16, -.16, .02, -.02])[sector] if kind == "lump" else 0
        f = .5 - .30 * (dx + dy) / (2 * r) + face + .12 * (d < r * .45)
    t.shade(m, pal, np.clip(f, 0, .999), r=.25 if kind == "gem" else .45)
    t.put(m & (np.hypot(dx + r * .35, dy + r * .35) < .75), pal[-1])
    t.h[m] = t.h.mean() + 2.4 * (1 - np.clip(d[m] / r, 0, 1)) ** .6
    if glow:
        t.glow(m, glow)


def ore(name, of, color, kind, glow=0.):
    painter, args, kw = of
    t = painter(name.split("_ore")[0].startswith("deepslate") and "deepslate" or ("netherrack" if "nether" in name else "stone"), *args, **kw)
    r = rng(name)
    pal = ramp(color, .26, .2, 8, shift=.03)
    for x, y, s in SPOTS:
        x, y = x + r.uniform(-1.5, 1.5), y + r.uniform(-1.5, 1.5)
        if kind == "gem":
            gem(t, x, y, 3.9 * s, pal, kind, r.uniform(-.35, .35), glow)
            if s > .9:
                gem(t, x + 4.2, y + 3.2, 2.1, pal, kind, r.uniform(-.35, .35), glow)
        elif kind == "lump":
            gem(t, x, y, 3.6 * s, pal, kind, r.uniform(0, 3), glow)
            gem(t, x + r.uniform(2.5, 4), y + r.uniform(-2.5, 2.5), 2.0 * s, pal, kind, r.uniform(0, 3), glow)
        else:
            for _ in range(5):
                gem(t, x + r.uniform(-3, 3), y + r.uniform(-3, 3), r.uniform(1.2, 2.3) * s, pal, kind, r.uniform(0, 3), glow)
    return t


def spots_in(name, of, key, color, kind):
    painter, args, kw = of
    t = painter(key, *args, **kw)
    pal = ramp(color, .24, .16, 8)
    r = rng(name)
    for x, y, s in SPOTS:
        for _ in range(3):
            gem(t, x + r.uniform(-3, 3), y + r.uniform(-3, 3), r.uniform(1.5, 2.8) * s, pal, kind, r.uniform(0, 3))
    return t


def debris(name, top):
    t = Tex(name, .6)
    if top:
        d, a = np.hypot(X - 15.5, Y - 15.5), np.arctan2(Y - 15.5, X - 15.5)
        u = (d * .75 + a * .8 + .8 * fbm(name, 4, 4, 2))
        f = .5 + .28 * np.sin(u * 1.6)
    else:
        u = Y + 2 * fbm(name, 3, 3, 2)
        f = .5 + .28 * np.sin(u / 32 * 2 * np.pi * 5) + .12 * fbm(name + "/g", 6, 6, 2)
    t.fill(np.clip(f, 0, .99), ramp("#69483f", .18, .2, 8))
    t.h = f * 2
    return t


def amethyst(name, budding=False):
    t = Tex(name, .2)
    c = Cells(points(name, 5, 5, .95), power=1.3)
    f = .5 + c.per(name, -.24, .24) - .05 * (c.vx + c.vy) - .12 * (c.edge < .4)
    t.fill(np.clip(f, 0, .99), ramp("#8a62c6", .2, .2, 8, shift=.03))
    t.h = 2.4 * ss(0, 3, c.edge)
    if budding:
        a = np.arctan2(Y - 15.5, X - 15.5)
        d = np.hypot(X - 15.5, Y - 15.5)
        m = (d < 11) & (np.abs(np.sin(a * 3)) < .22 + .5 / (d + 1))
        t.shade(m, ramp("#d9b8f6", .1, .1, 5), np.clip(1 - d / 14, 0, .99), h=3.)
    return t


for _o, (_c, _k) in ORES.items():
    add(_o + "_ore", ore, NATURAL["stone"], _c, _k)
    add(f"deepslate_{_o}_ore", ore, NATURAL["deepslate"], _c, _k)

add("nether_gold_ore", ore, SOILS["netherrack"], "#f6cf48", "lump")
add("nether_quartz_ore", ore, SOILS["netherrack"], "#efe6de", "gem")
add("gilded_blackstone", spots_in, NATURAL["blackstone"], "blackstone", "#f2bc3c", "lump")
add("ancient_debris_side", debris, False)
add("ancient_debris_top", debris, True)
add("amethyst_block", amethyst)
add("budding_amethyst", amethyst, True)
