"""A joint kind of the user's own, in one file that a scene names."""

import gc
import sys

import pytest

from exu_press import InputError, Scene, simulate
from exu_press.schema.kinds import import_kinds

BUSHING = """
from dataclasses import dataclass
from exu_press.joints.interface import FunctionInterface
from exu_press.scene import CustomJoint, key

@dataclass(frozen=True)
class Bushing(CustomJoint):
    stiffness: float = key(None, "radial", "N/m", above=0)
    damping: float = key(0.0, "radial and transverse", "N s/m", at_least=0)

    def interfaces(self):
        k, d = self.stiffness, self.damping

        def law(e, e_dot, v_t, omega_j, omega_b):
            turning = 0.5 * (omega_j + omega_b)
            of_t = d * turning, 0.0, -d, 0.5 * d * e, 0.5 * d * e
            return -k * e - d * e_dot, -d * (v_t - e * turning), -k, -d, 0.0, 0.0, 0.0, *of_t

        return [FunctionInterface(law, self.clearance, lambda e: (0.5 * k * e * e, k * e))]

class Unfinished(CustomJoint):
    pass

@dataclass(frozen=True)
class Empty(Bushing):
    def interfaces(self):
        return []

class NoJoint:
    pass
"""
KEYS = {"kind": "a_bushing:Bushing", "clearance": 1e-4, "stiffness": 2e8, "damping": 5e3}


@pytest.fixture(autouse=True)
def module(tmp_path, monkeypatch):
    (tmp_path / "a_bushing.py").write_text(BUSHING)
    monkeypatch.syspath_prepend(tmp_path)
    yield
    sys.modules.pop("a_bushing", None)
    gc.collect()  # no class of it is half gone in the next test


def crank(**changes):
    joints = {"crank_pin": {**KEYS, **changes}}
    import_kinds({"joints": joints})
    return Scene(mechanism="slider_crank", joints=joints)


@pytest.mark.parametrize(
    ("lines", "told"),
    [
        ("a = 1\nb = (\n", r"broken.py, line 2: SyntaxError: '\(' was never closed; allowed"),
        ("import no_such_package\n", "broken.py, line 1: No module named 'no_such_package'"),
        ("def f():\n    return 1 / 0\nf()\n", "broken.py, line 2: ZeroDivisionError: division"),
    ],
)
def test_a_module_that_does_not_load_is_named_with_its_line(lines, told, tmp_path):
    (tmp_path / "broken.py").write_text(lines)
    with pytest.raises(InputError, match=told):
        crank(kind="broken:Bushing")


def test_it_balances_energy_and_comes_near_the_ideal_joint_as_it_gets_stiff():
    ideal = simulate(Scene(mechanism="slider_crank", joints={})).quantity(
        "joints.crank_pin.peak_force"
    )
    peaks = []
    for stiffness in (2e8, 2e9):
        result = simulate(crank(stiffness=stiffness))
        assert result.completed
        assert abs(result.quantity("energy.residual").value) < 1e-4
        peaks.append(result.quantity("joints.crank_pin.peak_force").value / ideal.value - 1.0)
    assert abs(peaks[1]) < 1e-3
    assert abs(peaks[1]) < abs(peaks[0])


def test_a_scene_file_names_it_and_reads_back_equal(tmp_path):
    crank().save(tmp_path / "scene.toml")
    assert Scene.load(tmp_path / "scene.toml") == crank()
    changed = crank().replace({"joints.crank_pin.stiffness": 1e9})
    assert changed.joints["crank_pin"].stiffness == 1e9


@pytest.mark.parametrize(
    ("changes", "told"),
    [
        ({"kind": "no_such_module:Bushing"}, "No module named 'no_such_module'"),
        ({"kind": "a_bushing:Ring"}, "has no attribute 'Ring'"),
        ({"kind": "a_bushing:NoJoint"}, "derived from CustomJoint"),
        (
            {"kind": "a_bushing:Unfinished"},
            "the class has no interfaces, which CustomJoint asks",
        ),
        ({"kind": "a_bushing:Empty"}, r"a_bushing:Empty.interfaces\(\) returns \[\]: allowed is"),
        ({"stifness": 1.0}, "did you mean 'stiffness'"),
        ({"stiffness": -1.0}, "stiffness = -1.0"),
        ({"stiffness": None}, "stiffness"),
        ({"film": {}}, "film"),
    ],
)
def test_what_is_no_such_joint_is_refused(changes, told):
    keys = {key: value for key, value in {**KEYS, **changes}.items() if value is not None}
    joints = {"crank_pin": keys}
    with pytest.raises(InputError, match=told):
        import_kinds({"joints": joints})
        Scene(mechanism="slider_crank", joints=joints)


LOADS = """
from dataclasses import dataclass
from exu_press.laws.load_curve import LoadCurve
from exu_press.scene import CustomLoad, key

@dataclass(frozen=True)
class Cushion(CustomLoad):
    over = "height"
    stiffness: float = key(None, "of the cushion", "N/m", above=0)
    height: float = key(2e-2, "above bottom dead centre, where it is met", "m", above=0)

    def curve(self, angular_speed):
        return LoadCurve([0.0, self.height], [self.stiffness * self.height, 0.0])

@dataclass(frozen=True)
class NoCurve(CustomLoad):
    def curve(self, angular_speed):
        return 7.0

@dataclass(frozen=True)
class Sideways(Cushion):
    over = "width"
"""


@pytest.fixture
def cushion(tmp_path):
    (tmp_path / "a_cushion.py").write_text(LOADS)
    yield {"kind": "a_cushion:Cushion", "stiffness": 1e6}
    sys.modules.pop("a_cushion", None)


def with_load(keys):
    import_kinds({"load": {"cushion": keys}})
    return Scene(mechanism="slider_crank", joints={}, load={"cushion": keys}, revolutions=1.0)


def test_a_load_of_ones_own_gives_back_what_it_takes(cushion, tmp_path):
    """As the table of the same curve does: a spring has no work in a revolution."""
    own = simulate(with_load(cushion))
    table = {"kind": "table", "height": [0.0, 2e-2], "force": [2e4, 0.0], "acts": "both"}
    same = simulate(with_load(table))
    name = "loads.cushion.work"
    assert own.quantity("loads.cushion.peak_force").value == pytest.approx(2e4, rel=1e-9)
    assert own["load_cushion_force"] == pytest.approx(same["load_cushion_force"], abs=1e-6)
    assert abs(own.quantity(name).value) < 1e-3 * 0.5 * 1e6 * 2e-2**2
    own.save(tmp_path / "run.nc")
    own.scene.save(tmp_path / "scene.toml")
    assert Scene.load(tmp_path / "scene.toml") == own.scene


@pytest.mark.parametrize(
    ("changes", "told"),
    [
        ({"stiffness": None}, "stiffness"),
        ({"stifness": 1.0}, "did you mean 'stiffness'"),
        ({"kind": "a_cushion:NoCurve"}, "returns 7.0: allowed is a LoadCurve"),
        ({"kind": "a_cushion:Sideways"}, "over = 'width': allowed is one of"),
        ({"kind": "a_bushing:Bushing"}, "derived from CustomLoad"),
        ({"kind": "no_module:Load"}, "No module named 'no_module'"),
    ],
)
def test_what_is_no_such_load_is_refused(changes, told, cushion):
    keys = {key: value for key, value in {**cushion, **changes}.items() if value is not None}
    if "NoCurve" in keys["kind"]:
        keys.pop("stiffness")
    with pytest.raises(InputError, match=told):
        with_load(keys)
