"""Joints on cables of elements: on which of these they are, and where they have slid to."""

from bisect import bisect

from exu_press.integrate.problem import ON_CABLES, Problem

__all__ = ["Places"]


class _Joint:
    """A joint on a cable.

    Attributes:
        element: index of its element's number, among the data variables.
        place: index of its place along the cable, m, among them; None where that is a coordinate.
        starts: of the elements along the cable, m.
        slid: by how much the place has changed in the last step, m.
    """

    def __init__(self, problem: Problem, number: int) -> None:
        """Take the joint of this number."""
        self._mbs, self._number = problem.mbs, number
        item = problem.mbs.GetObject(number)
        self._body = int(item["markerNumbers"][0])
        self._markers = [int(marker) for marker in item["slidingMarkerNumbers"]]
        self.starts: list[float] = list(item["slidingMarkerOffsets"])
        self.element, *places = problem.data.GetObjectLTGData(number)
        self.place: int | None = places[0] if places else None
        self.slid = 0.0

    def put(self, element: int) -> None:
        """Put it on an element."""
        marker = self._markers[element]
        if int(self._mbs.GetObjectParameter(self._number, "markerNumbers")[1]) != marker:
            pair = [self._body, marker]
            self._mbs.SetObjectParameter(self._number, "markerNumbers", pair)
            self._mbs.AssembleLTGLists()


class Places:
    """Places of joints on cables.

    Exudyn moves a joint to the next element where a step has brought it there, and leaves it on
    that when the step is repeated. So each try begins on the element that the state says.

    Where a joint slides along a cable, one of its algebraic unknowns is by how much its place
    changes within the step. Exudyn takes that for one of the forces too, which adds to the forces
    on the cable what goes with the step. So each step begins at the place where it would end if the
    joint slid on as in the last one: what is left to the unknown goes with the step's square.
    """

    def __init__(self, problem: Problem) -> None:
        """Take the joints of a system."""
        self._joints = [
            _Joint(problem, number)
            for number, kind in enumerate(problem.kinds)
            if kind in ON_CABLES
        ]
        self._unknowns = list(problem.places)
        self._multipliers = problem.current.multipliers
        self._now, self._start = problem.current.data, problem.start.data
        self._last = 1.0  # step, s

    def begin(self) -> None:
        """Start at the places that are given; Exudyn's unknowns are their accelerations there."""
        self._multipliers[self._unknowns] = 0.0

    def before_try(self, step: float) -> None:
        """Slide on to the end of a step (s) that is about to be tried; 0.0: to its beginning."""
        for joint in self._joints:
            element = int(self._start[joint.element])
            if joint.place is not None:
                place = self._start[joint.place] + step / self._last * joint.slid
                element = max(bisect(joint.starts, place), 1) - 1
                self._now[joint.place], self._now[joint.element] = place, element
            joint.put(element)

    def stepped(self, step: float) -> None:
        """Be told of an accepted step (s), which leads to the current state."""
        self._last = step
        for joint in self._joints:
            if joint.place is not None:
                joint.slid = self._now[joint.place] - self._start[joint.place]
        if self._unknowns:
            self._multipliers[self._unknowns] = 0.0

    def within(self, part: float) -> None:
        """Go to a part of the accepted step, from 0.0 to its end at 1.0, with an even speed."""
        for joint in self._joints:
            if joint.place is not None:
                self._now[joint.place] = self._start[joint.place] + part * joint.slid
