"""The table of cases: along each axis from harmless to absurd, then pairs of extremes.

A case lasts as long as it takes for something to happen: from the centred start the surfaces meet
after some milliseconds, so that a tenth of a revolution holds the first impacts of every joint.
"""

import itertools
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import cache
from typing import Any, Self

from exu_press.mechanism.press import PAPER_LAWS
from exu_press.scene import Scene, flexible_press
from exu_press.studies.stability.cases import PAIRS, Case
from exu_press.studies.stability.run import StabilityStudy

__all__ = ["Campaign", "QuickCampaign", "cases", "quick_cases"]

Changes = Mapping[str, Any]

REVOLUTIONS = 0.1
"""Of a case, unless something takes longer or happens sooner."""

BUDGET = 20_000
"""Steps of a case, five times as many for the finer run beside it."""

LONG_BUDGET = 60_000
"""The same of whole revolutions with dry impacts, and of twenty with a film."""

BASES: Mapping[str, Changes] = {
    "press": {"joints.crank_pin": "dry"},
    "press lubricated": {"film.viscosity": 0.1},
    "press mixed": {"film.viscosity": 0.1, "film.at_contact": "mixed"},
    "slider-crank": {
        "mechanism": "slider_crank",
        "start": "centred",
        "joints.crank_pin": "dry",
        **PAPER_LAWS,
    },
    "slider-crank lubricated": {"mechanism": "slider_crank", "start": "centred"},
    "slider-crank mixed": {
        "mechanism": "slider_crank",
        "film.at_contact": "mixed",
        **PAPER_LAWS,
    },
    "press ideal": {"joints.crank_pin": "ideal", "joints.balls": "ideal"},
    "slider-crank ideal": {"mechanism": "slider_crank", "joints.crank_pin": "ideal"},
}
"""What an axis is varied on; dry balls in the press unless it says otherwise."""

DRY = ("press", "slider-crank")
FILM = ("press lubricated", "slider-crank lubricated")
MIXED = ("press mixed", "slider-crank mixed")
IDEAL = ("press ideal", "slider-crank ideal")


@dataclass(frozen=True)
class Campaign(StabilityStudy):
    """The cases of this table, in the place of a scene's extremes."""

    @classmethod
    def along(cls, axes: tuple[str, ...]) -> Self:
        """Return the campaign along some axes."""
        return cls(_base("press"), key=axes)

    @property
    def cases(self) -> tuple[Case, ...]:
        """The cases along the axes."""
        return self.along_axes(quick_cases() if self.quick else cases(), "--axis")


class QuickCampaign(Campaign):
    """The fixed sample of it."""

    quick = True


@cache
def cases() -> tuple[Case, ...]:
    """Return the whole table."""
    return tuple(
        itertools.chain(
            _contacts(), _clearances(), _speeds(), _films(), _frictions(), _loads(),
            _angles(), _masses(), _flexible(), _settings(), _variants(), _pairs(),
        )
    )  # fmt: skip


def quick_cases() -> tuple[Case, ...]:
    """Return a fixed sample: both ends of every axis on each of its bases, and every fifth pair."""
    chosen: list[Case] = []
    for along in _lines(cases()):
        if along[0].axis == PAIRS:
            chosen += along[::5]
        elif along[0].axis in ("flexible bodies", "long runs"):  # what takes longest
            chosen.append(along[0])
        else:
            chosen += [along[0], along[-1]]
    return tuple(dict.fromkeys(chosen))


def _lines(table: Iterable[Case]) -> list[list[Case]]:
    """Return the cases of the same axis and base together."""
    lines: dict[tuple[str, str], list[Case]] = {}
    for case in table:
        lines.setdefault((case.axis, case.name.rpartition(", ")[2]), []).append(case)
    return list(lines.values())


def _case(axis: str, base: str, value: str, changes: Changes) -> Case:
    """Return the case of a base with changes."""
    given = {"solver.max_steps": BUDGET, **changes}
    return Case(f"{axis}: {value}, {base}", axis, value, _base(base).replace(given))


@cache
def _base(name: str) -> Scene:
    scene = Scene(film={"law": "pinkus"}, revolutions=REVOLUTIONS)  # the paper's
    return scene.replace(BASES[name])


def _along(axis: str, bases: Iterable[str], values: Mapping[str, Changes]) -> list[Case]:
    """Return the cases of an axis: every value on every base."""
    return [
        _case(axis, base, value, changes) for base in bases for value, changes in values.items()
    ]


def _numbers(key: str, values: Iterable[float], unit: str = "") -> dict[str, Changes]:
    """Return the values of an axis that varies one key."""
    return {f"{value:g}{unit}": {key: value} for value in values}


def _contacts() -> list[Case]:
    """Stiffness, shape and damping of the contact."""
    factors = (1e-3, 0.01, 0.1, 1.0, 10.0, 100.0, 1e3)
    stiffness = {f"x {f:g}": {"contact.stiffness": 2.5545e10 * f} for f in factors}
    undamped = {
        f"{name}, light damping": {
            **change, "contact.damping": "flores", "contact.restitution": 0.9
        }
        for name, change in stiffness.items()
    }  # fmt: skip
    cylinder = {
        f"cylinder x {f:g}": {"contact.shape": "cylindrical", "contact.modulus": 1.1538e11 * f}
        for f in (1e-3, 1.0, 1e3)
    }
    laws: dict[str, Changes] = {
        f"{law}, {wanted:g}": {"contact.damping": law, "contact.restitution": wanted}
        for law in ("hunt_crossley", "lankarani_nikravesh", "flores", "gonthier", "hu_guo")
        for wanted in (0.05, 0.9)
    }
    pulling: dict[str, Changes] = {"pulling": {"contact.tension": True}}
    damping = (0.0, 2.55e4, 2.55e5, 2.55e6, 2.55e7, 2.55e8, 2.55e9, 2.55e10)
    return [
        *_along("contact stiffness", DRY, stiffness),
        *_along("contact stiffness", ["slider-crank"], undamped | cylinder),
        *_along("damping_max", DRY, _numbers("contact.damping_max", damping, " N s/m")),
        *_along("damping law", ["slider-crank"], laws | pulling),
    ]


def _clearances() -> list[Case]:
    """Radial clearance of every joint that has one."""
    values = (1e-7, 1e-6, 1e-5, 1e-4, 3e-4, 1e-3)
    pin = _numbers("joints.crank_pin.clearance", values, " m")
    both = {name: {**change, "joints.balls.clearance": v} for (name, change), v in zip(
        pin.items(), values, strict=True)}  # fmt: skip
    return [
        *_along("clearance", ["press", "press lubricated"], both),
        *_along("clearance", ["slider-crank", "slider-crank lubricated"], pin),
    ]


def _speeds() -> list[Case]:
    """Crank speed; slow ones are over sooner, as gravity does the same in the same time."""
    values = (1.0, 10.0, 60.0, 240.0, 500.0, 1000.0, 3000.0)
    speeds = {
        f"{rpm:g} rpm": {"speed_rpm": rpm, "revolutions": min(REVOLUTIONS, 4e-4 * rpm)}
        for rpm in values
    }
    whole = {f"{rpm:g} rpm": {"speed_rpm": rpm, "revolutions": 1.0} for rpm in values}
    return [*_along("speed", [*DRY, *FILM], speeds), *_along("speed", IDEAL, whole)]


def _films() -> list[Case]:
    """Viscosity, width and law of the film."""
    thin = (1e-5, 1e-4, 1e-3, 1e-2, 0.1, 0.4, 1.0, 10.0)
    thick = (0.1, 0.4, 1.0, 10.0)
    lengths = (0.0141, 0.05, 0.1, 0.28, 0.56)
    laws = {
        f"{law}, L = {length:g} m": {"film.law": law, "film.length": length}
        for law in ("finite", "pinkus", "pi_film", "short")
        for length in ((0.0141, 0.1, 0.56) if law in ("finite", "short") else (0.1,))
    }
    whole = {
        name: {**change, "revolutions": 1.0}
        for name, change in _numbers("film.viscosity", thick, " Pa s").items()
    }
    return [
        *_along("viscosity, film alone", ["slider-crank lubricated"], whole),
        *_along("viscosity, mixed", MIXED, _numbers("film.viscosity", thin, " Pa s")),
        *_along("bearing length", FILM, _numbers("film.length", lengths, " m")),
        *_along("film law", ["slider-crank lubricated"], laws),
    ]


def _frictions() -> list[Case]:
    """Friction coefficient and law, with and without a drop from static to kinetic.

    A thinner pin from 0.3 on: the press's own, 70 mm in radius on a crank of 30 mm, then seizes
    near dead centre, which is tried too.
    """

    thin = {"joints.crank_pin.radius": 0.02}

    def both(mu: float) -> Changes:
        return {"friction.mu_static": mu, "friction.mu_kinetic": mu, **(thin if mu > 0.1 else {})}

    seizing = {"friction.mu_static": 1.0, "friction.mu_kinetic": 1.0, "solver.max_steps": 5000}
    none: dict[str, Changes] = {"none": {"friction.law": "none"}}
    steady = {f"{mu:g}": both(mu) for mu in (0.01, 0.1, 0.3, 1.0)}
    others = {
        f"{law}, {mu:g}": {"friction.law": law, **both(mu)}
        for law in ("lugre", "stribeck")
        for mu in (0.01, 1.0)
    }
    others |= {
        f"coulomb, {mu:g}": {"friction.law": "coulomb", "friction.mu_kinetic": mu}
        | (thin if mu > 0.1 else {})
        for mu in (0.01, 1.0)
    }
    drop = {
        f"{law}, 1 to 0.1 at {v:g} m/s": {
            "friction.law": law,
            "friction.mu_static": 1.0,
            "friction.mu_kinetic": 0.1,
            "friction.stribeck_velocity": v,
            **thin,
        }
        for law in ("stribeck", "lugre")
        for v in (0.1, 1e-3)
    }
    return [
        *_along("friction", ["press"], none | steady),
        *_along("seizing pin", ["slider-crank"], {"friction 1, 70 mm": seizing}),
        *_along("friction", ["slider-crank"], none | steady | others | drop),
    ]


def _loads() -> list[Case]:
    """Blanking before bottom dead centre, up to far more than the press would bear."""
    values = {
        f"{force / 1e3:g} kN in {rise * 1e6:g} us": {
            "load.blanking.kind": "blanking",
            "load.blanking.force": force,
            "load.blanking.rise": rise,
            "load.blanking.fall": rise,
            "start_angle_deg": 170.0,
            "load.blanking.end_angle_deg": 182.0,
        }
        for force in (0.0, 1e4, 1e5, 2e6)
        for rise in ((1e-3,) if force == 0.0 else (1e-3, 1e-4, 1e-5))
    }
    return _along("blanking", ["press", "press lubricated"], values)


def _angles() -> list[Case]:
    """Where the crank stands at the start."""
    around = _numbers(
        "start_angle_deg", (0.0, 45.0, 90.0, 135.0, 180.0, 225.0, 270.0, 315.0), " deg"
    )
    ends = _numbers("start_angle_deg", (-180.0, 0.0, 180.0, 3600.0), " deg")
    return [
        *_along("start angle", ["press"], around),
        *_along("start angle", ["slider-crank lubricated"], ends),
    ]


def _press_masses() -> dict[str, float]:
    """Return the press's masses by their keys, kg."""
    press = Scene().to_dict()["press"]
    return {name: value for name, value in press.items() if name.endswith("_mass")}


def _masses() -> list[Case]:
    """All masses together, then the slider's alone."""
    press = _press_masses()
    crank = Scene(mechanism="slider_crank").to_dict()["slider_crank"]
    moving = {name: crank[name] for name in ("rod_mass", "rod_inertia", "slider_mass")}
    factors = (0.01, 0.1, 1.0, 10.0, 100.0)

    def scaled(table: str, values: Mapping[str, float]) -> dict[str, Changes]:
        return {
            f"x {f:g}": {f"{table}.{name}": f * value for name, value in values.items()}
            for f in factors
        }

    slider = {
        f"slider x {f:g}": {"press.slider_mass": f * press["slider_mass"]}
        for f in factors
        if f != 1.0
    }
    return [
        *_along("masses", ["press"], scaled("press", press) | slider),
        *_along("masses", ["slider-crank"], scaled("slider_crank", moving)),
    ]


def _flexible() -> list[Case]:
    """Flexible crank and linkage: number of modes, stiffness, damping; a whole revolution."""

    def whole(**keys: Any) -> Changes:
        bodies = flexible_press(**keys)
        return {"bodies": bodies, "revolutions": 1.0, "solver.max_steps": LONG_BUDGET}

    modes = {f"{n} modes": whole(modes=n) for n in (0, 2, 10, 20, 40, 60)}
    others = {
        "E x 0.5": whole(modes=4, youngs_modulus=1e11),
        "E x 100": whole(modes=4, youngs_modulus=2e13),
        "undamped": whole(modes=4, damping_ratio=0.0),
        "free modes": whole(modes=20, method="free"),
    }
    return [
        *_along("flexible bodies", ["press lubricated"], modes | others),
        *_along("flexible bodies", ["press"], {"4 modes": whole(modes=4)}),
        *_along("flexible bodies", ["press ideal"], {"20 modes": whole(modes=20)}),
    ]


def _settings() -> list[Case]:
    """Tolerance, fixed step and what else steers the integration."""
    tolerances = _numbers("solver.tolerance", (1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 1e-1))
    short = {name: {**change, "revolutions": 0.03} for name, change in tolerances.items()}
    steps = _numbers("solver.step", (1e-6, 1e-5, 2e-5, 5e-5, 1e-4, 1e-3), " s")
    short_steps = {name: {**change, "revolutions": 0.03} for name, change in steps.items()}
    radii = _numbers("solver.spectral_radius", (0.5, 0.8, 0.95))
    return [
        *_along("tolerance", ["press", "press lubricated", "slider-crank"], short),
        *_along("fixed step", ["press", "press lubricated", "slider-crank"], short_steps),
        *_along("fixed step", ["slider-crank lubricated"], short_steps),
        *_along("spectral radius", ["press", "slider-crank lubricated"], radii),
    ]


def _variants() -> list[Case]:
    """Every joint variant without gravity, for a whole revolution and, where cheap, twenty."""
    variants = {
        f"pin {pin}, balls {balls}": {"joints.crank_pin": pin, "joints.balls": balls}
        for pin in ("ideal", "dry", "lubricated")
        for balls in ("ideal", "dry")
    }
    still = {name: {**change, "gravity": 0.0} for name, change in variants.items()}
    whole = {
        name: {**change, "revolutions": 1.0, "solver.max_steps": LONG_BUDGET}
        for name, change in variants.items()
    }
    long: Changes = {"revolutions": 20.0, "solver.max_steps": LONG_BUDGET}
    return [
        *_along("no gravity", ["press"], still),
        *_along("no gravity", ["slider-crank", "slider-crank lubricated"], {"": {"gravity": 0.0}}),
        *_along("joint variants", ["press"], whole),
        *_along("joint variants", ["slider-crank"], {"pin dry": {"revolutions": 1.0}}),
        *_along("long runs", [*IDEAL, "slider-crank lubricated"], {"20 revolutions": long}),
        *_along("long runs", ["press lubricated"], {
            "20 revolutions, balls ideal": {**long, "joints.balls": "ideal"}}),
    ]  # fmt: skip


def _pairs() -> list[Case]:
    """Two extremes at once, on the press whose joints have film, asperities and contact."""
    extremes: dict[str, Changes] = {
        "stiffness x 1e-3": {"contact.stiffness": 2.5545e7},
        "stiffness x 1e3": {"contact.stiffness": 2.5545e13},
        "undamped": {"contact.damping_max": 0.0},
        "clearance 1e-7 m": {
            "joints.crank_pin.clearance": 1e-7,
            "joints.balls.clearance": 1e-7,
            "film.roughness": 1e-8,
        },
        "clearance 1e-3 m": {"joints.crank_pin.clearance": 1e-3, "joints.balls.clearance": 1e-3},
        "1 rpm": {"speed_rpm": 1.0, "revolutions": 2e-4},
        "3000 rpm": {"speed_rpm": 3000.0},
        "viscosity 1e-5 Pa s": {"film.viscosity": 1e-5},
        "viscosity 10 Pa s": {"film.viscosity": 10.0},
        "friction 1": {"friction.mu_static": 1.0, "friction.mu_kinetic": 1.0},
        "2 MN in 10 us": {
            "load.blanking.kind": "blanking", "load.blanking.force": 2e6,
            "load.blanking.rise": 1e-5, "load.blanking.fall": 1e-5,
        },
        "masses x 0.01": {f"press.{name}": 0.01 * value for name, value in _press_masses().items()},
        "masses x 100": {f"press.{name}": 100.0 * value for name, value in _press_masses().items()},
        "tolerance 0.1": {"solver.tolerance": 0.1},
        "tolerance 1e-5": {"solver.tolerance": 1e-5},
    }  # fmt: skip
    found = []
    for (first, one), (second, other) in itertools.combinations(extremes.items(), 2):
        if one.keys() & other.keys():
            continue  # two values of one key
        changes = {"revolutions": REVOLUTIONS, **one, **other}
        if "load.blanking.force" in changes:  # in the middle of the run
            changes["load.blanking.end_angle_deg"] = 180.0 * changes["revolutions"]
        found.append(_case(PAIRS, "press mixed", f"{first} + {second}", changes))
    return found
