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
    "redis-password-file": '"/run/secrets/password"',
    "redis-authorities": '"/etc/ssl/redis.pem"',
    "jobs": '"redis://queue.example:6380/1"',
    "worker-program": '"/opt/choose gpu"',
    "device": '"gl"',
    "drake-spec": '"/etc/gnomon/drake.json"',
    "backend": '"osmesa"',
    "require-gpu": "true",
    "until-stdin-closes": "true",
}


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
        self.assert_refused(serve("--print-config", "--config", self.write("port = ''\n")), ":1: port: ")

    def test_sizes_and_times_have_units_in_the_file_too(self):
        file = self.write("reply-cache-bytes = 2MB\ntile-cache-bytes = '1 GB'\nstore-age = 30d\nrequest-timeout = 2m\n")
        options = options_in(printed("--config", file))
        self.assertEqual([options[key] for key in ("reply-cache-bytes", "tile-cache-bytes", "store-age", "request-timeout")],
                         [str(2 << 20), str(1 << 30), "2592000", "120"])  # fmt: skip

    def test_a_wrong_file_is_refused_with_every_line(self):
        file = self.write("bind = '::1'\nworkrs = 2\nport = 99999\nrequire-gpu = maybe\ngrace = [1, 2]\nstore\nconfig = 'x'\n")
        self.assert_refused(serve("--print-config", "--config", file), f"{file}:6: This is not KEY = VALUE.")
        file = self.write("bind = '::1'\nworkrs = 2\nport = 99999\nrequire-gpu = maybe\ngrace = [1, 2]\nconfig = 'x'\n")
        self.assert_refused(
            serve("--config", file), f"{file}:2: There is no key workrs; did you mean workers?", f"{file}:3: port: ",
            "99999", f"{file}:4: require-gpu: ", f"{file}:5: grace: ", f"{file}:6: There is no key config",
        )  # fmt: skip

    def test_a_wrong_value_is_refused_where_a_flag_comes_before_it_too(self):
        self.assert_refused(serve("--port", "0", "--config", self.write("port = no\n")), f"{self.file}:1: port: ")

    def test_an_address_without_its_port_is_refused(self):
        done = serve("--config", self.write("admin-bind = '0.0.0.0'\n"))
        self.assertEqual(done.returncode, 1)
        self.assertIn("--admin-bind is an address of --admin-port", done.stderr)
        self.assert_refused(serve(GNOMON_ADMIN_BIND="0.0.0.0"), "--admin-port")

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
        for file in ("require-gpu = true\n", "device = cpu\nrequire-gpu = true\n"):
            self.assert_refused(serve("--config", self.write(file), "--device", "cpu"), f"{self.file}: {gpu}")
        self.assert_refused(serve("--config", self.write("backend = egl\ndevice = cpu\n")), context)
        printed("--device", "cpu", "--backend", "auto", "--require-gpu=false")

    def test_a_server_runs_by_its_file(self):
        with Server("--config", self.write("device = cpu\nqueue-limit = 1\n")) as server:
            self.assertEqual(server.get("/livez").status, 200)
            self.assertEqual(server.get("/v1/capabilities").json()["renderer"]["device"], "cpu")


if __name__ == "__main__":
    unittest.main()
