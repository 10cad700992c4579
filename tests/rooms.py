#!/usr/bin/env python3
"""Checks where the source files lie and what they include.

The layers are vtkfilters/kernels, vtkfilters, pipeline and app; a layer may use those before it.
pipeline/ and kernels/ are divided into rooms, which are folders. The README.md of a room has a line
"May use: `a`, `b`." that names the other rooms of its layer. The test fails when a file lies outside
a room, when a file includes what its room may not use, when the rooms use each other in a circle, when
a room may use what it does not, when an include does not name its room, or when the README of a room
does not name one of its files.
"""

import pathlib
import re
import sys

SOURCE = pathlib.Path(__file__).resolve().parent.parent
LAYERS = ["vtkfilters/kernels", "vtkfilters", "pipeline", "app"]
ROOMY = ["vtkfilters/kernels", "pipeline"]
NO_ROOMS = {"python"}  # files in Python
SUFFIXES = {".h", ".cxx", ".in"}


def includes(path):
    for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
        found = re.match(r'\s*#\s*include\s*"([^"]+)"', line)
        if found:
            yield number, found.group(1)


def sources(folder):
    return sorted(path for path in folder.rglob("*") if path.suffix in SUFFIXES)


def layer_of(path):
    """The innermost layer of a file."""
    name = path.relative_to(SOURCE).as_posix()
    return max((layer for layer in LAYERS if name.startswith(layer + "/")), key=len)


def allowed(readme):
    """The rooms that a room may use."""
    found = re.search(r"^May use: (nothing|(?:`\w+`(?:, )?)+)\.$", readme.read_text(encoding="utf-8"), re.M)
    if not found:
        raise SystemExit(f"{readme.relative_to(SOURCE)}: has no line 'May use: `a`, `b`.'")
    return set(re.findall(r"`(\w+)`", found.group(1)))


def find(name):
    """The file that an include names, and its layer; None for one of another library."""
    for layer in LAYERS:
        path = SOURCE / layer / name
        if path.is_file():
            return path
    if name == "report/ReportTemplate.h":  # generated
        return SOURCE / "pipeline/report/ReportTemplate.h.in"
    if name == "live/LivePage.h":  # generated
        return SOURCE / "pipeline/live/LivePage.h.in"
    return None


def check_readme(room, problems):
    """A file is named with or without its extension; XOptions and XCommand go by the names of commands."""
    readme = (room / "README.md").read_text(encoding="utf-8")
    for stem in sorted({path.name.split(".")[0] for path in sources(room)}):
        pattern = re.fullmatch(r"[A-Z][a-z]+(Options|Command)", stem) and room.name == "commands"
        name = re.sub(r"^[A-Z][a-z]+", "X", stem) if pattern else stem
        if not re.search(r"\b" + re.escape(name) + r"\b", readme):
            problems.append(f"{room.relative_to(SOURCE)}/README.md: does not name {stem}")


def check_rooms(layer, problems):
    root = SOURCE / layer
    rooms = {path.name for path in root.iterdir() if path.is_dir()} - NO_ROOMS
    may_use = {room: allowed(root / room / "README.md") for room in rooms}
    uses = {room: set() for room in rooms}
    for room in sorted(rooms):
        check_readme(root / room, problems)
    for path in sources(root):
        where = path.relative_to(SOURCE)
        room = path.relative_to(root).parts[0]
        if room not in rooms:
            problems.append(f"{where}: lies outside a room")
            continue
        for number, name in includes(path):
            target = find(name)
            if target is None or layer_of(target) != layer:
                continue
            other = target.relative_to(root).parts[0]
            if other == room:
                continue
            uses[room].add(other)
            if other not in may_use[room]:
                problems.append(f"{where}:{number}: {layer}/{room} may not use {other} ({name})")
    for room in sorted(rooms):
        for other in sorted(may_use[room] - rooms):
            problems.append(f"{layer}/{room}/README.md: there is no room {other}")
        for other in sorted(may_use[room] & rooms - uses[room]):
            problems.append(f"{layer}/{room}/README.md: {other} is not used")
    check_circles(layer, uses, problems)


def check_circles(layer, uses, problems):
    done = set()

    def visit(room, path):
        if room in path:
            problems.append(f"{layer}: rooms in a circle: {' -> '.join(path[path.index(room):] + [room])}")
        elif room not in done:
            for other in sorted(uses[room]):
                visit(other, path + [room])
            done.add(room)

    for room in sorted(uses):
        visit(room, [])


def check_layers(problems):
    for layer in LAYERS:
        for path in sources(SOURCE / layer):
            if layer_of(path) != layer:
                continue
            where = path.relative_to(SOURCE)
            for number, name in includes(path):
                target = find(name)
                if target is None and not name.startswith("vtk"):
                    problems.append(f"{where}:{number}: {name} names no file by its room")
                elif target and LAYERS.index(layer_of(target)) > LAYERS.index(layer):
                    problems.append(f"{where}:{number}: {layer} may not use {layer_of(target)} ({name})")
            if layer == "vtkfilters/kernels":
                text = path.read_text(encoding="utf-8")
                for found in re.finditer(r"#include <((?:vtk|opencv2/)[^>]*)>", text):
                    problems.append(f"{where}: kernels use neither VTK nor OpenCV ({found.group(1)})")


def main():
    problems = []
    for layer in ROOMY:
        check_rooms(layer, problems)
    check_layers(problems)
    print("\n".join(problems) or "every file is in a room and uses what its room may use")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
