#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""How steady a film is from frame to frame: steadiness.py FRAMES TRUTH

Both are folders with pictures and mask/ of the same cameras, in the order of their names; steps
should be so small that the object moves by less than a pixel. Flicker is what changes to and fro:
the second difference over time, p(t+1) - 2 p(t) + p(t-1), of every pixel, in grey levels, root mean
square over the object. What moves evenly has little of it, and what it has the truth has as well, so
the truth's is given beside. Prints JSON: "all", "inside" (3 px and more from the contour), "rim"
(the rest), each film and truth; "area" the same of the number of object pixels; "rms" the film's
error.
"""
import glob
import json
import os
import sys

import cv2
import numpy


def load(folder):
    """Pictures (n x h x w x 3) and masks (n x h x w, bool) of a folder."""
    files = sorted(glob.glob(os.path.join(folder, "*.png")))
    pictures = [cv2.imread(f).astype(numpy.float32) for f in files]
    masks = [cv2.imread(os.path.join(folder, "mask", os.path.basename(f)), 0) for f in files]
    return numpy.stack(pictures), numpy.stack(masks)


def second_difference(values):
    return values[2:] - 2 * values[1:-1] + values[:-2]


def rms(values):
    return float(numpy.sqrt(numpy.mean(numpy.square(values, dtype=numpy.float64))))


def main():
    film, film_mask = load(sys.argv[1])
    truth, truth_mask = load(sys.argv[2])
    truth[truth_mask == 0] = 0  # a film is before black
    film_object = film_mask > 127
    truth_object = truth_mask > 127
    square = numpy.ones((7, 7), numpy.uint8)
    inside = numpy.stack([cv2.erode(m.astype(numpy.uint8), square) > 0 for m in truth_object])[1:-1]
    either = (film_object | truth_object)[1:-1]
    film_changes = second_difference(film)
    truth_changes = second_difference(truth)
    result = {}
    for name, where in (("all", either), ("inside", inside), ("rim", either & ~inside)):
        result[name] = {"film": rms(film_changes[where]), "truth": rms(truth_changes[where])}
    result["area"] = {
        "film": rms(second_difference(film_object.sum((1, 2)).astype(float))),
        "truth": rms(second_difference(truth_object.sum((1, 2)).astype(float))),
    }
    result["rms"] = rms((film - truth)[1:-1][either])
    print(json.dumps(result))


if __name__ == "__main__":
    main()
