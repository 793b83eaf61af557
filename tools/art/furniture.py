"""Tables, shelves, chests and other joinery of the house."""
import numpy as np

from color import blend, lift, mix, ramp, rgb
from joinery import hole, inset, wooden
from metal import plate
from noise import X, Y, Cells, fbm, points, rng, roll, ss, value
from tex import Tex, add
from wood import WOODS, bark, cut_end, grain_field, planks

CX, CY = X - 15.5, Y - 15.5
D = np.minimum(np.minimum(X, 31 - X), np.minimum(Y, 31 - Y))
CHEB, EUC = np.maximum(abs(CX), abs(CY)), np.hypot(CX, CY)


def cabinet(name, base, rim=3):
    t = planks(name, base)
    m = D < rim
    g = np.where((Y < rim) | (Y > 31 - rim), grain_field(name), grain_field(name, True))
    t.shade(m, ramp(mix(base, "#2a1a10", .25), .14, .12, 7), np.clip(.58 + .2 * g, 0, .99), h=2.4)
    t.light(np.where(D == rim, -.28, 0) + np.where((D == 0) & ((X == 0) | (Y == 0)), .12, 0) - np.where((D == 0) & ((X == 31) | (Y == 31)), .2, 0))
    return t


def tool(t, m, color, tone=.6):
    t.light(np.where(roll(m, 1, 1) & ~m, -.3, 0))
    t.shade(m, ramp(color, .18, .16, 6), np.clip(tone - .03 * (CX + CY) * .4, 0, .99), h=3., r=.45)
    return t


def crafting(name, part):
    t = cabinet("crafting_table", "#a47c48")
    if part == "top":
        for k in (10.5, 20.5):
            m = ((np.abs(X - k) < 1) | (np.abs(Y - k) < 1)) & (D >= 3)
            t.light(np.where(m, -.38, 0) + np.where(roll(m, 1, 1) & ~m & (D >= 3), .1, 0))
            t.h -= m * .9
    else:
        panel = (np.abs(CX) < 11) & (np.abs(CY - 1) < 10)
        inset(t, panel)
        if part == "front":
            tool(t, (np.abs(X - 10) < 1.2) & (Y > 9) & (Y < 25), "#8a5f34")
            tool(t, (np.abs(X - 10) < 4) & (np.abs(Y - 10) < 2), "#9a9ca4")
            tool(t, (np.abs(X - 21) < 3.2) & (Y > 9) & (Y < 18), "#a8aab2")
            tool(t, (np.abs(X - 21) < 1.4) & (Y >= 18) & (Y < 25), "#8a5f34")
        else:
            tool(t, (np.abs(CX - CY * .5 + 2) < 1.3) & (np.abs(CY) < 8), "#8a5f34")
            tool(t, (np.abs(CX + 5) < 5) & (np.abs(CY + 6) < 1.6), "#9a9ca4")
    return t


def table(name, base, kind, part):
    t = cabinet(name.rsplit("_", 1)[0], base)
    if kind == "cartography":
        if part == "top":
            m = (np.abs(CX) < 11) & (np.abs(CY) < 10)
            t.light(np.where(roll(m, 1, 1) & ~m, -.3, 0))
            t.shade(m, ramp("#e2d2a4", .14, .06, 6), np.clip(.6 + .15 * fbm(name, 5, 5, 2), 0, .99), h=2.6)
            land = m & (fbm("map", 3, 3, 3) > .05)
            t.shade(land, ramp("#8a9a58", .1, .1, 5), np.full_like(X, .5))
            t.put(m & (np.abs(fbm("map", 3, 3, 3) - .05) < .05), rgb("#6b5a38"))
        else:
            tool(t, (np.abs(CX) < 9) & (np.abs(((Y - 9) % 8) - 3) < 2) & (np.abs(CY - 1) < 9), "#dccb9c")
    elif kind == "fletching":
        if part == "top":
            ring = (np.floor(CHEB / 3) % 2 == 0) & (CHEB < 11)
            t.shade(CHEB < 11, ramp("#e2d6ac", .12, .06, 6), np.clip(.6 + .1 * value(name, 9, 9), 0, .99), h=1.6)
            t.shade(ring, ramp("#b84a3a", .12, .1, 5), np.full_like(X, .5))
        else:
            for x in (9, 16, 23):
                tool(t, (np.abs(X - x) < 1) & (np.abs(CY) < 10), "#8a6538")
                tool(t, (np.abs(X - x) < 2.6) & (Y > 5) & (Y < 11), "#e8e8e2")
                tool(t, (np.abs(X - x) < (27 - Y) * .7) & (Y > 22) & (Y < 27), "#7c7e86")
    elif kind == "smithing":
        iron = plate("smithing", "#4c4e58", .45)
        m = (D >= 0) if part == "top" else (Y < 10)
        t.put(m, iron.rgb, h=2.6, r=.45)
        if part == "top":
            tool(t, (np.abs(CX - CY) < 2) & (CHEB < 9), "#8a6538")
            tool(t, (np.abs(CX + CY + 10) < 5) & (np.abs(CX - CY) < 6), "#8d8f98")
        elif part in ("front", "side"):
            inset(t, (np.abs(CX) < 10) & (Y > 13) & (Y < 28))
            tool(t, (np.abs(X - 11) < 1.2) & (Y > 14) & (Y < 27), "#a0a2aa")
            tool(t, (np.abs(X - 20) < 2.4) & (Y > 14) & (Y < 22), "#8d8f98")
    elif kind == "loom":
        if part == "front":
            m = (np.abs(CX) < 10) & (Y > 8) & (Y < 27)
            t.shade(m, ramp("#e4ddcc", .14, .06, 6), np.clip(.5 + .25 * ((X % 3) == 0) + .1 * ((Y % 2) == 0), 0, .99), h=.8)
            tool(t, m & (np.abs(Y - 14) < 1.2), "#8a6538")
            t.shade(m & (Y > 20), ramp("#b0483c", .12, .12, 5), np.clip(.5 + .25 * ((X % 3) == 0), 0, .99))
        elif part == "top":
            for y in (9, 22):
                tool(t, (np.abs(Y - y) < 2.2) & (D > 3), "#e4ddcc")
    elif kind == "lectern":
        m = (np.abs(CX) < 12) & (np.abs(CY) < 9)
        t.light(np.where(roll(m, 1, 1) & ~m, -.3, 0))
        t.shade(m, ramp("#ece2c4", .14, .05, 6), np.clip(.72 - .35 * np.exp(-(CX / 1.6) ** 2), 0, .99), h=2.6)
        t.light(np.where(m & (Y % 3 == 1) & (np.abs(np.abs(CX) - 6) < 4) & (value("ink", 16, 16) > -.2), -.38, 0))
    return t


def books(t, name, x0, x1, y0, y1, colors=("#9a3a34", "#3a6a8a", "#5a7a3a", "#a8803a", "#6a4a80", "#8a5a3a", "#3a7a70", "#b0a080")):
    r = rng(name)
    x = x0
    while x < x1:
        w = min(int(r.integers(2, 5)), x1 - x)
        top = y0 + int(r.integers(0, 3))
        c = colors[int(r.integers(0, len(colors)))]
        m = (X >= x) & (X < x + w) & (Y >= top) & (Y < y1)
        t.shade(m, ramp(c, .2, .16, 7), np.clip(.62 - .22 * (X - x) / w + .04 * value(name, 8, 8), 0, .99), h=2.)
        t.light(np.where(m & (X == x + w - 1), -.25, 0))
        t.put(m & ((Y == top + 2) | (Y == y1 - 3)) & (w > 2), lift(c, .2))
        x += w
    return t


def bookshelf(name, chiseled=False):
    t = planks("oak_planks", "#b08a52" if not chiseled else "#a87a44")
    for k, (y0, y1) in enumerate(((3, 14), (18, 29))):
        m = (Y >= y0) & (Y < y1) & (X >= (0 if not chiseled else 2)) & (X < (32 if not chiseled else 30))
        t.shade(m, blend("#1c120c", "#33200f", "#4a2f18", n=5), np.clip(.2 + .05 * (Y - y0), 0, .99), h=-1.)
        if not chiseled:
            books(t, f"{name}/{k}", 0, 32, y0, y1)
        else:
            for x in (11, 20):
                t.shade(m & (np.abs(X - x) < 1), ramp("#a87a44", .14, .1, 6), np.full_like(X, .5), h=2.)
            books(t, f"{name}/{k}", 3 + 9 * k, 9 + 9 * k, y0 + 1, y1)
        t.light(np.where(Y == y1, .14, 0) - np.where(Y == y0 - 1, .2, 0))
    return t


def barrel(name, part):
    if part == "side":
        t = planks(name, "#8a6238")
        t.rgb = t.rgb.transpose(1, 0, 2).copy()
        t.h = t.h.T.copy()
        for y in (6, 25):
            m = np.abs(Y - y) < 2
            t.shade(m, ramp("#5c5e66", .18, .18, 6), np.clip(.6 - .14 * (Y - y), 0, .99), h=2.8, r=.4)
            t.light(np.where(roll(m, 0, 1) & ~m, -.3, 0))
        return t
    t = cabinet(name, "#9a7040", 4)
    if part == "top":
        m = CHEB < 4
        t.shade(m, blend("#140d08", "#2a1a0e", n=4), np.full_like(X, .4), h=-2.)
        t.light(np.where(roll(m, 1, 1) & ~m, .15, 0))
    return t


def chest(name, part, ender=False):
    base = "#a8763a" if not ender else "#26323a"
    t = wooden("chest_" + part, base, False)
    t.wrap = False
    # A chest is 14 wide and 14 high, so its rim lies within the tile.
    d = np.minimum(np.minimum(X - 2, 29 - X), np.minimum(Y - (2 if part == "top" else 4), (29 if part == "top" else 31) - Y))
    edge = d < 3
    t.light(np.where(edge, -.34, 0) + np.where(d == 1, .14, 0) - np.where(d == 3, .14, 0))
    if part != "top":
        lid = np.abs(Y - 13) < 1
        t.light(np.where(lid, -.5, 0) + np.where(Y == 14, .14, 0))
        t.h -= lid * 1.5
    else:
        t.light(np.where((Y == 15) & (D > 4), -.14, 0))
    t.h += edge * .8
    if part == "front":
        m = (np.abs(CX) < 2.6) & (Y > 9) & (Y < 18)
        t.light(np.where(roll(m, 1, 1) & ~m, -.4, 0))
        t.shade(m, ramp("#c9ccd2" if not ender else "#3ac8a4", .2, .14, 7), np.clip(.75 - .03 * (CX + CY) * 2, 0, .99), h=3., r=.35)
        t.put(m & (np.abs(CX) < 1) & (np.abs(Y - 14) < 1.2), rgb("#2c2e34"))
        if ender:
            t.glow(m, .6)
    return t


def hive(name, part, nest=False):
    if nest:
        t = Tex(name, .85)
        u = Y + 1.6 * fbm("nest", 3, 3, 2) if part != "top" else EUC * .9 + fbm("nest", 4, 4, 2)
        t.fill(np.clip(.52 + .26 * np.sin(u / 32 * 2 * np.pi * 5) + .08 * fbm("nest/g", 8, 8, 2), 0, .99), ramp("#d0a048", .18, .12, 8))
        t.h = 1.2 * np.sin(u / 32 * 2 * np.pi * 5)
    else:
        t = cabinet("beehive", "#b8905a", 2)
        if part == "side":
            t.light(np.where(np.abs(Y - 20) < 1, -.3, 0))
    if part == "front":
        m = (np.abs(CX) < 6) & (np.abs(CY - 4) < 2.6)
        t.light(np.where(roll(m, -1, -1) & ~m, -.3, 0) + np.where(roll(m, 1, 1) & ~m, .2, 0))
        t.put(m, rgb("#2a1a0c"), h=-1.5)
    return t


def comb(name):
    t = Tex(name, .4)
    pts = np.array([(4 + 8 * i + (4 if j % 2 else 0), 4 + 8 * j) for j in range(4) for i in range(4)], float) % 32
    c = Cells(pts)
    f = .5 - .03 * (c.vx + c.vy) + c.per(name, -.08, .08) + .22 * (c.edge < .8) - .2 * (c.f1 < 2)
    t.fill(np.clip(f, 0, .99), ramp("#e49a24", .2, .16, 7), 0)
    t.h = 2 * ss(2, 0, c.edge)
    return t


def jelly(name, color, alpha):
    t = Tex(name, .1)
    core = CHEB < 9
    t.fill(np.clip(.55 - .012 * (CX + CY) + .12 * fbm(name, 4, 4, 2) - .18 * core, 0, .99), ramp(color, .16, .16, 8))
    t.light(np.where(D < 1, .12, 0) + np.where((np.abs(CX + CY + 20) < 2) & (D > 2), .2, 0))
    t.a[:] = alpha
    t.a[core] = min(1, alpha + .2)
    t.a[D < 2] = min(1, alpha + .2)
    t.h = ss(0, 3, D)
    return t


def scaffold(name, top):
    from wood import bamboo
    t = bamboo("bamboo_planks", "#cfae5c")
    if top:
        hole(t, (CHEB < 11) & ((X + Y) % 6 < 4) & ((X - Y) % 6 < 4))
        t.wrap = False
    return t


for _p in ("front", "side", "top"):
    add("crafting_table_" + _p, crafting, _p)
    add("cartography_table_" + _p, table, "#5a3f26", "cartography", _p)
    add("fletching_table_" + _p, table, "#d0bc8a", "fletching", _p)
    add("smithing_table_" + _p, table, "#5a3826", "smithing", _p)
    add("loom_" + _p, table, "#a4855a", "loom", _p)
    add("chest_" + _p, chest, _p)
    add("ender_chest_" + _p, chest, _p, True)
add("smithing_table_bottom", table, "#5a3826", "smithing", "bottom")
add("lectern_top", table, "#a9834e", "lectern", "top")
add("lectern_side", lambda name: books(cabinet(name, "#a9834e", 3), name, 6, 26, 10, 22))
add("bookshelf", bookshelf)
add("chiseled_bookshelf_front", bookshelf, True)
add("chiseled_bookshelf_side", lambda name: cabinet(name, "#a87a44", 3))
add("chiseled_bookshelf_top", lambda name: cabinet(name, "#a87a44", 4))
for _p in ("side", "top", "bottom"):
    add("barrel_" + _p, barrel, _p)
add("composter_side", lambda name: cabinet(name, "#8a5f36", 3))
add("composter_top", lambda name: planks(name, "#7a5430"))
for _p in ("front", "side", "end"):
    add("beehive_" + _p, hive, _p)
for _p in ("front", "side", "top", "bottom"):
    add("bee_nest_" + _p, hive, _p, True)
add("honeycomb_block", comb)
add("honey_block", jelly, "#f2a62a", .62)
add("slime_block", jelly, "#78c060", .58)
add("scaffolding_side", scaffold, False)
add("scaffolding_top", scaffold, True)
add("note_block", lambda name: cabinet(name, "#7a4e34", 3))
add("jukebox_top", lambda name: (lambda t: tool(t, (np.abs(CX) < 9) & (np.abs(CY) < 1.4), "#26201e", .3))(cabinet("note_block", "#7a4e34", 3)))
add("creaking_heart", lambda name: (lambda t: (t.shade((np.abs(CX) < 6) & (EUC < 9), ramp("#e07a2c", .2, .18, 7), np.clip(.9 - EUC / 11, 0, .99)), t.glow((np.abs(CX) < 6) & (EUC < 9), .6), t)[2])(bark("pale_oak_log", *WOODS["pale_oak"][1:4])))
add("creaking_heart_top", lambda name: cut_end(name, "#9a6a4c", ("pale_oak_log", *WOODS["pale_oak"][1:4])))
