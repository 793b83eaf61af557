"""Natural rock."""
import numpy as np

from color import blend, mix, ramp
from noise import X, Y, Cells, blur, clean, fbm, points, rng, roll, ss, value
from tex import Tex, add


def facet_field(name, nx=4, ny=4, sy=1., tilt=.035, crack=.55, width=.55):
    """Irregular facets, each a tilted plane, with cracks along some of their borders.
    Gives tone 0..1, height, crack mask."""
    wx = X + 1.6 * fbm(name + "/wx", 5, 5, 2)
    wy = Y + 1.6 * fbm(name + "/wy", 5, 5, 2)
    c = Cells(points(name, nx, ny, .95), sy=sy, x=wx, y=wy)
    gx, gy = c.per(name + "/gx", -1, 1), c.per(name + "/gy", -1, 1)
    plane = tilt * (gx * c.vx + gy * c.vy)
    tone = .5 + .5 * plane + c.per(name + "/tone", -.09, .09) - .04 * (gx + gy)
    cracked = (c.edge < width) & (c.pair(name) < crack)
    h = 1.1 * plane * 6 + c.per(name + "/hh", 0, 1.2) + ss(0, 1.6, c.edge) * .5 - cracked * 1.1
    return tone, h, cracked


def rock(name, base, dark=.16, light=.12, nx=4, ny=4, sy=1., crack=.5, grain=.16, gx=8, gy=8, rough=.86, n=7, width=.55, contrast=1., seed=None):
    t = Tex(name, rough)
    r = ramp(base, dark, light, n)
    s = seed or name
    tone, h, cracked = facet_field(s, nx, ny, sy, crack=crack, width=width)
    f = .5 + (tone - .5) * contrast + grain * fbm(s + "/grain", gx, gy, 2)
    f = f - .30 * cracked
    f = f + .13 * (roll(cracked, 1, 1) & ~cracked)
    t.fill(f, r)
    t.h = h + .5 * fbm(s + "/bump", gx, gy, 2)
    return t


def specks(t, name, color_ramp, count, size=(1, 2.2), height=.3, stretch=1.):
    """Mineral grains: small clusters in a few colors, the upper left lit."""
    r = rng(name + "/specks")
    for x, y in points(name + "/sp", int(np.sqrt(count) + .5), int(np.sqrt(count) + .5), .95):
        s = r.uniform(*size)
        dx, dy = (X - x + 16) % 32 - 16, (Y - y + 16) % 32 - 16
        m = (dx / stretch) ** 2 + dy ** 2 + .6 * dx * dy * r.uniform(-1, 1) < s
        k = int(r.integers(1, len(color_ramp) - 1))
        t.put(m, color_ramp[k])
        t.put(m & ~roll(m, 1, 1), color_ramp[k + 1])
        t.h[m] += height
    return t


def granular(name, base, a, b, counts=(30, 30), rough=.84):
    t = rock(name, base, .12, .10, crack=.35, grain=.2)
    specks(t, name + "/a", ramp(a, .1, .08, 5), counts[0])
    specks(t, name + "/b", ramp(b, .1, .08, 5), counts[1])
    return t


def polished(name, of, rough=.45, relief=1.):
    """The same mineral, ground flat, with a worked rim; relief: what is left of it."""
    painter, args, kw = of
    t = painter(name, *args, **kw)
    d = np.minimum(np.minimum(X, 31 - X), np.minimum(Y, 31 - Y))
    mean = t.rgb.mean((0, 1))
    t.rgb = mean + (t.rgb - mean) * .62
    t.h = t.h * .15
    rim = d < 1
    t.light(np.where(rim & ((Y < 1) | (X < 1)), .16, 0) + np.where(rim & ((Y > 30) | (X > 30)), -.22, 0))
    inner = (d >= 1) & (d < 2)
    t.light(np.where(inner & ((Y < 2) | (X < 2)), .06, 0) + np.where(inner & ((Y > 29) | (X > 29)), -.08, 0))
    t.h = (t.h + ss(0, 2.5, d) * 1.5) * relief
    t.r[:] = rough
    return t


def strata(name, base, dark=.16, light=.12, rows=9, rough=.84, wobble=1.6, grain=.2, n=7, speck=None, seed=None):
    """Layered rock: flat lens-like plates lying on each other."""
    t = Tex(name, rough)
    s = seed or name
    wy = Y + wobble * fbm(s + "/w", 4, 3, 2)
    c = Cells(points(s, 3, rows, .9), sx=.30, sy=1., x=X, y=wy)
    under = ss(-.2, 1.2, c.vy / 3)
    f = .52 + c.per(s + "/t", -.2, .2) + grain * fbm(s + "/g", 4, 16, 2) - .16 * under
    gap = c.edge < .42
    f = f - .22 * gap + .1 * (roll(gap, 0, 1) & ~gap)
    t.fill(f, ramp(base, dark, light, n))
    t.h = c.per(s + "/h", 0, 1.4) + ss(0, 1.2, c.edge) * .8
    if speck:
        specks(t, s, ramp(speck, .1, .1, 5), 25, (1, 2), stretch=1.8)
    return t


def veined(name, base, vein, rough=.6, dark=.08, light=.07, width=.07):
    """Marble and calcite: soft clouds cut by thin diagonal veins."""
    t = Tex(name, rough)
    wx, wy = X + 5 * fbm(name + "/x", 3, 3, 3), Y + 5 * fbm(name + "/y", 3, 3, 3)
    cloud = fbm(name + "/c", 3, 3, 3, wx, wy)
    t.fill(.55 + .42 * cloud, ramp(base, dark, light, 6))
    v = ramp(vein, .05, .12, 4)
    for k, (a, b, ph) in enumerate(((1, 1, 0), (1, -2, .37), (2, 1, .7))):
        u = (a * wx + b * wy) / 32 + ph
        d = np.abs(u - np.round(u))
        strong = value(f"{name}/s{k}", 4, 4) > -.1
        m = (d < width * (.5 if k else .8)) & strong
        t.put(m, v[1 if k == 0 else 2])
        t.put(roll(m, 1, 1) & ~m, t.rgb * .4 + v[3] * .6)
        t.h[m] -= .35
    t.h += .3 * cloud
    return t


def cobble(name, base, dark=.18, light=.14, nx=4, ny=4, gap=.75, rough=.85, mortar=None, spread=.22, hue=None, seed=None):
    """Rounded stones set close, lit from the upper left, each with its own tone."""
    t = Tex(name, rough)
    s = seed or name
    wx, wy = X + .8 * fbm(s + "/wx", 6, 6, 2), Y + .8 * fbm(s + "/wy", 6, 6, 2)
    c = Cells(points(s, nx, ny, .72), power=2.6, x=wx, y=wy)
    dome = ss(0, 3.2, c.edge)
    f = .40 + c.per(s + "/tone", -spread, spread) + .16 * dome - .030 * (c.vx + c.vy * 1.5) + .13 * fbm(s + "/g", 9, 9, 2)
    t.fill(f, ramp(base, dark, light, 8))
    if hue is not None:
        other = ramp(hue, dark, light, 8)
        pick = c.per(s + "/hue") > .66
        idx = np.clip((f * 8).astype(int), 0, 7)
        t.put(pick, other[clean(idx, 1)])
    m = c.edge < gap
    low = ramp(mortar or mix(base, "#201f24", .5), .06, .06, 3)
    t.put(m, low[1])
    t.put(m & (c.edge < gap * .45), low[0])
    lit = roll(m, 1, 1) & ~m
    t.light(np.where(lit, .16, 0))
    t.h = dome * 2.6 + c.per(s + "/h", 0, .8) * (dome > .1) + .4 * fbm(s + "/b", 9, 9, 2)
    t.r[m] = .95
    return t


def moss_over(name, of, amount=.1, base="#5f7f3c"):
    """Moss settles into the low places of another texture."""
    painter, args, kw = of
    t = painter(name, *args, **kw)
    field = fbm(name + "/moss", 4, 4, 3) - .22 * (t.h - t.h.mean()) + amount
    m = blur(field) > .06
    r = ramp(base, .16, .14, 6)
    f = .5 + .8 * (field - .2) + .22 * fbm(name + "/m2", 11, 11, 1)
    t.shade(m, r, np.clip(f, 0, .99))
    t.put(roll(m, 0, 1) & ~m, t.rgb * .74)
    t.h[m] += .7 + .5 * fbm(name + "/m3", 12, 12, 1)[m]
    t.r[m] = .95
    return t


def obsidian(name, glow=None):
    t = Tex(name, .18)
    tone, h, _ = facet_field(name, 4, 4, tilt=.06, crack=0)
    t.fill(tone + .1 * fbm(name + "/o", 5, 5, 2) - .05, blend("#0c0a14", "#171225", "#261c3c", "#3d2d5e", "#6a5396", n=7))
    t.h = h
    if glow:
        wx = X + 3 * fbm(name + "/cx", 4, 4, 2)
        d = np.abs(fbm(name + "/cr", 3, 3, 2, wx)) + .12 * (value(name + "/mask", 5, 5) < -.1)
        hot = blend("#4a12a0", "#8a30e0", "#d078ff", n=4)
        m = d < .085
        t.shade(m, hot, np.clip(1 - d / .085, 0, .99))
        t.glow(m, .9)
        t.h[m] -= .8
    return t


def bedrock(name):
    t = cobble(name, "#54565e", .26, .24, 3, 4, gap=.6, spread=.34, mortar="#17181d")
    tone, h, cracked = facet_field(name + "/f", 5, 5)
    t.light(.5 * (tone - .5) - .35 * cracked)
    t.h += h
    return t


def basalt_side(name, top="#4c4d57", rough=.8):
    t = Tex(name, rough)
    w = X + .9 * fbm(name, 3, 4, 2)
    col = (w / 32 * 5) % 1
    which = np.floor(w / 32 * 5).astype(int) % 5
    tone = rng(name).uniform(-.12, .12, 5)[which]
    breaks = value(name + "/br", 5, 9) > .52
    f = .55 + tone - .5 * np.abs(col - .42) + .16 * fbm(name + "/g", 8, 5, 2) - .2 * breaks
    gap = (col < .07) | (col > .93)
    t.fill(f - .35 * gap, ramp(top, .2, .16, 7))
    t.h = 2.2 * np.sqrt(np.clip(1 - (2 * col - 1) ** 2, 0, 1)) - .6 * breaks
    return t


def dripstone(name):
    t = Tex(name, .75)
    w = X + 2.2 * fbm(name, 4, 3, 2)
    folds = value(name + "/f", 8, 2, w, Y)
    f = .5 + .36 * folds + .14 * fbm(name + "/g", 10, 5, 2)
    t.fill(f, ramp("#87685a", .19, .16, 7))
    t.h = 2 * folds
    return t


def sandstone(name, base, part="side"):
    t = Tex(name, .9)
    r = ramp(base, .14, .09, 7)
    grain = fbm(name + "/g", 12, 12, 2)
    if part == "top":
        t.fill(.58 + .12 * fbm(name + "/a", 4, 4, 2) + .10 * grain, r)
        t.h = .4 * fbm(name + "/a", 4, 4, 2)
        return t
    if part == "bottom":
        tone, h, cracked = facet_field(name, 4, 4, crack=.4)
        t.fill(.48 + .7 * (tone - .5) + .12 * grain - .22 * cracked, r)
        t.h = h
        return t
    y = Y + .7 * fbm(name + "/w", 4, 4, 2)
    layer = np.interp(y % 32, [0, 4, 5, 9, 10, 11, 17, 18, 24, 25, 31, 32], [.78, .72, .5, .62, .42, .66, .58, .34, .55, .4, .5, .5])
    t.fill(layer + .10 * grain + .05 * fbm(name + "/s", 3, 14, 2), r)
    chip = (value(name + "/c", 7, 9) > .62) & (Y > 6)
    t.light(np.where(chip, -.1, 0) + np.where(roll(chip, 0, 1) & ~chip, .07, 0))
    t.h = 3 * layer + .3 * grain - .5 * chip
    return t


STONE, DEEP, TUFF, BLACK = "#85878c", "#55565f", "#6f726a", "#38343f"
GRANITE, DIORITE, ANDESITE = "#a06f5d", "#c3c3c4", "#8b8e8d"
NATURAL = {
    # This seed spreads its cracks evenly: stone covers more of the world than anything else, so it must not show its tile.
    "stone": (rock, (STONE,), dict(nx=5, ny=4, crack=.45, grain=.2, seed="c3")),
    "granite": (granular, (GRANITE, "#6d4640", "#c99a82"), {}),
    "diorite": (granular, (DIORITE, "#83858f", "#eceae6"), {}),
    "andesite": (granular, (ANDESITE, "#6d7176", "#a9aca8"), {}),
    "tuff": (strata, (TUFF,), dict(rows=8, speck="#8b8d80", grain=.24)),
    "calcite": (veined, ("#dcdcd6", "#b4b8bd"), dict(rough=.7)),
    "marble": (veined, ("#e6e3e2", "#9aa0b4"), dict(rough=.3)),
    "slate": (strata, ("#4f5a68",), dict(rows=10, rough=.6, wobble=.9)),
    "smooth_basalt": (rock, ("#4b4a53",), dict(crack=.2, grain=.14, dark=.13, light=.1)),
    "smooth_stone": (rock, ("#9b9da1",), dict(crack=0, grain=.1, dark=.08, light=.06, contrast=.5)),
    "deepslate": (strata, (DEEP,), dict(rows=9, dark=.15, light=.13)),
    "deepslate_top": (rock, (DEEP,), dict(nx=3, ny=5, sy=1.5, crack=.6)),
    "blackstone": (rock, (BLACK,), dict(crack=.7, nx=4, ny=5, dark=.13, light=.16)),
    "blackstone_top": (rock, (BLACK,), dict(crack=.6, dark=.13, light=.18)),
    "end_stone": (cobble, ("#dcdd9f",), dict(dark=.16, light=.08, nx=5, ny=5, gap=.5, spread=.12, mortar="#b6ae78")),
    "cobblestone": (cobble, (STONE,), {}),
    "cobbled_deepslate": (cobble, (DEEP,), dict(mortar="#25252d")),
    "cobbled_slate": (cobble, ("#56616f",), dict(mortar="#252b36")),
    "bedrock": (bedrock, (), {}),
    "obsidian": (obsidian, (), {}),
    "crying_obsidian": (obsidian, (True,), {}),
    "basalt_side": (basalt_side, (), {}),
    "basalt_top": (cobble, ("#50515b",), dict(nx=5, ny=5, gap=.6, spread=.14)),
    "dripstone_block": (dripstone, (), {}),
    "quartz_rock": (veined, ("#ece4e0", "#d6b8c0"), dict(rough=.25)),
}
for _n, (_p, _a, _k) in NATURAL.items():
    add(_n, _p, *_a, **_k)
for _n in ("granite", "diorite", "andesite", "tuff", "deepslate", "blackstone"):
    add("polished_" + _n, polished, NATURAL[_n])
for _n in ("marble", "slate"): # to a shine: halls are paved with them
    add("polished_" + _n, polished, NATURAL[_n], .14, .3)
add("smooth_stone_slab_side", polished, NATURAL["smooth_stone"], .6)
add("mossy_cobblestone", moss_over, NATURAL["cobblestone"])
for _red, _c in (("", "#dbcb98"), ("red_", "#b4653a")):
    add(_red + "sandstone", sandstone, _c)
    add(_red + "sandstone_top", sandstone, _c, "top")
    add(_red + "sandstone_bottom", sandstone, _c, "bottom")
