#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Markdown tables of the evaluations that tests/ablation.sh has run.

usage: ablation_table.py RUNS.tsv > ablation.md
       ablation_table.py RUNS.tsv --readme FILE...     replaces the tables of these pages: what is
                                                       between <!-- ablation NAME --> and <!-- end -->

Every line of RUNS.tsv is: object, configuration and scores.json, separated by tabs. Objects and
configurations keep their order there.
"""
import json
import re
import sys


def number(value, digits):
    """A number as text; JSON has null where it is not finite."""
    return "–" if value is None else f"{value:.{digits}f}"


def rms_ssim(scores, digits=2):
    """A stage's two scores in one cell."""
    if scores is None:
        return "–"
    return number(scores["rms"], digits) + " / " + number(scores["ssim"], 3)


def closure_cell(scores):
    closure = scores.get("gap_closure")
    if not closure or closure["rms"] is None:
        return "–"
    return number(closure["rms"], 2) + " / " + number(closure["ssim"], 2)


def table(head, rows):
    lines = [head, ["---"] * len(head)] + rows
    return "".join("| " + " | ".join(cells) + " |\n" for cells in lines) + "\n"


def overview(runs, objects, configurations):
    """A row per configuration, a column per object: the full stage. The least RMS is bold."""
    least = {}
    for (name, _), scores in runs.items():
        rms = scores["mean"]["full"]["rms"]
        least[name] = min(rms, least.get(name, rms))
    rows = []
    for configuration in configurations:
        row = [configuration]
        for name in objects:
            scores = runs.get((name, configuration))
            full = scores["mean"]["full"] if scores else None
            cell = rms_ssim(full)
            row.append(f"**{cell}**" if full and full["rms"] == least[name] else cell)
        rows.append(row)
    return table([""] + objects, rows)


def stages(runs, name, configurations):
    """A row per configuration of one object: means of the stages, and what is behind them."""
    rows = []
    for configuration in configurations:
        scores = runs.get((name, configuration))
        if scores is None:
            continue
        mean = scores["mean"]
        full = mean["full"]
        rows.append([configuration, rms_ssim(mean["hull"]), rms_ssim(mean["outline"]),
                     rms_ssim(full), rms_ssim(mean.get("oracle")),
                     closure_cell(scores),
                     number(full["iou"], 4), number(full["missing"], 4),
                     number(full["excess"], 4)])
    return table(["", "hull", "outline", "full", "oracle", "gap closed", "IoU", "missing",
                  "excess"], rows)


def views(runs, name, configurations):
    """A row per view of one object, a column per configuration: hull -> full."""
    used = [each for each in configurations if (name, each) in runs]
    names = [view["view"] for view in runs[name, used[0]]["views"]]
    rows = []
    for view_id, view in enumerate(names):
        row = [view]
        for configuration in used:
            scored = runs[name, configuration]["views"][view_id]["stages"]
            hull, full = scored["hull"], scored["full"]
            mark = " ▲" if full["rms"] > hull["rms"] else ""
            row.append(rms_ssim(hull) + " → " + rms_ssim(full) + mark)
        rows.append(row)
    return table([""] + used, rows)


def silhouette_cells(scores):
    return [number(scores[name], 4) for name in ("iou", "missing", "excess")]


def best_means(runs, objects):
    """A row per object: what `best` makes of it."""
    rows = []
    for name in objects:
        scores = runs[name, "best"]
        mean = scores["mean"]
        rows.append([name, rms_ssim(mean["hull"], 1), rms_ssim(mean["outline"], 1),
                     f"**{rms_ssim(mean['full'], 1)}**", rms_ssim(mean.get("oracle"), 1),
                     closure_cell(scores)] + silhouette_cells(mean["full"]))
    return table(["`best`", "hull", "outline", "full", "oracle", "gap closed", "IoU", "missing",
                  "excess"], rows)


def best_views(runs, objects):
    """A row per object and view: what `best` makes of it."""
    rows = [[f"{name}, {view['view']}", rms_ssim(view["stages"]["hull"], 1),
             rms_ssim(view["stages"]["full"], 1)] + silhouette_cells(view["stages"]["full"])
            for name in objects for view in runs[name, "best"]["views"]]
    return table(["`best`, view", "hull", "full", "IoU", "missing", "excess"], rows)


def parts(runs, objects, configurations):
    """A row per configuration, a column per object: the full stage."""
    return table(["full stage"] + objects,
                 [[configuration] + [rms_ssim(runs[name, configuration]["mean"]["full"], 1)
                                     for name in objects] for configuration in configurations])


def update_readmes(paths, runs, objects, configurations):
    texts = {}
    for path in paths:
        with open(path, encoding="utf-8") as file:
            texts[path] = file.read()
    for name, content in (("best", best_means(runs, objects)),
                          ("parts", parts(runs, objects, configurations)),
                          ("views", best_views(runs, objects))):
        places = 0
        for path, text in texts.items():
            texts[path], count = re.subn(
                rf"(<!-- ablation {name} -->\n).*?(\n<!-- end -->)",
                lambda found, new=content: found[1] + new + found[2].lstrip("\n"),
                text, flags=re.DOTALL)
            places += count
        if places != 1:
            sys.exit(f"{places} places for the table '{name}' in {', '.join(paths)}, not one")
    for path, text in texts.items():
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)


def main():
    if len(sys.argv) != 2 and not (len(sys.argv) > 3 and sys.argv[2] == "--readme"):
        sys.exit(__doc__)
    runs, objects, configurations = {}, {}, {}
    with open(sys.argv[1], encoding="utf-8") as lines:
        for line in lines:
            name, configuration, path = line.rstrip("\n").split("\t")
            with open(path, encoding="utf-8") as file:
                runs[name, configuration] = json.load(file)
            objects[name] = configurations[configuration] = True
    objects, configurations = list(objects), list(configurations)

    if len(sys.argv) > 3:
        update_readmes(sys.argv[3:], runs, objects, configurations)
        return
    print("# Ablation\n")
    print("RMS in grey levels / SSIM over the foreground, means over the held-out views.\n")
    print("## Result of the full stage\n")
    print(overview(runs, objects, configurations), end="")
    print("## Stages of each object\n")
    print("Gap closed: of the way from the hull to the oracle, the texture mapping on the true mesh,")
    print("the part that the full stage goes, by RMS / by SSIM. IoU, missing and excess pixels are")
    print("the full stage's.\n")
    for name in objects:
        print(f"### {name}\n")
        print(stages(runs, name, configurations), end="")
    print("## Views: hull → full\n")
    print("▲ marks a view whose full stage has a larger RMS than its hull.\n")
    for name in objects:
        print(f"### {name}\n")
        print(views(runs, name, configurations), end="")


if __name__ == "__main__":
    main()
