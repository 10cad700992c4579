# SPDX-License-Identifier: GPL-3.0-or-later
"""Data sets for the benchmarks, and runs of the program with the time and memory they take."""
import fcntl
import json
import os
import re
import shutil
import statistics
import subprocess
import sys
import time
from dataclasses import dataclass, field


# The stages that a further view needs.
VIEW_STAGES = ["culling", "outline", "non-outline", "texture", "report"]


@dataclass(frozen=True)
class DataSet:
    """Photographs of the bunny all around it, and novel cameras midway between neighbours."""
    views: int
    width: int
    height: int
    novel: int = 1

    @property
    def slug(self):
        return f"bunny-{self.views}x{self.width}x{self.height}-{self.novel}"

    @property
    def title(self):
        return f"{self.views} × {self.width}×{self.height}"


@dataclass
class Run:
    """What one process took: seconds, MiB; `others` is the share of the CPU that others used."""
    whole: float
    cpu: float
    peak: float
    others: float
    stages: dict = field(default_factory=dict)
    overlap: float = 0  # by how much their sum is too large, since some ran at the same time

    @property
    def rest(self):
        """Start-up, end, and whatever is not a stage."""
        return self.whole - sum(self.stages.values()) + self.overlap


def note(text):
    print(text, file=sys.stderr, flush=True)


def typical_run(runs, of=statistics.median):
    """A run each of whose numbers is the median, or another statistic, of these runs' numbers."""
    stages = {name: of([run.stages.get(name, 0) for run in runs]) for name in runs[0].stages}
    return Run(*(of([getattr(run, name) for run in runs])
                 for name in ("whole", "cpu", "peak", "others")), stages,
               of([run.overlap for run in runs]))


def busy_seconds():
    """Seconds of work that all processes of this machine have done so far, over all cores."""
    with open("/proc/stat", encoding="ascii") as file:
        ticks = [int(word) for word in file.readline().split()[1:]]
    idle = ticks[3] + ticks[4]
    return (sum(ticks[:8]) - idle) / os.sysconf("SC_CLK_TCK")


class Bench:
    """Runs the program with its files in one folder."""

    def __init__(self, program, out):
        self.program = program
        self.out = out
        self.log = []  # a row per measured run
        os.makedirs(out, exist_ok=True)
        self.lock = open(os.path.join(out, "lock"), "w", encoding="ascii")
        try:
            fcntl.flock(self.lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            sys.exit(f"{out}: another benchmark is at work there")

    def data(self, data_set):
        """The folder of a data set, generated unless it is there."""
        folder = os.path.join(self.out, "data", data_set.slug)
        if not os.path.exists(os.path.join(folder, "generate.json")):
            note(f"photographs {data_set.title}")
            step = 360 / data_set.views
            angles = ",".join(f"{(i + 0.5) * step:.6g}" for i in range(data_set.novel))
            self.must([self.program, "generate", "--quiet", "--out", folder,
                       "--views", str(data_set.views), "--step", f"{step:.10g}",
                       "--size", f"{data_set.width}x{data_set.height}", "--test-angles", angles])
        return folder

    def cameras(self, data_set, count):
        """A calibration file of the first so many novel cameras, and nothing beside it."""
        with open(os.path.join(self.data(data_set), "test", "test_par.txt"),
                  encoding="ascii") as file:
            lines = file.read().splitlines()[1:count + 1]
        path = os.path.join(self.out, "data", f"{data_set.slug}-{count}.txt")
        with open(path, "w", encoding="ascii") as file:
            file.write("\n".join([str(len(lines))] + lines) + "\n")
        return path

    def must(self, command):
        """Runs a command; its failure ends the benchmark with what it said."""
        end = subprocess.run(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True,
                             check=False)
        if end.returncode != 0:
            sys.exit(f"failed ({end.returncode}): {' '.join(command)}\n{end.stderr.strip()}")

    def run(self, what, words, threads):
        """One measured run; `what` names it in the log. Its files stay until the next one."""
        results = os.path.join(self.out, "run")
        timings = os.path.join(self.out, "timings.json")
        shutil.rmtree(results, ignore_errors=True)
        command = [self.program, *words, "--out", results, "--quiet", "--threads", str(threads),
                   "--timings", timings]
        busy, start = busy_seconds(), time.perf_counter()
        with open(os.path.join(self.out, "log.txt"), "wb") as log:
            process = subprocess.Popen(command, stdout=log, stderr=log)
            _, status, usage = os.wait4(process.pid, 0)
        whole = time.perf_counter() - start
        process.returncode = os.waitstatus_to_exitcode(status)
        if process.returncode != 0:
            with open(os.path.join(self.out, "log.txt"), encoding="utf-8") as log:
                sys.exit(f"failed ({process.returncode}): {' '.join(command)}\n{log.read()}")
        with open(timings, encoding="utf-8") as file:
            measured = json.load(file)
        cpu = usage.ru_utime + usage.ru_stime
        others = max(0.0, busy_seconds() - busy - cpu) / (whole * os.cpu_count())
        run = Run(whole, cpu, usage.ru_maxrss / 1024, others, measured["stages"],
                  measured["overlap"])
        self.log.append({**what, "threads": threads, "whole": run.whole, "cpu": run.cpu,
                         "peakMemoryMiB": run.peak, "others": run.others, "rest": run.rest,
                         "overlap": run.overlap, "stages": run.stages})
        note(f"  {', '.join(str(value) for value in what.values())}, threads {threads}: "
             f"{run.whole:.2f} s, {run.peak:.0f} MiB")
        return run

    def samples(self):
        """How many samples the visual hull of the last run has."""
        with open(os.path.join(self.out, "run", "meshes", "visual_hull.vtp"), "rb") as file:
            found = re.search(rb'NumberOfPoints="(\d+)"', file.read(4096))
        return int(found.group(1))


def view_words(folder, camera_file):
    """Words of a run with the first camera of a file, without anything that need not be."""
    with open(camera_file, encoding="ascii") as file:
        name = file.read().splitlines()[1].split()[0]
    return ["run", folder, "--view", f"file:{camera_file}#{name}", "--no-iterations"]


def whole_runs(bench, data_sets, presets, threads, repetitions):
    """
    All runs by (data set, preset, threads, command); commands are "run", "render 1" and "render N"
    with all cameras. Configurations take turns, so that whatever disturbs falls on all.
    """
    runs = {}
    for repetition in range(repetitions):
        for data_set in data_sets:
            folder = bench.data(data_set)
            one, many = bench.cameras(data_set, 1), bench.cameras(data_set, data_set.novel)
            for preset in presets:
                for count in threads:
                    commands = {
                        "run": view_words(folder, one),
                        "render 1": ["render", folder, "--cameras", one],
                        f"render {data_set.novel}": ["render", folder, "--cameras", many]}
                    for name, words in commands.items():
                        what = {"data": data_set.title, "preset": preset, "command": name,
                                "repetition": repetition}
                        key = (data_set, preset, count, name)
                        runs.setdefault(key, []).append(
                            bench.run(what, words + ["--preset", preset], count))
    return runs


def further_view(runs, data_set, preset, threads, of=statistics.median):
    """
    Seconds that each further view of the same object takes: what depends on its camera. The median,
    or another statistic, of all runs.
    """
    return of([sum(run.stages.get(stage, 0) for stage in VIEW_STAGES) / data_set.novel
               for run in runs[data_set, preset, threads, f"render {data_set.novel}"]])
