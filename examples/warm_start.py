"""Begin a search around an earlier motion: rear up, then rear up less steeply, from nothing and from the first motion."""

import argparse

import levade

parser = argparse.ArgumentParser(description=__doc__)
parser.add_argument("--trials", type=int, default=1200)
trials = parser.parse_args().trials

steep = levade.solve("rearing", trials=trials)
print("-60 degrees:", steep)

flatter = [
    "costs.orientation.pitch=-0.9",
    "success.pitch.target=-0.9",
    "costs.position.z=0.85",
    "success.height.target=0.85",
]
task = levade.load_task("rearing", changes=flatter)
cold = levade.solve(task, trials=trials)
warm = levade.solve(task, trials=trials, initial=steep.motion)
for name, result in (("cold", cold), ("warm", warm)):
    found = result.solution.trials_to_success
    print(f"{name}: {'no success' if found is None else 'success'} after {found or result.trials} trials")
