"""Reads an SVG as gnuplot writes it back into numbers: curves, polygons and points in the units of the axes."""

import re
import xml.etree.ElementTree as xml

SVG = "{http://www.w3.org/2000/svg}"
XLINK = "{http://www.w3.org/1999/xlink}href"
PLACE = re.compile(r"translate\(([-\d.]+),\s*([-\d.]+)\)")


class Axis:
    """Pixels to values, from two tics."""

    def __init__(self, tics, log=False):
        self.tics, self.log = tics, log

    def value(self, pixel):
        import math
        (p0, v0), (p1, v1) = self.tics[0], self.tics[-1]
        if self.log:
            v0, v1 = math.log(v0), math.log(v1)
        v = v0 + (pixel - p0) / (p1 - p0) * (v1 - v0)
        return math.exp(v) if self.log else v


class Figure:
    def __init__(self, path):
        self.root = xml.parse(path).getroot()

    def text_of(self, name):
        return self.root.find(SVG + name).text

    def texts(self):
        """[(text, x, y)] of everything written."""
        found = []
        for group in self.root.iter(SVG + "g"):
            place = PLACE.search(group.get("transform", ""))
            label = group.find(SVG + "text")
            if place and label is not None:
                found.append(("".join(label.itertext()), float(place[1]), float(place[2])))
        return found

    def numbers(self):
        found = []
        for text, x, y in self.texts():
            try:
                found.append((float(text), x, y))
            except ValueError:
                pass
        return found

    def axes(self, log_x=False, log_y=False):
        """The axes of a figure with one panel: tics in a row below, in a column at the left."""
        numbers = self.numbers()
        row = max(set(round(y) for _, _, y in numbers), key=lambda level: sum(abs(y - level) < 1 for _, _, y in numbers))
        below = sorted((x, v) for v, x, y in numbers if abs(y - row) < 1)
        left_edge = min(x for _, x, y in numbers if abs(y - row) > 1)
        left = sorted((y, v) for v, x, y in numbers if abs(x - left_edge) < 1 and abs(y - row) > 1)
        # A label's baseline lies below the middle of its tic by a constant.
        shift = 4.33
        return Axis(below, log_x), Axis([(y - shift, v) for y, v in left], log_y)

    def plots(self):
        return [group for group in self.root.iter(SVG + "g") if group.get("id", "").startswith("gnuplot_plot_")]

    def plot(self, title):
        """The group of the plot with this title in the key."""
        for group in self.plots():
            if any("".join(text.itertext()) == title for text in group.iter(SVG + "text")):
                return group
        raise AssertionError(f"no plot with the title {title!r} in {[t for t, _, _ in self.texts()]}")

    @staticmethod
    def lines(group):
        """Its paths in pixels, cut at every move, without the sample in the key."""
        found = []
        for path in group.iter(SVG + "path"):
            for part in path.get("d").split("M")[1:]:
                points = [tuple(map(float, p.split(","))) for p in re.findall(r"[-\d.]+,[-\d.]+", part)]
                found.append(points)
        return found

    @staticmethod
    def points(group):
        return [tuple(map(float, PLACE.search(use.get("transform")).groups())) for use in group.iter(SVG + "use")]

    @staticmethod
    def polygons(group):
        return [[tuple(map(float, p.split(","))) for p in polygon.get("points").split()]
                for polygon in group.iter(SVG + "polygon")]
