"""Validation of a scene: whatever is handed in is one or an InputError; tried by Hypothesis."""

import json

from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from exu_press import Scene, simulate
from exu_press.errors import InputError
from exu_press.integrate import SolverStatus
from exu_press.scene.usage import TABLES, table_keys
from exu_press.schema.table import declared_keys

anything = st.one_of(
    st.none(),
    st.booleans(),
    st.integers(-(10**400), 10**400),
    st.floats(),
    st.text(max_size=5),
    st.lists(st.integers(), max_size=2),
    st.dictionaries(st.text(max_size=3), st.integers(), max_size=2),
)


FIELDS = {
    (table, name): field
    for table in ("", *TABLES)
    for name, field in (table_keys(table) if table else declared_keys(Scene)).items()
    if "meaning" in field.metadata
}


def likely_value_of(field):
    """Return values of a key that are mostly allowed."""
    meta = field.metadata
    if meta["choices"]:
        likely = st.sampled_from(meta["choices"])
    elif isinstance(field.default, bool):
        likely = st.booleans()
    elif isinstance(field.default, int):
        likely = st.integers(0, 60)
    elif isinstance(field.default, float):
        likely = st.floats(-6.0, 6.0).map(lambda power: field.default * 10.0**power)
    else:
        likely = st.floats(-9.0, 3.0).map(lambda power: 10.0**power)
    return likely


def value_of(field):
    """Return values of a key: mostly likely ones, some at the edge, some nonsense."""
    meta, likely = field.metadata, likely_value_of(field)
    edges = [meta[name] for name in ("above", "at_least", "at_most") if meta[name] is not None]
    return st.one_of(*[likely] * 8, st.sampled_from([*edges, 0.0]), anything)


def table_of(table):
    fields = {name: value_of(field) for (of, name), field in FIELDS.items() if of == table}
    fields["unknown"] = anything
    names = st.lists(st.sampled_from(sorted(fields)), max_size=3, unique=True)
    return names.flatmap(lambda chosen: st.fixed_dictionaries({n: fields[n] for n in chosen}))


scenes = st.tuples(
    table_of(""),
    st.lists(st.sampled_from(sorted(TABLES)), max_size=3, unique=True).flatmap(
        lambda chosen: st.fixed_dictionaries({name: table_of(name) for name in chosen})
    ),
).map(lambda parts: {**parts[0], **parts[1]})


VARIANTS = st.sampled_from(
    [{"mechanism": "press", "joints": {"crank_pin": pin, "balls": balls}}
     for pin in ("ideal", "dry", "lubricated") for balls in ("ideal", "dry")]
    + [{"mechanism": "slider_crank", "joints": {"crank_pin": pin}}
       for pin in ("ideal", "dry", "lubricated")]
)  # fmt: skip


@st.composite
def likely_scenes(draw):
    """Return dictionaries of rigid scenes, of tables that they use and values mostly allowed."""
    data = draw(VARIANTS)
    used = Scene.from_dict(data).to_dict()
    for name in ("speed_rpm", "revolutions", "start_angle_deg", "gravity"):
        if draw(st.booleans()):
            data = {**data, name: draw(likely_value_of(FIELDS["", name]))}
    for table in set(used) & set(TABLES):
        keys = [name for of, name in FIELDS if of == table and name in used.get(table, {})]
        chosen = draw(st.lists(st.sampled_from(sorted(keys)), max_size=2)) if keys else []
        if chosen:
            data = {**data, table: {n: draw(likely_value_of(FIELDS[table, n])) for n in chosen}}
    return data


@settings(max_examples=30, deadline=None, suppress_health_check=[HealthCheck.too_slow])
@given(data=scenes)
def test_a_dictionary_is_a_scene_or_an_input_error(data):
    try:
        scene = Scene.from_dict(data)
    except InputError as error:
        said = "allowed", "not used", "needs", "missing"
        assert any(word in str(error) for word in said)
        assert "\n" not in str(error)
        return
    assert Scene.from_dict(scene.to_dict()) == scene
    json.dumps(scene.to_dict(), allow_nan=False)


def run_or_be_refused(data):
    """Run a scene with a budget of a few steps."""
    budget = {**data.get("solver", {}), "max_steps": 60}
    try:
        scene = Scene.from_dict({**data, "solver": budget})
    except InputError:
        return
    result = simulate(scene)
    assert result.info["status"] in {status.value for status in SolverStatus}
    assert (result.info["reason"] == "") == (result.info["status"] == "completed")
    json.dumps(result.summary(), allow_nan=False)


RUNS = {"deadline": None, "suppress_health_check": list(HealthCheck)}


@settings(max_examples=12, **RUNS)
@given(data=likely_scenes())
def test_an_accepted_scene_runs_or_stops_with_a_status(data):
    run_or_be_refused(data)
