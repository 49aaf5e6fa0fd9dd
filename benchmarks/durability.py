"""Whether a build of a motion library loses anything: kill -9 at random moments, and a disk that is full.

    python benchmarks/durability.py kill --times 20         # Linux
    python benchmarks/durability.py disk --sizes 150 400    # [KiB]; Linux, as root: mounts a small tmpfs for each size

The library is small: its motions only turn the robot's back away from the ground. After each interruption every record that was
there is still there, with the bytes of a build that nothing disturbed. In the end the libraries have the same bytes.
"""

from __future__ import annotations

import argparse
import multiprocessing
import subprocess
import tempfile
import time
from dataclasses import replace
from pathlib import Path

import numpy as np

from levade.costs import Criterion
from levade.errors import LevadeError
from levade.library import build
from levade.tasks import Task, load_task

STARTS = 8


def rolling() -> Task:
    """Return a task that is solved in a few trials from some falls, and not at all from others."""
    small = ("hold=0.1", "horizon=0.3", "search.polish=4", "search.population=4", "search.trials=24")
    task = load_task("self-righting", changes=["start={fallen: {height: 0.5, time: 0.4}}", *small])
    return replace(task, success={"over": Criterion("tilt", maximum=1.9, at="end")})


def built(directory: Path, processes: int = 1) -> None:
    """Build the library, or go on with it."""
    build(rolling(), starts=STARTS, directory=directory, threads=1, processes=processes)


def contents(directory: Path) -> dict[str, bytes]:
    """Return every file of a library, except its lock and what an interrupted write left."""
    files = (path for path in sorted(directory.rglob("*")) if path.is_file() and path.name[0] != ".")
    return {str(path.relative_to(directory)): path.read_bytes() for path in files}


def checked(directory: Path, before: set[str], whole: dict[str, bytes]) -> set[str]:
    """Check that nothing is lost or half written, and return the names of the records that are there."""
    found = {name: text for name, text in contents(directory).items() if name.startswith(("falls/", "motions/"))}
    wrong = [name for name, text in found.items() if text != whole[name]]
    records = {name for name in found if name.startswith("falls/")}
    if wrong or not before <= records:
        raise SystemExit(f"lost: {sorted(before - records)}; other bytes: {wrong}")
    return records


def kill(directory: Path, whole: dict[str, bytes], *, times: int, longest: float, seed: int) -> None:
    """Kill builds at random moments until it has been done so many times; finish each library, and compare."""
    context, generator = multiprocessing.get_context("fork"), np.random.default_rng(seed)
    killed, place, records = 0, directory / "0", set[str]()
    while killed < times:
        process = context.Process(target=built, args=(place,))
        process.start()
        process.join(generator.uniform(0.0, longest))
        if process.is_alive():
            process.kill()
            process.join()
            killed += 1
            records = checked(place, records, whole)
            print(f"killed {killed}: {len(records)} of {STARTS} falls are done", flush=True)
        elif contents(place) != whole:
            raise SystemExit("the finished library has other bytes")
        else:
            print("finished: the same bytes", flush=True)
            place, records = directory / str(killed), set[str]()
    built(place)
    if contents(place) != whole:
        raise SystemExit("the finished library has other bytes")
    print(f"killed {killed} times; every finished library has the same bytes")


def disk(directory: Path, whole: dict[str, bytes], *, sizes: list[int], processes: int) -> None:
    """Build on small disks; make room once they are full, go on, and compare."""
    directory.mkdir(exist_ok=True)
    for size in sizes:
        subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={size}k", "tmpfs", directory], check=True)
        try:
            try:
                built(directory, processes)
                said = "there was room"
            except LevadeError as error:
                said = str(error)
            records = checked(directory, set(), whole)
            print(f"{size} KiB: {len(records)} of {STARTS} falls are done. {said}", flush=True)
            subprocess.run(["mount", "-o", "remount,size=100m", directory], check=True)
            built(directory, processes)
            checked(directory, records, whole)
            if contents(directory) != whole:
                raise SystemExit("the finished library has other bytes")
        finally:
            subprocess.run(["umount", directory], check=True)
    print(f"{len(sizes)} full disks; every finished library has the same bytes")


def main() -> None:
    """Read the command line, build a library undisturbed, then disturb others."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("what", choices=("kill", "disk"))
    parser.add_argument("--times", type=int, default=20)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--sizes", type=int, nargs="+", default=[150, 400], help="of the disks [KiB]")
    parser.add_argument("--processes", type=int, default=1)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as place:
        began = time.monotonic()
        built(Path(place) / "whole")
        took = time.monotonic() - began
        whole = contents(Path(place) / "whole")
        print(f"undisturbed: {took:.1f} s, {len(whole)} files", flush=True)
        if options.what == "kill":
            kill(Path(place), whole, times=options.times, longest=took, seed=options.seed)
        else:
            disk(Path(place) / "disk", whole, sizes=options.sizes, processes=options.processes)


if __name__ == "__main__":
    main()
