#!/usr/bin/env python3
"""judge.py OUT NAME...: the sites that palacectl found in fields, held against their truth.

OUT/NAME holds scene.json, heights.ppm and analysis/site.json. The truth is of cells of 5 cm, each
as high as the highest of its four pixels in the height picture. Over a disc, as in
engine/world/ground_truth.h:

  slope      angle of the least-squares plane through its cells
  deviation  largest distance in height from that plane
  step       largest difference in height between a cell and one at most 15 cm away

A site is as bad as the worst of 17 touchdowns (its middle, eight half the navigation error away,
eight the whole). What the height picture does not show counts as unknown, and is unsafe.
Frames: W, metres north and east; heights up-positive. Exit: 1 when a confirmed site is unsafe.
"""
import argparse
import itertools
import json
import math
import pathlib
import sys

from expose import read_grey

NAV_ERROR_M, RADIUS_M = 0.5, 1.8
CLEAR_M, WIDE_M = 2.3, 2.6  # a safe disc; one with room to spare
SLOPE_DEG, DEVIATION_M, STEP_M = 10, 0.10, 0.15
UNSAFE, GROSS = 1.2, 1.5  # times a limit
EVERY_M = 0.5  # of the places at which safe discs are looked for
# Within 15 cm of a cell, by rows of 5 cm: how far the row is, how far along it.
FOOT = {-3: 0, -2: 2, -1: 2, 0: 3, 1: 2, 2: 2, 3: 0}


def along_rows(rows, reach, best):
    """best (max, min) of each cell and `reach` cells to both sides."""
    if reach == 0:
        return rows
    wide = [row[:1] * reach + row + row[-1:] * reach for row in rows]
    return [list(map(best, *(row[k:k + len(row) - 2 * reach] for k in range(2 * reach + 1))))
            for row in wide]


def around(rows, best):
    """best of each cell and those whose middles are at most 15 cm away."""
    reached = {reach: along_rows(rows, reach, best) for reach in set(FOOT.values())}
    last = len(rows) - 1
    return [list(map(best, *(reached[reach][min(last, max(0, r + away))]
                             for away, reach in FOOT.items()))) for r in range(len(rows))]


class Truth:
    """Heights and steps of the cells, row 0 northernmost."""

    def __init__(self, folder):
        self.scene = json.loads((folder / 'scene.json').read_text())
        side, _, pixels = read_grey(folder / 'heights.ppm')
        self.count = side // 2
        self.cell_m = 2 * self.scene['truth_pixel_m']
        reach, (north, east) = self.scene['reach_m'], self.scene['middle']
        self.north_max = north + self.count * self.cell_m / 2
        self.east_min = east - self.count * self.cell_m / 2
        rise_n, rise_e = self.scene['slope']
        tilt = [rise_e * (self.east(col) - east) - reach for col in range(self.count)]
        self.up = []
        for row in range(self.count):
            one = pixels[2 * row * side:(2 * row + 1) * side]
            two = pixels[(2 * row + 1) * side:(2 * row + 2) * side]
            high = map(max, one[::2], one[1::2], two[::2], two[1::2])
            level = rise_n * (self.north(row) - north)
            self.up.append([2 * reach * h / 65535 + level + t for h, t in zip(high, tilt)])
        self.step = [[max(high - h, h - low) for high, h, low in zip(*rows)]
                     for rows in zip(around(self.up, max), self.up, around(self.up, min))]

    def north(self, row):
        return self.north_max - (row + .5) * self.cell_m

    def east(self, col):
        return self.east_min + (col + .5) * self.cell_m

    def spans(self, north, east, radius):
        """(row, first column, column after the last) of a disc; None: it leaves the picture."""
        spans = []
        first = math.ceil((self.north_max - north - radius) / self.cell_m - .5)
        last = math.floor((self.north_max - north + radius) / self.cell_m - .5)
        for row in range(first, last + 1):
            half = math.sqrt(max(0, radius ** 2 - (self.north(row) - north) ** 2))
            start = math.ceil((east - half - self.east_min) / self.cell_m - .5)
            end = math.floor((east + half - self.east_min) / self.cell_m - .5) + 1
            if row < 0 or row >= self.count or start < 0 or end > self.count:
                return None
            spans.append((row, start, end))
        return spans

    def disc(self, north, east, radius):
        """(share of a limit, which limit, where) of one touchdown."""
        spans = self.spans(north, east, radius)
        if spans is None:
            return math.inf, 'unknown', (north, east)
        cells = [(self.north(row) - north, self.east(start + k) - east, up)
                 for row, start, end in spans for k, up in enumerate(self.up[row][start:end])]
        middle, rise_n, rise_e = plane(cells)
        off, n, e = max((abs(up - middle - rise_n * n - rise_e * e), n, e) for n, e, up in cells)
        step, row, col = max((self.step[row][col], row, col)
                             for row, start, end in spans for col in range(start, end))
        slope = math.degrees(math.atan(math.hypot(rise_n, rise_e)))
        return max((slope / SLOPE_DEG, 'slope', (north, east)),
                   (off / DEVIATION_M, 'deviation', (north + n, east + e)),
                   (step / STEP_M, 'step', (self.north(row), self.east(col))))

    def site(self, north, east):
        """The worst touchdown of a site."""
        places = [(north, east)]
        for away in (NAV_ERROR_M / 2, NAV_ERROR_M):
            places += [(north + away * math.cos(k * math.pi / 4),
                        east + away * math.sin(k * math.pi / 4)) for k in range(8)]
        return max(self.disc(n, e, RADIUS_M) for n, e in places)

    def in_view(self, north, east, radius):
        """Both cameras see the whole rim in the middle of the hover; what hides it is not asked."""
        scene, pose = self.scene, self.scene['pose']
        row = int((self.north_max - north) / self.cell_m)
        up = self.up[row][int((east - self.east_min) / self.cell_m)]
        for k in range(8):
            from_eye = [north + radius * math.cos(k * math.pi / 4) - pose['place'][0],
                        east + radius * math.sin(k * math.pi / 4) - pose['place'][1],
                        -up - pose['place'][2]]
            x, y, z = (sum(a * b for a, b in zip(from_eye, pose[axis]))
                       for axis in ('right', 'down', 'forward'))
            if z <= 0:
                return False
            for shift in (0, scene['baseline_m']):
                across, down = scene['fx_px'] * (x - shift) / z, scene['fx_px'] * y / z
                if (abs(across) > (scene['width_px'] - 1) / 2
                        or abs(down) > (scene['height_px'] - 1) / 2):
                    return False
        return True

    def safe_disc_in_view(self, radius, share):
        """Whether a disc lies in view over which no more than `share` of any limit is used."""
        over = [list(itertools.accumulate((s > share * STEP_M for s in row), initial=0))
                for row in self.step]
        spread = int((self.count * self.cell_m / 2 - radius) / EVERY_M)
        north, east = self.scene['middle']
        places = [(north + EVERY_M * i, east + EVERY_M * j)
                  for i in range(-spread, spread + 1) for j in range(-spread, spread + 1)]
        for n, e in sorted(places, key=lambda p: math.hypot(p[0] - north, p[1] - east)):
            if not self.in_view(n, e, radius):
                continue
            spans = self.spans(n, e, radius)
            if spans is None or any(over[row][end] > over[row][start] for row, start, end in spans):
                continue
            if self.disc(n, e, radius)[0] <= share:
                return True
        return False

    def nearest_thing(self, place):
        """(kind, distance to its rim) of what lies nearest to a place, or None."""
        found = [(max(0, distance(place, thing['from'], thing['to']) - thing['reach_m']),
                  thing['kind']) for thing in self.scene['things']]
        return min(found) if found else None


def plane(cells):
    """(middle, rise by north, rise by east) of the least-squares plane."""
    count = len(cells)
    mean = [sum(values) / count for values in zip(*cells)]
    nn = ne = ee = nu = eu = 0.0
    for north, east, up in cells:
        n, e, u = north - mean[0], east - mean[1], up - mean[2]
        nn, ne, ee, nu, eu = nn + n * n, ne + n * e, ee + e * e, nu + n * u, eu + e * u
    rest = nn * ee - ne * ne
    rise_n, rise_e = (nu * ee - eu * ne) / rest, (eu * nn - nu * ne) / rest
    return mean[2] - rise_n * mean[0] - rise_e * mean[1], rise_n, rise_e


def distance(place, start, end):
    """From a place to a line between two."""
    along = [b - a for a, b in zip(start, end)]
    from_start = [b - a for a, b in zip(start, place)]
    long2 = sum(a * a for a in along)
    share = sum(a * b for a, b in zip(along, from_start)) / long2 if long2 else 0
    share = min(1, max(0, share))
    return math.hypot(*(f - share * a for f, a in zip(from_start, along)))


def verdict(share):
    return ('within' if share <= 1 else 'over' if share <= UNSAFE
            else 'unsafe' if share <= GROSS else 'gross')


def room(truth):
    """The safe disc in view: 'wide' (2.6 m), 'safe' (2.3 m), 'tight' (in 1.2 limits) or 'none'."""
    for name, radius, share in (('wide', WIDE_M, 1), ('safe', CLEAR_M, 1),
                                ('tight', CLEAR_M, UNSAFE)):
        if truth.safe_disc_in_view(radius, share):
            return name
    return 'none'


LINE = '%-22s %-5s %-4s %-11s %14s  %-6s %5s %-9s %s'


def judge(out, name):
    """Prints the rows of a field. (what it was meant to be, its room, [(standing, share)])."""
    truth = Truth(out / name)
    found = json.loads((out / name / 'analysis' / 'site.json').read_text())
    safe, sites = room(truth), []
    for site in found['candidates']:
        share, what, place = truth.site(site['north_m'], site['east_m'])
        sites.append((site['standing'], share))
        thing = truth.nearest_thing(place)
        print(LINE % (name, safe, site['letter'], site['standing'],
                      '%.2f, %.2f' % (site['north_m'], site['east_m']), verdict(share),
                      '%.2f' % share, what, '%s, %.2f m' % thing[::-1] if thing else ''))
    if not sites:
        print(LINE % (name, safe, '-', 'none', '', '', '', '', found['none_reason'] or ''))
    return truth.scene['meant'], safe, sites


def main():
    parser = argparse.ArgumentParser(description='Sites held against the truth of foreign fields.')
    parser.add_argument('out', type=pathlib.Path)
    parser.add_argument('names', nargs='+')
    options = parser.parse_args()
    print(LINE % ('field', 'room', 'site', 'standing', 'north, east', 'truth', 'share', 'of',
                  'nearest to the worst of it, or why there is none'))
    offered = {True: [], False: []}  # by whether a safe disc is in view
    shares, unlike = {}, []
    for name in options.names:
        meant, safe, sites = judge(options.out, name)
        roomy = safe in ('wide', 'safe')
        offered[roomy].append(bool(sites))
        for standing, share in sites:
            shares.setdefault(standing, []).append(share)
        if meant == 'clear' and safe != 'wide' or meant == 'none' and roomy:
            unlike.append('%s was meant to be %s; of this seed it is not' % (name, meant))
    print('\nA safe disc in view: %d fields, a site offered in %d. None in view: %d, offered in %d.'
          % (len(offered[True]), sum(offered[True]), len(offered[False]), sum(offered[False])))
    for standing, of_it in sorted(shares.items()):
        print('%s: %d sites, %d over %g times a limit, %d over %g.'
              % (standing, len(of_it), sum(s > UNSAFE for s in of_it), UNSAFE,
                 sum(s > GROSS for s in of_it), GROSS))
    for words in unlike:
        print(words)
    return 1 if any(share > UNSAFE for share in shares.get('Confirmed', [])) else 0


if __name__ == '__main__':
    try:
        sys.exit(main())
    except (OSError, ValueError, KeyError) as error:
        print('foreign: cannot judge: %s' % error, file=sys.stderr)
        sys.exit(2)
