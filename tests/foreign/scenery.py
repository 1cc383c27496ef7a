"""What a foreign field is made of: ground, things, a hover over it; and the files that say so.

Frames. W: metres north, east, down from a local origin; heights are up-positive, 0 is the ground
at the middle of the view. POV-Ray's frame is left-handed: X east, Y up, Z north, so that a point
(north, east, up) of W is <east, up, north> there and nothing is mirrored. Body: forward, right,
down. Camera: right, down, forward (x, y, z of the pictures). Turns and headings are degrees
clockwise from north, in W as about POV-Ray's y axis. Lengths are metres.

A place is given as (ahead, right) of the middle of the view, along the heading of the hover.
"""
import json
import math
import random
import string

WIDTH_PX, HEIGHT_PX = 640, 480
SUPERSAMPLING = 2  # POV-Ray draws this many pixels a pixel, both ways
TRUTH_PIXEL_M = 0.025  # of the height picture
TRUTH_REACH_M = 8.0  # it tells heights of so much below and above the plane of the ground
FARTHEST_M = 30  # from the vehicle, of what the height picture shows
WIDEST_M = 24  # half a side of the height picture at most
BEYOND_VIEW_M = 2.6

# Pigments, one texture over the other. No grain is finer than a pixel of these hovers.
MATERIALS = {
    'gravel': ['''average pigment_map {
        [3 crackle solid scale .055 color_map {
            [0 rgb <.12,.11,.10>] [.5 rgb <.40,.38,.35>] [1 rgb <.75,.72,.67>]}]
        [1 granite scale .5 color_map {[0 rgb .2] [1 rgb .6]}]
        [1 bozo scale .7 color_map {[0 rgb .3] [1 rgb .48]}]}'''],
    'asphalt': ['''average pigment_map {
        [2 bozo scale .022 color_map {
            [0 rgb .10] [.45 rgb .17] [.6 rgb .22] [.75 rgb .33] [1 rgb .40]}]
        [1 bozo scale .9 turbulence .4 color_map {[0 rgb .13] [1 rgb .24]}]}'''],
    'grass': ['''average pigment_map {
        [2 bozo scale <.02,.02,.05> turbulence .6 color_map {
            [0 rgb <.07,.13,.03>] [.5 rgb <.16,.27,.07>] [1 rgb <.36,.46,.16>]}]
        [1 bozo scale .16 turbulence .5 color_map {
            [0 rgb <.08,.15,.04>] [1 rgb <.30,.36,.14>]}]
        [1 bozo scale 1.6 color_map {[0 rgb <.14,.22,.07>] [1 rgb <.26,.30,.12>]}]}'''],
    'soil': ['''average pigment_map {
        [2 granite scale .6 color_map {
            [0 rgb <.17,.11,.07>] [.5 rgb <.30,.21,.14>] [1 rgb <.52,.40,.28>]}]
        [1 bozo scale .04 color_map {[0 rgb <.20,.14,.09>] [1 rgb <.38,.28,.19>]}]
        [1 bozo scale 1.1 turbulence .5 color_map {
            [0 rgb <.20,.15,.10>] [1 rgb <.36,.27,.20>]}]}'''],
    'faint sand': ['''average pigment_map {
        [1 bozo scale .035 color_map {[0 rgb <.50,.44,.33>] [1 rgb <.60,.53,.41>]}]
        [1 bozo scale .4 turbulence .3 color_map {
            [0 rgb <.53,.46,.35>] [1 rgb <.58,.51,.39>]}]
        [1 bozo scale .09 color_map {[0 rgb <.51,.45,.34>] [1 rgb <.60,.53,.41>]}]}'''],
    'slabs': ['''average pigment_map {
        [1 bozo scale .03 color_map {[0 rgb .38] [1 rgb .52]}]
        [1 granite scale 1.3 color_map {[0 rgb .36] [1 rgb .56]}]
        [1 bozo scale .35 turbulence .6 color_map {[0 rgb .40] [1 rgb .54]}]}''',
              '''brick color rgb <.13,.13,.12> color rgbt 1
        brick_size <1,50,1> mortar .018 rotate y*35'''],
    'moss': ['''average pigment_map {
        [2 bozo scale .13 turbulence .8 lambda 2.3 omega .65 octaves 5 color_map {
            [0 rgb <.10,.14,.05>] [.45 rgb <.18,.23,.08>]
            [.6 rgb <.34,.31,.20>] [1 rgb <.50,.46,.36>]}]
        [1 bozo scale .03 color_map {[0 rgb .12] [1 rgb .38]}]}'''],
}

# Each macro textures one thing in the pictures, and nothing in the height picture, where one
# texture goes over all. A: tone, 1 as a rule.
POV_FILE = string.Template('''#version 3.7;
global_settings {assumed_gamma 1 max_trace_level 3}
#ifndef (Heights) #declare Heights = 0; #end

#macro Matt(Light) finish {ambient .42 diffuse .72 specular Light} #end
#macro Grain(Broad, Low, High, Fine, FineLow, FineHigh)
  #if (!Heights)
    texture {
      pigment {average pigment_map {
        [1 granite scale Broad color_map {[0 rgb Low] [1 rgb High]}]
        [1 bozo scale Fine color_map {[0 rgb FineLow] [1 rgb FineHigh]}]}}
      Matt(0)
    }
  #end
#end
#macro Rock(A) Grain(.3, .2*A, .5*A, .03, .22*A, .46*A) #end
#macro Wood(A) Grain(.2, <.20,.15,.10>*A, <.45,.35,.25>*A, .03, .2*A, .36*A) #end
#macro Block(A) Grain(.5, .25*A, .5*A, .04, .28*A, .46*A) #end
#macro Kerb(A) Grain(.5, .4*A, .6*A, .03, .38*A, .58*A) #end
#macro White(A) Grain(.5, .6*A, .8*A, .03, .66*A, .78*A) #end
#macro Dark(A) Grain(.5, .05*A, .10*A, .03, .05*A, .11*A) #end
#macro Leaf(A) #if (!Heights) texture {pigment {rgb <.16,.27,.08>*A} Matt(0)} #end #end
#macro Lacquer(A)
  #if (!Heights)
    texture {pigment {bozo scale .3 color_map {[0 rgb .4*A] [1 rgb .46*A]}} Matt(.3)}
  #end
#end
#macro Ground(A)
  #if (!Heights)
    $ground_textures
  #end
#end

#declare World = union {
  $ground
  $things
}

#if (Heights)
  // Black is $reach m below the plane of the ground, white as much above it.
  object {
    World
    texture {
      pigment {
        function {min(1, max(0, (y - ($slope_north)*z - ($slope_east)*x - ($up) + $reach)
                                / (2*$reach)))}
        color_map {[0 rgb 0] [1 rgb 1]}
      }
      finish {ambient 1 diffuse 0}
    }
  }
  camera {orthographic location <$east,60,$north> direction -y right x*$side up z*$side}
#else
  object {World}
  light_source {$sun rgb 1 parallel point_at 0}
  background {rgb <.6,.7,.8>}
  #switch (frame_number)
    $cameras
  #end
#end
''')


def product(a, b):
    """Of two 3 by 3 matrices, rows first."""
    return [[sum(a[i][k] * b[k][j] for k in range(3)) for j in range(3)] for i in range(3)]


def body_in_world(roll_deg, pitch_deg, heading_deg):
    """R_WB: heading about down, then pitch, then roll."""
    (cr, sr), (cp, sp), (ch, sh) = [
        (math.cos(math.radians(a)), math.sin(math.radians(a)))
        for a in (roll_deg, pitch_deg, heading_deg)]
    return product(product([[ch, -sh, 0], [sh, ch, 0], [0, 0, 1]],
                           [[cp, 0, sp], [0, 1, 0], [-sp, 0, cp]]),
                   [[1, 0, 0], [0, cr, -sr], [0, sr, cr]])


def pov(north, east, up):
    """A point or a direction, as POV-Ray writes it."""
    return '<%.6f,%.6f,%.6f>' % (east, up, north)


class Field:
    """One piece of ground, what stands on it, and a hover from which it is drawn."""

    def __init__(self, name, seed, material, height_m, tilt_deg=-90, heading_deg=0, view_deg=50,
                 baseline_m=1.0, slope=(0, 0), sun_deg=(50, 140), sway_m=0.2, travel_m=0.0):
        """
        height_m     of the cameras over the ground at the middle of the view, 0 in W
        tilt_deg     of the cameras: -90 straight down, 0 level
        view_deg     width of the view of one camera
        slope        rise of the ground by metre north and by metre east
        sun_deg      (above the horizon, clockwise from north)
        sway_m       how far the hover wanders; it turns by up to 1 degree about each axis
        travel_m     way forward over the whole hover
        """
        self.name, self.seed, self.material = name, seed, material
        self.height_m, self.tilt_deg, self.heading_deg = height_m, tilt_deg, heading_deg
        self.baseline_m, self.slope, self.sun_deg = baseline_m, slope, sun_deg
        self.sway_m, self.travel_m = sway_m, travel_m
        self.fx_px = WIDTH_PX / 2 / math.tan(math.radians(view_deg / 2))
        ahead_m = 0 if tilt_deg <= -89 else height_m / math.tan(math.radians(-tilt_deg))
        turn = math.radians(heading_deg)
        self.middle = (ahead_m * math.cos(turn), ahead_m * math.sin(turn))
        self.chance = self.random('things')
        self.solids, self.hollows, self.things = [], [], []

    def random(self, purpose):
        """Chance of its own for each purpose: the same for the same name and seed, anywhere."""
        return random.Random('%s/%s/%s' % (self.name, self.seed, purpose))

    # Places.

    def between(self, low, high):
        return self.chance.uniform(low, high)

    def place(self, ahead, right):
        """(north, east) of a place that is told from the middle of the view."""
        turn = math.radians(self.heading_deg)
        return (self.middle[0] + ahead * math.cos(turn) - right * math.sin(turn),
                self.middle[1] + ahead * math.sin(turn) + right * math.cos(turn))

    def ground_up(self, north, east):
        """Height of the bare ground: a plane through 0 at the middle of the view."""
        return (self.slope[0] * (north - self.middle[0]) + self.slope[1] * (east - self.middle[1]))

    def at(self, ahead, right, up=0.0):
        north, east = self.place(ahead, right)
        return pov(north, east, self.ground_up(north, east) + up)

    def ring(self, nearest, farthest, count, make):
        """make(ahead, right) at `count` places all around the middle of the view."""
        for k in range(count):
            turn = 2 * math.pi * k / count + self.between(-.2, .2)
            distance = self.between(nearest, farthest)
            make(distance * math.cos(turn), distance * math.sin(turn))

    def scatter(self, half, spacing, *makers):
        """One of the makers at each place of a loose grid of triangles, 2 `half` wide."""
        count = int(half / spacing) + 1
        for i in range(-count, count + 1):
            for j in range(-count, count + 1):
                ahead = (i + (.5 if j % 2 else 0) + self.between(-.2, .2)) * spacing
                right = (.87 * j + self.between(-.2, .2)) * spacing
                self.chance.choice(makers)(ahead, right)

    # Things.

    def note(self, kind, ahead, right, up, reach=0.0, length=0.0, turn_deg=0.0):
        """Keeps for the judge what stands where: a line of `length`, `reach` to each side."""
        north, east = self.place(ahead, right)
        half_n = length / 2 * math.cos(math.radians(turn_deg))
        half_e = length / 2 * math.sin(math.radians(turn_deg))
        self.things.append({'kind': kind, 'up_m': up, 'reach_m': reach,
                            'from': [north - half_n, east - half_e],
                            'to': [north + half_n, east + half_e]})

    def solid(self, shape, ahead, right, turn_deg=0.0):
        """A shape about its own foot: x right, y up, z along `turn_deg`."""
        self.solids.append('object {%s rotate y*%.3f translate %s}'
                           % (shape, turn_deg, self.at(ahead, right)))

    def rock(self, ahead, right, height, tone=None):
        tone = tone or self.between(.7, 1.3)
        wide = height * self.between(.8, 1.3)
        lumps = []
        for k in range(self.chance.randint(3, 5)):
            away = wide * self.between(.15, .45) if k else 0
            high = height * (self.between(.45, .85) if k else 1)
            turn = self.between(0, 2 * math.pi)
            lumps.append('sphere {0, 1 scale <%.4f,%.4f,%.4f> rotate <%.1f,%.1f,0> '
                         'translate <%.4f,0,%.4f>}'
                         % (wide * self.between(.45, .75), high, wide * self.between(.45, .75),
                            self.between(-8, 8), self.between(0, 180),
                            away * math.sin(turn), away * math.cos(turn)))
        self.solid('union {%s Rock(%.2f)}' % (' '.join(lumps), tone), ahead, right)
        self.note('rock', ahead, right, height, wide)

    def post(self, ahead, right, thick, height):
        self.solid('cylinder {<0,-.1,0>, <0,%.4f,0>, %.4f Wood(%.2f)}'
                   % (height, thick / 2, self.between(.6, 1.3)), ahead, right)
        self.note('post %.0f cm thick' % (100 * thick), ahead, right, height, thick / 2)

    def log(self, ahead, right, thick, length, turn_deg):
        self.solid('cylinder {<0,%.4f,%.4f>, <0,%.4f,%.4f>, %.4f Wood(%.2f)}'
                   % (.46 * thick, -length / 2, .46 * thick, length / 2, thick / 2,
                      self.between(.7, 1.2)), ahead, right, turn_deg)
        self.note('log', ahead, right, .96 * thick, thick / 2, length, turn_deg)

    def box(self, ahead, right, along, across, height, turn_deg, texture='Block(1)', kind='box'):
        self.solid('box {<%.4f,-.3,%.4f>, <%.4f,%.4f,%.4f> %s}'
                   % (-across / 2, -along / 2, across / 2, height, along / 2, texture),
                   ahead, right, turn_deg)
        self.note(kind, ahead, right, height, across / 2, along, turn_deg)

    def kerb(self, ahead, right, height, turn_deg, wide=0.15):
        self.box(ahead, right, 60, wide, height, turn_deg, 'Kerb(1)', 'kerb')

    def shade(self, ahead, right, along, across, height):
        """A block out of view; its shadow is in view."""
        self.box(ahead, right, along, across, height, 0, 'Block(.8)', 'block out of view')

    def pallet(self, ahead, right, turn_deg):
        parts = ['box {<%.3f,.1,-.6>, <%.3f,.144,.6>}' % (x - .05, x + .05)
                 for x in (-.35, -.175, 0, .175, .35)]
        parts += ['box {<-.4,0,%.3f>, <.4,.1,%.3f>}' % (z - .05, z + .05) for z in (-.55, 0, .55)]
        self.solid('union {%s Wood(1.2)}' % ' '.join(parts), ahead, right, turn_deg)
        self.note('pallet', ahead, right, .144, .4, 1.2, turn_deg)

    def vehicle(self, ahead, right, turn_deg):
        wheels = ' '.join('cylinder {<%.2f,.3,%.2f>, <%.2f,.3,%.2f>, .3}' % (x, z, x + .2, z)
                          for x in (-.9, .7) for z in (-1.3, 1.3))
        self.solid('union {box {<-.9,.25,-2.1>, <.9,.85,2.1>} box {<-.8,.85,-1.2>, <.8,1.45,1>} '
                   '%s Lacquer(%.2f)}' % (wheels, self.between(.4, 1.3)), ahead, right, turn_deg)
        self.note('vehicle', ahead, right, 1.45, .9, 4.2, turn_deg)

    def bush(self, ahead, right, radius, height):
        leaves = []
        while len(leaves) < 260 * (radius / .4) ** 2:
            x, y, z = self.between(-1, 1), self.between(0, 1), self.between(-1, 1)
            if .35 < x * x + y * y + z * z < 1:
                size = self.between(.03, .06)
                leaves.append('sphere {0, 1 scale <%.3f,%.3f,%.3f> rotate <%.0f,%.0f,%.0f> '
                              'translate <%.3f,%.3f,%.3f> Leaf(%.2f)}'
                              % (size, .25 * size, .6 * size, self.between(-50, 50),
                                 self.between(0, 180), self.between(-50, 50),
                                 x * radius, y * height, z * radius, self.between(.5, 1.9)))
        self.solid('union {%s}' % '\n'.join(leaves), ahead, right)
        self.note('bush', ahead, right, height, radius)

    def hole(self, ahead, right, radius, depth):
        """Round, with upright walls."""
        self.hollows.append('cylinder {%s, %s, %.4f}' % (
            self.at(ahead, right, -depth), self.at(ahead, right, .5), radius))
        self.note('hole', ahead, right, -depth, radius)

    def ditch(self, ahead, right, wide, depth, turn_deg):
        self.hollows.append('box {<%.3f,%.3f,-30>, <%.3f,1,30> rotate y*%.3f translate %s}'
                            % (-wide / 2, -depth, wide / 2, turn_deg, self.at(ahead, right)))
        self.note('ditch', ahead, right, -depth, wide / 2, 60, turn_deg)

    def step(self, ahead, right, height, turn_deg):
        """All ground to the right of a line is higher."""
        self.solid('box {<0,-.3,-40>, <40,%.4f,40> Ground(1)}' % height, ahead, right, turn_deg)
        self.note('step', ahead, right, height, 0, 80, turn_deg)

    def bank(self, ahead, right, rise_deg, turn_deg):
        """All ground to the right of a line rises."""
        self.solid('box {<0,-8,-40>, <40,0,40> Ground(1) rotate z*%.3f}' % rise_deg,
                   ahead, right, turn_deg)
        self.note('bank of %.0f degrees' % rise_deg, ahead, right, 0, 0, 80, turn_deg)

    def line(self, ahead, right, wide, length, turn_deg):
        """Paint, 2 mm thick."""
        self.solid('box {<%.3f,-.05,%.3f>, <%.3f,.002,%.3f> White(1)}'
                   % (-wide / 2, -length / 2, wide / 2, length / 2), ahead, right, turn_deg)
        self.note('painted line', ahead, right, .002, wide / 2, length, turn_deg)

    def patch(self, ahead, right, across, along, turn_deg):
        """A dark ellipse on the ground, 1 mm thick; half axes."""
        self.solid('cylinder {<0,-.05,0>, <0,.001,0>, 1 scale <%.3f,1,%.3f> Dark(1)}'
                   % (across, along), ahead, right, turn_deg)
        self.note('dark patch', ahead, right, .001, max(across, along))

    # The hover and the files.

    def poses(self, pairs):
        """Of each pair: time, place (W) and attitude of the left camera, and its axes in W."""
        chance, turn = self.random('hover'), math.radians(self.heading_deg)
        tilt = math.radians(self.tilt_deg)
        camera_in_body = [[0, math.sin(tilt), math.cos(tilt)], [1, 0, 0],
                          [0, math.cos(tilt), -math.sin(tilt)]]
        phases = [chance.uniform(0, 2 * math.pi) for _ in range(6)]
        poses = []
        for i in range(pairs):
            time = .1 * i

            def sway(axis, size, hertz):
                return size * math.sin(2 * math.pi * hertz * time + phases[axis])
            ahead = self.travel_m * (i / max(1, pairs - 1) - .5) + sway(0, self.sway_m, .5)
            right = sway(1, self.sway_m, .41)
            place = [ahead * math.cos(turn) - right * math.sin(turn),
                     ahead * math.sin(turn) + right * math.cos(turn),
                     -self.height_m + sway(2, self.sway_m / 2, .45)]
            attitude = [sway(3, 1, .6), sway(4, 1, .7), self.heading_deg + sway(5, 1, .37)]
            # The pictures are drawn from the pose as the file tells it.
            place, attitude = ([round(v, 6) for v in values] for values in (place, attitude))
            camera_in_world = product(body_in_world(*attitude), camera_in_body)
            axes = [[row[k] for row in camera_in_world] for k in range(3)]
            poses.append({'time_s': time, 'place': place, 'attitude_deg': attitude,
                          'right': axes[0], 'down': axes[1], 'forward': axes[2]})
        return poses

    def truth_side_px(self):
        """Side of the square about the middle of the view that the height picture shows."""
        tilt, across = math.radians(-self.tilt_deg), WIDTH_PX / 2 / self.fx_px
        reach = 0.0
        for up in (-HEIGHT_PX / 2 / self.fx_px, HEIGHT_PX / 2 / self.fx_px):
            ahead = math.cos(tilt) + up * math.sin(tilt)
            down = math.sin(tilt) - up * math.cos(tilt)
            scale = FARTHEST_M / math.hypot(ahead, across)
            if down > 0:
                scale = min(scale, self.height_m / down)
            reach = max(reach, abs(scale * ahead - math.hypot(*self.middle)), scale * across)
        half = min(WIDEST_M, reach + BEYOND_VIEW_M)
        return 2 * math.ceil(half / TRUTH_PIXEL_M)

    def truth_side_m(self):
        return self.truth_side_px() * TRUTH_PIXEL_M

    def pov_file(self, poses):
        side = self.truth_side_m()
        north, east = self.middle
        far = side + 60
        level = -self.slope[0] * north - self.slope[1] * east
        ground = ('box {<%.3f,-6,%.3f>, <%.3f,0,%.3f> '
                  'matrix <1,%.6f,0, 0,1,0, 0,%.6f,1, 0,%.6f,0>}'
                  % (east - far, north - far, east + far, north + far,
                     self.slope[1], self.slope[0], level))
        cameras = []
        for i, pose in enumerate(poses):
            for k in (0, 1):
                eye = [p + k * self.baseline_m * r for p, r in zip(pose['place'], pose['right'])]
                cameras.append(
                    '#case (%d) camera {perspective location %s direction %s*%.9f '
                    'right %s*%d up %s*%d} #break'
                    % (2 * i + k + 1, pov_down(eye), pov_down(pose['forward']), self.fx_px,
                       pov_down(pose['right']), WIDTH_PX,
                       pov_down([-v for v in pose['down']]), HEIGHT_PX))
        above, turn = (math.radians(a) for a in self.sun_deg)
        sun = pov(1e4 * math.cos(above) * math.cos(turn), 1e4 * math.cos(above) * math.sin(turn),
                  1e4 * math.sin(above))
        textures = ['texture {pigment {%s} Matt(0)}' % p for p in MATERIALS[self.material]]
        return POV_FILE.substitute(
            ground_textures='\n    '.join(textures),
            ground='difference {%s %s Ground(1)}' % (ground, '\n  '.join(self.hollows))
            if self.hollows else 'object {%s Ground(1)}' % ground,
            things='\n  '.join(self.solids), reach=TRUTH_REACH_M, slope_north=self.slope[0],
            slope_east=self.slope[1], up='%.6f' % level, north='%.4f' % north,
            east='%.4f' % east, side='%.4f' % side, sun=sun, cameras='\n    '.join(cameras))

    def write(self, folder, pairs, meant):
        """scene.pov, POSES.csv and RIG.toml, and scene.json with what the judge must know."""
        poses = self.poses(pairs)
        (folder / 'scene.pov').write_text(self.pov_file(poses))
        rows = ['file,time,north,east,down,roll,pitch,heading']
        for i, pose in enumerate(poses):
            rows.append('L%02d,%.3f,' % (i, pose['time_s'])
                        + ','.join('%.6f' % v for v in pose['place'] + pose['attitude_deg']))
        (folder / 'POSES.csv').write_text('\n'.join(rows) + '\n')
        lens = ('width = %d\nheight = %d\nfx_px = %.9f\nfy_px = %.9f\ncx_px = %.1f\ncy_px = %.1f\n'
                % (WIDTH_PX, HEIGHT_PX, self.fx_px, self.fx_px, (WIDTH_PX - 1) / 2,
                   (HEIGHT_PX - 1) / 2))
        (folder / 'RIG.toml').write_text(
            '[left]\n%s\n[right]\n%s\n[rig]\nbaseline_m = %.4f\nrectified = true\n\n'
            '[mount]\nposition_body_m = [0.0, 0.0, 0.0]\ntilt_deg = %.4f\n'
            % (lens, lens, self.baseline_m, self.tilt_deg))
        (folder / 'scene.json').write_text(json.dumps({
            'name': self.name, 'seed': self.seed, 'meant': meant, 'middle': self.middle,
            'slope': self.slope, 'truth_pixel_m': TRUTH_PIXEL_M,
            'reach_m': TRUTH_REACH_M, 'pairs': pairs, 'width_px': WIDTH_PX,
            'height_px': HEIGHT_PX, 'fx_px': self.fx_px,
            'baseline_m': self.baseline_m, 'pose': poses[pairs // 2], 'things': self.things},
            indent=1) + '\n')


def pov_down(vector):
    """The same of a vector (north, east, down), as a pose has them."""
    return pov(vector[0], vector[1], -vector[2])
