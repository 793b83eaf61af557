"""The game in a real window (Xvfb): starts, walks, digs, places, resizes, takes screenshots, pauses, quits, and keeps what was done."""
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import time

from harness import SCRATCH, VITRAIL, expect, expect_ok, finish

if not shutil.which("Xvfb") or not shutil.which("xdotool"):
    print("skipped: no Xvfb or xdotool")
    sys.exit(77)

read, write = os.pipe()
xvfb = subprocess.Popen(["Xvfb", "-displayfd", str(write), "-screen", "0", "1280x800x24", "-nolisten", "tcp"], pass_fds=[write],
                        stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
display = ":" + os.read(read, 16).decode().strip()
home = SCRATCH / "home"
home.mkdir()
env = {**os.environ, "DISPLAY": display, "HOME": str(home), "XDG_CONFIG_HOME": str(home / "config"),
       "XDG_DATA_HOME": str(home / "data"), "SDL_VIDEODRIVER": "x11", "SDL_AUDIODRIVER": "dummy"}
env.pop("WAYLAND_DISPLAY", None)
world = SCRATCH / "world"


def xdo(*words):
    return subprocess.run(["xdotool", *map(str, words)], env=env, capture_output=True, text=True, timeout=60).stdout.strip()


def start():
    log = open(SCRATCH / "play.log", "a")
    game = subprocess.Popen([VITRAIL, "play", "--world", str(world), "--seed", "7", "--size", "640x400", "--view-distance", "4"],
                            env=env, stdout=log, stderr=log)
    window = ""
    for _ in range(240):
        window = xdo("search", "--name", "Vitrail").split("\n")[-1]
        if window or game.poll() is not None:
            break
        time.sleep(0.5)
    expect(bool(window), "the window appears: " + (SCRATCH / "play.log").read_text()[-400:])
    xdo("windowfocus", window)
    return game, window


def screenshots():
    return sorted((home / "data/vitrail/screenshots").glob("*.png"))


def shoot(what):
    before = len(screenshots())
    deadline = time.time() + 90 # the first waits until the world is there
    while len(screenshots()) == before and time.time() < deadline:
        xdo("key", "F2")
        time.sleep(1.5)
    shots = screenshots()
    expect(len(shots) > before, f"a screenshot of {what}")
    if len(shots) > before:
        size = shots[-1].stat().st_size
        expect(size > 20000, f"the screenshot of {what} shows something ({size} bytes)")


def end(game, window):
    game.send_signal(signal.SIGTERM) # as Ctrl-C in the terminal: saves and ends
    try:
        game.wait(60)
    except subprocess.TimeoutExpired:
        game.kill()
    expect(game.returncode == 0, f"quits with status {game.returncode}: " + (SCRATCH / "play.log").read_text()[-400:])


try:
    game, window = start()
    shoot("the start")
    xdo("key", "F5") # the path tracer, and back
    time.sleep(3)
    shoot("the start, traced")
    expect(screenshots()[-1].read_bytes() != screenshots()[-2].read_bytes(), "F5 changes the picture")
    xdo("key", "F5")
    xdo("key", "F3")
    xdo("keydown", "w")
    time.sleep(1.5)
    xdo("keyup", "w")
    xdo("mousemove_relative", "--", "0", "420") # look down
    time.sleep(0.5)
    xdo("click", "1") # dig
    time.sleep(1.0)
    xdo("key", "2")
    xdo("click", "3") # place
    time.sleep(1.0)
    shoot("digging")
    xdo("windowsize", window, "500", "300")
    time.sleep(1)
    shoot("the smaller window")
    xdo("key", "Escape")
    time.sleep(0.5)
    shoot("the pause menu")
    end(game, window)
    expect_ok("verify", "--world", world)
    inspected = expect_ok("inspect", "--world", world).stdout
    expect("players       1" in inspected, "the player is kept: " + inspected)
    game, window = start()
    shoot("the second start")
    end(game, window)
finally:
    xvfb.send_signal(signal.SIGTERM)
finish()
