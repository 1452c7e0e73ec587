"""`gnomon evaluate` through the shipped binary: the same figures here and there, files, problems."""

import json
import unittest

from command_line import BOX, OK, PROBLEM, SMALL, USAGE, AgainstServer, gnomon


class Evaluate(AgainstServer):
    def test_an_evaluation_here_and_there(self):
        variants = ["--variant", '{"shadow": {"filter": {"type": "hard"}}}', "--variant", '{"shadow": {"cascadeCount": 1}}']
        files = {kind: self.folder / f"report.{kind}" for kind in ("json", "csv", "svg")}
        flags = [text for kind, path in files.items() for text in (f"--{kind}", str(path))]
        reports = []
        for where in ([], ["--server", self.url]):
            run = gnomon("evaluate", BOX, *SMALL, *variants, "--repeats", "1", *flags, *where,
                         "--path", '{"step": [0.01, 0, 0], "frames": 3}')
            self.assert_ends(run, OK)
            self.assertEqual(run.stderr, b"")
            table = run.stdout.decode().splitlines()
            self.assertTrue(table[1].startswith("filter.type hard ") and table[2].startswith("cascadeCount 1 "), table)
            self.assertEqual(table[1].split()[3], "1.00")
            reports.append(json.loads(files["json"].read_text()))
            self.assertEqual(len(files["csv"].read_text().splitlines()), 3)
            self.assertTrue(files["svg"].read_text().startswith("<svg "))
        self.assertTrue(all("shimmer" in row["metrics"] for report in reports for row in report["rows"]))
        here, there = ([row["metrics"] for row in report["rows"]] for report in reports)
        self.assertEqual(here, there)

    def test_an_evaluation_on_standard_output_is_nothing_else(self):
        run = gnomon("evaluate", BOX, *SMALL, "--variant", "{}", "--repeats", "1", "--csv", "-")
        self.assert_ends(run, OK)
        self.assertEqual([line.split(",")[0] for line in run.stdout.decode().splitlines()], ["name", "as given"])

    def test_what_is_wrong_with_an_evaluation_is_told(self):
        for arguments, said in (
            (["--variant", "{"], ["--variant (/variants/0)"]),
            (["--variant", "{}", "--variant", '{"fog": 1}'], ["--variant (/variants/1/fog)"]),
            (["--sweep", "everything"], ["--sweep (/sweep)"]),
            (["--path", '{"step": [1, 0, 0], "frames": 1}'], ["--path (/path/frames)"]),
            (["--repeats", "0"], ["--repeats (/repeats)", "1..100"]),
            (["--set", "width=0"], ["--set width"]),
            (["--camera", "nobody"], ["/spec/camera/node"]),
            (["--variant", '{"camera": {"node": "nobody"}}'], []),
        ):
            for where in ([], ["--server", self.url]):
                self.assert_ends(gnomon("evaluate", BOX, *SMALL, *arguments, *where), PROBLEM, *said)
        both = ["--variant", "{}", "--sweep", "sizes"]
        self.assert_ends(gnomon("evaluate", BOX, *both), USAGE)
        self.assert_ends(gnomon("evaluate", BOX, "--variant", "{}", "--csv", "-", "--json", "-"), USAGE)


if __name__ == "__main__":
    unittest.main()
