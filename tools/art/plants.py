"""Grass, ferns, saplings, vines and other green things."""
import numpy as np

from color import blend, gray, lift, ramp, rgb
from leaves import GREENS, leaves
from noise import X, Y, fbm, points, rng, roll, ss, value, wrap
from sprite import DEEP_GREEN, GREEN, OLIVE, ball, bloom, curve, leaf, pal, shoots, sprite, stalk, stroke, tuft
from tex import Tex, add
from wood import WOODS, bamboo

TINTED = gray(.40, 1., 8)


def grass(name, colors=TINTED, count=17, height=(9, 25), width=2.3, **kw):
    return tuft(sprite(name), name, colors, count, height, width, **kw)


def tall(name, colors=TINTED, top=False, width=2.6, count=13, heads=None):
    """Both halves are one drawing, 64 high, of which each shows its part."""
    t = sprite(name)
    key = name.rsplit("_", 1)[0]
    tuft(t, key, colors, count, (20, 58), width, 11, 11, 64 if top else 32)
    if heads is not None and top:
        r = rng(key + "/heads")
        for k in range(5):
            ball(t, 6 + 5 * k + r.uniform(-1, 1), 6 + r.uniform(0, 8), 1.6, heads, .6, 1.8)
    return t


def fern(name, colors=TINTED, fronds=7, top=False, height=25, spread=14):
    """Arching fronds with pinnae on both sides, the inner ones in front."""
    t = sprite(name)
    r = rng(name.replace("_top", "").replace("_bottom", ""))
    base = 64 if top else 32
    for k in sorted(range(fronds), key=lambda k: -abs(k - fronds // 2)):
        u = (k + .5) / fronds * 2 - 1
        hgt = height * (1 - .5 * abs(u)) * r.uniform(.92, 1.05)
        path = [(16 + u, base), (16 + u * spread * .35, base - hgt), (16 + u * spread, base - hgt * (1 - .45 * abs(u)))]
        pts = curve(path, max(7, int(hgt / 2.6)))
        shade = .62 - .30 * abs(u)
        for j in range(2, len(pts)):
            (x, y), (xp, yp) = pts[j], pts[j - 1]
            along = np.degrees(np.arctan2(-(y - yp), x - xp))
            size = 1.8 + 5.0 * (1 - j / len(pts)) ** .8
            for side in (-1, 1):
                a = np.radians(along + side * 58)
                stroke(t, [(x, y), (x + size * np.cos(a), y - size * np.sin(a))], 1.5, 1, colors, shade + .10 * (side > 0), .25, seam=False)
        stroke(t, path, 1.3, .9, colors, shade - .22, .2, seam=False)
    return t


def bush(name, twig="#7a5a38", dry=True):
    t = sprite(name)
    r = rng(name)
    p = pal(twig)

    def branch(x, y, a, length, w, depth):
        x1, y1 = x + np.cos(a) * length, y - np.sin(a) * length
        stroke(t, [(x, y), ((x + x1) / 2 + r.uniform(-1, 1), (y + y1) / 2), (x1, y1)], w, w * .7, p, .45 + .06 * depth, .2)
        if depth < 3:
            for side in (-1, 1):
                branch(x1, y1, a + side * r.uniform(.35, .75), length * r.uniform(.6, .8), w * .7, depth + 1)
    branch(16, 32.5, 1.57, 7, 2.6, 0)
    branch(15, 31, 2.3, 7, 1.8, 1)
    branch(17, 31, .85, 7, 1.8, 1)
    if not dry:
        for _ in range(22):
            leaf(t, r.uniform(6, 26), r.uniform(4, 20), r.uniform(0, 180), 4, 2.4, OLIVE, .5 + r.uniform(-.15, .15), rib=False)
    return t


def sapling(name, colors, bark_color, style="round"):
    t = sprite(name)
    r = rng(name)
    bark_pal = pal(bark_color)
    stroke(t, [(16, 32.5), (15.5, 25), (16, 14)], 2.6, 1.6, bark_pal)
    for s in (-1, 1):
        stroke(t, [(16, 22), (16 + s * 3, 20), (16 + s * 6, 15)], 1.5, 1, bark_pal)
    if style == "cone":
        for k in range(6):
            y = 24 - k * 4
            w = 11 - 1.6 * k
            for s in (-1, 1):
                for j in range(3):
                    leaf(t, 16, y - j * .8, 90 - s * (100 - 12 * j), w, 2.2, colors, .34 + .08 * k + .06 * (s < 0) + .05 * j, rib=False)
        leaf(t, 16, 7, 90, 6, 2.4, colors, .7, rib=False)
    elif style == "palm":
        for k, a in enumerate((175, 5, 150, 30, 125, 55, 90)):
            c = np.cos(np.radians(a))
            stroke(t, [(16, 14), (16 + c * 9, 14 - 9 * np.sin(np.radians(a)) - 3), (16 + c * 14, 14 - 4 * np.sin(np.radians(a)) + 3 * abs(c))], 2.6, 1, colors, .4 + .05 * k)
    else:
        spots = [(16, 9)] + [(16 + 8 * np.cos(a), 12 + 6 * np.sin(a)) for a in np.linspace(0, 2 * np.pi, 9)[:-1]]
        for layer in range(2):
            for x, y in spots:
                for k in range(3):
                    leaf(t, x + r.uniform(-3, 3), y + r.uniform(-3, 3), r.uniform(0, 360), 5.2, 3.2, colors, .32 + .2 * layer + .1 * k - .01 * (y - 12))
    return t


def vine(name, colors, strands=6, leaf_size=(3.4, 2.6), glow=None, cover=.9):
    t = sprite(name)
    t.wrap = True
    r = rng(name)
    for k in range(strands):
        x = (k + .5) * 32 / strands + r.uniform(-1.5, 1.5)
        ph = r.uniform(0, 6.3)
        stem = [(x + 1.2 * np.sin(ph + y / 32 * 2 * np.pi), y) for y in range(33)]
        for (xa, ya), (xb, yb) in zip(stem, stem[1:]):
            stroke(t, [(xa, ya), (xb, yb)], 1.1, 1.1, colors, .25, 0, seam=False)
        for j in range(11):
            if r.random() > cover:
                continue
            y = j * 32 / 11 + r.uniform(-1, 1)
            s = 1 if j % 2 else -1
            sx = x + 1.2 * np.sin(ph + y / 32 * 2 * np.pi)
            a = -90 + s * r.uniform(25, 75)
            tone = .5 + r.uniform(-.16, .16)
            for oy in (-32, 0, 32):
                leaf(t, sx, y + oy, a, leaf_size[0], leaf_size[1], colors, tone, rib=False)
    return t


def hanging(name, colors, tip=False, lit=None, leaf_w=3., stems=1, upward=False):
    """Vines that hang through a whole block, or end in it."""
    t = sprite(name)
    r = rng(name.replace("_lit", ""))
    bottom = 26 if tip else 32.5
    for k in range(stems):
        x = 16 + (k - (stems - 1) / 2) * 7
        path = [(x, -1), (x + 2.5, 10), (x - 2.5, 22), (x, bottom)]
        stroke(t, path, 2, 1.2 if tip else 2, colors, .35, 0)
        for j in range(9):
            y = j * 3.4 + 1
            if y > bottom - 2:
                break
            s = 1 if j % 2 else -1
            leaf(t, x + s * .6, y, -90 + s * r.uniform(40, 80), r.uniform(5.5, 8.5), leaf_w, colors, .5 + r.uniform(-.12, .12))
    if lit is not None:
        for x, y in ((11, 13), (20, 22), (13, 27)):
            ball(t, x, y, 2.6, pal(lit, .2, .2), .62, 1.1, e=.95)
    if upward:
        for k in ("rgb", "a", "h", "r"):
            setattr(t, k, getattr(t, k)[::-1].copy())
    return t


def lichen(name, color, glow=0., patches=9, size=(2.5, 5)):
    t = sprite(name)
    t.wrap = True
    r = rng(name)
    p = pal(color)
    for _ in range(patches):
        x, y, s = r.uniform(0, 32), r.uniform(0, 32), r.uniform(*size)
        dx, dy = wrap(X - x), wrap(Y - y)
        d = np.hypot(dx, dy) + 1.4 * value(name + "/e", 12, 12)
        m = d < s
        t.rgb[roll(m, 1, 1) & ~m & (t.a > 0)] *= .7
        t.shade(m, p, np.clip(.62 - .06 * (dx + dy) - .14 * ((d % 2) < .8), 0, .99), h=.8)
        if glow:
            t.glow(m, glow)
    return t


def roots(name, color, n=9, down=False, length=(14, 26), curl=5, tips=None):
    t = sprite(name)
    r = rng(name)
    p = pal(color)
    base, s = (-.5, 1) if down else (32.5, -1)
    for k in range(n):
        x = 16 + (k - (n - 1) / 2) * 2.6
        hgt = r.uniform(*length)
        x1 = x + r.uniform(-curl, curl) + (x - 16) * .3
        m = stroke(t, [(x, base), (x + r.uniform(-curl, curl) * .6, base + s * hgt * .5), (x1, base + s * hgt)], 1.9, .9, p, .45 + r.uniform(-.14, .14), .3)
        if tips is not None:
            ball(t, x1, base + s * hgt, 1.3, pal(tips), .6, e=.4)
    return t


def petals(name):
    t = sprite(name)
    t.wrap = True
    for k, (x, y) in enumerate(points(name, 4, 4, 1.)):
        bloom(t, x, y, 3.4, 4, pal("#f0a6c8", .14, .1), "#f6e08a", k, .5, .28)
        if k % 3 == 0:
            ball(t, (x + 4) % 32, (y + 3) % 32, 1.4, GREEN, .5)
    return t


def pad(name, color=gray(.42, .95, 8)):
    t = sprite(name)
    dx, dy = X - 15.5, Y - 15.5
    d, a = np.hypot(dx, dy), np.arctan2(dy, dx)
    m = (d < 14.5 + .5 * np.sin(5 * a)) & ~((abs(a - .5) < .22) & (d > 2))
    f = .55 + .1 * np.cos(a * 9) * (d > 3) - .2 * (d > 13) + .06 * fbm(name, 6, 6, 2) - .006 * (dx + dy)
    t.shade(m, color, np.clip(f, 0, .99), r=.4)
    t.h = np.where(m, .6 + .5 * (d > 12.6) + .2 * np.cos(a * 9), 0)
    return t


def web(name):
    t = sprite(name)
    p = pal("#dfe4ea", .12, .06)
    for a in np.linspace(0, 2 * np.pi, 11)[:-1]:
        stroke(t, [(16, 16), (16 + 22 * np.cos(a), 16 + 22 * np.sin(a))], 1, 1, p, .6, 0, seam=False)
    dx, dy = X - 15.5, Y - 15.5
    a = np.arctan2(dy, dx)
    sag = np.hypot(dx, dy) * (1 + .09 * np.abs(np.sin(a * 5)))
    t.put(np.abs((sag % 4.4) - 2.2) < .42, p[3])
    return t


def flat_leaf_block(name, colors, bloom_color=None, side=False):
    kw = dict(size=2.9, thin=.7)
    if bloom_color:
        kw["bloom"] = (bloom_color, 10, 2.4)
    t = leaves(name, colors, fill=not side, **kw)
    if side:
        t.a[18 + (2 * value(name, 16, 1)).astype(int)[0, 0]:] = 0
        cut = Y > 15 + 2.5 * value(name + "/cut", 12, 1)
        t.a[cut] = 0
    return t


def bamboo_leaves(name, n):
    t = sprite(name)
    r = rng(name)
    for k in range(n):
        a = r.uniform(20, 160)
        leaf(t, 16 + r.uniform(-2, 2), r.uniform(4, 27), a if r.random() < .6 else a - 90, r.uniform(8, 13), 3, GREEN, .5 + r.uniform(-.12, .12))
    return t


def azalea_plant(name):
    t = sprite(name)
    bark = pal("#7b6248")
    stroke(t, [(16, 32.5), (14, 22), (16, 12)], 3, 2, bark)
    for s in (-1, 1):
        stroke(t, [(15, 24), (16 + 4 * s, 18), (16 + 8 * s, 8)], 1.8, 1.2, bark)
    for k in range(26):
        r = rng(f"{name}/{k}")
        leaf(t, r.uniform(4, 28), r.uniform(2, 14), r.uniform(0, 180), 5, 3, GREENS["azalea_leaves"][0], .5 + r.uniform(-.15, .2))
    return t


def dripleaf_top(name):
    t = pad(name, ramp("#5f8f3c", .2, .16, 8))
    dx, dy = X - 15.5, Y - 15.5
    m = (abs(dx) < 15) & (abs(dy) < 14.5 - .25 * abs(dx)) & (t.a == 0)
    f = .5 + .1 * np.cos(Y * .9 + abs(dx) * .5)
    t.shade(m, ramp("#5f8f3c", .2, .16, 8), np.clip(f, 0, .99), h=.6)
    t.shade((abs(dx) < .9) & (t.a > 0), ramp("#a8c56e", .1, .1, 5), np.full_like(X, .6))
    return t


def strip_leaf(name):
    t = sprite(name)
    m = (Y >= 2) & (Y < 8)
    t.shade(m, ramp("#5f8f3c", .2, .16, 8), np.clip(.7 - .06 * Y, 0, .99))
    return t


def small_dripleaf(name, top):
    """One drawing 64 high, of which each half shows its part."""
    t = sprite(name)
    off = 0 if top else -32
    p = ramp("#6b9a42", .2, .16, 8)
    for x1, y1 in ((7, 20), (25, 14), (17, 34), (9, 44), (24, 40)):
        stroke(t, [(16, 64.5 + off), (16, (64 + y1) / 2 + off), (x1, y1 + off)], 1.6, 1.2, DEEP_GREEN)
    for x1, y1 in ((17, 34), (9, 44), (24, 40), (7, 20), (25, 14)):
        leaf(t, x1 - 7, y1 + off, 4, 14, 5.5, p, .55)
    return t


def cattail(name):
    t = tuft(sprite(name), name, DEEP_GREEN, 9, (14, 28), 2, 8, 6)
    for x, top in ((11, 9), (17, 4), (22, 11)):
        stalk(t, x, x, top - 4, OLIVE, 1.3)
        stroke(t, [(x, top + 8), (x, top)], 3.2, 3.2, pal("#6b4326"), .5, .1)
    return t


add("short_grass", grass)
add("tall_grass_bottom", tall)
add("tall_grass_top", tall, top=True)
add("fern", fern)
add("large_fern_bottom", fern, fronds=9, height=46, spread=15)
add("large_fern_top", fern, fronds=9, top=True, height=46, spread=15)
for _n, _w, _c in (("jungle", 3.4, 13), ("savanna", 1.6, 21)):
    add(_n + "_grass", grass, gray(.38, 1., 8), _c, (10, 28), _w)
    add(f"tall_{_n}_grass_bottom", tall, gray(.38, 1., 8), width=_w, count=_c - 2)
    add(f"tall_{_n}_grass_top", tall, gray(.38, 1., 8), True, _w, _c - 2, gray(.6, 1., 7) if _n == "savanna" else None)
add("dead_bush", bush)
add("desert_scrub", bush, "#8a7448", False)
add("golden_fern", fern, blend("#7a4a10", "#b97c1e", "#e3ae3a", "#f8dc7a", n=8))
add("cattail", cattail)
SAPLINGS = {"oak": ("#5f9638", "round"), "spruce": ("#41704a", "cone"), "birch": ("#86a84a", "round"), "jungle": ("#3f8a30", "round"),
            "acacia": ("#7f9440", "round"), "dark_oak": ("#44722f", "round"), "cherry": ("#eaa4c4", "round"), "pale_oak": ("#8e988a", "round"),
            "redwood": ("#41703c", "cone"), "palm": ("#5b9a3c", "palm"), "cypress": ("#557852", "cone")}
for _n, (_c, _s) in SAPLINGS.items():
    add(_n + "_sapling", sapling, ramp(_c, .22, .16, 8), WOODS[_n][1], _s)
add("mangrove_propagule", lambda name: shoots(sapling(name, ramp("#5f8f3c", .2, .16, 8), "#7f9a4c", "palm"), name, GREEN, 16, 2))
add("bamboo_sapling", lambda name: bamboo_leaves(name, 9))
add("bamboo_small_leaves", bamboo_leaves, 8)
add("bamboo_large_leaves", bamboo_leaves, 18)
add("vine", vine, gray(.34, .98, 8))
add("glow_lichen", lichen, "#84a899", .35)
add("sculk_vein", lichen, "#0f4f5c", .25, 11)
add("resin_clump", lichen, "#d9651c", 0., 7)
CAVE = ramp("#6d8f36", .22, .16, 8)
add("cave_vines", hanging, CAVE, True)
add("cave_vines_lit", hanging, CAVE, True, "#f2a23a")
add("cave_vines_plant", hanging, CAVE)
add("cave_vines_plant_lit", hanging, CAVE, False, "#f2a23a")
add("weeping_vines", hanging, ramp("#8f1f26", .2, .16, 8), True, None, 2.4)
add("weeping_vines_plant", hanging, ramp("#8f1f26", .2, .16, 8), False, None, 2.4)
add("twisting_vines", hanging, ramp("#1fa08a", .2, .16, 8), True, None, 2.4, upward=True)
add("twisting_vines_plant", hanging, ramp("#1fa08a", .2, .16, 8), False, None, 2.4)
add("pale_hanging_moss", hanging, ramp("#8b948a", .2, .16, 8), False, None, 2., 3)
add("pale_hanging_moss_tip", hanging, ramp("#8b948a", .2, .16, 8), True, None, 2., 3)
add("hanging_roots", roots, "#a98863", 8, True, (14, 30))
add("crimson_roots", roots, "#b5262c", 9, False, (12, 28), 7)
add("warped_roots", roots, "#1fa08a", 9, False, (12, 28), 7)
add("amber_roots", roots, "#e0952e", 9, False, (12, 28), 7, "#ffd070")
add("nether_sprouts", roots, "#19a38f", 10, False, (6, 13), 3)
add("amber_sprouts", roots, "#d98e2c", 10, False, (6, 13), 3)
add("pink_petals", petals)
add("lily_pad", pad)
add("cobweb", web)
add("azalea_top", flat_leaf_block, GREENS["azalea_leaves"][0])
add("azalea_side", flat_leaf_block, GREENS["azalea_leaves"][0], None, True)
add("flowering_azalea_top", flat_leaf_block, GREENS["azalea_leaves"][0], "#d863b8")
add("flowering_azalea_side", flat_leaf_block, GREENS["azalea_leaves"][0], "#d863b8", True)
add("azalea_plant", azalea_plant)
add("big_dripleaf_top", dripleaf_top)
add("big_dripleaf_side", strip_leaf)
add("big_dripleaf_stem", lambda name: (lambda t: (stroke(t, [(16, 32.5), (15, 16), (16, -.5)], 3, 3, DEEP_GREEN, .5, 0), t)[1])(sprite(name)))
add("small_dripleaf_bottom", small_dripleaf, False)
add("small_dripleaf_top", small_dripleaf, True)
