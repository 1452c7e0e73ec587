"""A system that refuses descriptors, memory or threads: the server goes on, or says why it does not start."""

import os
import resource
import shutil
import socket
import subprocess
import tempfile
import unittest
from pathlib import Path

from redis_place import free_port
from rights import needs_to_see_closed_processes
from shipped_server import BINARY, SLOW, TIMEOUT, Server, environment
from store_test import until

CLOSING_PROBE = b"GET /livez HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n"


@unittest.skipIf(SLOW > 1, "sanitizers want to be loaded first, and all of the address space")
class ShortOfEverything(unittest.TestCase):
    def test_no_error_of_accept_ends_the_server(self):
        compiler = shutil.which("cc")
        self.assertIsNotNone(compiler, "a C compiler makes the library that lets accept() fail")
        with tempfile.TemporaryDirectory() as folder:
            source = Path(folder) / "accept.c"
            source.write_text("""
                #define _GNU_SOURCE
                #include <dlfcn.h>
                #include <errno.h>
                #include <sys/socket.h>
                static int next_fails(void) {
                  static const int errors[] = {ENOBUFS, ENOMEM, ENFILE, EMFILE, ECONNABORTED, EPERM, EINTR, EPROTO};
                  static unsigned calls;
                  unsigned call = calls++;
                  if (call % 2 == 0 || call / 2 >= sizeof errors / sizeof *errors) return 0;
                  errno = errors[call / 2];
                  return 1;
                }
                int accept4(int fd, struct sockaddr *address, socklen_t *length, int flags) {
                  int (*real)(int, struct sockaddr *, socklen_t *, int) = dlsym(RTLD_NEXT, "accept4");
                  return next_fails() ? -1 : real(fd, address, length, flags);
                }
                int accept(int fd, struct sockaddr *address, socklen_t *length) {
                  int (*real)(int, struct sockaddr *, socklen_t *) = dlsym(RTLD_NEXT, "accept");
                  return next_fails() ? -1 : real(fd, address, length);
                }
                """)
            library = Path(folder) / "accept.so"
            subprocess.run([compiler, "-shared", "-fPIC", "-o", library, source, "-ldl"], check=True)
            with Server("--device", "cpu", variables={"LD_PRELOAD": str(library)}) as server:
                for _ in range(12):
                    self.assertEqual(server.get("/livez").status, 200)
                self.assertEqual(server.end(), 0)

    def serves(self, port):
        try:
            with socket.create_connection(("127.0.0.1", port), timeout=TIMEOUT) as connection:
                connection.sendall(CLOSING_PROBE)
                return connection.recv(12) == b"HTTP/1.1 200"
        except ConnectionError:
            return False

    def test_streams_that_are_closed_at_the_start_are_the_null_device(self):
        for closing in ("2>&-", "1>&- 2>&-", "0<&- 1>&- 2>&-"):
            port = free_port()  # what it prints may be lost
            process = subprocess.Popen(
                ["sh", "-c", f'exec "$0" "$@" {closing}', BINARY, "serve", "--port", str(port), "--device", "cpu"],
                stdin=subprocess.PIPE, stdout=subprocess.DEVNULL, env=environment(),
            )  # fmt: skip
            try:
                self.assertTrue(until(lambda port=port: self.serves(port)), closing)
                with self.subTest("its descriptors", closing=closing):
                    needs_to_see_closed_processes()
                    for stream in closing.split():
                        self.assertEqual(os.readlink(f"/proc/{process.pid}/fd/{stream[0]}"), "/dev/null")
            finally:
                process.terminate()
                process.wait(TIMEOUT)
                process.stdin.close()

    def start_and_end(self, resource_kind, limit, *flags):
        return subprocess.run(
            [BINARY, "serve", "--port", "0", "--device", "cpu", *flags],
            preexec_fn=lambda: resource.setrlimit(resource_kind, (limit, limit)),
            capture_output=True, text=True, timeout=TIMEOUT, env=environment(),
        )  # fmt: skip

    def test_more_connections_than_descriptors_keep_nobody_out(self):
        with Server("--device", "cpu", "--http-threads", "8", "--workers", "1", descriptors=256) as server:
            scene = server.upload("box_on_plane")
            silent = [socket.create_connection(server.address, timeout=TIMEOUT) for _ in range(300)]
            for _ in range(20):
                with socket.create_connection(server.address, timeout=TIMEOUT) as connection:
                    connection.sendall(CLOSING_PROBE)
                    self.assertEqual(connection.recv(12), b"HTTP/1.1 200")
            self.assertEqual(server.get(f"/v1/scenes/{scene}/frame?width=16&height=16").status, 200)
            for connection in silent:
                connection.close()

    def test_too_few_descriptors_end_the_start(self):
        ended = self.start_and_end(resource.RLIMIT_NOFILE, 256)
        self.assertEqual(ended.returncode, 1)
        self.assertRegex(ended.stderr, r"too few open files .* at least \d+\. \(256\)")

    def test_refused_threads_are_told_of(self):
        ended = self.start_and_end(resource.RLIMIT_AS, 4 << 30, "--http-threads", "600")
        self.assertEqual(ended.returncode, 1, ended.stderr[-500:])
        self.assertIn("so many threads", ended.stderr)


if __name__ == "__main__":
    unittest.main()
