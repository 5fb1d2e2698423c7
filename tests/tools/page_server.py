"""Starts `portrait serve` for the tests, and talks to it through plain sockets."""

import json
import os
import signal
import socket
import subprocess
import threading
import time


class Server:
    def __init__(self, program, folder, *arguments):
        self.process = subprocess.Popen([program, "serve", *map(str, arguments), "--port", "0"], cwd=folder, text=True,
                                        stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        url = self.process.stdout.readline().strip()
        if not url:
            raise AssertionError(self.process.communicate()[1])
        self.url, self.port = url, int(url.rstrip("/").split(":")[-1])
        # Messages are read as they come, so that the server never waits for us.
        self.errors = []
        self.reader = threading.Thread(target=lambda: self.errors.extend(self.process.stderr), daemon=True)
        self.reader.start()

    def stop(self, by=signal.SIGTERM):
        """Exit code and the seconds that it took."""
        begin = time.monotonic()
        self.process.send_signal(by)
        code = self.process.wait(timeout=30)
        self.process.stdout.close()
        self.reader.join(5)
        self.process.stderr.close()
        return code, time.monotonic() - begin

    def connect(self, timeout=30):
        return socket.create_connection(("127.0.0.1", self.port), timeout=timeout)

    def raw(self, data, timeout=30):
        """Everything that comes back until the server closes, or what came until the time was up."""
        with self.connect(timeout) as s:
            try:
                s.sendall(data)
                s.shutdown(socket.SHUT_WR)
            except OSError:
                pass  # it closed while we were still talking
            got = b""
            try:
                while part := s.recv(65536):
                    got += part
            except OSError:
                pass
            return got

    def request(self, method, path, body=b"", host=None, **headers):
        """(status, body)"""
        host = f"127.0.0.1:{self.port}" if host is None else host
        lines = [f"{method} {path} HTTP/1.1"] + ([f"Host: {host}"] if host else [])
        if body:
            headers.setdefault("Content_Length", len(body))
        lines += [f"{name.replace('_', '-')}: {value}" for name, value in headers.items()]
        answer = self.raw(("\r\n".join(lines) + "\r\nConnection: close\r\n\r\n").encode() + body)
        head, _, rest = answer.partition(b"\r\n\r\n")
        return int(head.split()[1]) if head.startswith(b"HTTP/") else 0, rest

    def post(self, path, request):
        body = request if isinstance(request, bytes) else json.dumps(request).encode()
        return self.request("POST", path, body, Content_Type="application/json")

    def answer(self, path, request):
        status, body = self.post(path, request)
        if status != 200:
            raise AssertionError((status, body))
        return json.loads(body)

    def alive(self):
        return self.process.poll() is None and self.post("/api/info", {})[0] == 200

    # ------------------------------------------------------------ what it uses

    def memory_kb(self):
        with open(f"/proc/{self.process.pid}/status") as status:
            return next(int(line.split()[1]) for line in status if line.startswith("VmRSS"))

    def threads(self):
        return len(os.listdir(f"/proc/{self.process.pid}/task"))

    def files(self):
        return len(os.listdir(f"/proc/{self.process.pid}/fd"))
