"""Channels say which way is positive, whatever the direction of output and guide."""

from dataclasses import replace

from exu_press import Scene, simulate
from exu_press.mechanism import Guide, shipped_mechanism
from exu_press.result.channel import positive


def test_an_output_along_x_is_not_upwards():
    drawn = shipped_mechanism("four_bar")
    words = {
        direction: simulate(
            Scene(
                mechanism=replace(drawn, output=replace(drawn.output, direction=direction)),
                joints={},
                revolutions=0.01,
            )
        )
        .channels["slider_position"]
        .long_name
        for direction in ((1.0, 0.0), (0.0, -1.0), (3.0, 4.0))
    }
    assert [*words.values()] == [
        "slider position, to the right",
        "slider position, downwards",
        "slider position, along [0.6, 0.8]",
    ]


def test_a_guides_force_is_positive_across_it():
    """To the right of a guide along +x is down."""
    assert positive(Guide(body="ram", direction=(1.0, 0.0)).normal) == "downwards"
    result = simulate(Scene(mechanism="slider_crank", joints={}, revolutions=0.01))
    told = result.channels["guide_force"].long_name
    assert told == "slider guide: force on the body, to the right"
