#!/bin/sh
# Rapier's JavaScript 0.21.0: a spring that a game makes with addForce swings ever wider, and more substeps make it worse.
#
# One expects more substeps to be more exact, and a spring without damping to keep its width. With numSolverIterations = 1 it does.
# With the default of 4 a spring of 1 Hz at 60 ticks a second swings 3.4 times as wide after 10 s, with 8 substeps 4.2 times.
#
# The force is read once a tick and held, while the substeps move the body on under it: the spring pulls from where the body has
# been, and the same ticks that conserve the energy with one substep add to it with more. A spring of the engine's own is solved in
# each substep, and is free of this. Box2D 3, and Jolt with more than one collision step, hold a force in the same way.
#
# Needs node and npm. Prints the widest place in the tenth second by substeps, and fails if the order or a figure changes.
set -eu
here=$(mktemp -d)
trap 'rm -rf "$here"' EXIT
cd "$here"
npm install --silent --no-audit --no-fund --prefix "$here" @dimforge/rapier2d-compat@0.21.0 >/dev/null
cat > run.mjs <<'JS'
import RAPIER from "@dimforge/rapier2d-compat";
const warn = console.warn;
console.warn = () => {};
await RAPIER.init();
console.warn = warn;
function widest(substeps) {
  const world = new RAPIER.World({ x: 0, y: 0 });
  if (substeps) world.numSolverIterations = substeps;
  const body = world.createRigidBody(RAPIER.RigidBodyDesc.dynamic().setTranslation(1, 0).setCanSleep(false));
  world.createCollider(RAPIER.ColliderDesc.ball(0.5).setMass(1), body);
  const stiffness = (2 * Math.PI) ** 2;
  let width = 0;
  for (let tick = 0; tick < 600; tick++) {
    body.resetForces(true);
    body.addForce({ x: -stiffness * body.translation().x, y: 0 }, true);
    world.step();
    if (tick >= 540) width = Math.max(width, Math.abs(body.translation().x));
  }
  return width;
}
const rows = [[1, 1.0, 0.01], [2, 2.27, 0.1], [0, 3.43, 0.15], [8, 4.2, 0.2]];
let wrong = 0;
for (const [substeps, expected, within] of rows) {
  const width = widest(substeps);
  const name = substeps ? `numSolverIterations ${substeps}` : "the default of 4";
  console.log(`${name}: from 1 m to ±${width.toFixed(3)} m in the tenth second`);
  if (!(Math.abs(width - expected) < within)) wrong = 1;
}
process.exit(wrong);
JS
node run.mjs
