#!/usr/bin/env python3
"""Which lines and branches of each layer have run in a build with NOVELVIEW_COVERAGE.

usage: tests/coverage.py BUILD. Prints a table, and writes BUILD/coverage/index.html with every line.
Branches that only exceptions of the standard library take are not counted.
"""

import json
import os
import pathlib
import subprocess
import sys

SOURCE = pathlib.Path(__file__).resolve().parent.parent
LAYERS = ["vtkfilters/kernels", "vtkfilters", "pipeline", "app"]
COUNTS = ["line_covered", "line_total", "branch_covered", "branch_total"]


def measure(build):
    """What gcovr counts in each source file."""
    page = build / "coverage" / "index.html"
    summary = build / "coverage" / "summary.json"
    page.parent.mkdir(exist_ok=True)
    subprocess.run(
        ["gcovr", "--root", SOURCE, "--object-directory", build, build, "-j", str(os.cpu_count())]
        + [f"--filter={SOURCE}/{folder}/" for folder in ("vtkfilters", "pipeline", "app")]
        + ["--exclude-throw-branches", "--exclude-unreachable-branches"]
        + ["--json-summary", summary, "--html-details", page],
        check=True,
    )
    return page, json.loads(summary.read_text(encoding="utf-8"))["files"]


def percent(covered, total):
    return f"{100 * covered / total:.1f} %" if total else "-"


def main():
    page, files = measure(pathlib.Path(sys.argv[1]).resolve())
    sums = {layer: dict.fromkeys(COUNTS, 0) for layer in LAYERS + ["all"]}
    for file in files:
        layer = next(layer for layer in LAYERS if file["filename"].startswith(layer + "/"))
        for name in COUNTS:
            sums[layer][name] += file[name]
            sums["all"][name] += file[name]
    print(f"{'layer':20}{'lines':>8}{'run':>10}{'branches':>10}{'run':>10}")
    for layer, counts in sums.items():
        lines, branches = counts["line_total"], counts["branch_total"]
        print(
            f"{layer:20}{lines:8}{percent(counts['line_covered'], lines):>10}"
            f"{branches:10}{percent(counts['branch_covered'], branches):>10}"
        )
    print(f"every line: {page}")
    print(f"coverage: {percent(sums['all']['line_covered'], sums['all']['line_total'])} of the lines")


if __name__ == "__main__":
    main()
