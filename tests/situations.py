#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Acts out what people's folders are like, and prints what the program says as a table.

usage: situations.py PROGRAM [WORD ...]   only the situations whose names contain a WORD
Ends with 1 when the program does something else than the list below expects.
"""
import os
import shutil
import subprocess
import sys
import tempfile

import cv2
import numpy

PROGRAM = sys.argv[1]
SIZE = "320x240"
SITUATIONS = []


def situation(name, expect, code=0, command=("check", "{data}", "--quiet"), start="middlebury"):
    """A function that changes a data set; the exit code and a text that the program then gives."""
    def add(change):
        SITUATIONS.append((name, change, start, [word for word in command], code, expect))
        return change
    return add


def run(*words):
    done = subprocess.run([PROGRAM, *words], capture_output=True, text=True, check=False)
    return done.returncode, done.stdout + done.stderr


def photographs(data):
    for folder in (data + "/images", data + "/image", data):
        names = sorted(n for n in os.listdir(folder) if n.startswith("bunny") and "." in n
                       and not n.endswith(".txt")) if os.path.isdir(folder) else []
        if names:
            return [folder + "/" + name for name in names]
    return []


def rewrite(data, change):
    """Passes every photograph through a function."""
    for file in photographs(data):
        cv2.imwrite(file, change(cv2.imread(file, cv2.IMREAD_UNCHANGED)))


def masks_to(data, place, name):
    os.makedirs(data + "/" + place, exist_ok=True)
    for file in sorted(os.listdir(data + "/mask")):
        mask = cv2.imread(data + "/mask/" + file, 0)
        cv2.imwrite(data + "/" + place + "/" + name(file), mask)
    if place != "mask":
        shutil.rmtree(data + "/mask")


def edit_masks(data, change):
    for file in sorted(os.listdir(data + "/mask")):
        mask = cv2.imread(data + "/mask/" + file, 0)
        cv2.imwrite(data + "/mask/" + file, change(mask))


def to_jpeg(data, quality, background):
    """Cut-outs as JPEG, without masks."""
    for file in photographs(data):
        picture = cv2.imread(file)
        picture[cv2.imread(data + "/mask/" + os.path.basename(file), 0) < 128] = background
        cv2.imwrite(file[:-4] + ".jpg", picture, [cv2.IMWRITE_JPEG_QUALITY, quality])
        os.remove(file)
    shutil.rmtree(data + "/mask")
    par = data + "/bunny_par.txt"
    text = open(par, encoding="utf-8").read().replace(".png", ".jpg")
    open(par, "w", encoding="utf-8").write(text)


@situation("as it is", "")
def _(data):
    pass


for quality_, background_ in ((75, 0), (90, 0), (75, 30), (75, 255)):
    @situation(f"cut-outs as JPEG {quality_} on grey {background_}, no masks", "")
    def _(data, quality=quality_, background=background_):
        to_jpeg(data, quality, background)


@situation("masks of 0 and 1", "")
def _(data):
    edit_masks(data, lambda mask: mask // 255)


@situation("red masks on black", "")
def _(data):
    edit_masks(data, lambda mask: cv2.merge([0 * mask, 0 * mask, mask]))


@situation("white masks with alpha", "")
def _(data):
    edit_masks(data, lambda mask: cv2.merge([0 * mask + 255] * 3 + [mask]))


@situation("masks of 0 and 38", "a largest value of 38", 3)
def _(data):
    edit_masks(data, lambda mask: mask // 255 * 38)


for place_, ending_ in (("mask", ".pgm"), ("Masks", ".png"), ("segmentation", ".bmp"),
                        ("mask/images", ".png"), ("masks", ".png.mask.png"),
                        ("masks", ".png_mask.png"), ("masks", "_mask.tif")):
    @situation(f"masks in {place_}/ as NAME{ending_}", "")
    def _(data, place=place_, ending=ending_):
        os.rename(data + "/mask", data + "/mask0")
        os.makedirs(data + "/" + place)
        for file in sorted(os.listdir(data + "/mask0")):
            cv2.imwrite(data + "/" + place + "/" + file[:-4] + ending,
                        cv2.imread(data + "/mask0/" + file, 0))
        shutil.rmtree(data + "/mask0")


@situation("masks in object_masks/", "not read: object_masks", 3)
def _(data):
    masks_to(data, "object_masks", lambda name: name)


@situation("masks of other names", "no photograph's masks by their names", 3)
def _(data):
    masks_to(data, "masks", lambda name: "m" + name)


@situation("EXIF tag 3 on photographs as calibrated", "")
def _(data):
    tag(data, 3)


@situation("EXIF tag 6 on photographs as calibrated", "")
def _(data):
    tag(data, 6)


@situation("12 bits in PNG of 16", "the largest is", 3)
def _(data):
    rewrite(data, lambda picture: picture.astype(numpy.uint16) * 16)


@situation("photographs called .PNG", "")
def _(data):
    for file in photographs(data):
        os.rename(file, file[:-4] + ".PNG")


@situation("paths of Windows", "", start="colmap")
def _(data):
    edit(data + "/sparse/0/images.txt", lambda text: text.replace(" bunny", " C:\\x\\bunny"))


@situation("calibration with byte-order mark", "")
def _(data):
    edit(data + "/bunny_par.txt", lambda text: "\ufeff" + text)


@situation("COLMAP, sparse/0 with 3 of 8 images", "", start="colmap")
def _(data):
    shutil.copytree(data + "/sparse/0", data + "/sparse/1")
    lines = open(data + "/sparse/0/images.txt", encoding="utf-8").read().splitlines()
    keep = [line for line in lines if line.startswith("#")]
    data_lines = [line for line in lines if not line.startswith("#")][:6]
    edit(data + "/sparse/0/images.txt", lambda text: "\n".join(keep + data_lines) + "\n")


@situation("between photographs of other shapes", "another shape", 1,
           command=("run", "{data}", "--quiet", "--view", "between:0,1", "--out", "{out}"))
def _(data):
    crop(data, 1)


for format_ in ("neus", "mvsnet"):
    @situation(f"calibration of {format_}", "", start=format_)
    def _(data):
        pass


for name_, text_, expect_ in (("cameras.sfm", "{}", "aliceVision_exportColmap"),
                              ("sfm_data.json", "{}", "openMVG_main_openMVG2Colmap"),
                              ("bundle.out", "# Bundle file v0.3", "Bundler"),
                              ("cameras.xml", "<document><chunk>", "Metashape"),
                              ("IMG_0001.HEIC", "", "heif-convert"),
                              ("video.mp4", "", "ffmpeg")):
    @situation(f"{name_} instead of a calibration", expect_, 1)
    def _(data, name=name_, text=text_):
        os.remove(data + "/bunny_par.txt")
        edit(data + "/" + name, lambda _: text)


@situation("a file instead of the folder", "is a file, not the folder", 1,
           command=("check", "{data}/bunny_par.txt", "--quiet"))
def _(data):
    pass


@situation("--exclude with the folder's name", "", start="colmap",
           command=("check", "{data}", "--quiet", "--exclude", "images/bunny0003.png"))
def _(data):
    pass


def edit(file, change):
    text = open(file, encoding="utf-8").read() if os.path.exists(file) else ""
    open(file, "w", encoding="utf-8", newline="").write(change(text))


def tag(data, orientation):
    """JPEG bytes with an orientation tag under the photographs' names."""
    exif = (b"Exif\0\0MM\0*\0\0\0\x08\0\1\1\x12\0\3\0\0\0\1\0" + bytes([orientation]) +
            b"\0\0\0\0\0\0")
    for file in photographs(data):
        jpeg = cv2.imencode(".jpg", cv2.imread(file), [cv2.IMWRITE_JPEG_QUALITY, 95])[1].tobytes()
        with open(file, "wb") as out:
            out.write(jpeg[:2] + b"\xff\xe1" + (len(exif) + 2).to_bytes(2, "big") + exif +
                      jpeg[2:])


def crop(data, number):
    file = photographs(data)[number]
    picture = cv2.imread(file)
    cv2.imwrite(file, picture[:-20])
    mask = data + "/mask/" + os.path.basename(file)
    cv2.imwrite(mask, cv2.imread(mask, 0)[:-20])


def main():
    wrong = []
    with tempfile.TemporaryDirectory() as work:
        starts = {"middlebury": work + "/middlebury"}
        run("generate", "--out", starts["middlebury"], "--size", SIZE, "--views", "8", "--step",
            "45", "--texture", "wood")
        for other in ("colmap", "neus", "mvsnet"):
            starts[other] = work + "/" + other
            run("convert", starts["middlebury"], starts[other], "--format", other)
        print("| input | what happens | exit code |\n|---|---|---|")
        for name, change, start, command, code, expect in SITUATIONS:
            if sys.argv[2:] and not any(word in name for word in sys.argv[2:]):
                continue
            data = work + "/data"
            shutil.copytree(starts[start], data)
            change(data)
            got, text = run(*[word.format(data=data, out=work + "/out") for word in command])
            lines = [line.replace(data + "/", "").replace(data, "photos") for line
                     in text.strip().splitlines()] or ["read, nothing to say"]
            more = f" (and {len(lines) - 1} more)" if len(lines) > 1 else ""
            print(f"| {name} | {lines[0]}{more} | {got} |", flush=True)
            if got != code or expect not in text:
                wrong.append(f"{name}: got {got}, expected {code} and '{expect}'")
            shutil.rmtree(data)
            shutil.rmtree(work + "/out", ignore_errors=True)
    print("\n".join(wrong), file=sys.stderr)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
