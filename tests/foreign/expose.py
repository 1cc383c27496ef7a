#!/usr/bin/env python3
"""expose.py FOLDER: a camera's pictures L00.png, R00.png, ... of what POV-Ray drew.

POV-Ray leaves drawn/f01.ppm, f02.ppm, ... (left, right, left, ...), grey, 16 bit, linear in light,
twice as wide and high. A pixel is the mean of its four, blurred by a Gaussian of 0.35 pixels, in
the 256 levels of sRGB, with noise of 2 levels (1 sigma) that no two pictures share.
"""
import array
import json
import pathlib
import random
import struct
import sys
import zlib

NOISE = 2.0
BESIDE = 0.061  # of a blur [BESIDE, 1 - 2 BESIDE, BESIDE], whose variance is 0.35^2


def read_grey(path):
    """(width, height, pixels) of a grey PPM of 16 bits, as POV-Ray writes it."""
    data = path.read_bytes()
    words, at = [], 0
    while len(words) < 4:
        if data[at:at + 1] == b'#':
            at = data.index(b'\n', at) + 1
        elif data[at:at + 1].isspace():
            at += 1
        else:
            end = at
            while not data[end:end + 1].isspace():
                end += 1
            words.append(data[at:end])
            at = end
    width, height = int(words[1]), int(words[2])
    pixels = array.array('H', data[at + 1:])
    if words[0] != b'P5' or words[3] != b'65535' or len(pixels) != width * height:
        raise ValueError('%s is no grey picture of 16 bits' % path)
    if sys.byteorder == 'little':
        pixels.byteswap()
    return width, height, pixels


def srgb(light):
    """0 to 255 of light from 0 to 1."""
    return 255 * (12.92 * light if light < .0031308 else 1.055 * light ** (1 / 2.4) - .055)


def halved(width, height, pixels):
    """Rows of the means of each two by two."""
    rows = []
    for top in range(0, height, 2):
        one = pixels[top * width:(top + 1) * width]
        two = pixels[(top + 1) * width:(top + 2) * width]
        rows.append([(a + b + c + d) >> 2
                     for a, b, c, d in zip(one[::2], one[1::2], two[::2], two[1::2])])
    return rows


def blurred(rows):
    """Each row along itself, then each with its neighbours; the rim is repeated."""
    middle = 1 - 2 * BESIDE
    rows = [[BESIDE * (a + c) + middle * b
             for a, b, c in zip(row[:1] + row[:-1], row, row[1:] + row[-1:])] for row in rows]
    return [[BESIDE * (a + c) + middle * b for a, b, c in zip(above, row, below)]
            for above, row, below in zip(rows[:1] + rows[:-1], rows, rows[1:] + rows[-1:])]


def write_png(path, rows):
    """8 bit grey."""
    def chunk(kind, data):
        return (struct.pack('>I', len(data)) + kind + data
                + struct.pack('>I', zlib.crc32(kind + data)))
    head = struct.pack('>IIBBBBB', len(rows[0]), len(rows), 8, 0, 0, 0, 0)
    path.write_bytes(b'\x89PNG\r\n\x1a\n' + chunk(b'IHDR', head)
                     + chunk(b'IDAT', zlib.compress(b''.join(b'\0' + row for row in rows), 1))
                     + chunk(b'IEND', b''))


def main():
    folder = pathlib.Path(sys.argv[1])
    scene = json.loads((folder / 'scene.json').read_text())
    drawn = sorted((folder / 'drawn').glob('f*.ppm'))
    if len(drawn) != 2 * scene['pairs']:
        sys.exit('foreign: %s holds %d pictures, not %d'
                 % (folder, len(drawn), 2 * scene['pairs']))
    level = [srgb(v / 65535) for v in range(65536)]
    for i, path in enumerate(drawn):
        noise = random.Random('%s/%s/%d' % (scene['name'], scene['seed'], i)).gauss
        rows = [bytes([min(255, max(0, int(level[int(light)] + noise(0, NOISE) + .5)))
                       for light in row]) for row in blurred(halved(*read_grey(path)))]
        write_png(folder / ('%s%02d.png' % ('LR'[i % 2], i // 2)), rows)


if __name__ == '__main__':
    main()
