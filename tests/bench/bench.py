#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Measures what NovelView costs and prints the tables as Markdown.

Run by tests/bench/bench.sh, which says more.
"""
import argparse
import json
import os
import platform
import statistics
import subprocess
import sys

import growth
import tables
from runs import Bench, DataSet, further_view, note, typical_run, whole_runs

PARTS = ["kernels", "runs", "growth"]
SMALL, MIDDLE, LARGE = (DataSet(12, 640, 480, 9), DataSet(24, 1600, 1200, 3),
                        DataSet(49, 1600, 1200, 3))
DATA_SETS = {"small": SMALL, "middle": MIDDLE, "large": LARGE}
QUICK = [DataSet(12, 320, 240, 3), DataSet(12, 640, 480, 3)]
# In a quick run only what needs no depth maps and few samples.
QUICK_KERNELS = ("visual_hull|silhouettes|culling|texture/paper|contour|photographs/|rasteriser|"
                 "power_crust/samples:35000")


def arguments():
    parser = argparse.ArgumentParser(prog="tests/bench/bench.sh", description=__doc__)
    parser.add_argument("--program", required=True, help=argparse.SUPPRESS)
    parser.add_argument("--kernels", required=True, help=argparse.SUPPRESS)
    parser.add_argument("--out", required=True, help="folder for data sets and results")
    parser.add_argument("--quick", action="store_true", help="small sizes, one repetition")
    parser.add_argument("--parts", default=",".join(PARTS),
                        help="which of kernels, runs, growth (default: all)")
    parser.add_argument("--data", default=",".join(DATA_SETS),
                        help="which data sets of the whole runs (default: all)")
    parser.add_argument("--presets", default="best,paper")
    parser.add_argument("--threads", default="1,2", help="numbers of threads to compare")
    parser.add_argument("--repetitions", type=int, help="medians of so many (default: 3)")
    options = parser.parse_args()
    options.parts = options.parts.split(",")
    options.data = options.data.split(",")
    options.presets = options.presets.split(",")
    options.threads = [int(count) for count in options.threads.split(",")]
    options.repetitions = options.repetitions or (1 if options.quick else 3)
    if (not set(options.parts) <= set(PARTS) or not set(options.presets) <= {"best", "paper"} or
            not set(options.data) <= set(DATA_SETS)):
        parser.error("no such part, preset or data set")
    return options


def processor():
    """The processor's name as Linux tells it."""
    with open("/proc/cpuinfo", encoding="utf-8") as file:
        for line in file:
            if line.startswith("model name"):
                return line.split(":", 1)[1].strip()
    return platform.machine()


def run_kernels(options):
    """{(name, threads): [ms of each repetition]}; Google Benchmark's own report is kept beside."""
    note("stages and kernels alone")
    path = os.path.join(options.out, "kernels.json")
    command = [options.kernels, f"--benchmark_out={path}", "--benchmark_out_format=json",
               f"--benchmark_repetitions={options.repetitions}"]
    if options.repetitions > 1:
        command.append("--benchmark_display_aggregates_only=true")
    if options.quick:
        command += ["--benchmark_min_time=0.01", f"--benchmark_filter={QUICK_KERNELS}"]
    end = subprocess.run(command, stdout=sys.stderr, check=False)
    if end.returncode != 0:
        sys.exit(f"failed ({end.returncode}): {' '.join(command)}")
    with open(path, encoding="utf-8") as file:
        return tables.kernel_times(json.load(file))


class Targets:
    """Rows of: work, target, median and fastest with two threads, of what was measured.

    The targets are those of `best`; `paper` has one for its whole process.
    """

    def __init__(self, runs, kernels, presets):
        self.rows = []
        self.medians = {key: typical_run(each) for key, each in runs.items()}
        self.fastest = {key: typical_run(each, min) for key, each in runs.items()}
        for preset, seconds in (("best", 4), ("paper", 3)):
            self.add_small(runs, preset, seconds)
        for data_set, seconds, gib in ((MIDDLE, 40, 2), (LARGE, 80, 3)):
            key = (data_set, "best", 2, "run")
            self.add(f"{data_set.title}, `best`, whole process",
                     self.each(key, lambda run: run.whole), at_most=seconds)
            self.add(f"{data_set.title}, `best`, memory",
                     self.each(key, lambda run: run.peak / 1024), "GiB", at_most=gib)
        for work, limit, name in self.KERNELS + [
                (f"texture alone, {SMALL.width}×{SMALL.height}, `{preset}`",
                 25 if preset == "best" else None, f"texture/{preset}/views:12/width:640")
                for preset in presets]:
            if (name, 2) in kernels:
                times = kernels[name, 2]
                self.add(work, (statistics.median(times), min(times)), "ms", at_most=limit)

    KERNELS = [(f"hull source, {SMALL.title}", 400, "visual_hull/paper/views:12/width:640"),
               (f"depth maps, {SMALL.title}", 2500, "depth_maps/best/views:12/width:640"),
               ("power crust, 35,000 samples", 1200, "power_crust/samples:35000"),
               ("power crust, 140,000 samples", 6000, "power_crust/samples:140000")]

    def each(self, key, number):
        """A number of the median and of the fastest run."""
        return tuple(number(runs[key]) if key in runs else None
                     for runs in (self.medians, self.fastest))

    def add_small(self, runs, preset, seconds):
        if (SMALL, preset, 2, "run") not in runs:
            return
        self.add(f"bunny, {SMALL.title}, `{preset}`, to the picture (`render`), whole process",
                 self.each((SMALL, preset, 2, "render 1"), lambda run: run.whole), at_most=seconds)
        self.add(f"each further view, `{preset}`",
                 tuple(further_view(runs, SMALL, preset, 2, of) for of in (statistics.median, min)),
                 at_most=0.4 if preset == "best" else None)
        one, two = ((SMALL, preset, count, "render 1") for count in (1, 2))
        if one in runs:
            # Of runs that followed each other.
            ratio = statistics.median(a.whole / b.whole for a, b in zip(runs[one], runs[two]))
            fastest = self.fastest[one].whole / self.fastest[two].whole
            self.add(f"two threads against one, whole process, `{preset}`", (ratio, fastest),
                     "times", at_least=1.6 if preset == "best" else None)

    def add(self, work, values, unit="s", at_most=None, at_least=None):
        if values[0] is None:
            return
        target, met = "–", True
        if at_most:
            target, met = f"≤ {at_most:,} {unit}", values[0] <= at_most
        if at_least:
            target, met = f"≥ {at_least} {unit}", values[0] >= at_least
        median, fastest = (f"{tables.number(value)} {unit}" for value in values)
        self.rows.append([work, target, median if met else f"**{median}** ✗", fastest])

    def table(self):
        return tables.table(["work", "target", "median", "fastest"], self.rows) if self.rows else ""


def heading(options, bench):
    text = (f"{processor()}, {os.cpu_count()} cores; medians of {options.repetitions}"
            f"{' (quick: too few and too small to go by)' if options.quick else ''}.")
    if bench.log:
        others = statistics.median(run["others"] for run in bench.log)
        if others > 0.05:
            text += f" Other processes took {100 * others:.0f} % of the processor meanwhile."
            note(f"Not alone: other processes took {100 * others:.0f} % of the processor.")
    return text + "\n\n"


def growth_text(options, bench):
    """Measures the growth; tables, plots and what is too steep."""
    text = ""
    measured = growth.measure(bench, options.quick, options.presets, max(options.threads),
                              options.repetitions)
    for preset, by_axis in measured.items():
        fits = growth.fits(by_axis)
        path = os.path.join(options.out, f"growth-{preset}.png")
        growth.plot(by_axis, f"{preset}, {tables.plural(max(options.threads))}", path)
        factors = "; ".join(f"{axis} {series[0][0]:,} to {series[-1][0]:,}"
                            for axis, series in by_axis.items())
        text += (f"Growth of `{preset}`, {tables.plural(max(options.threads))}: exponents of the "
                 f"cost, over all / over the upper half of {factors}; ▲ above {growth.LIMIT}.\n\n")
        text += tables.growth_table(fits)
        for axis, by_stage in fits.items():
            for stage, (whole, upper, steep) in by_stage.items():
                if steep:
                    note(f"too steep: {preset}, {stage} with {axis}: {whole:.2f}, {upper:.2f}")
        note(f"plot: {path}")
    return text


def main():
    options = arguments()
    bench = Bench(options.program, options.out)
    data_sets = QUICK if options.quick else [DATA_SETS[name] for name in options.data]
    kernels, runs, text = {}, {}, ""
    if "kernels" in options.parts:
        kernels = run_kernels(options)
    if "runs" in options.parts:
        runs = whole_runs(bench, data_sets, options.presets, options.threads, options.repetitions)
        for preset in options.presets:
            text += tables.stage_table(runs, data_sets, preset, options.threads)
    if kernels:
        text += tables.kernel_table(kernels, options.threads)
    text = Targets(runs, kernels, options.presets).table() + text
    if "growth" in options.parts:
        text += growth_text(options, bench)
    text = heading(options, bench) + text
    tables.write_csv(os.path.join(options.out, "runs.csv"), bench.log)
    for name, content in (("runs.json", json.dumps(bench.log, indent=1)), ("bench.md", text)):
        with open(os.path.join(options.out, name), "w", encoding="utf-8") as file:
            file.write(content)
    print(text, end="")


if __name__ == "__main__":
    main()
