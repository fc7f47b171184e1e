#!/usr/bin/env python3
"""Makes the logs of the engines that PyPI has again, and says how far they are from those kept here.

    python3 -m venv venv && venv/bin/pip install mujoco pymunk pybullet
    venv/bin/python make.py [FOLDER]      # the logs are written there, if one is named

A row of manifest.csv is a body on a line: of `mass`, from the state of its first row; `k` and `c` are a
spring's stiffness and damping, which a joint has, or, where the scenario is `held`, user code, which sets the force once
a tick; `C` is the drag coefficient per second, which each engine takes in a form of its own; `force` is constant. A tick
of `dt_s` has `n` substeps. Sleeping is off.

Other engines need a program in their own language, with the same body and the same rows: Box2D and Box3D a prismatic and a
distance joint without limits, 4 m long, told hertz and damping ratio, b2World_Step(world, dt_s, n) and b3World_Step; a
tumbling body of Box3D has the inertias 1, 2 and 3 and allowFastRotation, and its angular velocity is written in the axes of
the body; Rapier a SpringJoint, num_solver_iterations = n; Avian a DistanceJoint of 2 m with both limits at its length,
compliance 1 / k and JointDamping c / mass, and a PrismaticJoint with MotorModel::SpringDamper, SubstepCount(n); Jolt a
DistanceConstraint and a slider's motor, Update(dt_s, n); PhysX (5.6
by npm's physx-js-webidl) a D6 joint's drive with n position iterations; Bullet a
btGeneric6DofSpring2Constraint, stepped n times by dt_s / n. Write x and v of every tick at first and then of every 15th. When a log is made again, put its day on the card
of the engine, as `logged`, with the version.
"""
import csv
import math
import pathlib
import sys

HERE = pathlib.Path(__file__).parent


class Mujoco:
    def __init__(self, row, integrator, actuator=False):
        import mujoco

        self.step_of, self.n, self.held = mujoco.mj_step, row["n"], row["held"]
        joint = not row["held"] and not actuator
        damping = row["C"] * row["mass"] + (row["c"] if joint else 0)
        gains = f'kp="{row["k"]!r}" kv="{row["c"]!r}"'
        motor = f'<actuator><position joint="x" {gains}/></actuator>' if actuator else ""
        self.model = mujoco.MjModel.from_xml_string(
            f"""<mujoco><option timestep="{row["dt_s"] / row["n"]!r}" integrator="{integrator}" gravity="0 0 0"/>
            <worldbody><body><joint name="x" type="slide" axis="1 0 0" damping="{damping!r}"
            stiffness="{row["k"] if joint else 0!r}"/><geom type="sphere" size="0.1" mass="{row["mass"]!r}"/>
            </body></worldbody>{motor}</mujoco>"""
        )
        self.data = mujoco.MjData(self.model)
        self.data.qpos[0], self.data.qvel[0] = row["x0"], row["v0"]

    def state(self):
        return self.data.qpos[0], self.data.qvel[0]

    def tick(self, force):
        self.data.qfrc_applied[0] = force
        self.step_of(self.model, self.data, self.n)


class Chipmunk:
    FAR = 1e3  # The spring's other end, so that it never passes it.

    def __init__(self, row):
        import pymunk

        self.space, self.body, self.dt = pymunk.Space(), pymunk.Body(row["mass"], 1.0), row["dt_s"]
        self.space.damping = math.exp(-row["C"])
        self.body.position, self.body.velocity = (row["x0"], 0), (row["v0"], 0)
        self.space.add(self.body)
        if row["k"] and not row["held"]:
            ends = (-self.FAR, 0), (0, 0)
            still = self.space.static_body
            self.space.add(
                pymunk.DampedSpring(still, self.body, *ends, self.FAR, row["k"], row["c"])
            )

    def state(self):
        return self.body.position.x, self.body.velocity.x

    def tick(self, force):
        self.body.force = (force, 0)
        self.space.step(self.dt)


class Pybullet:
    def __init__(self, row):
        import pybullet as p

        self.p = p
        p.connect(p.DIRECT)
        p.resetSimulation()
        p.setPhysicsEngineParameter(fixedTimeStep=row["dt_s"], numSubSteps=0, deterministicOverlappingPairs=1)
        shape = p.createCollisionShape(p.GEOM_SPHERE, radius=0.1)
        self.body = p.createMultiBody(row["mass"], shape, basePosition=[row["x0"], 0, 0])
        p.resetBaseVelocity(self.body, [row["v0"], 0, 0])
        p.changeDynamics(self.body, -1, linearDamping=-math.expm1(-row["C"]), angularDamping=0)

    def state(self):
        place, velocity = self.p.getBasePositionAndOrientation(self.body)[0], self.p.getBaseVelocity(self.body)[0]
        return place[0], velocity[0]

    def tick(self, force):
        place = self.p.getBasePositionAndOrientation(self.body)[0]
        self.p.applyExternalForce(self.body, -1, [force, 0, 0], place, self.p.WORLD_FRAME)
        self.p.stepSimulation()


ENGINES = {
    "mujoco-Euler": lambda row: Mujoco(row, "Euler"),
    "mujoco-RK4": lambda row: Mujoco(row, "RK4"),
    "mujoco-implicitfast": lambda row: Mujoco(row, "implicitfast"),
    "mujoco-Euler-actuator": lambda row: Mujoco(row, "Euler", True),
    "mujoco-implicitfast-actuator": lambda row: Mujoco(row, "implicitfast", True),
    "chipmunk": Chipmunk,
    "pybullet-multibody": Pybullet,
}


def body(entry):
    numbers = {key: float(entry[key]) for key in ("dt_s", "mass", "k", "c", "force", "C")}
    held, has_spring = entry["scenario"] == "held", entry["scenario"] in ("spring", "held", "combo")
    if not has_spring:
        numbers |= {"k": 0.0, "c": 0.0}
    return numbers | {"n": int(entry["n"]), "held": held}


def make(entry):
    """The kept rows, and the same rows of a new run."""
    rows = [list(map(float, row)) for row in list(csv.reader(open(HERE / entry["file"])))[1:]]
    row = body(entry) | {"x0": rows[0][1], "v0": rows[0][2]}
    engine, ticks, made = ENGINES[entry["engine"]](row), 0, []
    for tick, _, _ in rows:
        while ticks < tick:
            x, v = engine.state()
            own = -(row["k"] * x + row["c"] * v) if row["held"] else 0.0
            engine.tick(row["force"] + own)
            ticks += 1
        made.append([int(tick), *engine.state()])
    return rows, made


def main():
    folder = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else None
    for entry in csv.DictReader(open(HERE / "manifest.csv")):
        if entry["engine"] not in ENGINES or entry["scenario"] == "tumble":
            continue
        rows, made = make(entry)
        scale = [max(abs(row[i]) for row in rows) or 1.0 for i in (1, 2)]
        off = max(abs(a[i] - b[i]) / scale[i - 1] for a, b in zip(rows, made) for i in (1, 2))
        print(f"{off:8.1e}  {entry['file']}")
        if folder:
            folder.mkdir(parents=True, exist_ok=True)
            with open(folder / entry["file"], "w", newline="") as file:
                csv.writer(file, lineterminator="\n").writerows([["tick", "x", "v"], *made])


if __name__ == "__main__":
    main()
