"""Success of motions on perturbed models, without and with a stabiliser, as a table: docs/feedback.md.

    python benchmarks/feedback.py rearing/motion.npz squat-jump/motion.npz

Each motion is stabilised as by `levade stabilise`, and then checked on 500 perturbed runs, none of which chose the stabiliser.
"""

from __future__ import annotations

import argparse
import time
from pathlib import Path

from levade.check import Perturbed, perturbed
from levade.engines import Perturbation
from levade.motions import Motion, RecordedSimulation
from levade.stabilise import stabilise


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("motions", nargs="+", type=Path)
    parser.add_argument("--runs", type=int, default=500)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--threads", type=int, default=0)
    options = parser.parse_args()
    print("| motion | without | with | chosen by (96 runs) | design: motion, hold, bound [rad] | CPU s to find |")
    print("|---|---|---|---|---|---|")
    for path in options.motions:
        motion = Motion.load(path)
        began = time.process_time()
        found = stabilise(motion, seed=options.seed, threads=options.threads)
        took = time.process_time() - began
        simulation = RecordedSimulation(motion, threads=options.threads)

        def share(feedback, simulation: RecordedSimulation = simulation) -> Perturbed:
            return perturbed(simulation, Perturbation(), runs=options.runs, seed=options.seed, feedback=feedback)

        without = share(None)
        within = without if found.design is None else share(found.motion.feedback)
        design = "none is better" if found.design is None else ", ".join(f"{v:g}" for v in vars(found.design).values())
        print(
            f"| {motion.task_name}, {motion.robot} | {_text(without)} | {_text(within)}"
            f" | {found.open_loop:.1%}, {found.share:.1%} | {design} | {took:.0f} |",
            flush=True,
        )


def _text(found: Perturbed) -> str:
    return f"{found.share:.1%} ({found.low:.1%} to {found.high:.1%})"


if __name__ == "__main__":
    main()
