#!/bin/sh
# Babylon's Havok 1.3.14: a body slower than 0.1 m/s loses 0.3 m/s each second until it stands, with no contact, no gravity, a
# damping of 0 and its activation always on. What is just above 0.1 m/s goes on for ever.
#
# Needs node and npm. Prints the speeds after 0.1 s and after 1 s, and fails if they change.
set -eu
here=$(mktemp -d)
trap 'rm -rf "$here"' EXIT
cd "$here"
npm install --silent --no-audit --no-fund --prefix "$here" @babylonjs/havok@1.3.14 >/dev/null
cat > run.mjs <<'JS'
import { readFileSync } from "node:fs";
import HavokPhysics from "@babylonjs/havok";
const HK = await HavokPhysics({ wasmBinary: readFileSync("node_modules/@babylonjs/havok/lib/esm/HavokPhysics.wasm") });
const world = HK.HP_World_Create()[1];
HK.HP_World_SetGravity(world, [0, 0, 0]);
HK.HP_World_SetIdealStepTime(world, 1 / 60);
const shape = HK.HP_Shape_CreateSphere([0, 0, 0], 0.5)[1];
const speeds = [0.05, 0.099, 0.101, 1];
const bodies = speeds.map((speed, n) => {
  const body = HK.HP_Body_Create()[1];
  HK.HP_Body_SetShape(body, shape);
  HK.HP_Body_SetMassProperties(body, [[0, 0, 0], 1, [1, 1, 1], [0, 0, 0, 1]]);
  HK.HP_Body_SetMotionType(body, HK.MotionType.DYNAMIC);
  HK.HP_Body_SetLinearDamping(body, 0);
  HK.HP_Body_SetQTransform(body, [[0, 10 * n, 0], [0, 0, 0, 1]]);
  HK.HP_World_AddBody(world, body, false);
  HK.HP_Body_SetActivationControl(body, HK.ActivationControl.ALWAYS_ACTIVE);
  HK.HP_Body_SetLinearVelocity(body, [speed, 0, 0]);
  return body;
});
const after = () => bodies.map((body) => HK.HP_Body_GetLinearVelocity(body)[1][0]);
for (let tick = 0; tick < 6; tick++) HK.HP_World_Step(world, 1 / 60);
const early = after();
for (let tick = 6; tick < 60; tick++) HK.HP_World_Step(world, 1 / 60);
const late = after();
speeds.forEach((speed, n) => console.log(`${speed} m/s: ${early[n].toFixed(4)} m/s after 0.1 s, ${late[n].toFixed(4)} after 1 s`));
const brake = (speeds[0] - early[0]) / 0.1;
console.log(`the slowest brakes by ${brake.toFixed(3)} m/s²`);
const holds = Math.abs(brake - 0.305) < 0.03 && late[0] === 0 && late[1] === 0 && Math.abs(late[2] - 0.101) < 1e-4 && Math.abs(late[3] - 1) < 1e-4;
process.exit(holds ? 0 : 1);
JS
node run.mjs
