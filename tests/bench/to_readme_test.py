#!/usr/bin/env python3
"""to_readme.py has to put the marked part in its place, turn its links, and refuse files without markers."""

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

    def test_refuses_files_without_markers(self):
        for name, result, readme in (("speed", RESULT, README), ("cost", "# T\n", README), ("cost", RESULT, "")):
            with self.assertRaises(ValueError):
                put(name, result, "r", readme)


if __name__ == "__main__":
    unittest.main()
