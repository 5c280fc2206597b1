"""Long-run dynamics of a press: period, largest Lyapunov exponent, figures by revolution."""

from exu_press.studies.attractor.lyapunov import Exponent
from exu_press.studies.attractor.period import Period, period_of
from exu_press.studies.attractor.study import Attractor, attractor

__all__ = ["Attractor", "Exponent", "Period", "attractor", "period_of"]
