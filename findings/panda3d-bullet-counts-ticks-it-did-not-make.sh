#!/bin/sh
# Panda3D 1.10.16: BulletWorld.doPhysics(dt) makes at most one tick of 1/60 s by default, and returns how many were due.
#
# At 30 frames a second a falling body is in slow motion at half speed, and the return value, two a frame, says that all is well.
# doPhysics(dt, 8) falls as far as at 60 frames a second.
#
# Needs Python 3 with pip. Prints ticks returned and metres fallen, and fails if they change.
set -eu
here=$(mktemp -d)
trap 'rm -rf "$here"' EXIT
cd "$here"
python3 -m venv env
env/bin/pip install --quiet --disable-pip-version-check panda3d==1.10.16
cat > run.py <<'PY'
import sys
from panda3d.bullet import BulletRigidBodyNode, BulletSphereShape, BulletWorld
from panda3d.core import NodePath, Vec3

def fall(fps, *limit):
    world = BulletWorld()
    world.setGravity(Vec3(0, 0, -9.81))
    node = BulletRigidBodyNode("ball")
    node.setMass(1.0)
    node.addShape(BulletSphereShape(0.1))
    body = NodePath(node)
    world.attach(node)
    returned = sum(world.doPhysics(1.0 / fps, *limit) for _ in range(fps))
    return returned, -body.getZ()

rows = [(fall(60), "60 fps"), (fall(30), "30 fps"), (fall(30, 8), "30 fps, 8 ticks allowed")]
for (returned, fallen), name in rows:
    print(f"{name}: doPhysics returned {returned} ticks in a second, the body fell {fallen:.2f} m")
(full, far), (half, near), (freed, again) = (row for row, _ in rows)
right = abs(full - 60) <= 1 and abs(half - 60) <= 1 and abs(near / far - 0.25) < 0.02 and abs(again / far - 1) < 0.05
sys.exit(0 if right else 1)
PY
env/bin/python run.py
