"""Options from flags, variables and a file: which comes first, what is refused, and what --print-config prints."""

import re
import subprocess
import tempfile
import unittest
from pathlib import Path

from shipped_server import BINARY, TIMEOUT, Server, environment

USAGE = 2

# A value of each option that is not its default, as the file has it.
OTHER = {
    "bind": '"0.0.0.0"',
    "port": "8123",
    "admin-port": "9123",
    "admin-bind": '"0.0.0.0"',
    "trusted-proxies": '["10.0.0.0/8"]',
    "allowed-hosts": '["a.example", "b.example"]',
    "allowed-origins": '["https://page.example"]',
    "keys": r'"/etc/a \"quoted\" # place\\with everything"',
    "store": '"/var/lib/scenes and more"',
    "store-bytes": "20000000000",
    "redis-password-file": '"/run/secrets/password"',
    "redis-authorities": '"/etc/ssl/redis.pem"',
    "jobs": '"rediss://queue.example:6380/1"',
    "worker-program": '"/opt/choose gpu"',
    "device": '"gl"',
    "drake-spec": '"/etc/gnomon/drake.json"',
    "backend": '"osmesa"',
    "require-gpu": "true",
    "until-stdin-closes": "true",
}

# Those of which nothing may be kept.
CACHES = ("gpu-scene-bytes", "tile-cache-bytes", "traced-scene-bytes", "light-map-bytes", "stored-light-map-bytes",
          "volume-bytes", "reply-cache-bytes", "store-bytes")  # fmt: skip


def serve(*flags, **variables):
    return subprocess.run([BINARY, "serve", *flags], capture_output=True, text=True, timeout=TIMEOUT,
                          env=environment(**variables))  # fmt: skip


def options_in(text):
    """Of a printed configuration: key -> value as it stands there."""
    lines = [line for line in text.splitlines() if line and not line.startswith("#")]
    return dict(line.split(" = ", 1) for line in lines)


def printed(*flags, **variables):
    done = serve("--print-config", *flags, **variables)
    assert done.returncode == 0, done.stderr
    return done.stdout


class Configuration(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.file = Path(folder.name) / "gnomon.conf"

    def write(self, text):
        self.file.write_text(text)
        return str(self.file)

    def assert_refused(self, done, *words):
        self.assertEqual(done.returncode, USAGE, done.stderr)
        self.assertEqual(done.stdout, "")
        for each in words:
            self.assertIn(each, done.stderr)

    def test_what_is_printed_is_read_back(self):
        text = printed()
        self.assertEqual(printed("--config", self.write(text)), text)

    def test_every_option_is_printed_and_read_back(self):
        flags = set(re.findall(r"^\s+--([a-z-]+)", serve("--help").stdout, re.MULTILINE))
        usual = options_in(printed())
        self.assertEqual(set(usual), flags - {"config", "print-config", "help"})
        other = {key: OTHER.get(key) or str(int(value) + 1) for key, value in usual.items()}
        for key in usual:
            self.assertNotEqual(other[key], usual[key], key)
        text = "".join(f"{key} = {value}\n" for key, value in other.items())
        self.assertEqual(options_in(printed("--config", self.write(text))), other)

    def test_the_flag_comes_before_the_variable_before_the_file(self):
        file = self.write("port = 1\ngrace = 2\ndrain = 3\nrequire-gpu = true\nallowed-hosts = ['file']\n")
        options = options_in(printed("--port", "11", "--require-gpu=false", GNOMON_CONFIG=file, GNOMON_LISTEN_PORT="12",
                                     GNOMON_GRACE="13", GNOMON_ALLOWED_HOSTS="x,y"))  # fmt: skip
        self.assertEqual([options[key] for key in ("port", "grace", "drain", "require-gpu", "allowed-hosts", "workers")],
                         ["11", "13", "3", "false", '["x", "y"]', "0"])  # fmt: skip

    def test_the_flag_names_the_file_before_the_variable_does(self):
        named = self.write("port = 5\n")
        self.assertEqual(options_in(printed("--config", named, GNOMON_CONFIG="/nowhere"))["port"], "5")

    def test_an_empty_value_is_that_of_an_option_nobody_set_where_it_has_no_other(self):
        usual = printed()
        for key in ("admin-port", "keys", "store"):
            self.assertEqual(printed("--config", self.write(f"{key} = ''\n")), usual, key)
        self.assert_refused(serve("--print-config", "--config", self.write("port = ''\n")), ":1: --port: ")

    def test_an_empty_variable_counts_as_none(self):
        self.assertEqual(printed(GNOMON_LISTEN_PORT="", GNOMON_STORE="", GNOMON_MAX_SCENE_BYTES=""), printed())

    def test_sizes_and_times_have_units_in_the_file_too(self):
        file = self.write("store = a\nreply-cache-bytes = 2MB\ntile-cache-bytes = '1 GB'\nstore-age = 30d\nrequest-timeout = 2m\n")
        options = options_in(printed("--config", file))
        self.assertEqual([options[key] for key in ("reply-cache-bytes", "tile-cache-bytes", "store-age", "request-timeout")],
                         [str(2 << 20), str(1 << 30), "2592000", "120"])  # fmt: skip

    def test_a_wrong_file_is_refused_with_every_line(self):
        file = self.write(
            "bind = '::1'\nworkrs = 2\nport = 99999\nrequire-gpu = maybe\ngrace = [1, 2]\nstore\nconfig = 'x'\n[more]\n"
            "request-timeout = 'abc'\nkeys = '/nowhere/keys'\ntrusted-proxies = ['127.0.0.1', 'foo']\nadmin-bind = '0.0.0.0'\n"
            "device = cpu\nbackend = egl\nmax-scene-bytes = -1\nupload-memory-bytes = 1MB\n"
        )
        self.assert_refused(
            serve("--config", file), f"{file}:2: There is no key workrs; did you mean workers?", f"{file}:3: --port: 99999 is",
            f"{file}:4: --require-gpu: ", f"{file}:5: --grace: ", f"{file}:6: This is not KEY = VALUE.",
            f"{file}:7: There is no key config", f"{file}:8: There are no sections", f"{file}:9: --request-timeout: abc is",
            f"{file}:10: --keys: ", f"{file}:11: --trusted-proxies: foo: ", f"{file}:12: --admin-bind is an address of",
            f"{file}:14: --backend chooses", f"{file}:15: --max-scene-bytes: -1 is",
        )  # fmt: skip
        self.assertEqual(len(serve("--config", file).stderr.splitlines()), 13, "and nothing follows from a wrong value")

    def test_a_wrong_value_is_refused_where_a_flag_comes_before_it_too(self):
        self.assert_refused(serve("--port", "0", "--config", self.write("port = no\n")), f"{self.file}:1: --port: ")

    def assert_refused_everywhere(self, key, value, words):
        """By flag, variable and file, in the same words."""
        variable = "GNOMON_" + key.upper().replace("-", "_").replace("PORT", "LISTEN_PORT")
        self.assert_refused(serve(f"--{key}={value}"), f"--{key}: {words}")
        self.assert_refused(serve(**{variable: value}), f"--{key}: {words}")
        self.assert_refused(serve("--config", self.write(f"{key} = '{value}'\n")), f"{self.file}:1: --{key}: {words}")

    def test_every_number_has_a_range(self):
        for key, value in options_in(printed()).items():
            if not value.isdigit():
                continue
            with self.subTest(option=key):
                sizes = key.endswith("-bytes")
                self.assert_refused_everywhere(key, "-1", "-1 is not within ")
                self.assert_refused_everywhere(key, "2PB" if sizes else "99999999999", "2PB is not" if sizes else "999")
                for other in ("18446744073709551615", "18446744073709551617", "1.5", "0x1", "1e3", "abc", "1XB", "+1"):
                    self.assert_refused(serve(f"--{key}={other}"), f"--{key}: {other} is not within ")
                if key in CACHES:
                    self.assertEqual(options_in(printed(f"--{key}=1PB", "--store=/x"))[key], str(1 << 50))

    def test_a_limit_that_would_refuse_everything_is_refused(self):
        for key in ("upload-memory", "scene-memory", "frame-memory", "reply-memory", "bundle-memory", "video-memory"):
            self.assert_refused_everywhere(f"{key}-bytes", "0", "0 is not within 1KB..1PB, with units KB, MB, GB, TB and PB.")
        self.assert_refused_everywhere("max-scene-bytes", "0", "0 is not within 1KB..1PB")
        self.assert_refused_everywhere("job-bytes", "0", "0 is not within 1KB..1PB")
        for key in CACHES:
            self.assertEqual(options_in(printed(f"--{key}=0"))[key], "0")

    def test_limits_that_contradict_each_other_are_refused(self):
        scene = "--max-scene-bytes (1048577) is more than --{} (1048576): the largest scenes would always be refused."
        for other in ("upload-memory-bytes", "bundle-memory-bytes", "store-bytes"):
            stored = ["--store", "redis://host"] if other == "store-bytes" else []
            with self.subTest(option=other):
                self.assert_refused(serve("--max-scene-bytes=1048577", f"--{other}=1MB", *stored), scene.format(other))
                printed("--max-scene-bytes=1MB", f"--{other}=1MB", *stored)
                file = self.write(f"port = 1\nmax-scene-bytes = 1048577\n{other} = 1MB\n")
                self.assert_refused(serve("--config", file, *stored), f"{file}:2: " + scene.format(other))
                self.write(f"{other} = 1MB\n")
                self.assert_refused(serve("--config", file, "--max-scene-bytes=1048577", *stored), f"{file}:1: --max-scene")
        printed("--max-scene-bytes=2MB", "--bundle-memory-bytes=1MB", "--store", "/a/directory")
        self.assert_refused(serve("--admin-port=8080"), "--admin-port is the port of --port")
        self.assert_refused(serve("--admin-port=8080", "--bind=0.0.0.0"), "--admin-port is the port of --port")
        printed("--admin-port=8080", "--bind=127.0.0.2")

    def test_a_store_that_is_no_store_is_refused(self):
        for value, words in (
            ("http://foo/", "It is neither a directory nor an address that begins with redis:// or rediss://."),
            ("s3://:secret@bucket", "It is neither"), ("file:///var/lib", "It is neither"), ("REDIS2://host", "It is neither"),
            ("redis://", "The Redis address has no valid host"), ("redis://h:99999", "The port of the Redis address is out of"),
            ("redis:host", "The Redis address does not begin"), ("redis://host/x", "The database of the Redis address"),
        ):  # fmt: skip
            with self.subTest(store=value):
                self.assert_refused_everywhere("store", value, words)
        for value in ("http://foo/", "/tmp", "redis://h:99999"):
            self.assert_refused_everywhere("jobs", value, "The ")
        printed("--store", "http:/a-folder")

    def test_what_could_never_match_is_refused(self):
        for key, values in {
            "allowed-hosts": ("a b", "http://render.example", "render.example/"),
            "allowed-origins": ("example.com", "https://a.example/", "https://a.example:443", "https://a b"),
            "trusted-proxies": ("foo", "10.0.0.1/8", "10.0.0.0/33"),
            "bind": ("127.0.0.1:8080", "http://127.0.0.1", "a b"),
        }.items():
            for value in values:
                with self.subTest(option=key, value=value):
                    self.assert_refused_everywhere(key, value, value)
        printed("--allowed-hosts=*,a.example,[::1]:8080", "--allowed-origins=null,http://a.example:8080", "--bind=fe80::1%lo")

    def test_a_file_that_an_option_names_is_read_at_the_start(self):
        text = str(self.file.parent / "text")
        Path(text).write_text("{")
        for key, more in (
            ("keys", []), ("drake-spec", []), ("worker-program", []),
            ("redis-password-file", ["--store=redis://h"]), ("redis-authorities", ["--store=rediss://h"]),
        ):  # fmt: skip
            wrong = ["/nowhere/at-all", str(self.file.parent)] + ([] if key == "redis-password-file" else [text])
            for value in wrong if key != "worker-program" else ["/nowhere/at-all", text]:
                with self.subTest(option=key, value=value):
                    self.assert_refused(serve(f"--{key}={value}", *more), f"gnomon: --{key}: ")
                    file = self.write(f"grace = 1\n{key} = '{value}'\n")
                    self.assert_refused(serve("--config", file, *more), f"{file}:2: --{key}: ")

    def test_an_option_that_means_nothing_alone_is_refused(self):
        for key, value, more in (
            ("admin-bind", "0.0.0.0", []), ("store-bytes", "1GB", []), ("store-age", "30d", []), ("jobs", "redis://h", []),
            ("redis-password-file", "/a", []), ("redis-authorities", "/a", ["--store=/b"]),
        ):  # fmt: skip
            with self.subTest(option=key):
                self.assert_refused(serve(f"--{key}={value}", *more), f"--{key}")
                self.assert_refused(serve("--config", self.write(f"{key} = '{value}'\n"), *more), f"{self.file}:1: ", f"--{key}")

    def test_a_port_that_is_taken_is_no_fault_of_the_options(self):
        with Server("--device", "cpu") as server:
            done = serve("--device", "cpu", "--port", str(server.address[1]))
            self.assertEqual(done.returncode, 1, done.stderr)

    def test_a_file_that_is_not_there_is_refused(self):
        self.assert_refused(serve("--config", str(self.file)), str(self.file), "No such file")
        self.assert_refused(serve("--config", str(self.file.parent)), str(self.file.parent), "can't be read")
        self.assert_refused(serve(GNOMON_CONFIG=str(self.file)), str(self.file))

    def test_a_misspelt_variable_is_refused(self):
        self.assert_refused(serve(GNOMON_STOR="/x"), "GNOMON_STOR; did you mean GNOMON_STORE?")
        self.assert_refused(serve(GNOMON_PORT="8080"), "GNOMON_PORT; did you mean GNOMON_LISTEN_PORT?")

    def test_variables_of_others_are_left_alone(self):
        printed(GNOMON_CPU_TARGET="sse4", GNOMON_KEY="x", GNOMON_URL="http://localhost", GNOMON_SERVICE_HOST="10.0.0.1",
                GNOMON_PORT="tcp://10.0.0.1:80", GNOMON_PORT_8080_TCP_ADDR="10.0.0.1",
                GNOMON_BINARY="/usr/bin/gnomon", GNOMON_SERVER="http://localhost")  # fmt: skip

    def test_a_gpu_beside_the_processor_is_refused_wherever_both_are_from(self):
        gpu, context = "--require-gpu asks for a GPU, and --device cpu uses none", "--backend chooses OpenGL's context"
        self.assert_refused(serve("--require-gpu", "--device", "cpu"), gpu)
        self.assert_refused(serve("--device", "cpu", GNOMON_REQUIRE_GPU="true"), gpu)
        self.assert_refused(serve(GNOMON_DEVICE="cpu", GNOMON_BACKEND="egl"), context)
        for file in ("require-gpu = true\n", "require-gpu = true\ndevice = cpu\n"):
            self.assert_refused(serve("--config", self.write(file), "--device", "cpu"), f"{self.file}:1: {gpu}")
        self.assert_refused(serve("--config", self.write("backend = egl\ndevice = cpu\n")), context)
        printed("--device", "cpu", "--backend", "auto", "--require-gpu=false")

    def test_a_server_runs_by_its_file(self):
        with Server("--config", self.write("device = cpu\nqueue-limit = 1\n")) as server:
            self.assertEqual(server.get("/livez").status, 200)
            self.assertEqual(server.get("/v1/capabilities").json()["renderer"]["device"], "cpu")

    def test_a_server_that_keeps_nothing_draws(self):
        with Server("--device", "cpu", *(f"--{key}=0" for key in CACHES if key != "store-bytes")) as server:
            scene = server.upload("box_on_plane")
            for technique in ("shadowMap", "rayTraced", "lightMap"):
                for _ in range(2):
                    spec = {"width": 64, "height": 48, "shadow": {"technique": technique}}
                    self.assertEqual(server.frame(scene, spec).status, 200, technique)


if __name__ == "__main__":
    unittest.main()
