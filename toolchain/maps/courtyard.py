"""A city courtyard of 21 x 27 m: street in the south, buildings on three sides, lawns around a pond, a terrace up some
stairs. Every one of the 14 classes occurs; passages are at least 1.4 m wide; the terrace is for people only."""

from canvas import Canvas


def draw():
    m = Canvas(21, 27, 0.0625, "pavement")
    _street(m)
    _lawns(m)
    _plaza(m)
    _buildings_and_walls(m)
    _terrace(m)
    _beds_and_hedges(m)
    _trees(m)
    _furniture(m)
    return m


def _street(m):
    m.rectangle("road", 0, 0, 21, 2.75)
    for i in range(6):
        m.rectangle("crossing", 8.75 + 0.5 * i, 0, 9.0 + 0.5 * i, 2.75)
    m.rectangle("parking", 0.75, 2.75, 7.5, 4.5)
    m.rectangle("parking", 13.0, 2.75, 20.25, 4.5)
    # Lines between the bays and kerbs at their ends.
    for x in (4.0625, 16.5625):
        m.rectangle("pavement", x, 2.75, x + 0.125, 4.5)
    m.rectangle("cycle lane", 0, 4.75, 21, 6.0)


def _lawns(m):
    m.rounded("grass", 4.75, 9.0, 9.25, 14.0, 0.6)
    m.rounded("grass", 12.0, 9.0, 16.75, 13.5, 0.6)
    m.rounded("grass", 4.75, 15.5, 9.25, 21.75, 0.6)
    m.rounded("grass", 12.0, 15.5, 16.75, 20.25, 0.6)


def _plaza(m):
    m.disc("pavement", 10.5, 14.75, 3.9)
    m.line("pavement", 4.0, 18.9, 9.0, 16.0, 1.5)
    m.ellipse("water", 10.5, 14.75, 1.75, 1.35)
    m.ellipse("water", 11.3, 14.1, 1.1, 0.85)


def _buildings_and_walls(m):
    # West wing, with a doorway set back.
    m.rectangle("building", 0, 7.0, 3.25, 23.25)
    m.rectangle("pavement", 1.5, 13.25, 3.25, 16.0)
    # North wing, with a porch.
    m.rectangle("building", 0, 23.25, 13.75, 27)
    m.rectangle("pavement", 6.25, 23.25, 9.25, 24.75)
    # East wing.
    m.rectangle("building", 18.5, 10.0, 21, 18.75)
    # The wall to the street: a gate in the middle, a side gate in the east.
    m.rectangle("wall", 3.25, 7.0, 8.75, 7.25)
    m.rectangle("wall", 12.25, 7.0, 17.75, 7.25)
    m.rectangle("wall", 19.75, 7.0, 21, 7.25)
    m.rectangle("wall", 20.75, 7.0, 21, 10.0)
    m.rectangle("wall", 20.75, 18.75, 21, 24.5)


def _terrace(m):
    m.rectangle("wall", 13.75, 24.25, 15.0, 24.5)
    m.rectangle("wall", 18.0, 24.25, 21, 24.5)
    m.rectangle("stairs", 15.0, 22.75, 18.0, 24.5)
    m.rectangle("wall", 14.75, 22.75, 15.0, 24.5)
    m.rectangle("wall", 18.0, 22.75, 18.25, 24.5)


def _beds_and_hedges(m):
    m.rounded("soil", 4.75, 7.25, 8.25, 8.25, 0.25)
    m.rounded("soil", 18.25, 19.75, 20.25, 22.0, 0.5)
    m.rounded("soil", 12.5, 17.75, 14.25, 19.5, 0.8)
    m.rectangle("shrub", 5.25, 21.25, 8.0, 21.75)
    m.rectangle("shrub", 12.75, 9.0, 16.25, 9.5)
    m.rectangle("shrub", 12.75, 20.75, 14.75, 21.25)
    m.rectangle("shrub", 16.25, 20.75, 17.5, 21.25)
    m.rounded("shrub", 5.25, 7.5, 6.25, 8.0, 0.2)
    m.rounded("shrub", 7.0, 7.5, 7.75, 8.0, 0.2)
    # Planters on the terrace.
    m.rectangle("shrub", 19.0, 26.5, 20.5, 27)
    m.rectangle("shrub", 14.0, 26.5, 15.25, 27)


def _trees(m):
    for x, y, radius in (
        (6.1, 12.4, 0.65),
        (7.6, 10.2, 0.5),
        (15.3, 11.9, 0.7),
        (13.2, 11.1, 0.4),
        (5.9, 16.4, 0.55),
        (6.6, 19.8, 0.7),
        (15.6, 18.0, 0.65),
        (19.6, 21.0, 0.55),
        (1.6, 6.45, 0.35),
    ):
        m.disc("tree", x, y, radius)


def _furniture(m):
    def bench(x0, y0, x1, y1):
        m.rectangle("street furniture", x0, y0, x1, y1)

    # Benches that look at the pond.
    bench(7.25, 14.0, 7.6875, 15.5)
    bench(13.3125, 14.0, 13.75, 15.5)
    bench(9.75, 17.75, 11.25, 18.1875)
    # Benches in the corners.
    bench(3.25, 20.5, 3.6875, 22.0)
    bench(18.0625, 12.0, 18.5, 13.5)
    bench(10.5, 22.8125, 12.0, 23.25)
    bench(16.0, 26.5625, 17.5, 27)
    # Bins beside the gates and the porch.
    for x, y in ((8.25, 7.25), (12.375, 7.25), (9.5, 22.8125), (17.25, 7.25)):
        m.rectangle("street furniture", x, y, x + 0.4375, y + 0.4375)
    # Bicycle stands by the street.
    for i in range(4):
        m.rectangle("street furniture", 14.0 + 0.75 * i, 6.125, 14.125 + 0.75 * i, 6.4375)
