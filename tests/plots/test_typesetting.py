import pytest

from exu_press.plots.typesetting import typeset


@pytest.mark.parametrize(
    ("ascii_text", "printed"),
    [
        ("m/s^2", "m/s²"),
        ("kg m^2", "kg m²"),
        ("N/m^1.5", "N/m^1.5"),
        ("m^3", "m³"),
        ("um", "µm"),
        ("film 93.7 um, tilt 0.2 urad.", "film 93.7 µm, tilt 0.2 µrad."),
        ("a gap of 3 um.", "a gap of 3 µm."),
        ("12.3 +- 0.4", "12.3 ± 0.4"),
        ("joints.um.radius", "joints.um.radius"),
        ("um.toml and out/um/run.nc", "um.toml and out/um/run.nc"),
        ("aluminium, museum, maximum", "aluminium, museum, maximum"),
    ],
)
def test_units_are_printed_and_names_stay(ascii_text, printed):
    assert typeset(ascii_text) == printed
