#!/usr/bin/env python3
"""Each rule of check_includes.py is broken once, in a tree of its own, and has to be named."""

import tempfile
import unittest
from pathlib import Path

import check_includes

# The smallest tree that has every room, and breaks nothing.
SOUND = {
    "protocol/result.h": "",
    "renderer/core/aabb.h": '#include "protocol/result.h"\n',
    "renderer/core/aabb.cpp": '#include "renderer/core/aabb.h"\n\n#include <cmath>\n',
    "renderer/image/image.h": '#include "renderer/core/aabb.h"\n',
    "renderer/image/codec.cpp": "#include <zlib.h>\n",
    "renderer/scene/scene.h": '#include "renderer/image/image.h"\n',
    "renderer/shadow/plan.h": '#include "renderer/core/aabb.h"\n',
    "renderer/rays/trace.h": '#include "renderer/scene/scene.h"\n',
    "renderer/reference/reference.h": '#include "renderer/rays/trace.h"\n',
    "renderer/frame/frame_views.cpp": '#include "renderer/reference/reference.h"\n',
    "renderer/gl/gl.h": "#include <glad/gl.h>\n",
    "renderer/passes/shade.h": '#include "renderer/gl/gl.h"\n#include "renderer/shaders/shared/frame.h"\n',
    "renderer/shaders/shared/frame.h": "",
    "renderer/render.h": '#include "renderer/image/image.h"\n',
    "renderer/passes/gl_device.h": "",
    "renderer/render.cpp": '#include "renderer/render.h"\n\n#include "renderer/passes/gl_device.h"\n',
    "clients/cli/remote/http_client.cpp": "#include <httplib.h>\n",
    "server/http/http_server.cpp": "",
    "server/metrics/readings.h": "",
    "server/redis/redis.cpp": "#include <hiredis/hiredis.h>\n#include <openssl/ssl.h>\n",
    "server/worker/worker.cpp": '#include "renderer/render.h"\n',
    "server/main.cpp": '#include "clients/cli/commands.h"\n#include "clients/web/web_files.h"\n',
    "clients/cli/commands.h": '#include "renderer/image/image.h"\n',
    "clients/web/web_files.h": "",
}

# Path, its text, and words of the one fault that it has to give.
BROKEN = [
    ("protocol/bad.h", '#include "renderer/core/aabb.h"\n', "not below protocol"),
    ("protocol/bad.h", "#include <GL/gl.h>\n", "belongs to renderer/gl alone"),
    ("protocol/bad.cpp", "#include <httplib.h>\n", "belongs to clients/cli/remote/http_client.cpp"),
    ("renderer/core/bad.h", '#include "renderer/image/image.h"\n', "not below renderer/core"),
    ("renderer/scene/bad.h", '#include "renderer/gl/gl.h"\n', "not below renderer/scene"),
    ("renderer/scene/bad.cpp", "#include <zlib.h>\n", "belongs to renderer/image alone"),
    ("renderer/image/bad.cpp", "#include <OpenImageIO/imageio.h>\n", "belongs to tests alone"),
    ("renderer/shadow/bad.cpp", "#include <glad/gl.h>\n", "belongs to renderer/gl"),
    ("renderer/shadow/bad.h", '#include "renderer/scene/scene.h"\n', "not below renderer/shadow"),
    ("renderer/volume/bad.h", '#include "renderer/shadow/plan.h"\n', "not below renderer/volume"),
    ("renderer/rays/bad.cpp", '#include "renderer/reference/reference.h"\n', "not below renderer/rays"),
    ("renderer/frame/bad.cpp", '#include "renderer/reference/reference.h"\n', "not below renderer/frame"),
    ("renderer/cpu/bad.cpp", '#include "renderer/reference/reference.h"\n', "not below renderer/cpu"),
    ("renderer/reference/bad.cpp", "#include <embree3/rtcore.h>\n", "belongs to renderer/rays alone"),
    ("renderer/gl/bad.h", '#include "renderer/passes/shade.h"\n', "not below renderer/gl"),
    ("renderer/passes/bad.h", '#include "renderer/render.h"\n', "not below renderer/passes"),
    ("renderer/attic/bad.h", '#include "protocol/result.h"\n', "has no rule"),
    ("renderer/render2.cpp", '#include "renderer/passes/shade.h"\n', "not below renderer"),
    ("renderer/render2.cpp", '#include "server/main.cpp"\n', "not below renderer"),
    ("server/bad.cpp", '#include "renderer/scene/scene.h"\n', "not below server"),
    ("server/http/bad.cpp", '#include "renderer/render.h"\n', "not below server/http"),
    ("server/http/bad.cpp", '#include "server/metrics/readings.h"\n', "not below server/http"),
    ("server/http/bad.cpp", "#include <hiredis/hiredis.h>\n", "belongs to server/redis alone"),
    ("server/redis/bad.cpp", '#include "server/http/http_server.cpp"\n', "not below server/redis"),
    ("server/http/bad.cpp", "#include <prometheus/counter.h>\n", "belongs to server/metrics alone"),
    ("server/jobs/bad.cpp", '#include "server/http/http_server.cpp"\n', "not below server/jobs"),
    ("server/bad.cpp", '#include "clients/cli/commands.h"\n', "not below server"),
    ("server/bad.cpp", '  #  include "httplib.h"\n', "belongs to clients/cli/remote/http_client.cpp"),
    ("clients/cli/bad.cpp", '#include "server/http/http_server.cpp"\n', "not below clients/cli"),
    ("renderer/core/bad.cpp", '#include "aabb.h"\n', "no file of the tree"),
    ("renderer/core/bad.cpp", "#include <renderer/core/aabb.h>\n", "written in quotes"),
    ("renderer/gl/gl.cpp", '#include <cmath>\n\n#include "renderer/gl/gl.h"\n', "not its first include"),
]


class CheckIncludes(unittest.TestCase):
    def faults(self, changes):
        with tempfile.TemporaryDirectory() as folder:
            root = Path(folder)
            for path, text in {**SOUND, **changes}.items():
                (root / path).parent.mkdir(parents=True, exist_ok=True)
                (root / path).write_text(text, encoding="utf-8")
            return list(check_includes.faults_of_tree(root))

    def test_a_sound_tree_has_no_fault(self):
        self.assertEqual(self.faults({}), [])

    def test_every_broken_rule_is_named(self):
        for path, text, words in BROKEN:
            with self.subTest(path=path, text=text):
                faults = self.faults({path: text})
                self.assertEqual(len(faults), 1, faults)
                self.assertTrue(faults[0].startswith(path), faults[0])
                self.assertIn(words, faults[0])

    def test_the_line_is_named(self):
        fault = self.faults({"protocol/bad.h": '\n\n#include "server/main.cpp"\n'})[0]
        self.assertTrue(fault.startswith("protocol/bad.h:3: "), fault)


if __name__ == "__main__":
    unittest.main()
