#!/bin/sh
# cannon-es 0.20.0, Bullet (ammojs3 0.0.11) and Rapier 0.21.0: a wheel that is set to 100 rad/s turns 83, 87 and 47 rad/s at 60 Hz,
# with no contact, force or damping. Two of the three go on to say 100.
#
# 100 rad/s is a car's wheel of 0.3 m at 108 km/h. At 10 rad/s all three are right within 0.3 %, at 240 Hz within 1.5 %.
#
# cannon-es adds half the tick times the speed to the quaternion and makes it a unit again: a turn of 2·atan(ωh/2) for ωh
# (Quaternion.integrate), never half a turn a tick. Bullet cuts the angle that it takes the sine and cosine of to 45° a tick, but
# not the axis that the sine is multiplied by, so that the turn is off from 47 rad/s on (btTransformUtil::integrateTransform).
# Rapier cuts the angular velocity itself to 45° a tick: the wheel is slowed for good, and by how much depends on the tick.
#
# Needs node and npm. Prints turn in a second and the speed that the engine then gives, and fails if they change.
set -eu
here=$(mktemp -d)
trap 'rm -rf "$here"' EXIT
cd "$here"
npm install --silent --no-audit --no-fund --prefix "$here" cannon-es@0.20.0 ammojs3@0.0.11 @dimforge/rapier3d-compat@0.21.0 >/dev/null
cat > run.mjs <<'JS'
import { createRequire } from "node:module";
import { Body, Sphere, World } from "cannon-es";
import RAPIER from "@dimforge/rapier3d-compat";
const load = createRequire(import.meta.url)("ammojs3");
const Ammo = await (load.default || load)();
console.warn = () => {};
await RAPIER.init();
function cannon(speed, hz) {
  const world = new World(), body = new Body({ mass: 1, shape: new Sphere(0.5), angularDamping: 0 });
  world.addBody(body);
  body.angularVelocity.set(0, 0, speed);
  return [() => world.step(1 / hz), () => [body.quaternion.z, body.quaternion.w], () => body.angularVelocity.z];
}
function bullet(speed, hz) {
  const configuration = new Ammo.btDefaultCollisionConfiguration(), at = new Ammo.btTransform();
  const world = new Ammo.btDiscreteDynamicsWorld(new Ammo.btCollisionDispatcher(configuration), new Ammo.btDbvtBroadphase(),
    new Ammo.btSequentialImpulseConstraintSolver(), configuration);
  world.setGravity(new Ammo.btVector3(0, 0, 0));
  at.setIdentity();
  const shape = new Ammo.btSphereShape(0.5), inertia = new Ammo.btVector3(0.1, 0.1, 0.1);
  const body = new Ammo.btRigidBody(new Ammo.btRigidBodyConstructionInfo(1, new Ammo.btDefaultMotionState(at), shape, inertia));
  body.setActivationState(4);
  world.addRigidBody(body);
  body.setAngularVelocity(new Ammo.btVector3(0, 0, speed));
  const turn = () => body.getWorldTransform().getRotation();
  return [() => world.stepSimulation(1 / hz, 0), () => [turn().z(), turn().w()], () => body.getAngularVelocity().z()];
}
function rapier(speed, hz) {
  const world = new RAPIER.World({ x: 0, y: 0, z: 0 });
  world.timestep = 1 / hz;
  const body = world.createRigidBody(RAPIER.RigidBodyDesc.dynamic().setAngvel({ x: 0, y: 0, z: speed }));
  world.createCollider(RAPIER.ColliderDesc.ball(0.5), body);
  return [() => world.step(), () => [body.rotation().z, body.rotation().w], () => body.angvel().z];
}
function turned([step, attitude, given], hz) {
  let angle = 0, before = 0;
  for (let tick = 0; tick < hz; tick++) {
    step();
    const now = 2 * Math.atan2(...attitude());
    angle += (now - before + 8 * Math.PI) % (2 * Math.PI);
    before = now;
  }
  return [angle, given()];
}
let wrong = 0;
const engines = [["cannon-es", cannon, 83.37, 100], ["Bullet", bullet, 86.53, 100], ["Rapier", rapier, 47.0, 47.12]];
for (const [name, make, turn, says] of engines) {
  for (const [speed, hz, want, given] of [[10, 60, 10, 10], [100, 60, turn, says], [100, 240, 100, 100]]) {
    const [angle, told] = turned(make(speed, hz), hz);
    console.log(`${name}, ${speed} rad/s at ${hz} Hz: turns ${angle.toFixed(2)} rad in a second, says ${told.toFixed(2)} rad/s`);
    if (!(Math.abs(angle / want - 1) < (hz === 60 ? 0.005 : 0.016) && Math.abs(told / given - 1) < 0.005)) wrong = 1;
  }
}
process.exit(wrong);
JS
node run.mjs
