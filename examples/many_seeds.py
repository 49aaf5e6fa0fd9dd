"""Run the same search from several seeds at once: their roll-outs share batches, and each result is the same as alone."""

import argparse

import numpy as np

import levade

parser = argparse.ArgumentParser(description=__doc__)
parser.add_argument("--trials", type=int, default=1200)
parser.add_argument("--seeds", type=int, default=5)
options = parser.parse_args()

results = levade.solve_many(["rearing"] * options.seeds, trials=options.trials)
for seed, result in enumerate(results):
    print(f"seed {seed}: {result}")

found = [result.solution.trials_to_success for result in results if result.success]
median = f", median {np.median(found):g} trials" if found else ""
print(f"{len(found)} of {len(results)} succeed{median}")

alone = levade.solve("rearing", seed=1, trials=options.trials)
same = np.array_equal(alone.motion["weights"], results[1].motion["weights"])
print("seed 1 alone gives", "the same motion" if same else "ANOTHER MOTION")
