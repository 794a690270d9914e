"""A map to paint on: metres, x right, y up, origin at the lower-left corner. A pixel takes what covers its centre."""

import math

from palette import INDEX


class Canvas:
    def __init__(self, width_m, height_m, resolution_m, ground):
        self.resolution_m = resolution_m
        self.width_px = round(width_m / resolution_m)
        self.height_px = round(height_m / resolution_m)
        self._rows = [bytearray([INDEX[ground]] * self.width_px) for _ in range(self.height_px)]

    def rows_from_the_top(self):
        return [bytes(row) for row in reversed(self._rows)]

    def rectangle(self, name, x0, y0, x1, y1):
        self._paint(name, (x0, y0, x1, y1), lambda x, y: True)

    def rounded(self, name, x0, y0, x1, y1, radius):
        """A rectangle with round corners."""

        def covers(x, y):
            dx = max(x0 + radius - x, x - x1 + radius, 0)
            dy = max(y0 + radius - y, y - y1 + radius, 0)
            return math.hypot(dx, dy) <= radius

        self._paint(name, (x0, y0, x1, y1), covers)

    def disc(self, name, x, y, radius):
        self.ellipse(name, x, y, radius, radius)

    def ellipse(self, name, x, y, rx, ry):
        box = (x - rx, y - ry, x + rx, y + ry)
        self._paint(name, box, lambda u, v: ((u - x) / rx) ** 2 + ((v - y) / ry) ** 2 <= 1)

    def line(self, name, x0, y0, x1, y1, width):
        """A straight strip with square ends."""
        length = math.hypot(x1 - x0, y1 - y0)
        ux, uy = (x1 - x0) / length, (y1 - y0) / length
        box = (min(x0, x1) - width, min(y0, y1) - width, max(x0, x1) + width, max(y0, y1) + width)

        def covers(x, y):
            along = (x - x0) * ux + (y - y0) * uy
            across = (y - y0) * ux - (x - x0) * uy
            return 0 <= along <= length and abs(across) <= width / 2

        self._paint(name, box, covers)

    def _paint(self, name, box, covers):
        res = self.resolution_m
        columns = range(max(0, math.floor(box[0] / res)), min(self.width_px, math.ceil(box[2] / res)))
        for j in range(max(0, math.floor(box[1] / res)), min(self.height_px, math.ceil(box[3] / res))):
            y = (j + 0.5) * res
            for i in columns:
                x = (i + 0.5) * res
                if box[0] <= x <= box[2] and box[1] <= y <= box[3] and covers(x, y):
                    self._rows[j][i] = INDEX[name]
