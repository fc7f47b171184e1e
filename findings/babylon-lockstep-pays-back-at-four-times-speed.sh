#!/bin/sh
# Babylon.js 9.35.0: after half a minute at 10 frames a second, a game in deterministic lockstep runs at four times its speed.
#
# One takes lockstepMaxSteps (4 by default) for a cap: what a slow frame cannot make up is lost, and the game is in slow motion.
# It is, but Scene.animate cuts the steps of a frame only, and keeps the time that they have left, without a limit. So each second
# at 10 frames adds a third of a second of debt, and once frames are quick again each makes four steps till all is paid: 3.3 s of
# fast motion after half a minute, just when the player thinks that the worst is over.
#
# Needs node and npm. Prints the steps of each second, and fails if they change.
set -eu
here=$(mktemp -d)
trap 'rm -rf "$here"' EXIT
cd "$here"
npm install --silent --no-audit --no-fund --prefix "$here" @babylonjs/core@9.35.0 >/dev/null
cat > run.mjs <<'JS'
import { NullEngine } from "@babylonjs/core/Engines/nullEngine.js";
import { FreeCamera } from "@babylonjs/core/Cameras/freeCamera.js";
import { Vector3 } from "@babylonjs/core/Maths/math.vector.js";
import { Scene } from "@babylonjs/core/scene.js";
const engine = new NullEngine({ renderWidth: 8, renderHeight: 8, textureSize: 8, deterministicLockstep: true, lockstepMaxSteps: 4 });
const scene = new Scene(engine);
new FreeCamera("camera", Vector3.Zero(), scene);
let delta = 0, steps = 0;
engine.getDeltaTime = () => delta;
scene.onBeforeStepObservable.add(() => { steps++; });
function second(fps) {
  const before = steps;
  delta = 1000 / fps;
  for (let frame = 0; frame < fps; frame++) scene.render();
  return steps - before;
}
const seconds = (n, fps) => Array.from({ length: n }, () => second(fps));
const before = seconds(3, 60), slow = seconds(30, 10), after = seconds(6, 60);
console.log(`60 fps: ${before.join(" ")} steps a second`);
console.log(`10 fps for 30 s: ${slow[0]} to ${slow.at(-1)} steps a second`);
console.log(`60 fps again: ${after.join(" ")} steps a second`);
const all = [...before, ...slow, ...after].reduce((sum, n) => sum + n, 0);
console.log(`${all} steps in 39 s, of which ${39 * 60} are due`);
const near = (value, wanted) => Math.abs(value - wanted) <= 2;
const holds = near(before[2], 60) && slow.every((n) => near(n, 40)) && near(after[0], 240) && near(after[2], 240) && near(after[5], 60);
process.exit(holds && near(all, 2340) ? 0 : 1);
JS
node run.mjs
