#!/usr/bin/env python3
"""to_readme.py has to put the marked part in its place, change its links, and refuse files without markers."""

import unittest

from to_readme import put

RESULT = "# T\n<!-- readme -->\n\n| a |\n![c](c.svg) [w](https://x/y) [s](#s)\n\n<!-- /readme -->\nrest\n"
README = "before\n<!-- cost -->\nold\n<!-- /cost -->\nafter\n"


class ToReadme(unittest.TestCase):
    def test_replaces_what_stood_between_the_markers(self):
        self.assertEqual(
            put("cost", RESULT, "tests/results", README),
            "before\n<!-- cost -->\n\n| a |\n![c](tests/results/c.svg) [w](https://x/y) [s](#s)\n\n"
            "<!-- /cost -->\nafter\n")

    def test_once_more_changes_nothing(self):
        once = put("cost", RESULT, "r", README)
        self.assertEqual(put("cost", RESULT, "r", once), once)

    def test_a_marker_that_names_columns_gets_them_alone(self):
        result = "<!-- readme -->\ntext\n\n| a | b % | c |\n|---|---|---|\n| **x** | 1 | 2 |\n\n![c](c.svg)\n<!-- /readme -->\n"
        page = "<!-- cost: c | a -->\nold\n<!-- /cost -->\n"
        self.assertEqual(put("cost", result, "r", page),
                         "<!-- cost: c | a -->\n\n| c | a |\n|---|---|\n| 2 | **x** |\n\n<!-- /cost -->\n")

    def test_a_name_that_begins_another_is_not_taken_for_it(self):
        with self.assertRaises(ValueError):
            put("cost", RESULT, "r", "<!-- cost of all -->\n<!-- /cost of all -->\n")

    def test_refuses_a_column_that_is_not_there(self):
        with self.assertRaises(ValueError):
            put("cost", RESULT, "r", "<!-- cost: b -->\n<!-- /cost -->\n")

    def test_refuses_files_without_markers(self):
        for name, result, readme in (("speed", RESULT, README), ("cost", "# T\n", README), ("cost", RESULT, "")):
            with self.assertRaises(ValueError):
                put(name, result, "r", readme)


if __name__ == "__main__":
    unittest.main()
