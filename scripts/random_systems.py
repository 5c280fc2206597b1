"""Systems by chance, as users write them: scripts for `exudyn_models.py`, one a seed.

Run with: python scripts/random_systems.py FOLDER [--seeds 340] [--part 1e-4]
then: python scripts/exudyn_models.py FOLDER OUT
"""

import argparse
from pathlib import Path

import exudyn as exu

from systems_by_chance import KINDS, Chance

SCRIPT = """import sys
sys.path.insert(0, {folder!r})
from random_systems import solve
solve({seed}, {part})  # by SolveDynamic
"""


def system(seed):
    """Return a system as it was built, not assembled yet."""
    by = Chance(seed)
    KINDS[seed % len(KINDS)](by)
    return by


def settings_of(by):
    """Return the settings of its user."""
    settings = exu.SimulationSettings()
    settings.timeIntegration.endTime = by.end
    settings.timeIntegration.numberOfSteps = by.choice([500, 1000, 2000])
    settings.timeIntegration.generalizedAlpha.spectralRadius = by.choice([0.5, 0.8, 0.9, 1.0])
    settings.timeIntegration.newton.useModifiedNewton = by.often()
    return settings


def solve(seed, part=1.0):
    """Build a system and solve it as its user does, or a part of its time in as many steps."""
    by = system(seed)
    by.end *= part
    by.mbs.Assemble()
    by.mbs.SolveDynamic(settings_of(by))


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--seeds", type=int, default=340)
    parser.add_argument("--part", type=float, default=1.0, help="of each run's time")
    options = parser.parse_args()
    folder = options.folder / "main" / "pythonDev" / "Examples"
    folder.mkdir(parents=True, exist_ok=True)
    here = str(Path(__file__).resolve().parent)
    for seed in range(options.seeds):
        kind = KINDS[seed % len(KINDS)].__name__
        script = folder / f"{kind}_{seed:03d}.py"
        script.write_text(
            SCRIPT.format(folder=here, seed=seed, part=options.part), encoding="utf-8"
        )
    print(f"{options.seeds} scripts in {folder}")


if __name__ == "__main__":
    main()
