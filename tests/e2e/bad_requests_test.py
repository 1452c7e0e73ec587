"""Every file of tests/bad_requests: the request is refused, with the status and the place that the file names."""

import json
import os
import unittest
from pathlib import Path

from shipped_server import ServerTest

CASES = sorted(Path(os.environ["GNOMON_BAD_REQUESTS"]).glob("*.json"))


def text_of(body):
    """A body is text, or a list of text and [text, how often]."""
    pieces = [body] if isinstance(body, str) else body
    return "".join(piece if isinstance(piece, str) else piece[0] * piece[1] for piece in pieces)


class BadRequests(ServerTest):
    def test_each_is_refused_with_its_place(self):
        scene = self.server.upload("box_on_plane")
        self.assertGreater(len(CASES), 20)
        for path in CASES:
            case = json.loads(path.read_text())
            request = case["request"]
            with self.subTest(path.name):
                reply = self.server.ask(
                    request.get("method", "POST"),
                    request.get("path", "/v1/scenes/{scene}/frames").replace("{scene}", scene),
                    text_of(request.get("body", "")).encode("utf-8", "surrogateescape"),
                    {"Content-Type": "application/json"} | request.get("headers", {}),
                )
                self.assert_problem(reply, case["expectedStatus"])
                expected = case["expectedPointer"]
                if isinstance(expected, list):  # exactly these, in any order
                    self.assertEqual(sorted(reply.pointers()), sorted(expected))
                else:
                    self.assertIn(expected, reply.pointers())


if __name__ == "__main__":
    unittest.main()
