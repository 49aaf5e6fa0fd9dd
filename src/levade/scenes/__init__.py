"""Scenes: the ground and the obstacles, and their model with a robot.

scene = Scene(boxes=(Box(position=(0.0, 0.4, 0.1), size=(0.9, 0.3, 0.2)),))
spec = compose(load_robot("hyq2max"), scene)
"""

from levade.scenes.scene import GROUND, PLATFORM, Box, Scene, compose, remove_scene
from levade.scenes.terrain import Gap, Terrain, read_heights

__all__ = ["GROUND", "PLATFORM", "Box", "Gap", "Scene", "Terrain", "compose", "read_heights", "remove_scene"]
