#!/bin/sh
# Kivy 2.3.1: maxfps 60, its default, lets 82 frames a second through where no vsync holds them, and 125 where a frame takes 8 ms.
#
# The clock wakes up four fifths of its resolution early, and takes what is due in less than a whole resolution after that as due
# now (idle and _check_ready in kivy/clock.py). Its resolution is a third of a frame. So a frame of 1/60 s is over after 11/15 of that
# at the latest, and one that has worked for 2/5 of its time is not held at all.
# A game that moves by a fixed way each frame, or makes one tick a frame, runs up to 2.5 times too fast.
#
# Needs Python 3.11 or newer with pip. Prints frames a second by limit and work, on a clock of its own; fails if they change.
set -eu
here=$(mktemp -d)
trap 'rm -rf "$here"' EXIT
cd "$here"
python3 -m venv env
env/bin/pip install --quiet --disable-pip-version-check kivy==2.3.1
cat > run.py <<'PY'
import os
import sys
os.environ.update(KIVY_NO_ARGS="1", KIVY_NO_CONSOLELOG="1", KIVY_NO_FILELOG="1", KIVY_HOME=os.path.abspath("home"))
from kivy.config import Config
from kivy.clock import ClockBase

class Virtual(ClockBase):
    now = 0.0

    def time(self):
        return self.now

    def usleep(self, microseconds):
        self.now += microseconds / 1e6

def rate(limit, work):
    Config.set("graphics", "maxfps", str(limit))
    clock = Virtual()
    clock._start_tick = clock._last_tick = 0.0
    for _ in range(2000):
        clock.idle()
        clock.now += work
    return 2000 / clock.now

right = True
for limit, work, expected in [(30, 0.001, 40.91), (60, 0.001, 81.82), (60, 0.008, 125.0), (60, 0.018, 55.6), (144, 0.001, 196.4)]:
    frames = rate(limit, work)
    print(f"maxfps {limit}, {work * 1000:.0f} ms of work in each frame: {frames:.1f} frames a second", file=sys.__stdout__)
    right = right and abs(frames / expected - 1) < 0.01
sys.exit(0 if right else 1)
PY
env/bin/python run.py
