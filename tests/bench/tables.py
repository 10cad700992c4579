# SPDX-License-Identifier: GPL-3.0-or-later
"""Markdown and CSV of what the benchmarks measured."""
import csv
import re
import statistics

from runs import further_view, typical_run

STAGES = ["photographs", "silhouettes", "visual hull", "power crust", "depth maps", "culling",
          "outline", "non-outline", "texture", "report"]


def number(value):
    """Three significant digits, and no more than milliseconds."""
    if value is None:
        return "–"
    size = abs(value)
    digits = 0 if size >= 100 else 1 if size >= 10 else 2 if size >= 1 else 3
    return f"{value:.{digits}f}".replace("-", "−")


def table(head, rows):
    lines = [head, ["---"] * len(head)] + rows
    return "".join("| " + " | ".join(cells) + " |\n" for cells in lines) + "\n"


def plural(threads):
    return f"{threads} thread" + ("s" if threads > 1 else "")


def stage_table(runs, data_sets, preset, threads):
    """A row per stage, a column per data set and number of threads; median seconds and MiB."""
    keys = [(data_set, count) for data_set in data_sets for count in threads]
    medians = [typical_run(runs[data_set, preset, count, "run"]) for data_set, count in keys]
    rows = []
    for stage in STAGES:
        if any(stage in run.stages for run in medians):
            rows.append([stage] + [number(run.stages.get(stage)) for run in medians])
    if any(run.overlap > 0 for run in medians):
        rows.append(["crust beside depth maps"] +
                    [number(-run.overlap) if run.overlap > 0 else "–" for run in medians])
    rows.append(["start-up and rest"] + [number(run.rest) for run in medians])
    rows.append(["**whole process**"] + [f"**{number(run.whole)}**" for run in medians])
    rows.append(["each further view"] +
                [number(further_view(runs, data_set, preset, count))
                 for data_set, count in keys])
    rows.append(["peak memory, MiB"] + [f"{run.peak:.0f}" for run in medians])
    head = [f"`{preset}`, s"] + [f"{data_set.title}, {plural(count)}" for data_set, count in keys]
    return table(head, rows)


def kernel_times(report):
    """{(name without threads, threads): [ms of each repetition]} of Google Benchmark's JSON."""
    times = {}
    for each in report["benchmarks"]:
        if each.get("error_occurred") or each.get("run_type") == "aggregate":
            continue
        name = each["run_name"].removesuffix("/real_time")
        threads = re.search(r"/threads:(\d+)", name)
        key = name.replace(threads.group(0), "") if threads else name
        to_ms = {"ns": 1e-6, "us": 1e-3, "ms": 1, "s": 1e3}[each["time_unit"]]
        times.setdefault((key, int(threads.group(1)) if threads else 1), []).append(
            each["real_time"] * to_ms)
    return times


def kernel_table(times, threads):
    """A row per benchmark, a column per number of threads; medians."""
    names = list(dict.fromkeys(name for name, _ in times))
    rows = [[name.replace("/", ", ").replace(":", " ").replace("_", " ")] +
            [number(statistics.median(times[name, count]) if (name, count) in times else None)
             for count in threads] for name in names]
    return table(["stage or kernel, ms"] + [plural(count) for count in threads], rows)


def growth_table(fits):
    """A row per stage, a column per axis: exponent over all / over the upper half."""
    stages = list(dict.fromkeys(stage for by_stage in fits.values() for stage in by_stage))
    rows = []
    for stage in stages:
        row = [stage]
        for by_stage in fits.values():
            if stage in by_stage:
                whole, upper, steep = by_stage[stage]
                text = f"{whole:.2f} / {upper:.2f}"
                row.append(f"**{text}** ▲" if steep else text)
            else:
                row.append("–")
        rows.append(row)
    return table(["exponent"] + list(fits), rows)


def write_csv(path, log):
    """A row per run and stage, "whole process" and "rest" among them."""
    columns = ["data", "preset", "command", "picture", "spacing", "threads", "repetition", "stage",
               "seconds", "peakMemoryMiB"]
    with open(path, "w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, columns, extrasaction="ignore")
        writer.writeheader()
        for run in log:
            stages = {**run["stages"], "rest": run["rest"], "whole process": run["whole"]}
            for stage, seconds in stages.items():
                writer.writerow({**run, "stage": stage, "seconds": f"{seconds:.4f}",
                                 "peakMemoryMiB": f"{run['peakMemoryMiB']:.0f}"})
