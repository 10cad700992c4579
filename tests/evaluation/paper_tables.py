#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tables 1 to 4 of the paper (Chia, He and Lin 2013), as Markdown.

usage: paper_tables.py PROGRAM JOBS DATA OUT

Runs the job files JOBS/paper-*.json on the data sets of DATA: bunny and damaged, which it
generates where they are missing, and dino12, which is skipped where it is missing. Everything goes
to OUT.

A table gives the RMS in the foreground after each iteration, and what the paper says of its own.
For the job with damaged masks it also tells how much of what they cut off comes back: of the true
object's pixels in the novel view that the hull of the undamaged masks covers and that of the
damaged ones does not, the share that the result covers.
"""
import csv
import json
import os
import subprocess
import sys

# job, name, tables of outline and non-outline iterations, and what the paper says of them. The text
# that the project has of the paper lacks the numbers in the tables.
JOBS = [
    ("paper-dino12", "dinosaur", "dino12",
     ("Table 1", "falls in every iteration up to the 7th, then rises slightly"),
     ("Table 2", "falls in every iteration")),
    ("paper-bunny", "bunny", "bunny",
     ("Table 3", "falls in every iteration"),
     ("Table 4", "large at the beginning, then falls")),
    ("paper-damaged", "bunny with two damaged masks", "damaged",
     ("As table 3", "not in the paper; there, the lost part of the dinosaur's fin comes back"),
     ("As table 4", "not in the paper")),
]
GENERATED = {
    "bunny": ["--test-angles", "15,75,165,255"],
    "damaged": ["--test-angles", "15,75,165,255", "--mask-erode", "2", "--mask-erode-views", "1,5"],
}


def read_table(path):
    """Iterations and their RMS from a CSV file of a run."""
    with open(path, encoding="utf-8") as lines:
        return [(int(row["iteration"]), float(row["rms"])) for row in csv.DictReader(lines)]


def falls(table):
    """In how many iterations the RMS falls, and of how many."""
    values = [rms for _, rms in table]
    return sum(after < before for before, after in zip(values, values[1:])), len(values) - 1


def iteration_table(title, table, paper):
    """A table in the paper's form: times, RMS error."""
    head = ["times"] + [str(iteration) for iteration, _ in table]
    fallen, count = falls(table)
    lines = [head, ["---"] * len(head), ["RMS error"] + [f"{rms:.3f}" for _, rms in table]]
    return (f"**{title}**\n\n" + "".join("| " + " | ".join(cells) + " |\n" for cells in lines)
            + f"\nFalls in {fallen} of {count} iterations, by "
            f"{table[0][1] - table[-1][1]:.3f} in all. The paper's: {paper}.\n\n")


def returned(truth, whole, damaged, result):
    """How many pixels the damaged hull has lost of what the whole one has of the truth, and the
    share of them that the result covers. All are masks of bool."""
    lost = truth & whole & ~damaged
    count = int(lost.sum())
    return count, float((lost & result).sum()) / count if count else 0.0


def run_job(program, jobs, data, out, name, folder):
    """Runs a job on the data set in this folder; returns where its files are."""
    with open(os.path.join(jobs, name + ".json"), encoding="utf-8") as file:
        job = json.load(file)
    view = os.path.basename(job["view"])  # test_par.txt#NAME
    dataset = os.path.join(data, folder)
    result = os.path.join(out, name)
    job["dataset"] = dataset
    job["view"] = "file:" + os.path.join(dataset, "test", view)
    job["out"] = result
    os.makedirs(out, exist_ok=True)
    changed = os.path.join(out, name + ".json")
    with open(changed, "w", encoding="utf-8") as file:
        json.dump(job, file, indent=2)
    subprocess.run([program, "run", changed, "--quiet"], check=True)
    return result


def stage_mask(folder, stage):
    import cv2  # late: tests of the tables do without
    mask = cv2.imread(os.path.join(folder, "stages", stage + "_mask.png"), 0)
    return mask > 127


def damage_report(truth_mask, whole, damaged):
    """What comes back of the part that damaged masks cut off, in the two runs' folders."""
    import cv2
    truth = cv2.imread(truth_mask, 0) > 127
    text = "| damaged masks, bunny at 15° | lost pixels | returned |\n| --- | --- | --- |\n"
    for stage in ("outline", "full"):
        count, share = returned(truth, stage_mask(whole, "hull"), stage_mask(damaged, "hull"),
                                stage_mask(damaged, stage))
        text += f"| after {stage} | {count} | {100 * share:.0f} % |\n"
    return text


def main():
    if len(sys.argv) != 5:
        sys.exit(__doc__)
    program, jobs, data, out = (os.path.abspath(path) for path in sys.argv[1:])
    for name, options in GENERATED.items():
        if not os.path.exists(os.path.join(data, name, "generate.json")):
            subprocess.run([program, "generate", "--mesh", "bunny", "--texture", "wood", "--quiet",
                            "--out", os.path.join(data, name)] + options, check=True)
    results = {}
    for job, name, folder, outline, others in JOBS:
        if not os.path.isdir(os.path.join(data, folder)):
            print(f"{name}: skipped, {folder} is missing\n")
            continue
        result = results[job] = run_job(program, jobs, data, out, job, folder)
        for (table, paper), step, file in ((outline, "outline", "rms_outline.csv"),
                                           (others, "non-outline", "rms_nonoutline.csv")):
            print(iteration_table(f"{table}: {name}, {step} iterations",
                                  read_table(os.path.join(result, file)), paper), end="")
    print(damage_report(os.path.join(data, "damaged", "test", "mask", "test0000.png"),
                        results["paper-bunny"], results["paper-damaged"]), end="")


if __name__ == "__main__":
    main()
