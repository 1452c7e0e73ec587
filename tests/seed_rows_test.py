#!/usr/bin/env python3
"""seed_rows.py has to name a row without a test, a row that there is not, and a stale table."""

import re
import tempfile
import unittest
from pathlib import Path

import seed_rows


def all_rows():
    return "".join(f"TEST(Rows, {row}_IsShown) {{}}\n" for row in seed_rows.MUST_HAVE_TESTS)


class SeedRows(unittest.TestCase):
    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.folder = Path(self.temporary.name)
        (self.folder / "golden").mkdir()
        (self.folder / "README.md").write_text(f"before\n{seed_rows.BEGIN}{seed_rows.END}\nafter\n", encoding="utf-8")

    def tearDown(self):
        self.temporary.cleanup()

    def faults(self, source):
        """The faults once the table is written."""
        (self.folder / "rows_test.cpp").write_text(source, encoding="utf-8")
        list(seed_rows.faults_of(self.folder, update=True))
        return list(seed_rows.faults_of(self.folder))

    def test_every_row_with_a_test_is_sound(self):
        self.assertEqual(self.faults(all_rows()), [])

    def test_a_row_without_a_test_is_named(self):
        faults = self.faults(all_rows().replace("X12_", ""))
        self.assertEqual(len(faults), 1, faults)
        self.assertTrue(faults[0].startswith("X12 "), faults)

    def test_a_golden_picture_is_a_test(self):
        (self.folder / "golden" / "X12_empty_atlas.json").write_text("{}", encoding="utf-8")
        self.assertEqual(self.faults(all_rows().replace("X12_", "")), [])
        self.assertIn("`golden/X12_empty_atlas`", (self.folder / "README.md").read_text(encoding="utf-8"))

    def test_a_row_that_there_is_not_is_named(self):
        faults = self.faults(all_rows() + "TEST(Rows, X36_IsNone) {}\n")
        self.assertEqual(len(faults), 1, faults)
        self.assertIn("X36", faults[0])

    def test_a_stale_table_is_named(self):
        self.faults(all_rows())
        (self.folder / "more_test.cpp").write_text("TEST(More,\n     X1_X2_Both) {}\n", encoding="utf-8")
        faults = list(seed_rows.faults_of(self.folder))
        self.assertEqual(len(faults), 1, faults)
        self.assertIn("stale", faults[0])

    def test_ctest_labels_the_letters_of_all_rows(self):
        label = (Path(__file__).resolve().parent / "seed_label.cmake.in").read_text(encoding="utf-8")
        labelled = [set(letters) for letters in re.findall(r"\[([A-Z]+)\]\[0-9\]", label)]
        read = [set(letters) for letters in re.findall(r"\[([A-Z]+)\]", seed_rows.ID.pattern)]
        letters = {row[0] for row in seed_rows.ROWS}
        self.assertEqual(labelled, [letters])
        self.assertEqual(read, [letters])

    def test_a_test_of_two_rows_stands_at_both(self):
        self.faults(all_rows() + "TEST_P(More, X1_X2_Both) {}\n")
        text = (self.folder / "README.md").read_text(encoding="utf-8")
        self.assertEqual(text.count("`More.X1_X2_Both`"), 2)
        self.assertTrue(text.startswith("before\n") and text.endswith("\nafter\n"), text)


if __name__ == "__main__":
    unittest.main()
