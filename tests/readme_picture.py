# SPDX-License-Identifier: GPL-3.0-or-later
"""Composes data/readme.png, the picture of README.md, from what app/demo.sh writes.

usage: /usr/bin/python3 tests/readme_picture.py [OUT [PNG]]    (OUT: the folder of app/demo.sh, default out/)
"""

import pathlib
import sys

import cv2
import numpy

BAND = (24, 22, 23)  # of captions and gaps, BGR
WIDTH, GAP, CAPTION = 1200, 6, 34
SHOWN = 0.86  # part of the height of an image


def tile(path, width, height):
    """The middle of an image, scaled to fill the size."""
    image = cv2.imread(str(path), cv2.IMREAD_COLOR)
    if image is None:
        sys.exit(f"readme_picture.py: {path}: not an image; run app/demo.sh first")
    rows, columns = image.shape[:2]
    y = round(rows * (1 - SHOWN) / 2)
    x = (columns - round((rows - 2 * y) * width / height)) // 2
    middle = image[y:rows - y, x:columns - x]
    return cv2.resize(middle, (width, height), interpolation=cv2.INTER_AREA)


def row(paths, height):
    """Images side by side."""
    width = (WIDTH - GAP * (len(paths) - 1)) // len(paths)
    band = numpy.full((height, WIDTH, 3), BAND, numpy.uint8)
    for i, path in enumerate(paths):
        x = i * (width + GAP)
        band[:, x:x + width] = tile(path, width, height)
    return band


def captions(texts):
    """A band with centred texts, one below each image."""
    band = numpy.full((CAPTION, WIDTH, 3), BAND, numpy.uint8)
    font, scale = cv2.FONT_HERSHEY_SIMPLEX, 0.65
    column = WIDTH / len(texts)
    for i, text in enumerate(texts):
        (width, height), _ = cv2.getTextSize(text, font, scale, 1)
        at = round((i + 0.5) * column - width / 2), (CAPTION + height) // 2
        cv2.putText(band, text, at, font, scale, (224, 224, 224), 1, cv2.LINE_AA)
    return band


def main():
    top = pathlib.Path(__file__).resolve().parent.parent
    out = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else top / "out"
    png = sys.argv[2] if len(sys.argv) > 2 else str(top / "data/readme.png")
    photographs = [out / f"bunny/bunny{i % 12:04}.png" for i in range(10, 16)]
    stages = out / "novel/stages"
    views = [stages / "hull.png", out / "novel/novel.png", out / "bunny/test/test0000.png"]
    picture = numpy.vstack([
        row(photographs, 162), captions(["six of twelve photographs, 30 degrees apart"]),
        row(views, 330),
        captions(["novel view: visual hull", "novel view: result", "truth (held out)"]),
    ])
    cv2.imwrite(png, picture, [cv2.IMWRITE_PNG_COMPRESSION, 9])


if __name__ == "__main__":
    main()
