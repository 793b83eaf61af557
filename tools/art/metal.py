"""Metal blocks, and copper in its four stages."""
import numpy as np

from color import blend, lift, mix, ramp, rgb
from joinery import door, frame, hole, metalwork, panels
from masonry import bricks, framed
from noise import X, Y, Cells, fbm, points, rng, roll, ss, value
from tex import Tex, add

D = np.minimum(np.minimum(X, 31 - X), np.minimum(Y, 31 - Y))


def rim(t, width=2, up=.16, down=.2):
    hi = ((X < width) & (Y < 32 - X)) | ((Y < width) & (X < 32 - Y))
    lo = ((X > 31 - width) | (Y > 31 - width)) & ~hi
    t.light(np.where(hi, up, 0) - np.where(lo, down, 0) + np.where(D == width, -.08, 0))
    t.h = t.h + ss(-.5, width + .5, D) * 1.4
    return t


def plate(name, color, rough=.28, dark=.16, light=.14, kind="lines", patina=None, amount=0.):
    t = Tex(name, rough)
    f = .58 + .07 * fbm("plate", 3, 10, 2) + .10 * np.cos((X + Y) / 32 * 2 * np.pi)
    if kind == "lines":
        f = f - .07 * ((Y % 8) == 7) + .05 * ((Y % 8) == 0)
        t.h = -.4 * ((Y % 8) == 7)
    elif kind == "gem":
        c = Cells(np.array([(8, 8), (24, 8), (8, 24), (24, 24), (16, 16), (0, 16), (16, 0), (0, 0)], float), power=1.)
        f = .55 + c.per("gem", -.1, .1) - .035 * (c.vx + c.vy) - .12 * (c.edge < .6)
        t.h = 2 * ss(0, 3, c.edge)
    t.fill(np.clip(f, 0, .99), ramp(color, dark, light, 8))
    rim(t)
    if patina is not None:
        m = fbm(name.split("_")[0] + "/patina", 4, 4, 3) + .10 * (D < 3) < amount
        t.shade(m, ramp(patina, .1, .1, 6), np.clip(.5 + .3 * fbm("pat", 8, 8, 2), 0, .99), r=.75)
    return t


def raw(name, color, spot):
    t = Tex(name, .6)
    c = Cells(points(name, 4, 4, .9), power=1.4)
    f = .48 + c.per(name, -.18, .18) - .045 * (c.vx + c.vy) - .3 * (c.edge < .6) + .1 * fbm(name, 8, 8, 2)
    t.fill(np.clip(f, 0, .99), ramp(color, .2, .18, 8))
    m = (value(name + "/s", 9, 9) > .5) & (c.edge > .7)
    t.shade(m, ramp(spot, .12, .12, 5), np.clip(f, 0, .99))
    t.h = 2.4 * ss(0, 3, c.edge)
    return t


COPPER = {"": ("#c06b4c", None, 0., .32), "exposed_": ("#a67a63", "#8d9a7c", -.34, .5), "weathered_": ("#6c9a72", "#8f7a60", -.36, .7), "oxidized_": ("#50a084", "#78b89c", -.30, .8)}


def patina_over(t, stage, keep=None):
    _, spot, amount, rough = COPPER[stage]
    t.r[:] = np.maximum(t.r, rough)
    if spot:
        f = fbm(stage + "pat", 4, 4, 3)
        m = f < amount if keep is None else (f < amount) & ~keep
        lum = t.rgb.mean(-1)
        t.shade(m & (t.a > 0), ramp(spot, .16, .14, 8), np.clip((lum - lum.min()) / max(np.ptp(lum), .01), 0, .99))
    return t


def copper(name, stage, kind):
    c = COPPER[stage][0]
    rough = COPPER[stage][3]
    if kind == "block":
        t = plate(name, c, rough)
        for x, y in ((3, 3), (27, 3), (3, 27), (27, 27)):
            m = (X >= x) & (X < x + 2) & (Y >= y) & (Y < y + 2)
            t.rgb[m] = lift(c, -.12)
            t.rgb[(X == x) & (Y == y)] = lift(c, .16)
    elif kind == "cut":
        t = bricks("cut_copper", c, [(16, 16, 0), (16, 16, 0)], rough=rough, tone=.05, chip=-.2, mortar=lift(c, -.2))
    elif kind == "chiseled":
        t = framed("chiseled_copper", c, "diamond", rough=rough)
    elif kind == "grate":
        t = plate(name, c, rough)
        hole(t, ((X % 8 > 2) & (Y % 8 > 2) & (X % 8 < 7) & (Y % 8 < 7)))
    elif kind in ("bulb", "bulb_lit"):
        t = plate(name, c, rough, kind="flat")
        cx, cy = X - 15.5, Y - 15.5
        cheb, euc = np.maximum(abs(cx), abs(cy)), np.hypot(cx, cy)
        cage = (euc < 11) & ((abs(cx) < 1) | (abs(cy) < 1) | (np.abs(euc - 10) < 1.1))
        core = (euc < 10) & ~cage
        lit = kind == "bulb_lit"
        pal = blend("#d07820", "#f8b848", "#ffe8a0", "#fffbe6", n=7) if lit else blend("#3a2620", "#5c3c2e", "#80573e", n=6)
        t.shade(core, pal, np.clip(1.05 - euc / 11 - .02 * (cx + cy), 0, .99), h=.6, r=.3)
        if lit:
            t.glow(core, {"": 1., "exposed_": .8, "weathered_": .6, "oxidized_": .4}[stage])
        t.h += cage * 1.5
        return patina_over(t, stage, euc < 11)
    elif kind in ("door_top", "door_bottom"):
        t = door("iron_" + kind, c, "grid", "panels", kind == "door_top", lift(c, -.15), rough)
    else:
        t = plate(name, c, rough, kind="flat")
        cx, cy = abs(X - 15.5), abs(Y - 15.5)
        hole(t, (np.maximum(cx, cy) < 11) & (np.minimum(cx, cy) > 2) & (cx + cy > 7) & (cx + cy < 17))
    return patina_over(t, stage)


add("iron_block", plate, "#d4d5d6")
add("gold_block", plate, "#f2c640", .22, .2, .14)
add("diamond_block", plate, "#63d8d2", .12, kind="gem")
add("emerald_block", plate, "#2fc268", .12, kind="gem")
add("netherite_block", plate, "#48434a", .45)
add("redstone_block", plate, "#b01c12", .5, kind="gem")
add("lapis_block", plate, "#2752a8", .4, kind="gem")
add("coal_block", raw, "#2a2a30", "#3e3e48")
add("raw_iron_block", raw, "#b08a70", "#d8b094")
add("raw_gold_block", raw, "#dda436", "#f6d35a")
add("raw_copper_block", raw, "#a8603f", "#5c9a78")
for _s in COPPER:
    add("copper_block" if _s == "" else _s + "copper", copper, _s, "block")
    add(_s + "cut_copper", copper, _s, "cut")
    add(_s + "chiseled_copper", copper, _s, "chiseled")
    for _k in ("grate", "bulb", "bulb_lit", "door_top", "door_bottom", "trapdoor"):
        add(f"{_s}copper_{_k}", copper, _s, _k)
