"""The table: every published number beside ours, with a verdict."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import asdict, dataclass
from typing import Any

from paper.clearance import Choice
from paper.comparison import observed, published_value, shown
from paper.published import Frequencies, Number, Trend, published
from paper.readings import MODELS, OBSERVED
from paper.sensitivity import Effect, Tornado
from paper.settings import AS_THEY_ARE
from paper.trends import follows

__all__ = [
    "AGREES_WITHIN",
    "Row",
    "choice_row",
    "frequency_rows",
    "number_rows",
    "trend_rows",
]

AGREES_WITHIN = 0.25
"""Largest deviation of a ratio from 1 that is called agreement."""

LEAST = 0.01
"""Of our value: what moves it by less is not named."""

Value = float | tuple[float | None, ...] | None
Runs = Mapping[str, Mapping[str, Any]]


@dataclass(frozen=True)
class Row:
    """One line of the table, SI units; of a trend, the values of its runs in order.

    Attributes:
        name: short, unique.
        kind: "number", "reference" (measured on the machine), "trend", "frequency", "choice".
        quantity: in words.
        figure: of the paper.
        measure: what of a run it is, as in `comparison.shown`.
        published: a number, or what is stated.
        resolved, mean_1ms, differentiated_1khz: ours, under three models of observation.
        ratio: ours over the paper's, under the model that all rows are judged by; of a low dead
            point, of how far it lies below the ideal one.
        verdict: "agrees", "trend", "differs", or "no run" where ours did not get to its end.
        reason: of a difference, from the sensitivity study; or what to know.
        run: which of ours.
    """

    name: str
    kind: str
    quantity: str
    figure: str
    measure: str
    published: float | str
    resolved: Value
    mean_1ms: Value
    differentiated_1khz: Value
    ratio: float | None
    verdict: str
    reason: str
    run: str

    def to_dict(self) -> dict[str, Any]:
        """Return the entries of paper.json."""
        return asdict(self)


def number_rows(
    numbers: Iterable[Number], runs: Runs, tornados: Mapping[str, Tornado]
) -> list[Row]:
    """Return a row for every number of section 5.

    Args:
        numbers: the published ones.
        runs: rows by name of the run.
        tornados: by name of the number, where it has one.
    """
    return [_number_row(number, runs[number.run], tornados.get(number.name)) for number in numbers]


def trend_rows(
    trends: Iterable[Trend], runs: Runs, settings: Mapping[str, Mapping[str, Sequence[float]]]
) -> list[Row]:
    """Return a row for every trend.

    Args:
        trends: the stated ones.
        runs: rows by name of the run.
        settings: of a trend's name, the series that every setting of the sensitivity study makes.
    """
    return [_trend_row(trend, runs, settings.get(trend.name, {})) for trend in trends]


def frequency_rows(parts: Runs) -> list[Row]:
    """Return a row for every published natural frequency of the parts.

    Args:
        parts: by name of the part, what `tasks.part_frequencies` returned, or why it did not.
    """
    return [
        _frequency_row(entry, index, parts[entry.part])
        for entry in published().frequencies
        if entry.part in parts
        for index in range(len(entry.mode_numbers))
    ]


def _number_row(number: Number, run: Mapping[str, Any], tornado: Tornado | None) -> Row:
    values = {model: shown(run, number.measure, model) for model in MODELS}
    value, aim = observed(run, number.measure, OBSERVED), published_value(number)
    if number.name == "bottom_dead_centre_ideal":
        value, aim = values[OBSERVED], number.published
    ratio = None if value is None else value / aim
    verdict = _verdict(ratio)
    reason = number.note
    if verdict == "no run":
        reason = str(run.get("reason") or run.get("status"))
    elif verdict == "differs":
        why = _why(tornado, aim) if tornado else "it is not varied"
        reason = "; ".join(filter(None, (number.note, why)))
    return Row(
        name=number.name,
        kind="reference" if number.reference else "number",
        quantity=number.quantity,
        figure=number.figure,
        measure=number.measure,
        published=number.published,
        **values,
        ratio=ratio,
        verdict=verdict,
        reason=reason,
        run=number.run,
    )


def _verdict(ratio: float | None) -> str:
    if ratio is None:
        return "no run"
    return "agrees" if abs(ratio - 1.0) <= AGREES_WITHIN else "differs"


def _why(tornado: Tornado, aim: float) -> str:
    """Return what the sensitivity study says of a number that differs."""
    measure = tornado.number.measure
    factors = {
        factor: effects
        for factor, effects in tornado.factors().items()
        if factor != "observation model" and tornado.swing(effects) > LEAST * abs(tornado.baseline)
    }
    movers = ", ".join(
        f"{factor} ({_changes(tornado, effects)})" for factor, effects in list(factors.items())[:3]
    )
    ours = _short(tornado.baseline, measure)
    text = f"ours with {tornado.bodies} bodies {ours}, moved most by {movers or 'nothing'}"
    if abs(tornado.baseline / aim - 1.0) <= AGREES_WITHIN:
        return f"{tornado.bodies} bodies meet the paper's as they are; {text}"
    nearest = tornado.nearest()
    if nearest is None or nearest.value is None:
        return text
    near = f"{nearest.factor} = {nearest.label}: {_short(nearest.value, measure)}"
    if abs(nearest.value / aim - 1.0) <= AGREES_WITHIN:
        return f"the paper's is met with {near}; {text}"
    known = [effect for effect in tornado.effects if effect.value is not None]
    return f"none of {len(known)} changes meets the paper's; nearest is {near}; {text}"


def _changes(tornado: Tornado, effects: Sequence[Effect]) -> str:
    changes = {effect.label: effect.change(tornado.baseline) for effect in effects}
    known = {label: change for label, change in changes.items() if change is not None}
    if tornado.number.measure == "bottom_dead_centre":
        measure, base = tornado.number.measure, tornado.baseline
        return ", ".join(f"{key}: {_short(base + base * by, measure)}" for key, by in known.items())
    return ", ".join(f"{label} {100.0 * change:+.0f} %" for label, change in known.items())


def _trend_row(trend: Trend, runs: Runs, settings: Mapping[str, Sequence[float]]) -> Row:
    values: dict[str, Value] = {
        model: tuple(shown(runs[name], trend.measure, model) for name in trend.runs)
        for model in MODELS
    }
    if trend.measure in (
        "oscillation_frequency",
        "permanent_contact_ball",
        "permanent_contact_pin",
    ):
        values = {model: values[model] if model == OBSERVED else None for model in MODELS}
    series = [observed(runs[name], trend.measure, OBSERVED) for name in trend.runs]
    known = [value for value in series if value is not None]
    reason = trend.note
    if len(known) < len(series):
        verdict, reason = "no run", "a run of the series did not get to its end"
    elif follows(trend.stated, known):
        verdict = "trend"
    else:
        verdict = "differs"
        reason = "; ".join(filter(None, (trend.note, _why_trend(trend, known, settings))))
    return Row(
        name=trend.name,
        kind="trend",
        quantity=trend.quantity,
        figure=trend.figure,
        measure=trend.measure,
        published=trend.stated,
        **values,
        ratio=None,
        verdict=verdict,
        reason=reason,
        run=", ".join(trend.runs),
    )


def _why_trend(
    trend: Trend, series: Sequence[float], settings: Mapping[str, Sequence[float]]
) -> str:
    """Return what ours does, and which changes of the sensitivity study make the trend appear."""
    ours = "ours: " + ", ".join(_short(value, trend.measure) for value in series)
    if not settings:
        return ours
    with_it = [label for label, values in settings.items() if follows(trend.stated, values)]
    if AS_THEY_ARE in with_it:
        return f"{ours}; with rigid bodies it appears"
    if not with_it:
        return f"{ours}; under none of {len(settings)} changes (rigid bodies) does it appear"
    shown_few = "; ".join(with_it[:3]) + (" ..." if len(with_it) > 3 else "")
    return f"{ours}; appears under {len(with_it)} of {len(settings)} changes: {shown_few}"


def _frequency_row(entry: Frequencies, index: int, part: Mapping[str, Any]) -> Row:
    number, aim = entry.mode_numbers[index], entry.hz[index]
    value = float(part["hz"][number - 1]) if "hz" in part else None
    ratio = None if value is None else value / aim
    return Row(
        name=f"{entry.part}_mode_{number}",
        kind="frequency",
        quantity=f"natural frequency of the {entry.part}, mode {number}, Hz",
        figure=entry.figure,
        measure="frequency",
        published=aim,
        resolved=value,
        mean_1ms=None,
        differentiated_1khz=None,
        ratio=ratio,
        verdict=_verdict(ratio),
        reason=str(part["reason"] or "a computed number: no observation model applies"),
        run=f"{entry.part}, bearing surfaces clamped",
    )


def _short(value: float, measure: str) -> str:
    """Return a value as it is judged."""
    if measure == "bottom_dead_centre":
        return f"{1e6 * value:.1f} µm"
    return f"{value:.3g}"


def choice_row(choice: Choice) -> Row:
    """Return the row of the recommended clearance."""
    paper, ours = published().clearance, choice.best[1.0]
    ratio = None if ours is None else ours / paper["published"]
    found = ", ".join(
        f"{1e3 * best:.2g} mm at weight {weight:g}" for weight, best in choice.best.items() if best
    )
    return Row(
        name="recommended_clearance",
        kind="choice",
        quantity=paper["quantity"],
        figure=paper["figure"],
        measure="clearance",
        published=paper["published"],
        resolved=None,
        mean_1ms=ours,
        differentiated_1khz=None,
        ratio=ratio,
        verdict=_verdict(ratio),
        reason=f"least losses times acceleration^weight: {found}",
        run="study of the clearance",
    )
