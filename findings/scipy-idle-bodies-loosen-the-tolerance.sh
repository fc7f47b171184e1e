#!/bin/sh
# SciPy 1.17.1: solve_ivp with the same tolerances is a hundred times less exact for a moving body when 5000 others rest beside it.
#
# The documentation says that local errors are kept below atol + rtol·|y|, which reads as of each number of the state. The solver
# takes the root of the mean of the squares over all of them (norm in scipy/integrate/_ivp/common.py), so that each number that is
# in no trouble lets one that is go further: with n numbers, one may be √n times past its tolerance.
# So a level that puts all its bodies in one state is solved worse as it grows, though it looks the same at each tolerance.
# LSODA takes another norm, the largest of each, and does not change.
#
# Needs Python 3.11 or newer with pip. Prints the error of a swing after 20 s, beside n resting bodies, and fails if that changes.
set -eu
here=$(mktemp -d)
trap 'rm -rf "$here"' EXIT
cd "$here"
python3 -m venv env
env/bin/pip install --quiet --disable-pip-version-check scipy==1.17.1 numpy==2.4.6
cat > run.py <<'PY'
import math
import sys
import numpy
from scipy.integrate import solve_ivp

def error(method, resting):
    def rates(_, y):
        dy = numpy.zeros_like(y)
        dy[0], dy[1] = y[1], -y[0]
        return dy
    start = numpy.zeros(2 + 2 * resting)  # place and speed of each body
    start[0] = 1.0
    run = solve_ivp(rates, (0.0, 20.0), start, method=method, rtol=1e-6, atol=1e-9)
    return len(run.t) - 1, abs(run.y[0, -1] - math.cos(20.0))

rows = {}
for method in ("RK45", "DOP853", "LSODA"):
    for resting in (0, 50, 5000):
        steps, far = rows[method, resting] = error(method, resting)
        print(f"{method} beside {resting} resting bodies: {steps} steps, error {far:.1e}")
worse = {method: rows[method, 5000][1] / rows[method, 0][1] for method in ("RK45", "DOP853", "LSODA")}
print(", ".join(f"{method} {factor:.0f} times worse" for method, factor in worse.items()))
right = 50 < worse["RK45"] < 300 and 20 < worse["DOP853"] < 150 and abs(worse["LSODA"] - 1) < 0.1
sys.exit(0 if right and rows["RK45", 5000][0] < 0.6 * rows["RK45", 0][0] else 1)
PY
env/bin/python run.py
