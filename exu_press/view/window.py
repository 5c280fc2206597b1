"""The animation in a window: play, pause, a time slider; space and the arrow keys do the same."""

import time
from typing import Any

import matplotlib
from matplotlib.figure import Figure
from matplotlib.widgets import Button, Slider

from exu_press.errors import InputError
from exu_press.plots.style import RUN, look
from exu_press.result import Result
from exu_press.view.animation import SIZE, Animation, Look
from exu_press.view.instants import Instants

__all__ = ["Player", "show"]

WINDOW_DPI = 84
"""Of a new window: its 1075 x 605 pixels and its tools fit a screen of 1366 x 768."""

HEADLESS = ("agg", "pdf", "ps", "svg", "pgf", "cairo", "template")


class Player:
    """Plays an animation on its figure's canvas, at its own speed whatever drawing takes.

    Frames that there is no time for are left out.
    """

    def __init__(self, animation: Animation) -> None:
        """Add the controls and connect them."""
        self.animation, self.frame, self.playing = animation, 0, False
        self._last = len(animation.instants) - 1
        figure = animation.figure
        with look():
            self._button = Button(figure.add_axes((0.30, 0.012, 0.05, 0.034)), "Play")
            times = animation.instants.time * 1e3
            self._slider = Slider(
                figure.add_axes((0.425, 0.012, 0.16, 0.034)),
                "time, ms",
                float(times[0]),
                float(times[-1]),
                valinit=float(times[0]),
                valstep=times,
                color=RUN,
            )
        self._slider.drawon = False
        self._controls = (self._slider.ax, self._button.ax)
        for axes in self._controls:
            axes.set_animated(True)
        self._background: Any = None
        self._begun = (0.0, 0)
        canvas = figure.canvas
        self._timer = canvas.new_timer(interval=max(1, int(500 / animation.instants.fps)))
        self._timer.add_callback(self.tick)
        self._button.on_clicked(lambda event: self.toggle())
        self._slider.on_changed(self._drag)
        canvas.mpl_connect("key_press_event", self._key)
        canvas.mpl_connect("draw_event", self._redrawn)
        animation.show(0)

    def toggle(self) -> None:
        """Play or pause; at the end, play from the start."""
        if self.playing:
            self._timer.stop()
        else:
            start = 0 if self.frame == self._last else self.frame
            self._begun = time.monotonic(), start
            self._timer.start()
        self.playing = not self.playing
        self._button.label.set_text("Pause" if self.playing else "Play")
        self._paint()

    def tick(self) -> None:
        """Show the frame whose time it is; pause at the end."""
        since, start = self._begun
        due = start + int((time.monotonic() - since) * self.animation.instants.fps)
        self.go(min(due, self._last))
        if due >= self._last and self.playing:
            self.toggle()

    def go(self, frame: int) -> None:
        """Show a frame."""
        self.frame = frame
        self.animation.show(frame)
        self._slider.eventson = False
        self._slider.set_val(self.animation.instants.time[frame] * 1e3)
        self._slider.eventson = True
        self._paint()

    def _drag(self, milliseconds: float) -> None:
        """Go to where the slider was put, and play on from there if it plays."""
        frame = int(abs(self.animation.instants.time * 1e3 - milliseconds).argmin())
        self._begun = time.monotonic(), frame
        self.go(frame)

    def _key(self, event: Any) -> None:
        steps = {"left": -1, "right": 1, "pageup": -10, "pagedown": 10}
        if event.key == " ":
            self.toggle()
        elif event.key in steps and not self.playing:
            self.go(min(max(self.frame + steps[event.key], 0), self._last))

    def _redrawn(self, event: Any) -> None:
        """Keep what does not change, after the window was drawn anew."""
        canvas: Any = self.animation.figure.canvas
        if canvas.supports_blit:
            self._background = canvas.copy_from_bbox(self.animation.figure.bbox)
        self._draw_changes()

    def _draw_changes(self) -> None:
        with look():
            self.animation.draw(self.animation.artists)
            for axes in self._controls:
                self.animation.figure.draw_artist(axes)

    def _paint(self) -> None:
        """Draw what changes on what does not."""
        canvas: Any = self.animation.figure.canvas
        if self._background is None or not canvas.supports_blit:
            canvas.draw_idle()
            return
        canvas.restore_region(self._background)
        self._draw_changes()
        canvas.blit(self.animation.figure.bbox)


def show(result: Result, instants: Instants, flexible: Look | None = None) -> None:
    """Show a run in a window until it is closed.

    Raises:
        InputError: there is no display, or no toolkit that opens windows.
    """
    import matplotlib.pyplot as plt

    figure: Figure = plt.figure("exu-press view", figsize=SIZE, dpi=WINDOW_DPI)
    backend = matplotlib.get_backend().lower()
    if backend in HEADLESS:
        plt.close(figure)
        raise InputError(
            "view: no window can be opened here (no display, or no toolkit such as tkinter); "
            "use --save FILE.mp4, FILE.gif or FILE.png"
        )
    player = Player(Animation(result, instants, figure, flexible))
    plt.show()
    player.playing = False
