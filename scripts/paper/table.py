"""What the study found as tables of texts, for the terminal and for paper.json."""

from collections.abc import Mapping, Sequence

from exu_press.scene import Scene
from exu_press.terminal.columns import columns
from paper.choice import WEIGHTS, cost, least, radii
from paper.published import Number, Trend, published
from paper.readings import MODELS, OBSERVED
from paper.runs import DAMPINGS, DEFAULT
from paper.study import Study
from paper.value import Value, distance
from paper.verdicts import AGREES_WITHIN, agreement, followed

__all__ = ["report_lines", "tables"]

Table = list[tuple[str, ...]]

PEAK = f"peak_acceleration.{OBSERVED}"
HEADINGS = {"resolved": "resolved", "mean_1ms": "over 1 ms", "differentiated_1khz": "1 kHz"}
UNITS = {
    "below_ideal": ("mm", 1e3),
    PEAK: ("m/s²", 1.0),
    "peak_velocity": ("m/s", 1.0),
    "oscillation_frequency": ("Hz", 1.0),
    "ball.share_permanent": ("%", 1e2),
    "pin.share_permanent": ("%", 1e2),
}
WORDS = """\
A +- B: the figure and its error, shown as 0.1 % at least; A to B: the scene does not determine it,
other runs lie between. All are read in the last revolution, accelerations, velocities and positions
as means over 1 ms. agrees: within {:.0f} % of the paper's whatever the error; trend: ours do what
the paper says whatever the errors; open: the errors decide it; differs: neither.
"""
REDUCED = "REDUCED FORM, rigid bodies and a fraction of a revolution: says nothing of the paper."

REAL = " *"
"""Marks a change by more than both errors, and by more than LEAST."""

LEAST = 0.01
"""Of the figure as it is."""


def report_lines(study: Study) -> list[str]:
    """Return everything that is printed."""
    lines = [*([REDUCED] if study.quick else []), *WORDS.format(100 * AGREES_WITHIN).splitlines()]
    for title, table in tables(study).items():
        lines += ["", *columns([(title, *table[0][1:]), *table[1:]])]
    section_5 = [s for runs in study.scenes.values() for s in runs.values() if s in study.rows]
    residual = max(abs(study.rows[scene].get("residual") or 0.0) for scene in section_5)
    ended = sum(study.rows[scene]["status"] == "completed" for scene in section_5)
    return [
        *lines,
        "",
        f"{ended} of {len(section_5)} runs of section 5 completed; largest energy residual "
        f"{residual:.1e}",
    ]


def tables(study: Study) -> dict[str, Table]:
    """Return every table by its title, the head of its columns first."""
    found = {"numbers": _numbers(study), "natural frequencies, Hz": _frequencies(study)}
    for damping in DAMPINGS:
        found[f"trends, c_max {damping} N s/m"] = _trends(study, damping)
    for bodies, suffix in (("flexible", ""), ("rigid", ", rigid")):
        for damping in DAMPINGS:
            title = f"peak acceleration, m/s², {bodies} bodies, c_max {damping} N s/m"
            found[title] = _peaks(study, damping, suffix)
    for title, cases, changes in study.settings:
        found[f"peak acceleration, m/s², {title}, one change"] = _settings(study, cases, changes)
    for damping, line in study.line.items():
        found[f"one clearance, c_max {damping} N s/m"] = _line(study, line)
    found["clearance to choose, mm"] = _choice(study)
    found["pin, mm, against balls, mm: power times acceleration, kW m/s²"] = _map(study)
    return found


def _numbers(study: Study) -> Table:
    head = [cell for d in DAMPINGS for cell in (f"ours, c_max {d}", "over paper's", "")]
    table: Table = [("", "figure", "paper", *head)]
    for number in published().numbers:
        unit, scale = UNITS[number.measure]
        cells = []
        for damping in DAMPINGS:
            value = study.value(damping, number.run, number.measure)
            cells += [_text(value, scale), *_judged(value, number.published)]
        paper = f"{scale * number.published:.4g}"
        table.append((f"{number.quantity}, {unit}", number.figure, paper, *cells))
    chosen, cells = published().clearance, []
    for line in study.line.values():
        value = least(study.of, line, 1.0)
        cells += [_text(value, 1e3), *_judged(value, chosen["published"])]
    paper = f"{1e3 * chosen['published']:g}"
    return [*table, (f"{chosen['quantity']}, mm", chosen["figure"], paper, *cells)]


def _frequencies(study: Study) -> Table:
    table: Table = [("", "figure", "paper", "ours", "over paper's", "")]
    for entry in published().frequencies:
        for mode, aim in zip(entry.mode_numbers, entry.hz, strict=True):
            known = study.frequencies[entry.part]
            value = known[mode - 1] if known else None
            words = f"{entry.part}, mode {mode}"
            table.append((words, entry.figure, f"{aim:g}", _text(value), *_judged(value, aim)))
    return table


def _judged(value: Value | None, aim: float) -> tuple[str, str]:
    """Return the ratio to the paper's, and the verdict."""
    return _text(value and value.over(aim)), agreement(value, aim)


def _trends(study: Study, damping: str) -> Table:
    def cells(trend: Trend) -> tuple[str, ...]:
        unit, scale = UNITS[trend.measure]
        values = [study.value(damping, name, trend.measure) for name in trend.runs]
        series = ", ".join(_text(value, scale) for value in values)
        words = f"{trend.quantity}, {unit}"
        return (words, trend.figure, trend.stated, series, followed(trend.stated, values))

    return [("", "figure", "paper", "ours", ""), *(cells(trend) for trend in published().trends)]


def _peaks(study: Study, damping: str, suffix: str) -> Table:
    """Return the computed peaks under every model of observation, and their distances."""
    numbers = published().peaks
    found = {
        model: [
            study.value(damping, number.run + suffix, f"peak_acceleration.{model}")
            for number in numbers
        ]
        for model in MODELS
    }

    def cells(place: int, number: Number) -> tuple[str, ...]:
        words = number.quantity.removeprefix("peak acceleration, ")
        ours = (_text(found[model][place]) for model in MODELS)
        return (words, number.figure, f"{number.published:g}", *ours)

    aims = [number.published for number in numbers]
    distances = (_text(distance(found[model], aims)) for model in MODELS)
    return [
        ("", "figure", "paper", *HEADINGS.values()),
        *(cells(place, number) for place, number in enumerate(numbers)),
        ("distance: root mean square of log(ours / paper's)", "", "", *distances),
    ]


def _settings(
    study: Study, cases: Mapping[str, str], changes: Mapping[str, Mapping[str, Scene | None]]
) -> Table:
    """Return the peaks as they are and with each change that is one, and what changes nothing."""
    base = {case: study.value(DEFAULT, name, PEAK) for case, name in cases.items()}
    paper = {number.run: f"{number.published:g}" for number in published().peaks}
    table: Table = [
        ("", *cases),
        ("paper", *(paper.get(name.removesuffix(", rigid"), "-") for name in cases.values())),
        ("ours", *(_text(value) for value in base.values())),
    ]
    alike = []
    for words, scenes in changes.items():
        cells, moved = zip(*(_change(study, scenes[c], base[c]) for c in cases), strict=True)
        if any(moved):
            table.append((words, *cells))
        else:
            alike.append(words)
    table += [("none of these changes one by more than 1 %:", *[""] * len(cases))]
    return table + [(f"  {words}", *[""] * len(cases)) for words in alike]


def _change(study: Study, scene: Scene | None, base: Value | None) -> tuple[str, bool]:
    """Return what a change makes of a peak, and whether it is to be shown."""
    if scene is None or base is None:
        return "-", False
    value = study.of(scene, PEAK)
    if value is None:
        return "no run", True
    moved = abs(value.value - base.value) > LEAST * base.value
    return _text(value) + (REAL if moved and value.apart(base) else ""), moved


def _line(study: Study, line: Sequence[Scene]) -> Table:
    def cells(scene: Scene) -> tuple[str, ...]:
        values = {
            name: study.of(scene, name) for name in (PEAK, "below_ideal", "power", "power.pin")
        }
        scales = (1.0, 1e3, 1.0, 1.0)
        shown = (_text(v, scale) for v, scale in zip(values.values(), scales, strict=True))
        return (f"{1e3 * radii(scene)[1]:g} mm", *shown, _text(cost(study.of, scene), 1e-3))

    head = ("", "peak, m/s²", "dead centre below ideal, mm", "power lost, W", "of it in the pin, W")
    return [(*head, "power times peak, kW m/s²"), *(cells(scene) for scene in line)]


def _choice(study: Study) -> Table:
    def cells(weight: float) -> tuple[str, ...]:
        found = (least(study.of, line, weight) for line in study.line.values())
        words = f"one per cent of acceleration is worth {weight:g} per cent of power"
        return (words, *(_text(value, 1e3) for value in found))

    return [("", *(f"c_max {d}" for d in study.line)), *(cells(weight) for weight in WEIGHTS)]


def _map(study: Study) -> Table:
    """Return the costs with one clearance for the pin, a line each, and one for the balls."""
    costs = {radii(scene): _text(cost(study.of, scene), 1e-3) for scene in study.map}
    balls = sorted({ball for _, ball in costs})
    return [
        ("", *(f"{1e3 * ball:g}" for ball in balls)),
        *((f"{1e3 * pin:g}", *(costs[pin, ball] for ball in balls)) for pin in balls),
    ]


def _text(value: Value | None, scale: float = 1.0) -> str:
    return "-" if value is None else value.text(scale)
