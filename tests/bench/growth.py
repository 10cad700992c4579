# SPDX-License-Identifier: GPL-3.0-or-later
"""How the cost of every stage grows with each of the inputs, all others held fixed."""
import math
from dataclasses import dataclass

from runs import DataSet, note, typical_run, view_words

# n log n over a factor of sixteen from some ten thousand: 1.08 to 1.1; and some room for noise.
LIMIT = 1.15
# Shorter ones (seconds, at the largest input) are all overhead and noise.
LEAST_SECONDS = 0.05


@dataclass(frozen=True)
class Point:
    """One run: photographs, whose novel camera (and so the size of its picture), spacing."""
    photographs: DataSet
    camera: DataSet
    spacing: float  # of hull samples, px of the photographs


def of_width(width, views=12):
    return DataSet(views, width, width * 3 // 4)


def axes(quick):
    """Points by what grows along them; a factor of sixteen each, four when quick."""
    base = 320 if quick else 640
    steps = [-1, 0, 1] if quick else [-2, -1, 0, 1, 2]
    # Pixels grow as the square of the width; sixteenths of the width keep 4:3 exact.
    widths = [round(base * 2 ** (step / 2) / 16) * 16 for step in steps]
    spacing = 2.0
    counts = [12 * 2 ** i for i in range(len(steps))]
    usual, small = of_width(base), base // 2
    return {
        "photographs": [Point(of_width(small, count), of_width(small, count), spacing)
                        for count in counts],
        # Samples and picture stay as they are: the same spacing in the world, the same camera.
        "pixels per photograph": [Point(of_width(width), usual, spacing * width / base)
                                  for width in widths],
        "samples": [Point(usual, usual, spacing * 2 ** (-step / 2)) for step in steps],
        "novel-view pixels": [Point(usual, of_width(width), spacing) for width in widths],
    }


def size_of(axis, point, samples):
    """Where a point stands on its axis."""
    return {"photographs": point.photographs.views,
            "pixels per photograph": point.photographs.width * point.photographs.height,
            "samples": samples,
            "novel-view pixels": point.camera.width * point.camera.height}[axis]


def measure(bench, quick, presets, threads, repetitions):
    """{preset: {axis: [(size, Run), ..]}}, medians."""
    result = {preset: {} for preset in presets}
    for axis, points in axes(quick).items():
        note(f"growth with {axis}")
        for preset in presets:
            for point in points:
                # The novel picture's size is that of the picture beside this file.
                camera = bench.data(point.camera) + "/test/test_par.txt"
                words = view_words(bench.data(point.photographs), camera)
                words += ["--hull-spacing", f"{point.spacing:.6g}", "--preset", preset]
                runs = []
                for repetition in range(repetitions):
                    what = {"data": point.photographs.title, "preset": preset,
                            "command": f"growth with {axis}", "repetition": repetition,
                            "picture": f"{point.camera.width}×{point.camera.height}",
                            "spacing": round(point.spacing, 3)}
                    runs.append(bench.run(what, words, threads))
                size = size_of(axis, point, bench.samples())
                result[preset].setdefault(axis, []).append((size, typical_run(runs)))
    return result


def slope(points):
    """Exponent of the power law through points (x, y), by least squares of the logarithms."""
    logs = [(math.log(x), math.log(y)) for x, y in points]
    mean_x = sum(x for x, _ in logs) / len(logs)
    mean_y = sum(y for _, y in logs) / len(logs)
    return (sum((x - mean_x) * (y - mean_y) for x, y in logs) /
            sum((x - mean_x) ** 2 for x, _ in logs))


def exponents(points):
    """Over all points (x, y), and over their upper half, where overheads no longer hide it."""
    return slope(points), slope(points[len(points) // 2:])


def stage_points(series):
    """{stage: [(size, seconds), ..]} of what is long enough to say anything, and memory (MiB)."""
    names = list(dict.fromkeys(name for _, run in series for name in run.stages))
    lines = {name: [(size, run.stages.get(name, 0)) for size, run in series] for name in names}
    lines["rest"] = [(size, run.rest) for size, run in series]
    lines["whole process"] = [(size, run.whole) for size, run in series]
    lines = {name: points for name, points in lines.items()
             if points[-1][1] >= LEAST_SECONDS and all(y > 0 for _, y in points)}
    lines["peak memory"] = [(size, run.peak) for size, run in series]
    return lines


def fits(by_axis):
    """{axis: {stage: (exponent, upper exponent, too steep?)}}."""
    result = {}
    for axis, series in by_axis.items():
        result[axis] = {}
        for stage, points in stage_points(series).items():
            whole, upper = exponents(points)
            result[axis][stage] = (whole, upper, max(whole, upper) > LIMIT)
    return result


def plot(by_axis, title, path):
    """A panel per axis, a line per stage, logarithmic both ways."""
    import matplotlib  # late: it takes long, and nothing is measured any more
    matplotlib.use("Agg")
    from matplotlib import pyplot
    figure, panels = pyplot.subplots(1, len(by_axis), figsize=(5.2 * len(by_axis), 5.5))
    for panel, (axis, series) in zip(panels, by_axis.items()):
        lines = stage_points(series)
        lines.pop("peak memory")
        for colour, (stage, points) in enumerate(lines.items()):
            whole, upper = exponents(points)
            panel.loglog(*zip(*points), marker="o", markersize=3, color=f"C{colour % 10}",
                         linestyle="-" if colour < 10 else "--",
                         label=f"{stage}: {whole:.2f}, {upper:.2f}")
        first, last = series[0][0], series[-1][0]
        top = max(run.whole for _, run in series)
        panel.loglog([first, last], [top * first / last, top], color="0.7", linestyle=":",
                     label="exponent 1")
        panel.set_xlabel(axis)
        panel.set_ylabel("seconds")
        panel.grid(True, which="both", color="0.92")
        panel.legend(fontsize=7, title="exponent: all, upper half", title_fontsize=7)
    figure.suptitle(title)
    figure.tight_layout()
    figure.savefig(path, dpi=90)
    pyplot.close(figure)
