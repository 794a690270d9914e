"""M2: 40 x 40 m with buildings and walls. The original was never published; this is a reconstruction of its kind."""

from canvas import Canvas


def draw():
    m = Canvas(40, 40, 0.25, "pavement")
    # Four blocks, none like another, off the middle so that every pair of them leaves a street of its own width.
    m.rectangle("building", 5, 26, 13, 34)
    m.rectangle("pavement", 9, 26, 13, 29)
    m.rectangle("building", 24, 29, 34, 35)
    m.rectangle("building", 27, 10, 35, 16)
    m.rectangle("pavement", 27, 10, 30, 12)
    m.rectangle("building", 7, 7, 12, 13)
    # Rooms without roofs: walls of half a metre with gaps of three metres and more.
    m.rectangle("wall", 16, 16, 16.5, 24)
    m.rectangle("wall", 16, 16, 20, 16.5)
    m.rectangle("wall", 23.5, 16, 24, 21)
    m.rectangle("wall", 19.5, 23.5, 24, 24)
    # Free-standing walls.
    m.rectangle("wall", 4, 19, 11, 19.5)
    m.rectangle("wall", 17.5, 4, 18, 11)
    m.rectangle("wall", 22, 5.5, 30, 6)
    m.rectangle("wall", 29, 21, 36, 21.5)
    m.rectangle("wall", 28.75, 21, 29.25, 25)
    m.rectangle("wall", 17.5, 29, 18, 36)
    return m
