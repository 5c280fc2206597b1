"""The press' flexible bodies, reduced in a second; tests of several folders share them."""

from exu_press.scene import flexible_press

COARSE = flexible_press(modes=4, mesh_size=0.1)
