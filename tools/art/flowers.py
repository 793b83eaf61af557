"""Flowers, small and tall."""
import numpy as np

from color import blend, lift, ramp, rgb
from noise import X, Y, rng
from sprite import DEEP_GREEN, GREEN, OLIVE, ball, bloom, leaf, outline, pal, shoots, sprite, stalk, stroke, tuft
from tex import add


def simple(name, color, heads, petals=6, core="#f2c53d", r=4.2, green=GREEN, depth=.35, core_r=.3, feet=4, squash=1., turn=.3):
    """Stems with open flower heads; heads = list of (x, y, radius factor)."""
    t = sprite(name)
    shoots(t, name, green, 16, feet, height=(8, 13))
    p = pal(color, .2, .14, 7)
    for x, y, k in sorted(heads, key=lambda q: q[1]):
        stalk(t, 16 + (x - 16) * .2, x, y, green)
    for x, y, k in sorted(heads, key=lambda q: q[1]):
        bloom(t, x, y, r * k, petals, p, core, turn + x, depth, core_r, squash)
    return t


def tulip(name, color):
    t = sprite(name)
    p = pal(color, .22, .14, 7)
    for a, length in ((58, 17), (122, 16), (75, 12), (106, 11)):
        leaf(t, 16, 32, a, length, 4, DEEP_GREEN, .5)
    stalk(t, 16, 16, 11, GREEN)
    for dx, a, tone in ((-2.2, 100, .42), (2.2, 80, .36), (0, 90, .62)):
        leaf(t, 16 + dx, 14.5, a, 11.5, 6, p, tone, rib=False)
    return t


def spike(name, color, top=4, width=5, bells=26, green=GREEN, stems=((16, 4),), feet=5, size=2.):
    """Many small blossoms along upright stems, larger below."""
    t = sprite(name)
    shoots(t, name, green, 16, feet, height=(8, 14))
    r = rng(name)
    p = pal(color, .2, .16, 7)
    for x1, y1 in stems:
        stalk(t, 16 + (x1 - 16) * .25, x1, y1, green, 1.4)
        n = bells // len(stems)
        for k in range(n):
            u = k / max(n - 1, 1)
            y = y1 + (1 - u) * 0 + u * 15
            w = width * (.25 + .75 * u)
            ball(t, x1 + r.uniform(-w, w) * .8, y + r.uniform(-1, 1), size * (.6 + .5 * u), p, .55 + r.uniform(-.18, .18))
    return t


def globe(name, color, y=8, r=6, n=40, size=1.4, green=GREEN):
    t = sprite(name)
    shoots(t, name, green, 16, 4, height=(9, 14))
    stalk(t, 16, 16, y, green)
    g = rng(name)
    p = pal(color, .24, .18, 8)
    for k in range(n):
        a, d = g.uniform(0, 6.28), r * np.sqrt(g.uniform(0, 1))
        ball(t, 16 + d * np.cos(a), y + d * np.sin(a), size, p, .5 - .055 * (d * np.cos(a) + d * np.sin(a)) + g.uniform(-.1, .1))
    return t


def orchid(name):
    t = sprite(name)
    shoots(t, name, DEEP_GREEN, 16, 5, height=(10, 15))
    stroke(t, [(15, 32), (12, 16), (20, 5)], 1.6, 1.2, GREEN)
    p = pal("#3fa9e6", .2, .18)
    for x, y, s in ((20, 6, 4.4), (14, 12, 4.), (21, 15, 3.6), (13, 19, 3.)):
        bloom(t, x, y, s, 5, p, "#f4f0b8", x, .5, .28)
    return t


def bells(name):
    t = sprite(name)
    for a, length in ((62, 19), (118, 18), (80, 15)):
        leaf(t, 16, 32.5, a, length, 6, DEEP_GREEN, .5)
    stroke(t, [(16, 32), (14, 14), (22, 5)], 1.5, 1.1, GREEN)
    p = pal("#f2f4f0", .16, .05)
    for x, y in ((22, 8), (18, 10), (14.5, 14), (20, 14), (13, 19), (18.5, 19)):
        ball(t, x, y, 2.3, p, .62, 1.1)
    return t


def torch_flower(name):
    t = sprite(name)
    shoots(t, name, DEEP_GREEN, 16, 4, height=(8, 13))
    stalk(t, 16, 16, 10, pal("#4a8a7a"), 2.2)
    for a, tone in ((130, .4), (50, .36), (108, .5), (72, .46), (90, .62)):
        leaf(t, 16, 15, a, 12, 5, blend("#8f2f0c", "#e0641a", "#ffa62e", "#ffe07a", n=7), tone, rib=False)
    m = (t.a > 0) & (Y < 15)
    t.glow(m, .7)
    return t


def eyeblossom(name, opened):
    t = sprite(name)
    stroke(t, [(16, 32.5), (13, 22), (16, 11)], 2, 1.6, pal("#6d6a66"))
    shoots(t, name, pal("#7b8078"), 16, 3, height=(7, 11))
    p = pal("#9c948e" if opened else "#6f6a68")
    if opened:
        bloom(t, 16, 9, 8, 5, p, None, .3, .5)
        ball(t, 16, 9, 2.8, pal("#f08a1e"), .65, e=.9)
    else:
        for a in (110, 70, 90):
            leaf(t, 16, 14, a, 11, 6, p, .5, rib=False)
    return t


def tall_flower(name, kind, top):
    """A bush 64 high, drawn once for each half."""
    t = sprite(name)
    off = 0 if top else -32
    key = kind
    r = rng(key)

    def at(y):
        return y + off
    green = {"lilac": DEEP_GREEN, "sunflower": GREEN, "peony": DEEP_GREEN, "rose_bush": DEEP_GREEN, "pitcher_plant": pal("#4f8f82", .2, .16, 8)}[kind]
    if kind == "sunflower":
        stroke(t, [(16, at(65)), (14, at(40)), (16, at(14))], 3, 2.2, green)
        for k, y in enumerate((58, 50, 43, 36, 29)):
            leaf(t, 16, at(y), 35 if k % 2 else 145, 12 - k, 6, green, .5)
        p = pal("#f2b822", .2, .14)
        bloom(t, 16, at(14), 13, 13, p, None, 0, .4)
        bloom(t, 16, at(14), 10.5, 13, p, None, .24, .4, tone=.72)
        ball(t, 16, at(14), 5.6, pal("#5a3516", .14, .2), .5)
        m = (np.hypot(X - 15.5, Y - at(14)) < 5) & ((X + Y) % 3 == 0)
        t.rgb[m & (t.a > 0)] *= 1.25
        return t
    if kind == "pitcher_plant":
        stroke(t, [(16, at(65)), (17, at(40)), (16, at(22))], 3, 2.6, green)
        for k, y in enumerate((60, 54, 47)):
            leaf(t, 16, at(y), 30 if k % 2 else 150, 14, 6, green, .5)
        p = pal("#7a9fd0", .2, .16)
        for a, tone in ((135, .36), (45, .32), (112, .48), (68, .44), (90, .6)):
            leaf(t, 16, at(28), a, 22, 8, p, tone)
        ball(t, 16, at(24), 6, pal("#d6a0c8"), .5, .8)
        return t
    for k in range(9):
        x1, y1 = 16 + r.uniform(-11, 11), r.uniform(8, 34)
        stroke(t, [(16 + (x1 - 16) * .3, at(65)), (16 + (x1 - 16) * .5, at(44)), (x1, at(y1))], 1.8, 1.2, green, .38)
    for k in range(46):
        leaf(t, r.uniform(5, 27), at(r.uniform(14, 62)), r.uniform(20, 160), r.uniform(5, 8), 4, green, .48 + r.uniform(-.18, .14))
    if kind == "lilac":
        p = pal("#b683cc", .22, .18, 8)
        for x, y, n in ((9, 10, 15), (17, 4, 15), (24, 12, 14), (13, 26, 13), (22, 30, 12), (7, 38, 9)):
            for j in range(n):
                u = j / n
                ball(t, x + r.uniform(-3.4, 3.4) * (.3 + u), at(y + u * 9), 1.6, p, .5 + r.uniform(-.2, .2))
    else:
        color, core, rr, spots = {"rose_bush": ("#c02535", None, 3.4, 12), "peony": ("#eaa6cc", "#f6dc9a", 4.6, 8)}[kind]
        p = pal(color, .24, .16, 8)
        for k in range(spots):
            x, y = 5 + 22 * ((k * .618) % 1) + r.uniform(-1, 1), 5 + k * (52 / spots)
            bloom(t, x, at(y), rr, 6, p, None, k, .3)
            bloom(t, x - .4, at(y) - .4, rr * .62, 5, p, core, k + 1, .3, .4, tone=.74)
    return t


DANDY = [(16, 10, 1)]
add("dandelion", simple, "#f4c522", DANDY, 12, "#f29a1c", 5.6, depth=.3, feet=6)
add("poppy", simple, "#d8302a", [(16, 9, 1)], 4, "#2a2020", 6.4, depth=.22, core_r=.3)
add("allium", globe, "#b36be0")
add("azure_bluet", simple, "#e9eef6", [(9, 14, 1), (16, 8, 1.1), (23, 13, 1), (13, 20, .8), (21, 21, .8)], 4, "#f2cf3f", 3.6, depth=.3)
for _c, _h in (("red", "#d33a2c"), ("orange", "#ef8a28"), ("white", "#eef0f2"), ("pink", "#f0a2c8")):
    add(_c + "_tulip", tulip, _h)
add("oxeye_daisy", simple, "#f4f4f0", [(16, 9, 1)], 11, "#f0b92c", 7, depth=.4, core_r=.36)
add("cornflower", simple, "#4a66d8", [(16, 9, 1), (22, 16, .65)], 9, "#2f2f8a", 6, depth=.55)
add("lily_of_the_valley", bells)
add("blue_orchid", orchid)
add("wither_rose", simple, "#2f2a2e", [(16, 10, 1)], 5, "#57484e", 6, green=pal("#3d4a33"), depth=.25)
add("torchflower", torch_flower)
add("open_eyeblossom", eyeblossom, True)
add("closed_eyeblossom", eyeblossom, False)
for _k in ("sunflower", "lilac", "rose_bush", "peony", "pitcher_plant"):
    add(_k + "_top", tall_flower, _k, True)
    add(_k + "_bottom", tall_flower, _k, False)
add("heather", spike, "#b05fa6", bells=36, stems=((9, 10), (16, 5), (23, 9), (12, 14)), size=1.5, green=OLIVE)
add("ice_flower", simple, "#bfe6fb", [(16, 10, 1), (9, 18, .6), (23, 17, .6)], 6, "#ffffff", 6.4, green=pal("#6fa3b0"), depth=.7)
add("swamp_iris", simple, "#7a5fd0", [(13, 8, 1), (21, 14, .8)], 3, "#f2d23f", 6, green=DEEP_GREEN, depth=.55, feet=7)
add("spore_blossom", lambda name: (lambda t: ([leaf(t, 16, 3, a, 15, 7, pal("#d97fb8"), .5) for a in (200, 340, 225, 315, 250, 290, 270)],
                                             [leaf(t, 16, 1, a, 8, 4, GREEN, .5) for a in (195, 345)], ball(t, 16, 6, 3, pal("#f4d77a"), .6), t)[-1])(sprite(name)))
