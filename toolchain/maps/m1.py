"""M1: 40 x 40 m without obstacles."""

from canvas import Canvas


def draw():
    return Canvas(40, 40, 0.25, "pavement")
