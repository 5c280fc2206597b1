"""The counterweight with which the press shakes its frame least: one key, one objective."""

from exu_press import Scene
from exu_press.studies.optimise import Optimise, optimise

scene = Scene(joints={}, revolutions=1.0)
key, quantity = "press.counterweight_mass", "shaking.vertical"
study = Optimise(
    scene,
    {key: {"low": 200.0, "high": 3000.0}},
    objective=[{"quantity": quantity}],
    optimise={"trials": 16},
)
report = optimise(study, "out/optimise_counterweight", quiet=True)
mass = report.scenes[0].press.counterweight.counterweight_mass
force = report.numbers(quantity)[0]
print(f"counterweight {mass:.0f} kg: the frame takes {1e-3 * force:.3f} kN at most")
