"""The player on a canvas in memory: the same code as in a window, without one."""

from types import SimpleNamespace

import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from exu_press.errors import InputError
from exu_press.view import Animation, instants, window
from exu_press.view.animation import SIZE


def test_a_new_window_fits_a_small_laptop():
    """Of 1366 x 768 pixels, title, tools and the desktop's bar take 130."""
    width, height = (window.WINDOW_DPI * inch for inch in SIZE)
    assert width <= 1366
    assert height <= 768 - 130


@pytest.fixture
def player(runs):
    figure = Figure(figsize=SIZE, dpi=50)
    FigureCanvasAgg(figure)
    animation = Animation(runs["ideal"], instants(runs["ideal"], frames=51), figure)
    player = window.Player(animation)
    figure.canvas.draw()
    return player


def test_play_and_pause(player, monkeypatch):
    now = [100.0]
    monkeypatch.setattr(window.time, "monotonic", lambda: now[0])
    player.toggle()
    assert player.playing and player._button.label.get_text() == "Pause"
    now[0] += 1.0
    player.tick()
    assert player.frame == 25  # at 25 frames a second
    player.toggle()
    assert not player.playing and player.frame == 25
    now[0] += 10.0
    player.toggle()
    now[0] += 0.4
    player.tick()
    assert player.frame == 35  # the pause does not count


def test_it_pauses_at_the_end_and_starts_again(player, monkeypatch):
    now = [0.0]
    monkeypatch.setattr(window.time, "monotonic", lambda: now[0])
    player.toggle()
    now[0] = 60.0
    player.tick()
    assert (player.frame, player.playing) == (50, False)
    player.toggle()
    now[0] += 0.2
    player.tick()
    assert player.frame == 5


def test_the_slider_goes_to_its_time(player):
    times = player.animation.instants.time
    player._slider.set_val(1e3 * times[20])
    assert player.frame == 20
    assert f"t = {1e3 * times[20]:7.2f} ms" in player.animation._clock.get_text()
    player.go(30)
    assert player._slider.val == pytest.approx(1e3 * times[30])


def test_keys(player):
    for key, frame in (("right", 1), ("pagedown", 11), ("left", 10), ("pageup", 0), ("left", 0)):
        player._key(SimpleNamespace(key=key))
        assert player.frame == frame
    player._key(SimpleNamespace(key=" "))
    assert player.playing


def test_without_a_display_it_says_what_to_do(runs, monkeypatch):
    monkeypatch.setenv("MPLBACKEND", "agg")
    import matplotlib.pyplot as plt

    plt.switch_backend("agg")
    with pytest.raises(InputError, match=r"no window can be opened.*--save FILE\.mp4"):
        window.show(runs["ideal"], instants(runs["ideal"]))
    assert plt.get_fignums() == []
