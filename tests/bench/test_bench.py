# SPDX-License-Identifier: GPL-3.0-or-later
"""The arithmetic behind the benchmarks' tables; nothing here is timed."""
import math
import sys
import unittest

import bench
import growth
import tables
from runs import Bench, DataSet, Run, further_view, typical_run


def series(cost, sizes=(1e4, 2e4, 4e4, 8e4, 16e4)):
    """What growth.measure gives for one axis, with one stage of this cost in seconds."""
    return [(size, Run(cost(size) + 0.2, 0, 100 + size / 1e3, 0, {"hull": cost(size)}))
            for size in sizes]


class Growth(unittest.TestCase):
    def test_the_exponent_of_a_power_law_is_found(self):
        for exponent in (0.5, 1.0, 1.7):
            points = [(size, 3 * size ** exponent) for size in (1, 2, 4, 8, 16)]
            self.assertAlmostEqual(growth.slope(points), exponent)

    def test_n_log_n_passes_and_more_does_not(self):
        fine = growth.fits({"samples": series(lambda n: 1e-6 * n * math.log(n))})
        steep = growth.fits({"samples": series(lambda n: 1e-6 * n ** 1.3)})
        self.assertFalse(fine["samples"]["hull"][2])
        self.assertTrue(steep["samples"]["hull"][2])

    def test_what_an_overhead_hides_shows_in_the_upper_half(self):
        whole, upper, steep = growth.fits(
            {"samples": series(lambda n: 2 + (n / 4e4) ** 1.6)})["samples"]["hull"]
        self.assertLess(whole, upper)
        self.assertLess(whole, 1)
        self.assertFalse(steep)  # 0.95 in the upper half
        self.assertTrue(growth.fits(
            {"samples": series(lambda n: 1 + (n / 2e4) ** 1.6)})["samples"]["hull"][2])

    def test_stages_too_short_to_say_are_left_out(self):
        fits = growth.fits({"samples": series(lambda n: 1e-8 * n)})["samples"]
        self.assertNotIn("hull", fits)
        self.assertIn("peak memory", fits)

    def test_axes_span_a_factor_of_sixteen_one_at_a_time(self):
        for axis, points in growth.axes(False).items():
            samples = [1 / point.spacing ** 2 for point in points]
            sizes = [growth.size_of(axis, point, count)
                     for point, count in zip(points, samples)]
            self.assertGreaterEqual(sizes[-1] / sizes[0], 15.9, axis)
            # In the world: the spacing in pixels over the width.
            dense = [point.spacing / point.photographs.width for point in points]
            if axis != "samples":
                self.assertAlmostEqual(min(dense), max(dense), msg=axis)
            if axis != "novel-view pixels":
                self.assertEqual(len({point.camera.width for point in points}), 1, axis)


class Tables(unittest.TestCase):
    def setUp(self):
        self.data = DataSet(12, 640, 480, 9)
        self.runs = {}
        for threads in (1, 2):
            for name, whole in (("run", 8), ("render 1", 4), ("render 9", 12)):
                self.runs[self.data, "best", threads, name] = [Run(
                    whole / threads, 0, 300, 0, {"texture": 0.5, "visual hull": 1})]
        self.runs[self.data, "best", 1, "render 9"][0].stages["texture"] = 4.5

    def test_each_further_view_takes_what_depends_on_its_camera(self):
        self.assertEqual(further_view(self.runs, self.data, "best", 1), 0.5)

    def test_the_fastest_further_view_is_that_of_one_run(self):
        self.runs[self.data, "best", 1, "render 9"] = [
            Run(9, 0, 300, 0, {"outline": 0.9, "texture": 1.8}),
            Run(9, 0, 300, 0, {"outline": 1.8, "texture": 0.9})]
        self.assertAlmostEqual(further_view(self.runs, self.data, "best", 1, min), 0.3)

    def test_targets_tell_median_and_fastest_and_what_is_missed(self):
        runs = {key: [run, Run(run.whole + 3, 0, 300, 0, {"texture": 9}),
                      Run(run.whole + 2, 0, 300, 0, run.stages)]
                for key, (run,) in self.runs.items()}
        kernels = {("power_crust/samples:35000", 2): [1300, 1100, 1400],
                   ("depth_maps/best/views:12/width:640", 2): [2000]}
        rows = bench.Targets(runs, kernels, ["best"]).rows
        # Two threads: 4 / 2, and that plus 3 and plus 2.
        self.assertEqual(rows[0][1:], ["≤ 4 s", "4.00 s", "2.00 s"])
        # One thread 4, 7, 6 against 2, 5, 4: 2, 1.4 and 1.5 times.
        self.assertEqual(rows[2][1:], ["≥ 1.6 times", "**1.50 times** ✗", "2.00 times"])
        self.assertEqual(rows[3][1:], ["≤ 2,500 ms", "2000 ms", "2000 ms"])
        self.assertEqual(rows[4][1:], ["≤ 1,200 ms", "**1300 ms** ✗", "1100 ms"])

    def test_stages_stand_in_their_order_with_rest_and_memory(self):
        lines = tables.stage_table(self.runs, [self.data], "best", [1, 2]).strip().splitlines()
        self.assertEqual([line.split("|")[1].strip() for line in lines[2:]],
                         ["visual hull", "texture", "start-up and rest", "**whole process**",
                          "each further view", "peak memory, MiB"])
        self.assertEqual(lines[4], "| start-up and rest | 6.50 | 2.50 |")

    def test_what_ran_at_the_same_time_counts_once(self):
        for threads in (1, 2):
            run = self.runs[self.data, "best", threads, "run"][0]
            run.overlap = 0.25 * (threads - 1)
        lines = tables.stage_table(self.runs, [self.data], "best", [1, 2]).strip().splitlines()
        self.assertEqual(lines[4:6], ["| crust beside depth maps | – | −0.250 |",
                                      "| start-up and rest | 6.50 | 2.75 |"])

    def test_medians_are_each_numbers_own(self):
        runs = [Run(3, 1, 10, 0, {"a": 5}), Run(1, 2, 30, 0, {"a": 4}), Run(2, 9, 20, 0, {"a": 9})]
        self.assertEqual(typical_run(runs), Run(2, 2, 20, 0, {"a": 5}))

    def test_kernels_are_found_by_name_and_threads(self):
        report = {"benchmarks": [
            {"run_name": "texture/best/views:12/width:640/threads:2/real_time", "real_time": 20,
             "time_unit": "ms", "run_type": "iteration"},
            {"run_name": "texture/best/views:12/width:640/threads:2/real_time", "real_time": 22,
             "time_unit": "ms", "run_type": "iteration"},
            {"run_name": "texture/best/views:12/width:640/threads:2/real_time", "real_time": 99,
             "time_unit": "ms", "run_type": "aggregate", "aggregate_name": "mean"},
            {"run_name": "contour_distance/width:640/real_time", "real_time": 5000,
             "time_unit": "us"},
            {"run_name": "broken/threads:1", "error_occurred": True, "real_time": 0,
             "time_unit": "ms"}]}
        self.assertEqual(tables.kernel_times(report),
                         {("texture/best/views:12/width:640", 2): [20, 22],
                          ("contour_distance/width:640", 1): [5]})


class Processes(unittest.TestCase):
    def test_a_failing_program_ends_the_benchmark(self):
        import tempfile
        with tempfile.TemporaryDirectory() as folder, self.assertRaises(SystemExit) as failure:
            Bench(sys.executable, folder).run({"command": "none"}, ["-c", "import nothing"], 1)
        self.assertIn("failed (1)", str(failure.exception))


if __name__ == "__main__":
    unittest.main()
