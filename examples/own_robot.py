"""Change a robot through `mujoco.MjSpec` and let it do a task: a HyQ2Max that carries 8 kg on its back.

`levade.load_robot(spec, like=robot)` keeps the legs, limits, gains and postures of the original robot. A spec of
another robot, without ``like``, is read like a file.
"""

import argparse

import mujoco

import levade

parser = argparse.ArgumentParser(description=__doc__)
parser.add_argument("--trials", type=int, default=1200)
trials = parser.parse_args().trials

plain = levade.load_robot("hyq2max")
spec = plain.spec()
spec.modelname = "hyq2max-loaded"
payload = spec.body(plain.trunk).add_body(name="payload", pos=[0, 0, 0.2])
payload.add_geom(type=mujoco.mjtGeom.mjGEOM_BOX, size=[0.15, 0.1, 0.05], mass=8, contype=0, conaffinity=0)

loaded = levade.load_robot(spec, like=plain)
for robot in (plain, loaded):
    print(f"{robot.name}: {robot.model.body_subtreemass[0]:.1f} kg")
    print(levade.solve("rearing", robot=robot, trials=trials))
