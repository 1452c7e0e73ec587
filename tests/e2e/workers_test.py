"""Workers end, hang, grow and are taken over: other requests are served, and nothing that was stored is lost."""

import ctypes
import glob
import json
import os
import re
import signal
import subprocess
import tempfile
import threading
import time
import unittest
from pathlib import Path

from extreme_scene import demo_with
from rights import needs_to_see_closed_processes
from shipped_server import SCENES, SLOW, SMALL, Server, ServerTest, await_end, form, started_by, workers_of

FAULTY = os.environ["GNOMON_FAULTY_WORKER"]


def has_landlock():
    """Whether the kernel says its version (landlock_create_ruleset(2))."""
    create_ruleset, version = 444, 1
    return ctypes.CDLL(None).syscall(create_ruleset, None, 0, version) > 0


def leads_to(link):
    """Where a link of /proc leads; "" where what it told of has just ended."""
    try:
        return os.readlink(link)
    except OSError:
        return ""


class Load:
    """Clients that ask for small frames until they are told to stop; how often each status came."""

    def __init__(self, server, scene, clients=4):
        self.server, self.scene = server, scene
        self.statuses, self.refusals, self.longest, self.stopping = {}, [], 0, False
        self.lock = threading.Lock()
        self.threads = [threading.Thread(target=self.ask, args=(index,)) for index in range(clients)]

    def ask(self, index):
        count = 0
        while not self.stopping:
            count += 1
            begun = time.monotonic()
            reply = self.server.frame(self.scene, SMALL | {"exposure": index + count / 1000})
            with self.lock:
                self.statuses[reply.status] = self.statuses.get(reply.status, 0) + 1
                if reply.status != 200:
                    self.refusals.append(reply.body)
                self.longest = max(self.longest, time.monotonic() - begun)

    def __enter__(self):
        for thread in self.threads:
            thread.start()
        return self

    def __exit__(self, *_):
        self.stopping = True
        for thread in self.threads:
            thread.join()


class Liveness:
    """Asks /livez all the while; the longest that it took."""

    def __init__(self, server):
        self.server, self.longest, self.failures, self.stopping = server, 0, 0, False
        self.thread = threading.Thread(target=self.ask)

    def ask(self):
        while not self.stopping:
            begun = time.monotonic()
            if self.server.get("/livez").status != 200:
                self.failures += 1
            self.longest = max(self.longest, time.monotonic() - begun)
            time.sleep(0.01)

    def __enter__(self):
        self.thread.start()
        return self

    def __exit__(self, *_):
        self.stopping = True
        self.thread.join()


class KilledWorkers(unittest.TestCase):
    def test_every_worker_is_killed_again_and_again_under_load(self):
        with tempfile.TemporaryDirectory() as directory, Server("--workers", "2", "--store", directory) as server:
            scene = server.upload("box_on_plane")
            before = workers_of(server)
            self.assertEqual(len(before), 2)
            with Liveness(server) as liveness, Load(server, scene) as load:
                for _ in range(3):
                    time.sleep(1)
                    for pid in workers_of(server):
                        os.kill(pid, signal.SIGKILL)
                time.sleep(2)
            self.assertEqual(load.refusals, [], "each frame is tried again")
            self.assertGreater(load.statuses[200], 20)
            self.assertEqual(liveness.failures, 0)
            self.assertLess(liveness.longest, 1 * SLOW)
            self.assertFalse(before & workers_of(server))
            self.assertIn(scene.encode(), server.get("/v1/scenes").body)
            self.assertEqual(server.get("/readyz").status, 200)

    def test_workers_go_with_the_server(self):
        with Server() as server:
            below = started_by(server.process.pid)
            self.assertLessEqual(workers_of(server), {pid for pid, _ in below})
            server.end(signal.SIGKILL)
            self.assertEqual(await_end(below, 10 * SLOW), set())

    def test_their_heaps_ask_for_huge_pages_beside_what_else_is_set(self):
        needs_to_see_closed_processes()
        for own, told in ((None, "glibc.malloc.hugetlb=1"),
                          ("glibc.malloc.perturb=7", "glibc.malloc.perturb=7:glibc.malloc.hugetlb=1"),
                          ("glibc.malloc.hugetlb=0", "glibc.malloc.hugetlb=0")):
            with Server(variables={} if own is None else {"GLIBC_TUNABLES": own}) as server:
                scene = server.upload("box_on_plane")
                self.assertEqual(server.frame(scene, SMALL).status, 200)
                for pid in workers_of(server):
                    variables = "\0" + Path(f"/proc/{pid}/environ").read_text()
                    # The loader puts an end after each tunable.
                    self.assertIn(f"\0GLIBC_TUNABLES={told}\0".replace(":", "\0"), variables)
                    self.assertEqual(variables.count("\0GLIBC_TUNABLES="), 1)
                    self.assertEqual(variables.count("glibc.malloc.hugetlb"), 1)

    def test_a_ctrl_c_meets_the_server_alone(self):
        with Server() as server:
            scene = server.upload("box_on_plane")
            for pid in workers_of(server):
                os.kill(pid, signal.SIGINT)
                os.kill(pid, signal.SIGTERM)
            self.assertEqual(server.frame(scene, SMALL).status, 200)
            self.assertNotIn("ended with", server.settled_log())


class SealedWorkers(unittest.TestCase):
    def rights(self, pid):
        lines = Path(f"/proc/{pid}/status").read_text().splitlines()
        return dict(line.split(":\t", 1) for line in lines if ":\t" in line)

    def assert_sealed(self, pid):
        end = time.monotonic() + 30 * SLOW  # it may be starting still
        while (rights := self.rights(pid))["Seccomp"] != "2" and time.monotonic() < end:
            time.sleep(0.05)
        self.assertEqual((rights["Seccomp"], rights["NoNewPrivs"]), ("2", "1"))
        for capabilities in ("CapEff", "CapPrm", "CapInh"):
            self.assertEqual(int(rights[capabilities], 16), 0)

    def test_workers_keep_no_right_that_they_do_not_need(self):
        with Server("--workers", "2", "--device", "cpu") as server:
            scene = server.upload("box_on_plane")
            self.assertEqual(server.frame(scene, SMALL | {"output": {"format": "exr"}}).status, 200)
            for pid in workers_of(server):
                self.assert_sealed(pid)
            with self.subTest("files of work that is done"):
                needs_to_see_closed_processes()
                for pid in workers_of(server):
                    names = {leads_to(entry).split(":")[0] for entry in Path(f"/proc/{pid}/fd").iterdir()}
                    self.assertIn("/dev/null", names)
                    self.assertFalse({name for name in names if name.endswith((".bundle", ".map"))})

    def test_what_starts_the_reader_of_a_volume_is_sealed_and_names_are_no_paths(self):
        with Server("--workers", "1", "--device", "cpu") as server:
            model, ball = (SCENES / "box_on_plane.glb").read_bytes(), (SCENES / "ball.vdb").read_bytes()

            def drawn(grid):
                volume = {"file": "ball.vdb", "grid": grid, "box": {"min": [-3, 2, -3], "max": [3, 5, 3]},
                          "transferFunction": [{"value": 0}, {"value": 5, "extinction": 5}]}
                body, content_type = form([("scene", "a.glb", model), ("file", "ball.vdb", ball),
                                           ("spec", None, json.dumps(SMALL | {"volumes": [volume]}).encode())])
                return server.ask("POST", "/v1/render", body, {"Content-Type": content_type})

            self.assertEqual(drawn("density").status, 200)
            for grid in ("/bin/sh", "density\n/bin/sh", "density\0", "x" * 255, "\U00010000" * 255):
                refused = drawn(grid)
                self.assertIn(refused.status, (400, 422), refused.body)
                self.assertTrue(refused.pointers()[0].startswith("/volumes/0"), refused.pointers())
            self.assertEqual(drawn("density").status, 200)
            (worker,) = workers_of(server)
            starters = {pid for pid, _ in started_by(worker)}
            self.assertEqual(len(starters), 1, "the readers have ended")
            self.assert_sealed(starters.pop())

    def test_workers_that_draw_by_opengl_are_sealed_too(self):
        with Server("--workers", "1", "--device", "gl") as server:
            scene = server.upload("box_on_plane")
            for technique in ("shadowMap", "shadowVolume"):
                reply = server.frame(scene, SMALL | {"shadow": {"technique": technique}}, "application/json")
                self.assertEqual(reply.status, 200, reply.body)
            (only,) = workers_of(server)
            self.assert_sealed(only)


def has_gpu():
    return bool(glob.glob("/dev/dri/render*")) or any(map(os.path.exists, ("/dev/nvidiactl", "/dev/kfd", "/dev/dxg", "/dev/mali0")))


@unittest.skipIf(has_gpu(), "this machine has a GPU")
class WithoutGpu(unittest.TestCase):
    def test_auto_loads_no_driver_and_refuses_opengl(self):
        with Server("--workers", "1") as server:
            scene = server.upload("box_on_plane")
            self.assertEqual(server.frame(scene, SMALL).status, 200)
            refused = server.frame(scene, SMALL | {"device": "gl"})
            self.assertEqual((refused.status, refused.pointers()), (422, ["/device"]), refused.body)
            self.assertIn("start with --device gl", refused.json()["problems"][0]["detail"])
            (only,) = workers_of(server)
            with self.subTest("loaded libraries"):
                needs_to_see_closed_processes()
                mapped = Path(f"/proc/{only}/maps").read_text()
                self.assertIn("libc.so", mapped)
                self.assertNotRegex(mapped, "libEGL|libGL|OSMesa|_dri|libLLVM")


class TakenOverWorkers(unittest.TestCase):
    """A real worker runs injected code once it is sealed (tests/server/worker/escapes.cpp)."""

    DRIVERS_NEED = {"map code", "make memory code", "read a library"}

    def escapes(self, *flags):
        """What it could do to a server and its files."""
        with (tempfile.NamedTemporaryFile() as secret,
              Server("--workers", "1", "--worker-program", FAULTY, *flags, variables={"TEST_SECRET": secret.name}) as server):
            scene = server.upload("box_on_plane")
            self.assertEqual(server.frame(scene, SMALL).status, 200)
            reply = server.frame(scene, SMALL | {"camera": {"node": "fault-escape"}}, Prefer="wait=3")
            self.assertEqual(reply.status, 504, reply.body)
            self.assertIn("escape: tried all", server.settled_log())
            self.assertEqual(server.get("/livez").status, 200)
            return set(re.findall("^escape: could (.*)$", server.log_text(), re.MULTILINE))

    def test_one_that_draws_by_the_processor_gets_nowhere(self):
        self.assertEqual(self.escapes("--device", "cpu"), set())

    @unittest.skipUnless(has_landlock(), "this kernel has no Landlock")
    def test_one_that_draws_by_opengl_reads_what_drivers_read(self):
        self.assertEqual(self.escapes("--device", "gl"), self.DRIVERS_NEED)


@unittest.skipUnless(os.geteuid() == 0, "another user is needed")
class ClosedProcesses(unittest.TestCase):
    """Processes of the same user can't look into the front, its workers, and what starts the readers of VDB files."""

    flags = ("--workers", "1", "--device", "cpu")
    AS_ANOTHER = ("setpriv", "--reuid=65532", "--regid=65532", "--clear-groups")

    def assert_memory_is_known(self, server):
        scene = server.upload("box_on_plane")
        self.assertEqual(server.frame(scene, SMALL).status, 200)
        resident = re.search(rb"^gnomon_workers_resident_bytes (\S+)$", server.get("/metrics").body, re.MULTILINE)
        self.assertGreater(float(resident[1]), 1 << 20)

    def test_their_memory_and_variables_are_the_systems(self):
        with Server(*self.flags, by=self.AS_ANOTHER) as server:
            self.assert_memory_is_known(server)
            below = {pid for pid, _ in started_by(server.process.pid)}
            self.assertGreaterEqual(len(below), 2, "a worker, and its starter")
            for pid in below | {server.process.pid}:
                self.assertEqual(os.stat(f"/proc/{pid}/environ").st_uid, 0, "root's: the process is not dumpable")
                self.assertIn("Uid:\t65532", Path(f"/proc/{pid}/status").read_text())

    def test_the_front_knows_a_workers_memory_where_the_system_hides_closed_processes(self):
        """As systemd's ProtectProc=invisible does."""
        hidden = ("unshare", "--mount", "sh", "-c", 'mount -t proc -o hidepid=invisible proc /proc && exec "$@"', "sh")
        tried = subprocess.run([*hidden, "true"], capture_output=True, text=True)
        if tried.returncode != 0:
            self.skipTest(f"processes can't be hidden here: {tried.stderr.strip()}")
        with Server(*self.flags, by=(*hidden, *self.AS_ANOTHER)) as server:
            self.assert_memory_is_known(server)


class FaultyWorkers(ServerTest):
    """A frame's camera names what its worker does wrong."""

    flags = ("--workers", "2", "--worker-program", FAULTY, "--device", "cpu")

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.scene = cls.server.upload("box_on_plane")

    def replaced(self):
        lines = self.server.get("/metrics").body.decode().splitlines()
        return sum(float(line.split()[-1]) for line in lines if line.startswith("gnomon_worker_replacements_total{"))

    def assert_harmless(self, fault, statuses, client, **headers):
        """The frame gets one of these statuses; all others are drawn, and /livez never blinks."""
        with Liveness(self.server) as liveness, Load(self.server, self.scene, 2) as load:
            time.sleep(0.3)
            spec = SMALL | {"camera": {"node": fault}}
            reply = self.server.frame(self.scene, spec, client=client, **headers)
        self.assertIn(reply.status, statuses, reply.body)
        self.assertEqual(load.refusals, [])
        self.assertEqual(liveness.failures, 0)
        self.assertLess(liveness.longest, 1 * SLOW)
        return reply

    def test_a_frame_that_aborts(self):
        reply = self.assert_harmless("fault-abort", {500}, "127.0.0.2")
        self.assertIn("Two workers ended over this request", reply.json()["problems"][0]["detail"])

    def test_a_frame_that_loops(self):
        begun = time.monotonic()
        reply = self.assert_harmless("fault-loop", {504}, "127.0.0.3", Prefer="wait=2")
        self.assertEqual(reply.json()["problems"][0]["limit"], "2 seconds")
        self.assertLess(time.monotonic() - begun, 8 * SLOW)

    def test_a_worker_that_speaks_nonsense(self):
        self.assert_harmless("fault-garbage", {500}, "127.0.0.4")

    def test_what_ended_two_workers_is_not_tried_a_third_time(self):
        spec = SMALL | {"camera": {"node": "fault-abort again"}}
        first = self.server.frame(self.scene, spec, client="127.0.0.5")
        self.assert_problem(first, 500)
        self.assertNotIn("Retry-After", first.headers)
        before = self.replaced()
        for client in ("127.0.0.5", "127.0.0.6"):
            reply = self.server.frame(self.scene, spec, client=client)
            self.assert_problem(reply, 500)
            detail = reply.json()["problems"][0]["detail"]
            self.assertRegex(detail, "^Two workers ended over .* It is not tried again before [23][0-9][0-9] seconds")
            self.assertIn(int(reply.headers["Retry-After"]), range(200, 301))
        self.assertEqual(self.replaced(), before)

    def test_a_client_costs_a_few_workers_a_minute(self):
        before = self.replaced()
        statuses = []
        for number in range(5):
            spec = SMALL | {"camera": {"node": f"fault-abort {number}"}}
            reply = self.server.frame(self.scene, spec, client="127.0.0.7")
            statuses.append(reply.status)
        self.assertEqual(statuses, [500, 500, 429, 429, 429])
        self.assertIn(int(reply.headers["Retry-After"]), range(1, 61))
        self.assertEqual(self.replaced() - before, 4)
        self.assertEqual(self.server.frame(self.scene, SMALL).status, 200)


class ExtremeNumbers(ServerTest):
    """A vertex far from all others: Embree once ended the process over it."""

    flags = ("--workers", "2", "--device", "cpu")
    WAYS = (
        {"shadow": {"technique": "rayTraced"}},
        {"shadow": {"technique": "lightMap", "lightMap": {"size": 512}}},
        {"views": ["error"]},
        {"quality": {"maxError": 0.01}},
        {"shadow": {"technique": "shadowMap"}},
    )

    def rendered(self, scene, spec):
        body, content_type = form([("scene", "scene.glb", scene), ("spec", None, json.dumps(spec).encode())])
        return self.server.ask("POST", "/v1/render", body, {"Content-Type": content_type})

    def test_a_place_that_is_out_of_reach_is_a_problem_with_its_node(self):
        for mesh, node, value in (("gold", "gold", 1e10), ("gold", "gold", 3e38), ("tree 1", "tree 1", -1e11)):
            for way in self.WAYS:
                reply = self.rendered(demo_with(mesh, value), {"width": 32, "height": 24} | way)
                self.assert_problem(reply, 422)
                self.assertIn(f'"{node}"', reply.json()["problems"][0]["actual"])
        scaled = demo_with(None, None, lambda gltf: gltf["nodes"][26].update(scale=[1e38, 1e38, 1e38]))
        self.assert_problem(self.rendered(scaled, {"width": 32, "height": 24}), 422, "/nodes/26")
        self.assert_no_worker_ended()

    def test_a_place_that_is_far_but_within_reach_is_drawn(self):
        for value in (1e9, 1.9e9):
            for way in self.WAYS:
                reply = self.rendered(demo_with("gold", value), {"width": 32, "height": 24} | way)
                self.assertEqual(reply.status, 200, (value, way, reply.body[:500]))
        self.assert_no_worker_ended()

    def assert_no_worker_ended(self):
        self.assertNotIn("ended with", self.server.settled_log())


if __name__ == "__main__":
    unittest.main()
