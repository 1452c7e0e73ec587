"""Plans over HTTP: what a frame would do, against what it does."""

import json
import unittest

from shipped_server import SMALL, ServerTest

JSON = {"Content-Type": "application/json"}
SUN_AND_LAMPS = SMALL | {
    "lights": [
        {"sun": {"azimuthDegrees": 120, "elevationDegrees": 35}},
        {"type": "spot", "position": [3, 4, 2], "direction": [-3, -4, -2], "range": 20},
        {"type": "point", "position": [-2, 3, 1], "range": 15},
        {"type": "point", "position": [0, 0, 900], "range": 2},
    ]
}


class Plans(ServerTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.scene = cls.server.upload("box_on_plane")

    def plan(self, spec):
        body = spec if isinstance(spec, bytes) else json.dumps(spec)
        reply = self.server.ask("POST", f"/v1/scenes/{self.scene}/plan", body, JSON)
        self.assertEqual((reply.status, reply.headers["Content-Type"]), (200, "application/json"), reply.body)
        return reply.json()

    def test_it_holds_what_the_frame_holds(self):
        plan = self.plan(SUN_AND_LAMPS)
        report = self.server.frame(self.scene, SUN_AND_LAMPS, "application/json").json()["report"]
        self.assertEqual(plan["spec"], report["spec"])
        self.assertLessEqual(plan["depthRange"][0], report["depthRange"][0])
        self.assertGreaterEqual(plan["depthRange"][1], report["depthRange"][1])
        self.assertEqual(len(plan["lights"]), 4)
        for planned, drawn in zip(plan["lights"], report["lights"]):
            self.assertEqual(planned["light"], drawn["light"])
            self.assertEqual(planned["askedTileSize"], drawn["askedTileSize"])
            self.assertGreaterEqual(planned["shadowed"], drawn["shadowed"])
            self.assertNotIn("cpuMilliseconds", planned)
            self.assertEqual(len(planned["tiles"]), len(drawn["tiles"]))
            for tile in planned["tiles"]:
                if tile["tile"][2] == 0:
                    continue
                self.assertEqual(len(tile["matrix"]), 16)
                if planned["light"] == 0:  # a lamp's tile may hold no block's middle
                    self.assertGreater(tile["predictedError"]["max"], 0)
                self.assertEqual(tile["casterTriangles"] + tile["culledTriangles"], report["counts"]["sceneTriangles"])
        self.assertIn("out of view", plan["lights"][3]["note"])
        self.assertEqual(plan["lights"][3]["tiles"], [])

    def test_no_body_means_every_default(self):
        self.assertEqual(self.plan(b"")["spec"], self.plan(b"{}")["spec"])

    def test_a_later_frame_takes_the_range_of_an_earlier_one(self):
        first = self.server.frame(self.scene, SMALL, "application/json").json()["report"]
        previous = first["lights"][0]["depthRange"]
        shadow = {"depthRange": {"previous": previous}, "stabilization": "projectionSnapping"}
        second = self.server.frame(self.scene, SMALL | {"shadow": shadow}, "application/json").json()["report"]
        self.assertEqual(second["lights"][0]["depthRange"], previous)
        self.assertEqual(second["lights"][0]["note"], "")


if __name__ == "__main__":
    unittest.main()
