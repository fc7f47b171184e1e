#!/bin/sh
# Bullet's btGeneric6DofSpringConstraint (ammojs3 0.0.11): setDamping(axis, 1), the default, is nearly no damping; 0.05 damps more,
# 0.01 does not swing at all, and at 0 the spring never moves.
#
# The spring is a motor whose target speed is the damping times the frequency of ticks times the stretch. With setStiffness and
# setDamping of the same names, btGeneric6DofSpring2Constraint takes a damping in N·s/m.
#
# Needs node and npm. Prints how far a mass of 1 kg at 1 m on 40 N/m comes to the other side, and fails if the order changes.
set -eu
here=$(mktemp -d)
trap 'rm -rf "$here"' EXIT
cd "$here"
npm install --silent --no-audit --no-fund --prefix "$here" ammojs3@0.0.11 >/dev/null
cat > run.cjs <<'JS'
const load = require("ammojs3");
(load.default || load)().then((Ammo) => {
  function swing(damping) {
    const configuration = new Ammo.btDefaultCollisionConfiguration();
    const world = new Ammo.btDiscreteDynamicsWorld(new Ammo.btCollisionDispatcher(configuration), new Ammo.btDbvtBroadphase(),
      new Ammo.btSequentialImpulseConstraintSolver(), configuration);
    world.setGravity(new Ammo.btVector3(0, 0, 0));
    function body(mass, x) {
      const at = new Ammo.btTransform();
      at.setIdentity();
      at.setOrigin(new Ammo.btVector3(x, 0, 0));
      const shape = new Ammo.btSphereShape(0.1), inertia = new Ammo.btVector3(0, 0, 0);
      shape.calculateLocalInertia(mass, inertia);
      const made = new Ammo.btRigidBody(new Ammo.btRigidBodyConstructionInfo(mass, new Ammo.btDefaultMotionState(at), shape, inertia));
      made.setActivationState(4);
      world.addRigidBody(made);
      return made;
    }
    const [post, mass] = [body(0, 0), body(1, 1)], frame = new Ammo.btTransform();
    frame.setIdentity();
    const spring = new Ammo.btGeneric6DofSpringConstraint(post, mass, frame, frame, true);
    spring.setLinearLowerLimit(new Ammo.btVector3(1, 0, 0));
    spring.setLinearUpperLimit(new Ammo.btVector3(-1, 0, 0));
    spring.setAngularLowerLimit(new Ammo.btVector3(0, 0, 0));
    spring.setAngularUpperLimit(new Ammo.btVector3(0, 0, 0));
    spring.enableSpring(0, true);
    spring.setStiffness(0, 40);
    spring.setDamping(0, damping);
    spring.setEquilibriumPoint(0, 0);
    world.addConstraint(spring, true);
    let least = Infinity;
    for (let tick = 0; tick < 120; tick++) {
      world.stepSimulation(1 / 60, 0);
      least = Math.min(least, mass.getWorldTransform().getOrigin().x());
    }
    return least;
  }
  const rows = [1, 0.1, 0.05, 0.01, 0].map((damping) => [damping, swing(damping)]);
  for (const [damping, least] of rows) console.log(`setDamping(0, ${damping}): swings from 1 m to ${least.toFixed(3)} m`);
  const ends = rows.map(([, least]) => least);
  const rises = ends.every((end, n) => Number.isFinite(end) && (n === 0 || end > ends[n - 1]));
  process.exit(rises && ends[0] < -0.95 && Math.abs(ends[4] - 1) < 1e-6 ? 0 : 1);
});
JS
node run.cjs
