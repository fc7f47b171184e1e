#!/bin/sh
# pybullet 3.2.7: nothing falls faster than 15 m/s by default, and linearDamping is not what its name says.
#
# One expects a fall in vacuum, for no drag was asked for; or, who knows of the default of 0.04, the 245 m/s at which a damping of
# 0.04/s holds a weight. But Bullet's btMultiBody, which a body of pybullet is by default, multiplies the speed by the damping
# twice: d·v for the linear part, d·v·|v| for another of the same d (DAMPING_K1_LINEAR and DAMPING_K2_LINEAR in btMultiBody.cpp).
# So the final speed v is where d·v·(1 + v) = g, and a body of 50 m/s loses two thirds of its speed in a second.
# bullet3#2655 met it in a robot. createMultiBody(..., useMaximalCoordinates=True) and linearDamping=0 both fall freely.
#
# Needs Python 3.11 or newer with pip. Prints the speed after 10 s of fall under each damping, and fails if it changes.
set -eu
here=$(mktemp -d)
trap 'rm -rf "$here"' EXIT
cd "$here"
python3 -m venv env
env/bin/pip install --quiet --disable-pip-version-check pybullet==3.2.7 numpy==2.4.6
cat > run.py <<'PY'
import sys
import pybullet

def fall(damping):
    client = pybullet.connect(pybullet.DIRECT)
    pybullet.setGravity(0, 0, -9.81)
    ball = pybullet.createCollisionShape(pybullet.GEOM_SPHERE, radius=0.1)
    body = pybullet.createMultiBody(1, ball, -1, [0, 0, 1000])
    if damping is not None:
        pybullet.changeDynamics(body, -1, linearDamping=damping)
    for _ in range(2400):  # ten seconds at the default of 240 Hz
        pybullet.stepSimulation()
    speed = -pybullet.getBaseVelocity(body)[0][2]
    pybullet.disconnect(client)
    return speed

right = True
for damping, expected in [(None, 15.17), (0.5, 3.958), (0.0, 98.1)]:
    speed = fall(damping)
    d = 0.04 if damping is None else damping
    linear, both = (f"{9.81 / d:.1f}", f"{((1 + 4 * 9.81 / d) ** 0.5 - 1) / 2:.2f}") if d else ("no limit", "no limit")
    name = "damping not set" if damping is None else f"linearDamping={damping}"
    print(f"{name}: {speed:.2f} m/s after 10 s; limit by d·v: {linear}, by d·v·(1 + v): {both}")
    right = right and abs(speed / expected - 1) < 0.01
sys.exit(0 if right else 1)
PY
env/bin/python run.py
