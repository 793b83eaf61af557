"""Mushrooms, wart blocks and the giant ones' caps and stems."""
import numpy as np

from color import blend, lift, ramp, rgb
from noise import X, Y, Cells, fbm, points, rng, roll, ss, value, wrap
from sprite import ball, outline, pal, sprite, stroke
from tex import Tex, add


def mushroom(name, cap, stem="#e6dcc8", spots=None, shape="dome", size=1., glow=0., second=True):
    t = sprite(name)
    r = rng(name)
    for x, base, k in ((21.5, 32.5, .62), (13.5, 32.5, 1.)) if second else ((16, 32.5, 1.),):
        k *= size
        top = 32 - 17 * k
        stroke(t, [(x + 1, base), (x - .5, base - 7 * k), (x, top)], 4.4 * k, 3.4 * k, pal(stem), .58, .1)
        p = pal(cap, .24, .18, 8)
        w, hgt = 9.2 * k, {"dome": 8.5, "flat": 5.5, "cone": 11}[shape] * k
        dx, dy = (X + .5 - x) / w, (Y + .5 - top - 1.5 * k) / hgt
        m = (dx * dx + (dy * (1. if shape != "cone" else .9)) ** 2 < 1) & (dy < .22)
        if shape == "cone":
            m = (np.abs(dx) < (dy + 1.1) * .85) & (dy < .15) & (dy > -1.05)
        outline(t, m, .45)
        t.shade(m, p, np.clip(.52 - .26 * dx - .30 * dy - .1, 0, .999))
        rim = m & ~np.pad(m, 1)[2:, 1:-1]
        t.shade(rim, p, np.full_like(X, .16))
        t.h[m] = 2 * np.sqrt(np.clip(1 - dx[m] ** 2, 0, 1))
        if spots:
            for _ in range(6):
                sx, sy = x + r.uniform(-.75, .75) * w, top - r.uniform(-.1, .75) * hgt
                s = (np.hypot(X + .5 - sx, (Y + .5 - sy) * 1.2) < r.uniform(.9, 1.7) * k) & m
                t.put(s, rgb(spots))
        if glow:
            t.glow(m, glow)
    return t


def nether_fungus(name, cap, stem, spot):
    t = mushroom(name, cap, stem, spot, "cone", 1.08, 0., False)
    for x, k in ((7, .45), (25, .55)):
        stroke(t, [(x, 32.5), (x + (16 - x) * .1, 32 - 10 * k)], 2, 1.6, pal(stem))
        ball(t, x + (16 - x) * .1, 32 - 12 * k, 4.5 * k, pal(cap), .55)
    return t


def wart(name, color, rough=.85):
    """Clusters of swollen warts."""
    t = Tex(name, rough)
    c = Cells(points(name, 6, 6, .95))
    f = .50 + c.per(name, -.14, .14) - .055 * (c.vx + c.vy) - .24 * (c.edge < .5) + .08 * (c.f1 < 1)
    t.fill(np.clip(f, 0, .999), ramp(color, .2, .17, 8, shift=.025))
    t.h = 2.4 * ss(0, 2.5, c.edge)
    return t


def cap_skin(name, color, spots=None, glow=0.):
    t = Tex(name, .5)
    f = .5 + .16 * fbm(name, 3, 3, 3) + .08 * value(name + "/f", 5, 14)
    t.fill(np.clip(f, 0, .99), ramp(color, .14, .12, 7))
    t.h = .8 * fbm(name, 3, 3, 3)
    if spots:
        r = rng(name)
        for x, y in points(name + "/s", 3, 3, .8):
            s = r.uniform(2, 4.2)
            dx, dy = wrap(X - x), wrap(Y - y)
            m = np.hypot(dx, dy) + .8 * value(name + "/e", 10, 10) < s
            t.put(roll(m, 1, 1) & ~m, t.rgb * .72)
            t.shade(m, ramp(spots, .12, .08, 5), np.clip(.65 - .07 * (dx + dy), 0, .99), h=2.)
            if glow:
                t.glow(m, glow)
    return t


def pores(name, color):
    t = Tex(name, .9)
    c = Cells(points(name, 8, 8, .85))
    f = .6 + c.per(name, -.1, .1) - .3 * (c.f1 < 1.2) + .06 * fbm(name, 4, 4, 2)
    t.fill(np.clip(f, 0, .99), ramp(color, .14, .08, 6), 0)
    t.h = ss(0, 1.5, c.f1)
    return t


def fleshy_stem(name, color, veil=None):
    t = Tex(name, .8)
    w = X + 1.4 * fbm(name, 4, 3, 2)
    f = .56 + .24 * value(name + "/s", 14, 2, w, Y) + .1 * value(name + "/g", 24, 5, w, Y)
    t.fill(np.clip(f, 0, .99), ramp(color, .14, .09, 7))
    t.h = 1.2 * value(name + "/s", 14, 2, w, Y)
    if veil:
        m = value(name + "/v", 6, 8, w, Y) > .5
        t.shade(m, ramp(veil, .1, .1, 5), np.clip(f, 0, .99))
    return t


def flesh_end(name, color, ring):
    t = Tex(name, .8)
    d = np.hypot(X - 15.5, Y - 15.5) + .8 * fbm(name, 4, 4, 2)
    f = .62 + .1 * np.cos(d * 1.3) - .25 * (np.maximum(abs(X - 15.5), abs(Y - 15.5)) > 14)
    t.fill(np.clip(f, 0, .99), ramp(color, .14, .08, 7))
    t.shade(np.abs(d - 8) < .8, ramp(ring, .1, .1, 5), np.full_like(X, .5))
    return t


def gills(name, color, glow):
    """The underside of a cap: thin glowing gills."""
    t = Tex(name, .7)
    w = X + 1.2 * np.sin(Y / 32 * 2 * np.pi) + .5 * fbm(name, 4, 4, 2)
    u = (w / 32 * 8) % 1
    f = .4 + .45 * np.abs(u - .5) * 2
    t.fill(np.clip(f, 0, .99), ramp(color, .2, .18, 8))
    t.h = 2 * np.abs(u - .5)
    t.glow(np.abs(u - .5) > .34, glow)
    return t


def petal(name):
    """Rafflesia: red flesh with pale raised warts."""
    t = cap_skin(name, "#b23a34", "#eec9a4")
    return t


def core(name):
    t = Tex(name, .6)
    a, d = np.arctan2(Y - 15.5, X - 15.5), np.hypot(X - 15.5, Y - 15.5)
    spikes = (np.cos(a * 9 + np.floor(d / 4) * 2) > .3) & (d > 3)
    f = .30 + .03 * d + .2 * spikes + .1 * fbm(name, 6, 6, 2)
    t.fill(np.clip(f, 0, .99), blend("#3a0c12", "#7a1a1e", "#c0482a", "#e8924a", "#f8cf8a", n=8))
    t.h = 1.4 * spikes
    t.glow(spikes, .35)
    return t


def nether_wart(name, stage):
    t = sprite(name)
    r = rng("wart")
    for x in (5, 12, 19, 26):
        hgt = (6, 11, 15)[stage] * r.uniform(.8, 1.1)
        stroke(t, [(x, 32.5), (x + r.uniform(-1, 1), 32 - hgt)], 2, 1.6, pal("#8a1f28"))
        for k in range(2 + 2 * stage):
            ball(t, x + r.uniform(-2.6, 2.6), 31 - r.uniform(.3, 1) * hgt, 1.6 + .5 * stage, pal("#a8202c"), .5 + r.uniform(-.15, .2))
    return t


add("brown_mushroom", mushroom, "#9a7350", shape="flat")
add("red_mushroom", mushroom, "#cc2a24", spots="#f4ece0")
add("purple_mushroom", mushroom, "#8a4ac0", "#d9cfe6", "#e6b8f4", "dome", 1., .35)
add("blue_mushroom", mushroom, "#3a6cc8", "#cfd9ea", "#b8e0ff", "cone", 1., .35)
add("crimson_fungus", nether_fungus, "#a8202a", "#7c3653", "#f0a03a")
add("warped_fungus", nether_fungus, "#1a9a88", "#5a3a52", "#f08a3a")
add("amber_fungus", nether_fungus, "#e29a2c", "#7a5234", "#fff0b8")
add("nether_wart_block", wart, "#7e1418")
add("warped_wart_block", wart, "#16807e")
add("amber_wart_block", wart, "#d58a26")
add("brown_mushroom_block", cap_skin, "#95704f", "#ad8a66")
add("red_mushroom_block", cap_skin, "#c22a26", "#f0e6da")
add("purple_mushroom_block", cap_skin, "#7b43a8", "#d6a6ea", .25)
add("mushroom_block_inside", pores, "#cdb08a")
add("mushroom_stem", fleshy_stem, "#d3cabb")
add("purple_mushroom_stem", fleshy_stem, "#cbbfd3", "#a78fb8")
add("purple_mushroom_stem_top", flesh_end, "#d6cbdc", "#a78fb8")
add("purple_mushroom_gills", gills, "#b077d8", .55)
add("rafflesia_petal", petal)
add("rafflesia_core", core)
add("rafflesia_stem", fleshy_stem, "#6f7a44", "#a2523c")
add("rafflesia_stem_top", flesh_end, "#98a060", "#a2523c")
for _s in range(3):
    add(f"nether_wart_stage{_s}", nether_wart, _s)
