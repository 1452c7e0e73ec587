"""A system that refuses descriptors, memory or threads: the server goes on, or says why it does not start."""

import resource
import shutil
import socket
import subprocess
import tempfile
import unittest
from pathlib import Path

from shipped_server import BINARY, SLOW, TIMEOUT, Server, environment

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

    def test_a_server_without_descriptors_serves_on_when_it_has_some(self):
        process = subprocess.Popen(
            [BINARY, "serve", "--port", "0", "--device", "cpu"],
            preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_NOFILE, (64, 64)),
            stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True, env=environment(),
        )  # fmt: skip
        try:
            port = int(process.stdout.readline().rsplit(":", 1)[1])
            silent = [socket.create_connection(("127.0.0.1", port), timeout=TIMEOUT) for _ in range(100)]
            with socket.create_connection(("127.0.0.1", port), timeout=TIMEOUT) as connection:
                connection.sendall(CLOSING_PROBE)
                self.assertEqual(connection.recv(12), b"HTTP/1.1 200")
            for connection in silent:
                connection.close()
            self.assertIsNone(process.poll())
        finally:
            process.kill()
            process.wait(TIMEOUT)
            process.stdout.close()

    def test_refused_threads_are_told_of(self):
        ended = subprocess.run(
            [BINARY, "serve", "--port", "0", "--device", "cpu", "--http-threads", "4096"],
            preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (6 << 30, 6 << 30)),
            capture_output=True, text=True, timeout=TIMEOUT, env=environment(),
        )  # fmt: skip
        self.assertEqual(ended.returncode, 1, ended.stderr[-500:])
        self.assertIn("so many threads", ended.stderr)


if __name__ == "__main__":
    unittest.main()
