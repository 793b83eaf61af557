"""The sixteen dyes on wool, concrete, clay, glass, beds, boxes and candles."""
import numpy as np

from color import blend, lift, mix, ramp, rgb
from masonry import glazed
from noise import N, X, Y, Cells, Grid, blur, fbm, points, rng, roll, ss, value
from tex import Tex, add
from wood import planks

DYES = {"white": "#eceef0", "orange": "#ee7e1d", "magenta": "#bd48b4", "light_blue": "#41aedb", "yellow": "#f6c52c", "lime": "#76bb22",
        "pink": "#ee92b0", "gray": "#474c52", "light_gray": "#a0a19b", "cyan": "#178a94", "purple": "#7b30ae", "blue": "#373da0",
        "brown": "#744a2b", "green": "#567020", "red": "#a62a26", "black": "#1c1c22"}
PARTNER = {"white": "light_blue", "orange": "cyan", "magenta": "purple", "light_blue": "blue", "yellow": "orange", "lime": "yellow", "pink": "magenta",
           "gray": "light_gray", "light_gray": "cyan", "cyan": "gray", "purple": "black", "blue": "light_blue", "brown": "cyan", "green": "lime",
           "red": "pink", "black": "red"}


def depth(c):
    """Dark dyes keep some room below them, light ones some above."""
    v = rgb(c).mean()
    return (.13 if v < .25 else .16), (.13 if v < .8 else .06)


def wool(name, c):
    """Knitted rows: each stitch a small V."""
    t = Tex(name, .97)
    d, l = depth(c)
    col, row = X % 4, (Y + np.where((X // 4) % 2 == 1, 0, 0)) % 4
    v = (Y + np.abs(col - 1.5) * 1.0) % 4
    f = .60 - .10 * np.abs(col - 1.5) + .14 * np.cos(v / 4 * 2 * np.pi) + .10 * fbm(name, 5, 5, 2) + .07 * value("wool/s", 8, 8)
    t.fill(np.clip(f, 0, .99), ramp(c, d, l, 7), 0)
    t.h = .9 * np.cos(v / 4 * 2 * np.pi) - .35 * np.abs(col - 1.5) + .5 * fbm("wool", 5, 5, 2)
    return t


def concrete(name, c):
    t = Tex(name, .8)
    t.fill(.52 + .22 * fbm("concrete", 5, 5, 3), ramp(c, .025, .025, 5), 1)
    r = rng("concrete")
    for _ in range(7):
        x, y = r.integers(0, N, 2)
        t.rgb[y, x] *= .88
        t.h[y, x] -= .6
    t.h += .15 * fbm("concrete", 5, 5, 3)
    return t


def powder(name, c):
    t = Tex(name, .98)
    cells = Cells(points("powder", 11, 11, .95))
    f = .52 + cells.per("powder", -.2, .2) + .14 * fbm("powder", 4, 4, 2)
    d, l = depth(c)
    t.fill(np.clip(f, 0, .99), ramp(lift(c, .02), d * .6, l * .7, 6), 0)
    t.h = cells.per("powder", 0, .8) + .5 * ss(0, 1, cells.edge)
    return t


def clay(name, c):
    """Fired clay: broad throwing marks and small pores."""
    t = Tex(name, .85)
    f = .52 + .16 * fbm("terra", 3, 5, 3) + .07 * np.sin((Y + 1.5 * fbm("terra/w", 3, 3, 2)) / 32 * 2 * np.pi * 4)
    pore = (value("terra/p", 16, 16) > .66)
    t.fill(np.clip(f - .2 * pore, 0, .99), ramp(c, .08, .07, 6))
    t.h = .4 * f - .4 * pore
    return t


def glass(name, c=None, alpha=.45, tinted=False):
    """A clean frame and two streaks of light."""
    t = Tex(name, .05)
    base = rgb(c) if c is not None else rgb("#dff0f4")
    d = np.minimum(np.minimum(X, 31 - X), np.minimum(Y, 31 - Y))
    t.rgb[:] = base
    t.a[:] = alpha if c is not None else 0
    if c is not None:
        t.fill(.5 + .12 * np.cos((X + Y) / 32 * 2 * np.pi), ramp(c, .05, .05, 5))
    u = X + Y
    streak = ((u > 15) & (u < 19) | (u > 21) & (u < 23)) & (d > 4) & (X < 17) | ((u > 42) & (u < 45)) & (d > 4) & (X > 14) & (Y > 14)
    light = mix(base, "#ffffff", .75)
    t.put(streak, light, a=(.75 if c is not None else 1.))
    rim = d < 2
    t.put(rim, mix(base, "#ffffff", .45) if c is None else lift(base, .06), a=1. if c is None else min(1, alpha + .4))
    t.put((d == 0) & ((X == 31) | (Y == 31)), lift(base, -.14), a=1. if c is None else min(1, alpha + .4))
    t.put((d == 1) & ((X == 1) | (Y == 1)), mix(base, "#ffffff", .7 if c is None else .3), a=1. if c is None else min(1, alpha + .4))
    t.h = ss(2.5, 1, d) * 1.
    t.r[:] = .05
    return t


def pane_top(name, c=None):
    t = Tex(name, .1)
    base = rgb(c) if c is not None else rgb("#cfe3e8")
    t.fill(np.clip(.6 - .05 * np.abs(X - 15.5), .1, .99), ramp(base, .1, .12, 6), 0)
    t.a[:] = 1. if c is None else .85
    return t


def bed(name, c, part):
    blanket = wool(name, c)
    if part == "side":
        t = planks("oak_planks", "#b08a52")
        m = (Y >= 14) & (Y < 23 + 1.5 * value("bed/hem", 6, 1))
        t.put(m, blanket.rgb, h=2.)
        t.light(np.where(m & ~roll(m, 0, -1), -.3, 0) + np.where((Y == 14), .12, 0))
        return t
    t = blanket
    t.h += 1.2 * fbm("bed/fold", 3, 3, 2)
    t.light(.10 * (fbm("bed/fold", 3, 3, 2) - roll(fbm("bed/fold", 3, 3, 2), 2, 2)) * 3)
    if part == "head":
        sheet = (Y < 20)
        t.shade(sheet, ramp("#e6e4e0", .08, .05, 5), np.clip(.6 + .1 * fbm("bed/s", 4, 4, 2), 0, .99), h=.8)
        px, py = X - 15.5, Y - 8.5
        pillow = (np.abs(px) / 12.5) ** 4 + (np.abs(py) / 6.2) ** 4 < 1
        t.light(np.where(roll(pillow, 1, 1) & ~pillow, -.22, 0))
        t.shade(pillow, ramp("#f4f3f0", .12, .04, 6), np.clip(.85 - .05 * np.abs(px) * .5 - .04 * (py + 4), 0, .99), h=2.2)
        t.light(np.where(sheet & (Y == 19), -.14, 0))
    rim = np.minimum(X, 31 - X) < 1
    t.light(np.where(rim, -.16, 0))
    return t


def shulker(name, c, part):
    t = Tex(name, .55)
    d, l = depth(c)
    p = ramp(mix(c, "#8a6a94", .12), d, l, 8)
    edge = np.minimum(np.minimum(X, 31 - X), np.minimum(Y, 31 - Y))
    f = .5 + .10 * fbm("shulker", 5, 5, 2)
    if part == "top":
        cx, cy = np.abs(X - 15.5), np.abs(Y - 15.5)
        man = cx + cy
        f += .14 * (man < 11) - .3 * (np.abs(man - 11.5) < 1) - .2 * (np.abs(man - 19) < .8) + .1 * (edge < 2)
        f -= .04 * ((X - 15.5) + (Y - 15.5)) * (man < 11) * .5
    elif part == "side":
        lid = Y < 18 + 3 * (np.abs(((X + 4) % 16) - 8) < 4)
        f += np.where(lid, .08, -.12) + .12 * (edge < 2)
        f -= .35 * (lid & ~roll(lid, 0, -1)) + .18 * ((np.abs(Y - 9) < 1) & (np.abs(X - 15.5) < 10))
        t.h = lid * 1.5
    else:
        f += -.08 + .12 * (edge < 3) - .25 * (edge == 3)
    f += np.where((edge < 1) & ((X < 1) | (Y < 1)), .1, 0) - np.where((edge < 1) & ((X > 30) | (Y > 30)), .16, 0)
    t.fill(np.clip(f, 0, .99), p, 0)
    t.h = t.h + ss(0, 2, edge)
    return t


def candle(name, c, lit_top=False):
    t = Tex(name, .5)
    t.fill(np.clip(.72 - .014 * Y - .10 * np.abs((X % 4) - 1.2) * .5 + .12 * value("candle", 8, 4), 0, .99), ramp(c, .14, .1, 7))
    drip = value("candle/d", 10, 5) > .45
    t.light(np.where(drip, .08, 0) - np.where(roll(drip, 1, 0) & ~drip, .1, 0))
    t.h = drip * .8
    if lit_top:
        d = np.hypot(X % 4 - 1.5, Y % 4 - 1.5)
        t.shade(np.ones_like(X, bool), blend("#f8a030", "#ffd870", "#fff6cc", n=5), np.clip(1 - d / 3, 0, .99))
        t.glow(np.ones_like(X, bool), 1.)
    return t


for _k, (_d, _c) in enumerate(DYES.items()):
    add(_d + "_wool", wool, _c)
    add(_d + "_concrete", concrete, mix(_c, "#101018", .1))
    add(_d + "_concrete_powder", powder, mix(_c, "#ffffff", .12))
    add(_d + "_terracotta", clay, mix(mix(_c, "#98604a", .5), "#7a5a50", .15))
    add(_d + "_glazed_terracotta", glazed, _c, DYES[PARTNER[_d]], _k)
    add(_d + "_stained_glass", glass, _c)
    add(_d + "_stained_glass_pane_top", pane_top, _c)
    for _p in ("head", "foot", "side"):
        add(f"{_d}_bed_{_p}", bed, _c, _p)
    for _p in ("top", "side", "bottom"):
        add(f"{_d}_shulker_box_{_p}", shulker, _c, _p)
    add(_d + "_candle", candle, mix(_c, "#f4e8d0", .15))
    add(_d + "_candle_lit_top", candle, _c, True)
for _p in ("top", "side", "bottom"):
    add(f"shulker_box_{_p}", shulker, "#976797", _p)
add("candle", candle, "#ecd8a8")
add("candle_lit_top", candle, "#ecd8a8", True)
add("terracotta", clay, "#9a5f44")
add("glass", glass)
add("glass_pane_top", pane_top)
add("tinted_glass", glass, "#2c2636", .85)
