#!/usr/bin/env python3
"""The foreign fields: what stands where, and from where it is seen. scenery.py says in what frames.

  fields.py list [NAME]                            names, of those that begin with NAME
  fields.py write NAME FOLDER [--pairs N] [--seed N]   scene.pov, POSES.csv, RIG.toml, scene.json;
                                                   says the side of the height picture, the width
                                                   and the height of the pictures to draw (pixels)

Each field is meant to be `clear` (a safe disc of 2.6 m radius lies in view), `none` (no disc of
2.3 m is safe) or `mixed`. The judge measures which it is, and says where that differs.
Places are (ahead, right) of the middle of the view. Another seed draws another field of the same
kind; what is written in figures stays.
"""
import argparse
import pathlib
import sys

from scenery import HEIGHT_PX, SUPERSAMPLING, WIDTH_PX, Field

FIELDS = {}


def field(meant, material, height_m, **look):
    """Enters a field in the table; the function puts things on its ground."""
    def enter(furnish):
        FIELDS[furnish.__name__] = (meant, furnish, dict(look, material=material,
                                                         height_m=height_m))
        return furnish
    return enter


# Clear.

@field('clear', 'gravel', 13, heading_deg=30)
def a01_gravel_low_rocks(f):
    f.ring(3.5, 4.6, 9, lambda a, r: f.rock(a, r, f.between(.2, .5)))
    f.ring(.5, 2.5, 6, lambda a, r: f.rock(a, r, .055))


@field('clear', 'asphalt', 10, tilt_deg=-40, heading_deg=200)
def a02_asphalt_road(f):
    for right in (-2.4, 0, 2.4):
        f.line(0, right, .12, 30, f.heading_deg)
    for right in (-5, 5):
        f.kerb(0, right, .15, f.heading_deg)


@field('clear', 'faint sand', 12, sun_deg=(35, 230), travel_m=.6)
def a05_faint_sand(f):
    f.ring(3.6, 4.6, 6, lambda a, r: f.log(a, r, f.between(.15, .3), f.between(.8, 1.6),
                                           f.between(0, 180)))


@field('clear', 'slabs', 13, heading_deg=20)
def a06_slabs_vehicle(f):
    f.vehicle(.5, 4.6, 20)
    f.pallet(-3.2, -3.6, 23)


@field('clear', 'gravel', 14, sun_deg=(40, 90))
def a08_shadow_edge(f):
    f.shade(0, 13, along=5, across=4, height=10)


@field('clear', 'asphalt', 17, heading_deg=150, view_deg=45)
def a09_lines_and_patch(f):
    f.patch(1.5, -1, .9, .6, 57)
    for k in range(5):
        f.line(1.5 * k - 3, 0, .15, 4, 17)
    f.ring(4.2, 6, 5, lambda a, r: f.rock(a, r, f.between(.3, .6)))


@field('clear', 'grass', 9, tilt_deg=-36, slope=(-.087, 0), view_deg=58)
def a10_slope_from_aside(f):
    f.ring(4, 7, 6, lambda a, r: f.bush(a, r, .5, .6))


# Nothing is safe.

@field('none', 'gravel', 10, heading_deg=40)
def b01_gravel_rocks(f):
    f.scatter(8, 2.3, lambda a, r: f.rock(a, r, f.between(.16, .35)))


@field('none', 'grass', 12, tilt_deg=-45, heading_deg=10, view_deg=46)
def b02_grass_mixed(f):
    f.scatter(14, 2.3, lambda a, r: f.rock(a, r, f.between(.2, .45)),
              lambda a, r: f.bush(a, r, f.between(.25, .45), f.between(.3, .6)),
              lambda a, r: f.post(a, r, .08, f.between(.4, 1)))


@field('none', 'soil', 12, heading_deg=250)
def b03_soil_holes(f):
    f.scatter(9, 2.3, lambda a, r: f.hole(a, r, f.between(.15, .4), f.between(.2, .5)))


@field('none', 'slabs', 12)
def b04_slabs_kerbs(f):
    for k in range(11):
        f.kerb(0, 2.6 * k - 13, f.between(.19, .25), 20)


@field('none', 'asphalt', 10, heading_deg=90, travel_m=1)
def b05_asphalt_posts(f):
    f.scatter(8, 2.2, lambda a, r: f.post(a, r, f.between(.05, .10), f.between(.3, 1)))


@field('none', 'moss', 10, tilt_deg=-60, heading_deg=60, slope=(.2, .18))
def b06_moss_15_degrees(f):
    pass


@field('none', 'soil', 11, tilt_deg=-50, heading_deg=180)
def b08_soil_ditches(f):
    for k in range(-6, 7):
        f.ditch(0, 2.7 * k, f.between(.3, .5), f.between(.2, .45), 209)


@field('none', 'grass', 13, travel_m=1, sun_deg=(30, 60))
def b11_grass_logs(f):
    f.scatter(9, 2.3, lambda a, r: f.log(a, r, f.between(.19, .3), f.between(.7, 1.8),
                                         f.between(0, 180)))


# Mixed.

@field('mixed', 'soil', 13)
def m02_soil_step(f):
    f.step(0, .3, .2, 23)


@field('mixed', 'grass', 13, heading_deg=270)
def m03_grass_hole(f):
    f.hole(.3, -.4, .22, .35)


@field('mixed', 'moss', 12, tilt_deg=-42, heading_deg=330, travel_m=1)
def m06_posts_from_afar(f):
    """Ahead and right, thickness and height in metres: a draw that found a defect."""
    for post in [
            (-7.41, -4.65, .049, .31), (-7.67, 3.70, .072, .51), (-1.95, -3.75, .052, .58),
            (-4.65, -0.72, .043, .56), (-2.15, 3.25, .053, .76), (-5.19, 7.77, .066, .40),
            (0.42, -8.33, .059, .61), (2.69, -4.68, .077, .99), (0.52, 0.36, .045, .86),
            (3.06, 3.29, .059, .96), (-0.13, 7.29, .078, .68), (7.06, -11.09, .052, .92),
            (4.34, -8.83, .071, .87), (6.91, -4.46, .042, .31), (4.56, -0.90, .060, .98),
            (6.15, 4.72, .058, .32), (4.46, 8.23, .051, .77), (7.37, 12.88, .058, .51),
            (12.11, -12.07, .076, .91), (9.13, -8.79, .060, .83), (12.21, -4.42, .062, .91),
            (9.08, 0.14, .044, .88), (12.18, 4.83, .079, .50), (9.34, 7.14, .075, .96),
            (10.97, 11.71, .052, .85), (15.53, -12.61, .041, .75), (13.86, -8.18, .071, .43),
            (16.23, -3.78, .040, .81), (14.62, -0.06, .060, .81), (15.19, 4.84, .047, .66),
            (12.96, 8.44, .068, .50), (16.20, 12.31, .077, .52)]:
        f.post(*post)


@field('mixed', 'soil', 14)
def m08_soil_bank(f):
    f.bank(0, .5, 14, 20)


@field('mixed', 'gravel', 12, baseline_m=.5, sun_deg=(35, 120))
def m09_gravel_vehicle(f):
    f.vehicle(3, 3.5, 57)
    f.pallet(-2.5, .5, 11)
    f.pallet(.5, -4, 69)
    for _ in range(4):
        f.rock(f.between(-4, 4), f.between(-5, 5), f.between(.15, .5))


@field('mixed', 'gravel', 13, heading_deg=20)
def x02_one_post(f):
    """Seen from straight above: little but its top."""
    f.post(-.2, .1, .06, .5)


@field('mixed', 'asphalt', 10, heading_deg=90, travel_m=1)
def x06_posts_end_on(f):
    f.post(-.128, -.2, .077, .84)
    f.post(-.388, 3.619, .064, .74)


def main():
    parser = argparse.ArgumentParser(description='The foreign fields.')
    parser.add_argument('action', choices=['list', 'write'])
    parser.add_argument('name', nargs='?', default='')
    parser.add_argument('folder', nargs='?', type=pathlib.Path)
    parser.add_argument('--pairs', type=int, default=10)
    parser.add_argument('--seed', type=int, default=0)
    options = parser.parse_args()
    names = [name for name in sorted(FIELDS) if name.startswith(options.name)]
    if not names:
        sys.exit('foreign: no field is called %s' % options.name)
    if options.action == 'list':
        print('\n'.join(names))
        return
    if options.name not in FIELDS or options.folder is None or options.pairs < 1:
        parser.error('write takes the whole name of a field, a folder, and at least one pair')
    meant, furnish, look = FIELDS[options.name]
    made = Field(options.name, options.seed, **look)
    furnish(made)
    options.folder.mkdir(parents=True, exist_ok=True)
    made.write(options.folder, options.pairs, meant)
    print(made.truth_side_px(), SUPERSAMPLING * WIDTH_PX, SUPERSAMPLING * HEIGHT_PX)


if __name__ == '__main__':
    main()
