#!/bin/sh
# Rapier's JavaScript 0.21.0: no body goes faster than 400 units a second, at any rate of ticks.
#
# For a game in pixels that is less than a third of a screen a second. What is set to 1000 is at 400 after one step, what falls
# under 981 px/s² stops gaining after 0.4 s, and a body of the kind kinematicVelocityBased, which nothing should slow, is as slow.
# Nothing warns of it, and linvel() gives 1000 until the next step.
#
# The cap is 400 times integrationParameters.lengthUnit, of which the types that come with the package only say that distances are
# multiplied by it.
#
# Needs node and npm. Prints how far bodies come in a second, and fails if that changes.
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
function second(kind, speed, { gravity = 0, hz = 60, unit = 1 } = {}) {
  const world = new RAPIER.World({ x: 0, y: -gravity });
  world.timestep = 1 / hz;
  world.integrationParameters.lengthUnit = unit;
  const body = world.createRigidBody(RAPIER.RigidBodyDesc[kind]().setLinvel(speed, 0));
  world.createCollider(RAPIER.ColliderDesc.ball(10), body);
  for (let tick = 0; tick < hz; tick++) world.step();
  const { x, y } = body.translation();
  return gravity ? -y : x;
}
const rows = [
  ["300/s, 60 Hz", second("dynamic", 300), 300],
  ["1000/s, 60 Hz", second("dynamic", 1000), 400],
  ["1000/s, 240 Hz", second("dynamic", 1000, { hz: 240 }), 400],
  ["1000/s, kinematicVelocityBased", second("kinematicVelocityBased", 1000), 400],
  ["a fall under 981/s², 490 in truth", second("dynamic", 0, { gravity: 981 }), 319.3],
  ["1000/s, lengthUnit 50", second("dynamic", 1000, { unit: 50 }), 1000],
  ["a fall under 981/s², lengthUnit 50", second("dynamic", 0, { gravity: 981, unit: 50 }), 492.5],
];
for (const [name, way] of rows) console.log(`${name}: ${way.toFixed(1)} units in a second`);
process.exit(rows.every(([, way, expected]) => Math.abs(way / expected - 1) < 0.01) ? 0 : 1);
JS
node run.mjs
