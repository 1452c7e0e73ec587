"""The list of scenes, page by page."""

import json
import shutil
import subprocess
import unittest
from pathlib import Path

from shipped_server import TIMEOUT, ServerTest
from triggers_store_test import padded, upload

WEB = Path(__file__).resolve().parents[2] / "clients" / "web"


class Pages(ServerTest):
    flags = ("--device", "cpu", "--workers", "1")

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.ids = sorted(upload(cls.server, padded(10, str(number))).json()["id"] for number in range(12))

    def pages(self, limit):
        """(ids of each page, the last reply)"""
        found, target = [], f"/v1/scenes?limit={limit}"
        while target:
            reply = self.server.get(target)
            self.assertEqual(reply.status, 200)
            page = reply.json()
            found.append([scene["id"] for scene in page["scenes"]])
            self.assertEqual("next" in page, "Link" in reply.headers)
            target = None
            if "next" in page:
                target = f"/v1/scenes?limit={limit}&after={page['next']}"
                self.assertEqual(reply.headers["Link"], f'<{target}>; rel="next"')
        return found

    def test_follow_each_other_without_gap_or_overlap(self):
        for limit in (1, 5, 6, 11, 12, 13, 1000):
            pages = self.pages(limit)
            self.assertEqual(sum(pages, []), self.ids, limit)
            self.assertEqual([len(page) for page in pages[:-1]], [limit] * (len(pages) - 1))
        self.assertEqual([scene["id"] for scene in self.server.get("/v1/scenes").json()["scenes"]], self.ids)

    def test_a_page_begins_after_an_id_that_is_gone_too(self):
        page = self.server.get("/v1/scenes?after=" + "0" * 64).json()
        self.assertEqual([scene["id"] for scene in page["scenes"]], self.ids)
        self.assertEqual(self.server.get("/v1/scenes?after=" + "f" * 64).json(), {"scenes": []})

    def test_wrong_queries_are_refused_with_their_place(self):
        for query, pointer in (("limit=0", "/limit"), ("limit=1001", "/limit"), ("limit=", "/limit"), ("limit=1x", "/limit"),
                               ("limit=-1", "/limit"), ("limit=1&limit=1", "/limit"), ("after=x", "/after"),
                               ("after=" + "A" * 64, "/after"), ("page=2", "/page")):  # fmt: skip
            self.assert_problem(self.server.get("/v1/scenes?" + query), 400, pointer)

    @unittest.skipUnless(shutil.which("node"), "the page's modules want Node")
    def test_the_page_follows_them(self):
        host, port = self.server.address
        script = f"""
          import {{ scenePages }} from '{WEB}/api.mjs';
          const fetched = [], real = fetch;
          globalThis.fetch = (path, options) => {{
            fetched.push(path);
            return real('http://{host}:{port}/' + path.replace('limit=1000', 'limit=5'), options);
          }};
          const ids = [];
          for await (const page of scenePages()) ids.push(...page.map(({{ id }}) => id));
          console.log(JSON.stringify({{ ids, fetched: fetched.length }}));
        """
        done = subprocess.run(["node", "--input-type=module", "-e", script], capture_output=True, text=True, timeout=TIMEOUT)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(json.loads(done.stdout), {"ids": self.ids, "fetched": 3})


if __name__ == "__main__":
    unittest.main()
