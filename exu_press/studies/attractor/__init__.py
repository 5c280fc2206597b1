"""Long-run dynamics of a press: period, largest Lyapunov exponent, figures by revolution."""

from exu_press.studies.attractor.lyapunov import Exponent
from exu_press.studies.attractor.motion import Attractor, attractor
from exu_press.studies.attractor.period import Period, period_of

__all__ = ["Attractor", "Exponent", "Period", "attractor", "period_of"]
