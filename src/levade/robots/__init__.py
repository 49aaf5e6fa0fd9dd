"""Robots: model, legs, joint order, limits, actuators, postures and mirror signs. Built-in robots are data files.

    robot = load_robot("hyq2max")
    robot = load_robot("my/robot.yaml", actuation="ideal", kp=400)

A robot is one YAML file next to its model. ``data/hyq2max/robot.yaml`` is the example to copy.
`levade.robots.description` explains each key.
"""

from levade.robots.actuation import PID, Actuation, DCMotor
from levade.robots.dimensions import Dimensions, dimensions
from levade.robots.loading import builtin_robots, load_robot, missing_package
from levade.robots.packages import find_package_robot, package_robots
from levade.robots.robot import Robot
from levade.robots.spec import robot_of_spec
from levade.robots.symmetry import mirror_signs
from levade.robots.understanding import Leg

__all__ = [
    "PID",
    "Actuation",
    "DCMotor",
    "Dimensions",
    "Leg",
    "Robot",
    "builtin_robots",
    "dimensions",
    "find_package_robot",
    "load_robot",
    "mirror_signs",
    "missing_package",
    "package_robots",
    "robot_of_spec",
]
