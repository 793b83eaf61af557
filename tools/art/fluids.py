"""Water, lava, fire and portals: strips of frames that come back to where they began."""
import numpy as np

from color import blend, gray, ramp, rgb
from noise import N, X, Y, Cells, fbm, loop, points, rng, roll, ss, value, wrap
from tex import Tex, add

FRAMES = 16


def water(name, flow=False):
    """Caustics: bright ridges where slowly changing swells cross zero. Gray, so that the biome's tint colors it."""
    pal = gray(.62, 1., 9)
    wx, wy = loop("water/wx", 3, 3, FRAMES), loop("water/wy", 3, 3, FRAMES)
    frames = []
    for k in range(FRAMES):
        t = Tex(name, .06)
        x, y = X + 3.4 * wx[k], Y + 3.4 * wy[k]
        if flow:
            y = y - N * k / FRAMES
        tall = 2 if flow else 3
        swell = [value("water/a", 3, tall, x, y), value("water/b", 4, tall + 1, x + 9, y - 5)]
        ridge = [np.clip(1 - np.abs(v) / .42, 0, 1) for v in swell]
        bright = .66 * ridge[0] ** 1.6 + .44 * ridge[1] ** 1.6
        depth = .5 * (swell[0] + swell[1])
        t.fill(np.clip(.19 + .24 * depth + .80 * bright, 0, .999), pal, 2)
        t.h = 1.5 * depth + .5 * bright
        t.a = np.round(np.clip(.64 + .14 * bright, 0, 1) * 32) / 32
        frames.append(t)
    return frames


LAVA = blend("#5a0c06", "#9c1c08", "#d9440c", "#f57a16", "#ffb534", "#ffe680", n=10)


def lava(name, flow=False):
    """Slow convection: dark skin drifts over bright melt."""
    r = rng("lava")
    pts = points("lava", 3, 3, .85)
    ph, rad = r.uniform(0, 6.28, len(pts)), r.uniform(1.2, 2.2, len(pts))
    swirl = loop("lava/s", 3, 3, FRAMES)
    heat = loop("lava/h", 5, 5, FRAMES)
    frames = []
    for k in range(FRAMES):
        a = 2 * np.pi * k / FRAMES
        t = Tex(name, .6)
        wx, wy = X + 1.7 * swirl[k], Y + 1.7 * swirl[(k + 4) % FRAMES]
        if flow:
            c = Cells(pts % N, sx=1, sy=.6, x=wx, y=wy - 32 * k / FRAMES)
        else:
            c = Cells((pts + np.stack([np.cos(a + ph), np.sin(a + ph)], 1) * rad[:, None]) % N, x=wx, y=wy)
        crust = ss(.6, 4.6, c.edge)
        f = .82 - .50 * crust + .13 * heat[k] + .10 * value("lava/g", 8, 8, wx, wy)
        t.fill(np.clip(f, 0, .999), LAVA, 1)
        t.h = 1.8 * crust
        t.glow(np.ones_like(X, bool), 1.)
        t.e *= np.clip(.30 + f, .3, 1)[..., None]
        frames.append(t)
    return frames


def fire(name, colors):
    pal = blend(*colors, n=9)
    r = rng("fire")
    tongues = [(x, r.uniform(.5, 1.), r.uniform(0, 6.28), int(r.integers(1, 3))) for x in np.linspace(3, 29, 7)]
    frames = []
    for k in range(FRAMES):
        a = 2 * np.pi * k / FRAMES
        t = Tex(name, 1.).empty()
        up = 31.5 - Y
        hot = np.zeros((N, N))
        rise = value("fire/rise", 6, 4, X, Y + 32 * k / FRAMES)
        for x, s, ph, n in tongues:
            tall = 31 * s * (.78 + .22 * np.sin(n * a + ph))
            sway = 2.2 * np.sin(n * a + ph + up * .22) * up / 20
            u = up / tall
            w = 4.4 * np.clip(1 - u, 0, 1) ** .7 * (.7 + .5 * np.clip(up / 6, 0, 1))
            d = np.abs(X + .5 - x - sway)
            hot = np.maximum(hot, np.where(u < 1, (1 - d / np.maximum(w, .1)) * (1.15 - .75 * u), 0))
        hot = np.where(hot > .04, hot + .22 * rise * (up > 3), hot)
        m = hot > .16
        t.shade(m, pal, np.clip(hot * .95, 0, .999))
        t.glow(m, 1.)
        for j in range(5):
            y = (r.uniform(0, 1) if False else (j * .2 + k / FRAMES)) % 1
            px, py = int(5 + 5.2 * j + 2 * np.sin(a + j)), int(14 - 14 * y)
            if 0 <= py < N:
                t.put((X == px) & (Y == py), pal[6], e=1.)
        frames.append(t)
    return frames


def portal(name):
    pal = blend("#2a0a4e", "#4a1490", "#7a2ad0", "#a85cf0", "#dcb0ff", n=8)
    swirl = loop("portal/a", 3, 3, FRAMES)
    frames = []
    for k in range(FRAMES):
        t = Tex(name, .1)
        wx, wy = X + 5 * swirl[k], Y + 5 * swirl[(k + 5) % FRAMES]
        v = value("portal/v", 4, 4, wx, wy - 32 * k / FRAMES)
        d = np.abs(v)
        f = .42 + .3 * v + .4 * np.exp(-(d / .12) ** 2)
        t.fill(np.clip(f, 0, .999), pal)
        t.glow(np.ones_like(X, bool), .7)
        t.a = np.round((.62 + .25 * np.clip(f, 0, 1)) * 32) / 32
        t.h = f
        frames.append(t)
    return frames


def starfield(name):
    t = Tex(name, .3)
    t.fill(.3 + .3 * fbm(name, 3, 3, 3), blend("#02040a", "#06101c", "#0c2230", "#123c48", n=7))
    r = rng(name)
    for k in range(46):
        x, y = r.integers(0, N, 2)
        c = rgb(("#7fe0d0", "#d8f4ff", "#6aa0f0", "#b090f0")[int(r.integers(0, 4))])
        big = r.random() < .16
        m = (np.abs(wrap(X - x)) + np.abs(wrap(Y - y))) <= (1 if big else 0)
        t.put(m, c * (.65 if big else r.uniform(.5, 1)))
        t.put((X == x) & (Y == y), c)
        t.glow(m, .9)
    return t


def magma(name):
    """Cracked crust whose seams breathe."""
    c = Cells(points(name, 4, 4, .9), x=X + fbm(name + "/x", 5, 5, 2), y=Y + fbm(name + "/y", 5, 5, 2))
    frames = []
    for k in range(8):
        a = 2 * np.pi * k / 8
        t = Tex(name, .85)
        pulse = .5 + .5 * np.sin(a + 6.28 * c.pair(name))
        f = .5 + c.per(name, -.2, .2) - .04 * (c.vx + c.vy) + .12 * fbm(name + "/g", 9, 9, 2)
        t.fill(np.clip(f, 0, .99), ramp("#4a2418", .15, .13, 7))
        hot = 1 - c.edge / (.8 + .55 * pulse)
        m = (hot > 0) & (c.pair(name) < .8)
        t.shade(m, blend("#a2280c", "#e8641a", "#ffb040", "#ffe890", n=7), np.clip(.15 + hot * .6 + .25 * pulse, 0, .999))
        t.glow(m, .95)
        t.h = np.where(m, 0, 2 * ss(0, 2.5, c.edge))
        frames.append(t)
    return frames


def cauldron_water(name):
    return water("water_still")[0]


add("water_still", water)
add("water_flow", water, True)
add("lava_still", lava)
add("lava_flow", lava, True)
add("fire", fire, ("#8a1606", "#d8380a", "#f57c12", "#ffbe34", "#fff2b0"))
add("soul_fire", fire, ("#063a5a", "#0a7aa8", "#1ab8cc", "#6ae8e8", "#e6ffff"))
add("nether_portal", portal)
add("end_portal", starfield)
add("magma_block", magma)
add("cauldron_water", cauldron_water)
