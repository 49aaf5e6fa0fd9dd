"""What is understood of robots that nobody described, and whether they stand.

    python benchmarks/limbs.py ROBOT ...        # names, packages' robots or files; one row of a table each

A robot is put down in its neutral posture for 3 s, and again with a push of 5 % of its weight for 0.2 s forward, backward and
sideways. It stands where its trunk is within 15 degrees of level and 15 % of its height.
"""

from __future__ import annotations

import argparse
import math

from levade.errors import LevadeError
from levade.robots import Robot, dimensions, load_robot
from levade.robots.settling import BALANCE_TIME, settle

PUSHES = {"forward": (0.05, 0.0), "backward": (-0.05, 0.0), "sideways": (0.0, 0.05)}


def stands(robot: Robot, push: tuple[float, float] = (0.0, 0.0)) -> bool:
    """Whether a robot that is put down still stands."""
    settled = settle(robot, time=BALANCE_TIME, push=push)
    return not settled.broken and settled.tilt < math.radians(15) and abs(settled.sag) < 0.15 * dimensions(robot).height


def row(name: str) -> str:
    """A row of the table."""
    try:
        robot = load_robot(name)
    except LevadeError as error:
        return f"| `{name}` | refused | | | {str(error).rpartition('/')[2][:160]} |"
    others = [leg.name for leg in robot.legs if not leg.stands]
    legs = f"{len(robot.standing)} legs{''.join(f', {other}' for other in others)}"
    upright = stands(robot)
    felled = [way for way, push in PUSHES.items() if not stands(robot, push)] if upright else []
    pushed = "" if not upright else f"no: {', '.join(felled)}" if felled else "yes"
    return f"| `{name}` | {robot.stance}, {legs} | {len(robot.joint_names)} | {'yes' if upright else 'no'} | {pushed} |"


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("robots", nargs="+")
    print("| robot | understood as | joints that move | stands 3 s | pushed, too |\n|---|---|---|---|---|")
    for name in parser.parse_args().robots:
        print(row(name), flush=True)


if __name__ == "__main__":
    main()
