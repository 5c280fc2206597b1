"""Mechanisms as data, and their ideal motion. Nothing here knows scenes or Exudyn."""

from exu_press.mechanism.file import (
    SHIPPED,
    change_mechanism,
    load_mechanism,
    mechanism_from_dict,
    mechanism_lines,
    mechanism_to_dict,
    shipped_mechanism,
    unit_in_mechanism,
)
from exu_press.mechanism.gears import Gear
from exu_press.mechanism.mechanism import Mechanism
from exu_press.mechanism.motion import Motion
from exu_press.mechanism.parts import GROUND, Body, Guide, Guideway, Joint, Output, Point, Spring
from exu_press.mechanism.press import Press, press
from exu_press.mechanism.slider_crank import SliderCrank, slider_crank
from exu_press.mechanism.springs import GasSpring, LinearSpring

__all__ = [
    "GROUND",
    "SHIPPED",
    "Body",
    "GasSpring",
    "Gear",
    "Guide",
    "Guideway",
    "Joint",
    "LinearSpring",
    "Mechanism",
    "Motion",
    "Output",
    "Point",
    "Press",
    "SliderCrank",
    "Spring",
    "change_mechanism",
    "load_mechanism",
    "mechanism_from_dict",
    "mechanism_lines",
    "mechanism_to_dict",
    "press",
    "shipped_mechanism",
    "slider_crank",
    "unit_in_mechanism",
]
