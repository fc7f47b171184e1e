#!/bin/sh
# cannon-es 0.20.0: `new Spring(a, b, { damping: 0 })` makes a spring with a damping of 1, for 0 counts as not given.
#
# `spring.damping = 0` after the constructor is kept.
#
# Needs node and npm. Prints the widest place in the tenth second under both, and fails if that changes.
set -eu
here=$(mktemp -d)
trap 'rm -rf "$here"' EXIT
cd "$here"
npm install --silent --no-audit --no-fund --prefix "$here" cannon-es@0.20.0 >/dev/null
cat > run.mjs <<'JS'
import { Body, Spring, Vec3, World } from "cannon-es";
function widest(set) {
  const world = new World();
  const [post, mass] = [new Body({ mass: 0 }), new Body({ mass: 1, position: new Vec3(1, 0, 0), linearDamping: 0 })];
  world.addBody(post);
  world.addBody(mass);
  const spring = new Spring(post, mass, { restLength: 0, stiffness: 40, damping: 0 });
  set(spring);
  let width = 0;
  for (let tick = 0; tick < 600; tick++) {
    spring.applyForce();
    world.step(1 / 60);
    if (tick > 540) width = Math.max(width, Math.abs(mass.position.x));
  }
  return [spring.damping, width];
}
const asked = widest(() => {}), set = widest((spring) => { spring.damping = 0; });
console.log(`damping: 0 in the constructor: damping ${asked[0]}, ±${asked[1].toFixed(4)} m in the tenth second`);
console.log(`spring.damping = 0 afterwards: damping ${set[0]}, ±${set[1].toFixed(4)} m in the tenth second`);
process.exit(asked[0] === 1 && asked[1] < 0.02 && set[0] === 0 && Math.abs(set[1] - 1) < 0.1 ? 0 : 1);
JS
node run.mjs
