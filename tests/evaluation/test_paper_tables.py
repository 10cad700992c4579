#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
import os
import tempfile
import unittest

import numpy

import paper_tables


class TableTest(unittest.TestCase):
    def test_reads_the_table_of_a_run(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "rms_outline.csv")
            with open(path, "w", encoding="utf-8") as file:
                file.write("iteration,rms,psnr\n0,15.5,20\n1,14.25,21\n")
            self.assertEqual(paper_tables.read_table(path), [(0, 15.5), (1, 14.25)])

    def test_counts_the_iterations_in_which_the_rms_falls(self):
        self.assertEqual(paper_tables.falls([(0, 3), (1, 2), (2, 2), (3, 1), (4, 1.5)]), (2, 4))
        self.assertEqual(paper_tables.falls([(0, 3)]), (0, 0))

    def test_table_in_the_form_of_the_paper(self):
        self.assertEqual(
            paper_tables.iteration_table("Table 3", [(0, 3), (1, 2.5)], "falls"),
            "**Table 3**\n\n| times | 0 | 1 |\n| --- | --- | --- |\n"
            "| RMS error | 3.000 | 2.500 |\n\n"
            "Falls in 1 of 1 iterations, by 0.500 in all. The paper's: falls.\n\n")


class ReturnedTest(unittest.TestCase):
    def test_share_of_what_was_lost_of_the_truth(self):
        def mask(text):
            return numpy.array([each == "#" for each in text])
        truth = mask("######..")
        whole = mask("#######.")  # one pixel more than the truth, which is not lost
        hurt = mask("##......")
        self.assertEqual(paper_tables.returned(truth, whole, hurt, mask("###...#.")), (4, 0.25))
        self.assertEqual(paper_tables.returned(truth, whole, hurt, hurt), (4, 0))
        self.assertEqual(paper_tables.returned(truth, whole, whole, whole), (0, 0))


if __name__ == "__main__":
    unittest.main()
