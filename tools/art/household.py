"""Pots, anvils, cauldrons, cake, spawners and other single blocks; mangrove roots."""
import numpy as np

from color import blend, lift, mix, ramp, rgb
from fungi import pores
from furniture import cabinet, tool
from joinery import hole
from masonry import framed, smooth_block
from metal import plate, rim
from noise import X, Y, Cells, fbm, points, rng, roll, ss, value, wrap
from redstone import machine, opening
from sprite import pal, sprite, stroke
from stone import NATURAL, rock
from tex import Tex, add
from wood import WOODS, bark

CX, CY = X - 15.5, Y - 15.5
D = np.minimum(np.minimum(X, 31 - X), np.minimum(Y, 31 - Y))
CHEB, EUC = np.maximum(abs(CX), abs(CY)), np.hypot(CX, CY)


def anvil(name, crack=0):
    t = Tex(name, .45)
    t.fill(np.clip(.55 + .16 * fbm("anvil", 5, 5, 3) - .008 * (CX + CY), 0, .99), ramp("#4a4b52", .16, .18, 7))
    t.h = .6 * fbm("anvil", 5, 5, 3)
    if "top" in name:
        m = (np.abs(CX) < 9)
        t.light(np.where(m & ~roll(m, 1, 0), .3, 0) + np.where(m, .10, 0))
    if crack:
        c = Cells(points(name, 3, 3, .9), x=X + 2 * fbm(name + "/x", 5, 5, 2), y=Y)
        m = (c.edge < .35 + .2 * crack) & (c.pair(name) < .4 * crack)
        t.light(np.where(m, -.45, 0) + np.where(roll(m, 1, 1) & ~m, .15, 0))
        t.h -= m * 1.2
    return t


def cauldron(name, top):
    t = plate(name, "#4a4b52", .5, kind="lines")
    if top:
        opening(t, CHEB < 11.5)
    return t


def cake(name, part):
    t = Tex(name, .8)
    if part == "top":
        t.fill(np.clip(.7 + .2 * fbm(name, 4, 4, 2), 0, .99), ramp("#f2ece4", .1, .04, 5))
        r = rng(name)
        for x, y in points(name, 3, 3, .8):
            m = np.hypot(X - x, Y - y) < r.uniform(1.6, 2.6)
            t.shade(m, ramp("#cf2f36", .16, .16, 6), np.clip(.6 - .1 * (X - x + Y - y), 0, .99), h=1.5, r=.3)
    else:
        # The lower half is what shows: the cake is half a block high.
        drip = 19 + 2.2 * value("drip", 9, 1)
        t.fill(np.clip(.55 + .25 * fbm(name, 8, 8, 2), 0, .99), ramp("#b9743c", .14, .12, 6))
        t.shade((Y < drip), ramp("#f2ece4", .1, .04, 5), np.clip(.7 + .15 * fbm(name + "/i", 6, 6, 2), 0, .99), h=1.2)
        t.shade((Y > 24) & (Y < 27) & (part == "side"), ramp("#d8b06a", .1, .1, 5), np.full_like(X, .5))
    return t


def pot(name, part):
    t = Tex(name, .85)
    f = .55 + .12 * fbm("pot", 4, 8, 2)
    t.fill(np.clip(f, 0, .99), ramp("#a3583c", .16, .12, 7))
    if part == "flower":
        t.light(np.where((Y >= 20) & (Y < 24), .14, 0) - np.where(Y == 24, .25, 0))
        dirt_zone = (CHEB < 4)
        t.shade(dirt_zone, ramp("#5a3d29", .12, .12, 5), np.clip(.5 + .4 * value("pd", 14, 14), 0, .99))
    elif part == "side":
        for y in (6, 25):
            t.light(np.where(np.abs(Y - y) < 1, -.25, 0))
        m = (np.abs(np.abs(CX) + np.abs(CY) - 7) < 1.4)
        t.light(np.where(m, -.28, 0))
    else:
        opening(t, EUC < 7)
    return t


def bone(name, top):
    t = Tex(name, .7)
    if top:
        f = .62 + .12 * np.cos(EUC * 1.1) - .3 * (CHEB > 14) - .3 * (EUC < 3)
    else:
        f = .58 + .16 * value(name, 12, 3) - .2 * (np.abs(Y - 3) < 1) - .2 * (np.abs(Y - 28) < 1)
    t.fill(np.clip(f + .06 * fbm(name, 8, 8, 2), 0, .99), ramp("#ddd8c0", .16, .07, 7))
    t.h = f * 2
    return t


def cage(name):
    t = sprite(name, .5)
    iron = ramp("#38424e", .16, .2, 7)
    m = (D < 3) | (X % 7 < 2) & (D >= 3) | (Y % 7 < 2) & (D >= 3)
    t.shade(m, iron, np.clip(.6 - .012 * (CX + CY) + .15 * fbm(name, 7, 7, 2) - .15 * ((X % 7 == 1) | (Y % 7 == 1)), 0, .99))
    t.h = m * 1.5 + (D < 3) * 1.
    return t


def vault(name, part, trial=False):
    t = framed(name, "#5d6a68" if not trial else "#66717a", {"front": "eye", "side": "columns", "top": "rings"}[part], inlay="#c8782e" if not trial else "#e8a23c", glow=part != "side")
    return t


def grind(name):
    t = rock("stone", "#9a9a98", .1, .1, crack=0, contrast=.5)
    t.light(.08 * np.cos(EUC * 1.4))
    tool(t, EUC < 4, "#6a4a2c")
    return t


def cutter(name, part):
    if part == "saw":
        t = sprite(name, .3)
        a = np.arctan2(Y - 31, CX)
        d = np.hypot(CX, Y - 31)
        m = d < 13 + 1.4 * np.sign(np.sin(a * 14))
        t.shade(m, ramp("#c2c5ca", .18, .14, 7), np.clip(.6 + .12 * np.cos(a * 3) - .02 * (d - 8), 0, .99), h=1.)
        return t
    t = machine(name, "#8a8580")
    if part == "top":
        opening(t, (np.abs(CY) < 1.6) & (np.abs(CX) < 12))
    return t


def enchanting(name, top):
    if top:
        t = Tex(name, .8)
        t.fill(np.clip(.55 + .12 * fbm(name, 5, 5, 2), 0, .99), ramp("#a02a30", .14, .12, 6))
        tool(t, D < 3, "#5ad8cc")
        t.light(np.where((CHEB > 7) & (CHEB < 8.6), .25, 0))
        return t
    t = NATURAL["obsidian"][0]("obsidian")
    m = Y < 14
    t.shade((Y >= 8) & (Y < 14), ramp("#a02a30", .14, .12, 6), np.clip(.6 - .05 * (Y - 8) + .1 * value(name, 9, 9), 0, .99), h=2.)
    for x in (4, 27):
        tool(t, (np.abs(X - x) < 3) & (np.abs(Y - 12) < 3), "#5ad8cc")
    return t


def bell(name):
    t = plate(name, "#eec04a", .22, .2, .14, kind="flat")
    t.light(np.where(np.abs(Y - 24) < 1, -.25, 0) + np.where(np.abs(CX + 4) < 1.5, .18, 0))
    return t


def roots(name, top, mud=False):
    t = sprite(name, .9)
    t.wrap = True
    if mud:
        from soil import SOILS
        p, a, k = SOILS["mud"]
        t = p("mud", *a, **k)
    r = rng(name.replace("muddy_", ""))
    bp = pal("#5e4a34", .2, .18, 8)
    for layer in range(3):
        for k in range(5):
            x0, x1 = r.uniform(-4, 36), r.uniform(-4, 36)
            pts = [(x0, -2), (x0 + r.uniform(-8, 8), 12), (x1 + r.uniform(-8, 8), 22), (x1, 34)] if not top else \
                  [(x0, r.uniform(-2, 34)), (r.uniform(4, 28), r.uniform(4, 28)), (x1, r.uniform(-2, 34))]
            stroke(t, pts, 3.2, 2.4, bp, .3 + .16 * layer, .1)
    return t


def anchor(name, top):
    t = NATURAL["crying_obsidian"][0]("crying_obsidian", True)
    if top:
        m = EUC < 11
        a = np.arctan2(CY, CX)
        t.shade(m, blend("#2a0a4e", "#7a2ad0", "#c890ff", n=7), np.clip(.5 + .35 * np.sin(a * 2 + EUC * .6), 0, .99), h=-1.)
        t.glow(m, .8)
    else:
        for k in range(4):
            m = np.hypot(X - 6 - 6.6 * k, Y - 16) < 2.2
            t.shade(m, ramp("#e8b83c", .2, .16, 6), np.full_like(X, .6), h=2.)
    return t


def beacon(name):
    t = Tex(name, .1)
    t.fill(np.clip(.75 - EUC / 40 + .1 * np.cos(CHEB * 1.4), 0, .99), blend("#2aa8b8", "#6ae8e4", "#c8fffa", "#ffffff", n=8))
    t.glow(np.ones_like(X, bool), 1.)
    t.h = ss(0, 4, D)
    return t


add("anvil", anvil)
add("anvil_top", anvil)
add("chipped_anvil_top", anvil, 1)
add("damaged_anvil_top", anvil, 2)
add("cauldron_side", cauldron, False)
add("cauldron_top", cauldron, True)
for _p in ("side", "top", "bottom"):
    add("cake_" + _p, cake, _p)
add("flower_pot", pot, "flower")
add("decorated_pot_side", pot, "side")
add("decorated_pot_top", pot, "top")
add("bone_block_side", bone, False)
add("bone_block_top", bone, True)
add("spawner", cage)
for _p in ("front", "side", "top"):
    add("vault_" + _p, vault, _p)
add("trial_spawner_side", vault, "side", True)
add("trial_spawner_top", vault, "top", True)
add("heavy_core", framed, "#565b66", "diamond", rough=.35)
add("grindstone_side", grind)
for _p in ("side", "top", "saw"):
    add("stonecutter_" + _p, cutter, _p)
add("enchanting_table_top", enchanting, True)
add("enchanting_table_side", enchanting, False)
add("bell", bell)
add("beacon", beacon)
add("conduit", framed, "#9a8a6a", "eye", inlay="#5ad8e8", glow=True)
add("mangrove_roots_side", roots, False)
add("mangrove_roots_top", roots, True)
add("muddy_mangrove_roots_side", roots, False, True)
add("muddy_mangrove_roots_top", roots, True, True)
add("respawn_anchor_side", anchor, False)
add("respawn_anchor_top", anchor, True)
add("lodestone_side", framed, "#87888c", "columns")
add("lodestone_top", framed, "#87888c", "circle", inlay="#50525c")
