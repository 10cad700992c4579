# SPDX-License-Identifier: GPL-3.0-or-later
import sys
import numpy
import novelview

views = novelview.read(sys.argv[1])  # or novelview.views([...]) from arrays
camera = novelview.between(views, 0, 1)  # half-way between the first two
picture = novelview.synthesise(views, camera, preset="best")
pixels = novelview.image(picture, "Color")  # height x width x 3, uint8, RGB
depth = novelview.image(picture, "Depth")  # world units, 0 = no object
numpy.savez(sys.argv[2], pixels=pixels, depth=depth)
