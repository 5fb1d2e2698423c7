"""portrait serve against requests that nobody honest makes: it answers its own page, and neither falls nor hangs nor grows."""

import json
import random
import resource
import socket
import struct
import time

import program
from page_server import Server
from program import ProgramTest

VIEW = {"x": "kappa", "y": "delta", "held": [0, 0, 0], "minimize": "IAE_w + IAE_d", "colour": "Ms", "where": ["Ms <= 3"]}


class Hostile(ProgramTest):
    def setUp(self):
        super().setUp()
        self.small_portrait()
        self.server = Server(program.PROGRAM, self.folder, "small.h5")
        self.sanitized = "asan" in program.PROGRAM

    def tearDown(self):
        if self.server.process.poll() is None:
            code, seconds = self.server.stop()
            self.assertEqual(code, 0, self.server.errors)  # a leak found by the sanitizer is another code
        super().tearDown()

    def status(self, *arguments, **headers):
        return self.server.request(*arguments, **headers)[0]

    def test_only_this_machine_can_reach_it(self):
        own = f"{self.server.port:04X}"
        with open("/proc/net/tcp") as table:
            listening = [line.split()[1] for line in table if line.split()[3] == "0A"]
        self.assertEqual([a for a in listening if a.endswith(":" + own)], ["0100007F:" + own])

    def test_only_its_own_page_is_answered(self):
        self.assertEqual(self.status("GET", "/"), 200)
        self.assertEqual(self.status("GET", "/", host=f"localhost:{self.server.port}"), 200)
        for host in ("", "evil.example", "127.0.0.1", f"127.0.0.1:{self.server.port + 1}", f"evil.example:{self.server.port}",
                     f"127.0.0.1:{self.server.port}.evil.example", f"127.0.0.1:{self.server.port} "[:-1] + "\r\nHost: evil.example"):
            self.assertIn(self.status("GET", "/", host=host), (400, 403), host)
        for origin in ("http://evil.example", "null", f"https://127.0.0.1:{self.server.port}", f"http://localhost:{self.server.port}"):
            self.assertEqual(self.status("GET", "/", Origin=origin), 403, origin)
        self.assertEqual(self.status("GET", "/", Origin=f"http://127.0.0.1:{self.server.port}"), 200)

    def test_no_file_but_the_page_is_given(self):
        secret = (self.folder / "small.toml").read_bytes()
        for path in ("/../small.toml", "/..%2fsmall.toml", "/%2e%2e/small.toml", "//etc/passwd", "/small.toml", "/small.h5",
                     "/page.js/../../etc/passwd", "/..\\small.toml", "/%00", "/page.js%00", "file:///etc/passwd",
                     f"http://127.0.0.1:{self.server.port}/../etc/passwd", "/" + "../" * 40 + "etc/passwd"):
            status, body = self.server.request("GET", path)
            self.assertIn(status, (0, 400, 404), path)
            self.assertNotIn(b"root:", body)
            self.assertNotIn(secret, body)
        self.assertTrue(self.server.alive())

    def test_methods_and_bodies_it_has_no_use_for(self):
        json_type = {"Content_Type": "application/json"}
        for method in ("PUT", "DELETE", "PATCH", "OPTIONS", "TRACE", "CONNECT", "BREW"):
            self.assertIn(self.status(method, "/api/info"), (400, 405), method)
        self.assertEqual(self.status("POST", "/api/info", b"{}", Content_Type="text/plain"), 415)
        self.assertEqual(self.status("POST", "/api/info", b"{}", Content_Encoding="gzip", **json_type), 415)
        self.assertEqual(self.status("POST", "/api/info", b"2\r\n{}\r\n0\r\n\r\n", Transfer_Encoding="chunked", **json_type), 411)
        self.assertEqual(self.status("POST", "/api/info", b"x" * 65537, **json_type), 413)
        self.assertEqual(self.status("GET", "/page.js", Range="bytes=" + ",".join(["0-"] * 1500)), 416)  # 50 MB from 36 kB
        for length in ("10000000000000", "-1", "99999999999999999999999999", "two", "0x10"):
            self.assertIn(self.status("POST", "/api/info", b"{}", Content_Length=length, **json_type), (400, 413), length)
        self.assertTrue(self.server.alive())

    def test_giant_bodies_and_heads_are_not_kept(self):
        before = self.server.memory_kb()
        head = f"POST /api/info HTTP/1.1\r\nHost: 127.0.0.1:{self.server.port}\r\nContent-Type: application/json\r\n"
        part = b"x" * (1 << 20)
        for data in (head + "Content-Length: 5000000000\r\n\r\n", head + "X: ", "GET /", head + "Content-Length: 60000\r\n\r\n"):
            with self.server.connect() as s:
                sent = 0
                try:
                    s.sendall(data.encode())
                    while sent < 64 << 20:
                        s.sendall(part)
                        sent += len(part)
                except OSError:
                    pass
                self.assertLess(sent, 64 << 20, "it took all of it")
        self.assertLess(self.server.memory_kb() - before, 20_000 if not self.sanitized else 200_000)
        self.assertTrue(self.server.alive())

    def test_requests_that_do_not_fit_say_why(self):
        for path, request, message in (
                ("/api/view", b"[" * 60_000, "nested too deeply"), ("/api/view", b"{", "not JSON"),
                ("/api/view", b'{"a":' + b"[" * 20 + b"]" * 20 + b"}", "nested too deeply"),
                ("/api/view", b"\xff\xfe", "not JSON"), ("/api/view", b"7", "not an object"),
                ("/api/view", {}, "minimize"), ("/api/view", {**VIEW, "minimize": "IAE_x"}, 'unknown name "IAE_x"'),
                ("/api/view", {**VIEW, "x": "delta"}, "same axis"), ("/api/view", {**VIEW, "x": "tau_f"}, "no axis"),
                ("/api/view", {**VIEW, "held": [0, 0]}, "held"), ("/api/view", {**VIEW, "held": [0, 0, 3]}, "held"),
                ("/api/view", {**VIEW, "held": [0, -1, 0]}, "held"), ("/api/view", {**VIEW, "held": [0, 1.5, 0]}, "held"),
                ("/api/view", {**VIEW, "held": ["0", 0, 0]}, "held"), ("/api/view", {**VIEW, "where": "Ms <= 2"}, "where"),
                ("/api/view", {**VIEW, "where": ["Ms <= 2"] * 65}, "where"), ("/api/view", {**VIEW, "where": [["Ms"]]}, "where"),
                ("/api/view", {**VIEW, "where": ["Ms <="]}, "constraint 1:1:"),
                ("/api/view", {**VIEW, "colour": "(" * 5000}, "colour"),
                ("/api/view", {**VIEW, "plant": {"K": "x", "Td": 1}}, "not a number"),
                ("/api/view", {**VIEW, "plant": {"K": 0, "Td": 1}}, "K"), ("/api/view", {**VIEW, "plant": {"Td": -1}}, "Td"),
                ("/api/view", {**VIEW, "plant": []}, "plant"), ("/api/setting", {}, "number"),
                ("/api/setting", {"number": 27}, "number"), ("/api/setting", {"number": 1e300}, "number"),
                ("/api/setting", {"number": 0, "expressions": [1]}, "expressions"),
                ("/api/simulate", {"number": -1}, "number"), ("/api/front", {"x_expression": "Ms"}, "y_expression"),
                ("/api/rules", {}, "minimize"), ("/api/rules", {"minimize": "Ms", "x_expression": 1, "y_expression": "Ms"}, "x_expression"),
                ("/api/rules", {"minimize": "Ms", "where": ["Ms <="]}, "constraint 1:1:")):
            status, body = self.server.post(path, request)
            self.assertEqual(status, 400, (path, request, body))
            self.assertIn(message, json.loads(body)["error"])
        self.assertTrue(self.server.alive())

    def test_nonsense_of_all_kinds(self):
        rng = random.Random(5)
        good = f"POST /api/view HTTP/1.1\r\nHost: 127.0.0.1:{self.server.port}\r\nContent-Type: application/json\r\nContent-Length: "
        body = json.dumps(VIEW).encode()
        whole = good.encode() + str(len(body)).encode() + b"\r\n\r\n" + body
        for _ in range(300):
            data = bytearray(whole)
            for _ in range(rng.randint(1, 8)):
                at = rng.randrange(len(data))
                choice = rng.randrange(3)
                if choice == 0:
                    data[at] = rng.randrange(256)
                elif choice == 1:
                    del data[at:at + rng.randint(1, 30)]
                else:
                    data[at:at] = rng.choice([b"\0", b"\r\n", b"\xff" * 9, b"%", b"{", b"1e999"])
                if not data:
                    break
            self.server.raw(bytes(data), timeout=10)
        self.assertTrue(self.server.alive())

    def test_slow_clients_do_not_hold_it_up(self):
        slow = [self.server.connect() for _ in range(200)]
        begin = time.monotonic()
        worst = 0
        while time.monotonic() - begin < 4:
            for s in slow:
                try:
                    s.send(b"G")
                except OSError:
                    pass
            before = time.monotonic()
            self.assertEqual(self.server.post("/api/view", VIEW)[0], 200)
            worst = max(worst, time.monotonic() - before)
            time.sleep(0.2)
        self.assertLess(worst, 3)
        for s in slow:
            s.close()

    def test_a_body_that_never_comes_is_given_up(self):
        with self.server.connect() as s:
            s.sendall(f"POST /api/info HTTP/1.1\r\nHost: 127.0.0.1:{self.server.port}\r\nContent-Type: application/json\r\n"
                      "Content-Length: 50000\r\n\r\n".encode())
            begin = time.monotonic()
            try:
                for _ in range(100):  # a byte now and then gains no time
                    s.send(b" ")
                    time.sleep(0.2)
            except OSError:
                pass
            self.assertLess(time.monotonic() - begin, 9)

    def test_thousands_of_connections(self):
        soft, hard = resource.getrlimit(resource.RLIMIT_NOFILE)
        count = min(3000, hard - 100)
        resource.setrlimit(resource.RLIMIT_NOFILE, (max(soft, count + 100), hard))
        before_files = self.server.files()
        open_ones = []
        for k in range(count):
            s = socket.socket()
            s.setblocking(False)
            s.connect_ex(("127.0.0.1", self.server.port))
            open_ones.append(s)
            if k % 500 == 499:
                # Among hundreds that say nothing it may be ended before it speaks: a browser would ask again, and so does this.
                end = time.monotonic() + 10
                while not self.server.alive():
                    self.assertLess(time.monotonic(), end)
        self.assertLess(self.server.threads(), 64 + 10)
        for s in open_ones:
            s.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, struct.pack("ii", 1, 0))
            s.close()
        self.assertTrue(self.server.alive())
        end = time.monotonic() + 30
        while self.server.files() > before_files + 2 and time.monotonic() < end:
            time.sleep(0.2)
        self.assertLessEqual(self.server.files(), before_files + 2)

    def test_ten_thousand_requests_in_flat_memory(self):
        total = 10_000 if not self.sanitized else 1_000
        s = self.server.connect()
        stream = s.makefile("rb")
        requests = [("/api/view", VIEW), ("/api/setting", {"number": 5}), ("/api/simulate", {"number": 4}),
                    ("/api/front", {"x_expression": "Ms", "y_expression": "IAE_d"}), ("/api/view", {**VIEW, "minimize": "?"})]
        memory = []
        for k in range(total):
            path, request = requests[k % 5 if k % 50 == 0 or k % 5 != 2 else 1]
            body = json.dumps(request).encode()
            s.sendall((f"POST {path} HTTP/1.1\r\nHost: 127.0.0.1:{self.server.port}\r\nContent-Type: application/json\r\n"
                       f"Content-Length: {len(body)}\r\n\r\n").encode() + body)
            status = int(stream.readline().split()[1])
            self.assertEqual(status, 400 if request.get("minimize") == "?" else 200)
            length = 0
            while (line := stream.readline().strip()) != b"":
                if line.lower().startswith(b"content-length:"):
                    length = int(line.split(b":")[1])
            self.assertEqual(len(stream.read(length)), length)
            if k + 1 in (total // 10, total):
                memory.append((self.server.memory_kb(), self.server.files(), self.server.threads()))
        s.close()
        print(f"memory after {total // 10} and {total} requests: {memory[0][0]} and {memory[1][0]} kB", flush=True)
        self.assertLess(memory[1][0] - memory[0][0], 2_000 if not self.sanitized else 200_000)
        self.assertEqual(memory[0][1:], memory[1][1:])

    def test_it_ends_when_asked_also_with_open_connections(self):
        open_ones = [self.server.connect() for _ in range(20)]
        code, seconds = self.server.stop()
        self.assertEqual(code, 0, self.server.errors)
        self.assertLess(seconds, 5)
        for s in open_ones:
            s.close()

    def test_a_taken_port_is_said(self):
        self.assert_fails(self.run_program("serve", "small.h5", "--port", self.server.port), 2,
                          f"port {self.server.port} of 127.0.0.1 is taken: give another --port")

    def test_a_portrait_without_a_plane_is_refused(self):
        self.write("one.toml", 'plant = "ipdt"\nn = 0\nhorizon = 20\n[parameters]\nkappa = [0.2, 0.3]\ntau_i = 8\ndelta = 0\n')
        self.run_program("sweep", "one.toml", "-o", "one.h5", "--quiet")
        self.assert_fails(self.run_program("serve", "one.h5"), 2, "one.h5: a page needs a portrait with two axes or more")


if __name__ == "__main__":
    program.main()
