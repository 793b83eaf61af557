"""Cut and laid stone: bricks, tiles, pillars, carved blocks."""
import numpy as np

from color import blend, lift, mix, ramp
from noise import X, Y, Cells, Grid, fbm, points, roll, ss, value
from stone import BLACK, DEEP, NATURAL, STONE, TUFF, facet_field, moss_over
from tex import Tex, add

STONE_ROWS = [(16, 32, 0), (16, 32, 16)]
HALF_ROWS = [(16, 16, 0), (16, 16, 8)]
BRICK_ROWS = [(8, 16, 0), (8, 16, 8), (8, 16, 0), (8, 16, 8)]
TILE_ROWS = [(8, 8, 0), (8, 8, 4), (8, 8, 0), (8, 8, 4)]
LONG_ROWS = [(8, 16, 0), (8, 16, 8), (8, 16, 4), (8, 16, 12)]


def bricks(name, base, rows=BRICK_ROWS, mortar=None, dark=.18, light=.13, tone=.14, grain=.16, rough=.85, cracked=False, gap=1, bevel=.13,
           chip=.45, hue=None):
    t = Tex(name, rough)
    g = Grid(rows)
    # Mortar lies on the right and bottom side of each brick, so that a row keeps its height.
    joint = (g.right < gap) | (g.bottom < gap)
    inner_r, inner_b = g.right - gap, g.bottom - gap
    f = .52 + g.per(name + "/tone", -tone, tone) + grain * fbm(name + "/g", 7, 7, 2)
    f += np.where(g.top == 0, bevel, 0) + np.where((g.left == 0) & (g.top > 0), bevel * .7, 0)
    f -= np.where(inner_b == 0, bevel * 1.2, 0) + np.where((inner_r == 0) & (inner_b > 0), bevel * .8, 0)
    # Knocked-off corners make each brick its own.
    corner = np.minimum(np.minimum(g.left, inner_r) + np.minimum(g.top, inner_b), 9)
    chipped = (corner < .5 + 1.6 * (value(name + "/chip", 16, 16) + chip - .5)) & ~joint
    joint = joint | (chipped & (corner < 2))
    crack = np.zeros_like(joint)
    if cracked:
        tone2, _, crack = facet_field(name + "/crack", 3, 3, crack=.75, width=.6)
        f = f + .5 * (tone2 - .5)
        crack = crack & ~joint
    f = f - .42 * crack + .12 * (roll(crack, 1, 1) & ~crack)
    t.fill(np.clip(f, 0, .99), ramp(base, dark, light, 8))
    if hue is not None:
        other = ramp(hue, dark, light, 8)
        pick = (g.per(name + "/hue") > .7) & ~joint
        t.shade(pick, other, np.clip(f, 0, .99))
    m = ramp(mix(base, "#20222c", .5) if mortar is None else mortar, .06, .05, 4)
    t.shade(joint, m, np.clip(.5 + .5 * value(name + "/m", 10, 10), 0, .99))
    t.h = np.where(joint, 0, 1.2 + ss(-.6, 1.6, np.minimum(np.minimum(g.left, inner_r), np.minimum(g.top, inner_b))) * .8 + g.per(name + "/h", 0, .4)
                   + .35 * fbm(name + "/b", 8, 8, 2)) - .9 * crack
    t.r[joint] = .95
    return t


def framed(name, base, pattern="rings", dark=.2, light=.16, rough=.8, inlay=None, glow=False):
    """A carved block: a rim, a groove, and a motif cut into the middle."""
    t = Tex(name, rough)
    r = ramp(base, dark, light, 8)
    d = np.minimum(np.minimum(X, 31 - X), np.minimum(Y, 31 - Y))
    cx, cy = X - 15.5, Y - 15.5
    cheb, man, euc = np.maximum(abs(cx), abs(cy)), abs(cx) + abs(cy), np.hypot(cx, cy)
    h = ss(-.5, 1.5, d) * 1.0
    cut = {
        "rings": ((cheb > 4) & (cheb < 6)) | ((cheb > 8) & (cheb < 10)) | (cheb < 1.5),
        "diamond": ((man > 9) & (man < 11.6)) | (man < 4.2) | ((man > 17) & (man < 19) & (d > 3)),
        "circle": ((euc > 8.4) & (euc < 10.6)) | ((euc > 3) & (euc < 5)),
        "face": ((abs(abs(cx) - 5) < 2.1) & (abs(cy + 3.5) < 2.1)) | ((abs(cy - 6) < 1.6) & (abs(cx) < 7)) | ((abs(cx) < 1.2) & (abs(cy - 1) < 2.2)),
        "cross": ((abs(cx) < 1.6) | (abs(cy) < 1.6)) & (cheb < 10) | ((cheb > 9.5) & (cheb < 11.2)),
        "columns": (np.abs(((X - 2) % 7) - 3) < .9) & (d > 4),
        "waves": (np.abs(((Y + 3 * np.sin(X / 32 * 4 * np.pi)) % 8) - 4) < 1.0) & (d > 3),
        "eye": ((np.hypot(cx * .7, cy) > 5.2) & (np.hypot(cx * .7, cy) < 7.2)) | (euc < 2.6),
        "spiral": (np.abs(((euc - 1.6 * np.arctan2(cy, cx)) % 5.03) - 2.5) < .9) & (euc < 11.5) & (euc > 1),
        "plain": np.zeros_like(cx, bool),
    }[pattern]
    groove = (d >= 2) & (d < 3)
    low = cut | groove
    f = .55 + .13 * fbm(name + "/g", 7, 7, 2) - .28 * low + .14 * (roll(low, 1, 1) & ~low) - .10 * (roll(low, -1, -1) & ~low)
    f += np.where((d < 1) & ((X < 1) | (Y < 1)), .15, 0) - np.where((d < 1) & ((X > 30) | (Y > 30)), .2, 0)
    t.fill(np.clip(f, 0, .99), r, 0)
    t.h = h * 1.5 - 1.3 * low
    if inlay is not None:
        t.shade(cut, ramp(inlay, .12, .16, 5), np.clip(.5 + .3 * fbm(name + "/i", 6, 6, 2), 0, .99))
        if glow:
            t.glow(cut, .8)
    return t


def fluted(name, base, top=False, rough=.5, dark=.14, light=.1):
    t = Tex(name, rough)
    r = ramp(base, dark, light, 7)
    if top:
        cheb = np.maximum(abs(X - 15.5), abs(Y - 15.5))
        f = .55 + .14 * np.cos(cheb * np.pi / 2.5) + .08 * fbm(name, 6, 6, 2)
        t.h = .8 * np.cos(cheb * np.pi / 2.5)
    else:
        u = (X % 8) / 8
        cap = (Y < 3) | (Y > 28)
        f = np.where(cap, .66, .5 + .24 * np.sin(u * 2 * np.pi + .5)) + .07 * fbm(name, 8, 3, 2)
        f -= .3 * ((Y == 3) | (Y == 28)) - .12 * ((Y == 0) | (Y == 29))
        t.h = np.where(cap, 1.6, 1 - 1.2 * np.abs(u - .5) * 2)
    t.fill(np.clip(f, 0, .99), r)
    return t


def smooth_block(name, base, rim=True, rough=.4, dark=.08, light=.06, grain=.12):
    t = Tex(name, rough)
    t.fill(.5 + grain * fbm(name, 4, 4, 3) * 2, ramp(base, dark, light, 6))
    if rim:
        d = np.minimum(np.minimum(X, 31 - X), np.minimum(Y, 31 - Y))
        t.light(np.where((d < 1) & ((X < 1) | (Y < 1)), .06, 0) - np.where((d < 1) & ((X > 30) | (Y > 30)), .12, 0))
        t.h = ss(0, 2, d)
    return t


def cut_block(name, base):
    """Cut sandstone: a smooth field between two lines."""
    t = smooth_block(name, base, True, .85)
    line = ((Y > 2) & (Y < 5)) | ((Y > 26) & (Y < 29)) | (Y == 15)
    t.light(np.where(line, -.14, 0) + np.where(roll(line, 0, 1) & ~line, .07, 0))
    t.h -= line * 1.0
    return t


def prismarine(name):
    """Its plates drift in color, slowly, and come back."""
    shades = ["#5f9e8e", "#64979e", "#7386a8", "#64979e"]
    frames = []
    for c in shades:
        t = Tex(name, .5)
        cells = Cells(points(name, 5, 5, .9))
        f = .5 + cells.per(name, -.22, .22) - .03 * (cells.vx + cells.vy) - .3 * (cells.edge < .6)
        t.fill(f, ramp(c, .2, .15, 7))
        t.h = 2 * ss(0, 2, cells.edge)
        frames.append(t)
    return frames


def glazed(name, base, accent, pattern):
    """Glazed terracotta: one quarter of a motif that joins up when four are laid in a ring."""
    t = Tex(name, .15)
    a, b, c = ramp(base, .16, .12, 6), ramp(accent, .16, .1, 6), ramp(mix(base, "#f4f0e6", .72), .1, .04, 6)
    euc = np.hypot(X + .5, Y + .5)
    far = np.hypot(31.5 - X, 31.5 - Y)
    diag = X - Y
    sh = np.clip(.55 + .12 * fbm(name, 5, 5, 2), 0, .99)
    t.shade(np.ones_like(X, bool), a, sh)
    k = pattern % 4
    if k == 0:
        t.shade((euc > 8) & (euc < 13), c, sh).shade((euc > 17) & (euc < 20), b, sh).shade(far < 11, b, sh).shade(far < 6, c, sh)
    elif k == 1:
        t.shade(abs(diag) < 5, c, sh).shade(abs(diag) < 2, b, sh).shade(euc < 9, b, sh).shade(far < 9, b, sh).shade((far > 11) & (far < 13), c, sh)
    elif k == 2:
        m = (np.maximum(X, Y) % 11) < 4
        t.shade(m, b, sh).shade((np.maximum(X, Y) % 11) == 4, c, sh).shade((euc < 7), c, sh)
    else:
        leaf = (np.hypot(X - 20, Y - 8) < 9) & (np.hypot(X - 8, Y - 20) > 12) | (np.hypot(X - 8, Y - 20) < 9) & (np.hypot(X - 20, Y - 8) > 12)
        t.shade(leaf, c, sh).shade(far < 10, b, sh).shade((far > 12) & (far < 14), c, sh).shade(euc < 5, b, sh)
    edge = np.abs(t.rgb - roll(t.rgb, 1, 0)).sum(-1) + np.abs(t.rgb - roll(t.rgb, 0, 1)).sum(-1) > .5
    t.light(np.where(edge, -.2, 0))
    t.h = -.5 * edge
    return t


add("bricks", bricks, "#9c5443", hue="#8a4a40", mortar="#b3a79c", tone=.2)
add("stone_bricks", bricks, "#87888c", HALF_ROWS, tone=.08)
add("cracked_stone_bricks", bricks, "#87888c", HALF_ROWS, tone=.08, cracked=True)
add("mossy_stone_bricks", moss_over, (bricks, ("#87888c", HALF_ROWS), dict(tone=.08)), -.04)
add("chiseled_stone_bricks", framed, "#87888c", "circle")
add("mud_bricks", bricks, "#8c6a50", [(8, 16, 0), (8, 16, 8), (8, 16, 4), (8, 16, 12)], tone=.16, mortar="#6b5040")
add("deepslate_bricks", bricks, DEEP, HALF_ROWS, mortar="#25252c", tone=.1)
add("cracked_deepslate_bricks", bricks, DEEP, HALF_ROWS, mortar="#25252c", tone=.1, cracked=True)
add("deepslate_tiles", bricks, "#46464e", TILE_ROWS, mortar="#202026", tone=.18)
add("cracked_deepslate_tiles", bricks, "#46464e", TILE_ROWS, mortar="#202026", tone=.18, cracked=True)
add("chiseled_deepslate", framed, DEEP, "eye")
add("reinforced_deepslate_side", framed, "#5d5f60", "waves")
add("reinforced_deepslate_top", framed, "#6b6e66", "circle")
add("tuff_bricks", bricks, "#6f7369", HALF_ROWS, tone=.1)
add("chiseled_tuff", framed, TUFF, "rings")
add("chiseled_tuff_bricks", framed, "#6f7369", "columns")
add("polished_blackstone_bricks", bricks, "#3a3640", HALF_ROWS, mortar="#1b191f", tone=.12, light=.15)
add("cracked_polished_blackstone_bricks", bricks, "#3a3640", HALF_ROWS, mortar="#1b191f", tone=.12, cracked=True, light=.15)
add("chiseled_polished_blackstone", framed, BLACK, "face")
add("nether_bricks", bricks, "#3f2026", BRICK_ROWS, mortar="#1d0f14", tone=.12, light=.12)
add("cracked_nether_bricks", bricks, "#3f2026", BRICK_ROWS, mortar="#1d0f14", tone=.12, cracked=True)
add("chiseled_nether_bricks", framed, "#3f2026", "face")
add("red_nether_bricks", bricks, "#6a1517", BRICK_ROWS, mortar="#2e0a0e", tone=.12)
add("end_stone_bricks", bricks, "#dfe0a6", [(8, 16, 0), (8, 32, 8), (8, 16, 4), (8, 32, 0)], mortar="#b0a878", dark=.12, light=.07)
add("purpur_block", bricks, "#a877a8", HALF_ROWS, mortar="#7b5480", tone=.08, chip=.1)
add("purpur_pillar", fluted, "#ab7bab")
add("purpur_pillar_top", fluted, "#ab7bab", True)
add("quartz_block_side", smooth_block, "#ebe5de", rough=.3)
add("smooth_quartz", smooth_block, "#ece6df", False, .3)
add("quartz_bricks", bricks, "#eae4dc", BRICK_ROWS, mortar="#cdc4ba", dark=.1, light=.05, tone=.06, chip=.1, rough=.35)
add("quartz_pillar", fluted, "#eae4dc", dark=.12, light=.06)
add("quartz_pillar_top", fluted, "#eae4dc", True, dark=.1, light=.06)
add("chiseled_quartz_block", framed, "#eae4dc", "spiral", dark=.16, light=.07, rough=.35)
add("marble_bricks", bricks, "#e2dfe0", BRICK_ROWS, mortar="#b9b7c2", dark=.12, light=.06, tone=.09, rough=.35, chip=.2)
add("slate_bricks", bricks, "#52606f", HALF_ROWS, mortar="#2a323d", tone=.12, rough=.6)
add("prismarine", prismarine)
add("prismarine_bricks", bricks, "#67a898", HALF_ROWS, mortar="#4a7f7c", hue="#6f93a8", rough=.5)
add("dark_prismarine", bricks, "#335b4d", TILE_ROWS, mortar="#22403a", rough=.45, tone=.12)
add("resin_bricks", bricks, "#d9651c", BRICK_ROWS, mortar="#96400f", rough=.4)
add("chiseled_resin_bricks", framed, "#d9651c", "diamond", rough=.4)
add("resin_block", smooth_block, "#dd6c1e", rough=.35, dark=.14, light=.12, grain=.2)
for _red, _c in (("", "#dccc9a"), ("red_", "#b6673c")):
    add(f"cut_{_red}sandstone", cut_block, _c)
    add(f"chiseled_{_red}sandstone", framed, _c, "face" if not _red else "diamond", .18, .08)
