#!/usr/bin/env python3
"""A large sweep end to end: killed on the way, resumed, verified, asked, shown on the page; what each step takes.

    bench/load.py build/release/tools/portrait FOLDER                 10^8 settings of four measures, 3.3 GB
    bench/load.py build/release/tools/portrait FOLDER --points 20     160,000 settings
    bench/load.py ... --compare                                       and once more without a kill: the same digests

Prints a table in Markdown. Ends with 1, and says why, when something is not as it should be. The portrait is removed.
Seconds are those of the clock; memory is the largest resident set of the step's process, pages of the file included.
"""

import argparse
import http.client
import json
import os
import re
import signal
import subprocess
import sys
import time
from pathlib import Path

GRID = """title = "Load"
plant = "dipdt"
n = 1
horizon = 51
measures = ["IAE_w", "IAE_d", "TV2_uw", "Ms"]
[parameters]
kappa = {{ from = 0.05, to = 0.35, count = {n} }}
delta = {{ from = 0.35, to = 1.05, count = {n} }}
tau_i = {{ from = 6, to = 26, count = {n} }}
tau_f = {{ from = 0.05, to = 1, count = {n}, scale = "log" }}
b = 0
c = 0
"""
QUERIES = [
    ["--minimize", "IAE_w + IAE_d", "--where", "Ms <= 2", "--where", "TV2_uw <= 0.1"],
    ["--minimize", "IAE_d", "--where", "Ms <= 1.7", "--where", "tau_f >= 0.1"],
    ["--pareto", "IAE_d,TV2_uw", "--where", "Ms <= 2"],
]
REQUESTS = [
    ("/api/view", {"x": "kappa", "y": "delta", "held": [0, 0, 0, 0], "minimize": "IAE_d", "colour": "Ms", "where": ["Ms <= 2"]}),
    ("/api/front", {"x_expression": "IAE_d", "y_expression": "TV2_uw", "where": ["Ms <= 2"]}),
    ("/api/quantiles", {"expression": "Ms"}),
    ("/api/rules", {"minimize": "IAE_d", "where": ["Ms <= 2"]}),
    ("/api/simulate", {"number": 0}),
]


class Wrong(Exception):
    pass


class Table:
    def __init__(self):
        self.rows = []

    def add(self, step, seconds, kilobytes, what=""):
        self.rows.append(f"| {step} | {seconds:.3g} | {kilobytes / 1024:.0f} | {what} |")
        print(self.rows[-1], file=sys.stderr, flush=True)

    def text(self):
        return "\n".join(["| step | seconds | MB | |", "|---|---|---|---|", *self.rows])


class Load:
    def __init__(self, program, folder, points):
        self.program, self.folder, self.table = str(Path(program).resolve()), Path(folder), Table()
        self.settings = points**4
        self.folder.mkdir(parents=True, exist_ok=True)
        for left in ("load.h5", "load.h5.run"):
            if (self.folder / left).exists():
                raise Wrong(f"{self.folder / left} is there already")
        (self.folder / "load.toml").write_text(GRID.format(n=points))

    def begin(self, *words):
        return subprocess.Popen([self.program, *map(str, words)], cwd=self.folder, stdout=subprocess.PIPE,
                                stderr=subprocess.PIPE, text=True)

    def run(self, *words):
        """Its output, the seconds and the kilobytes that it took."""
        begun = time.monotonic()
        process = self.begin(*words)
        out, err = process.stdout.read(), process.stderr.read()
        _, status, used = os.wait4(process.pid, 0)
        if os.waitstatus_to_exitcode(status) != 0:
            raise Wrong(f"portrait {' '.join(map(str, words))} failed: {err}")
        return out, time.monotonic() - begun, used.ru_maxrss

    def stored(self):
        if not (self.folder / "load.h5.run").exists():
            return 0
        state = json.loads(self.run("info", "load.h5.run", "--json")[0])
        return state["tiles_stored"] / state["tiles"]

    def bytes_stored(self):
        try:
            return sum(path.stat().st_size for path in (self.folder / "load.h5.run").iterdir())
        except FileNotFoundError:  # not begun, or ended this very moment
            return 0

    def killed(self, number, at):
        """A sweep that goes on from what the last one left, killed when so many bytes are stored."""
        begun = time.monotonic()
        process = self.begin("sweep", "load.toml", "-o", "load.h5", "--quiet", "--resume")
        while self.bytes_stored() < at and not os.waitid(os.P_PID, process.pid, os.WEXITED | os.WNOHANG | os.WNOWAIT):
            time.sleep(0.005)
        os.kill(process.pid, signal.SIGKILL)
        process.stdout.close(), process.stderr.close()
        _, status, used = os.wait4(process.pid, 0)
        if os.waitstatus_to_exitcode(status) != -signal.SIGKILL:
            raise Wrong(f"sweep {number} ended with {os.waitstatus_to_exitcode(status)} before it was killed")
        self.table.add(f"sweep, killed ({number})", time.monotonic() - begun, used.ru_maxrss,
                       f"{100 * self.stored():.0f} % of the tiles are stored")

    def sweep(self, *options):
        out, seconds, memory = self.run("sweep", "load.toml", "-o", "load.h5", "--json", *options)
        told = json.loads(out)
        if told["settings"] != self.settings:
            raise Wrong(f"{told['settings']} settings")
        self.table.add("sweep" + ("".join(" " + o for o in options)), seconds, memory,
                       f"{told['settings_measured']:,} settings, {told['settings_per_second']:,.0f} a second on {told['threads']} threads; "
                       f"{told['unstable']:,} unstable, {told['not_settled']:,} not settled")

    def verify(self):
        out, seconds, memory = self.run("verify", "load.h5")
        self.table.add("verify", seconds, memory, f"{(self.folder / 'load.h5').stat().st_size / 1e9:.3g} GB, every digest as written")
        return out

    def ask(self):
        for question in QUERIES:
            out, seconds, memory = self.run("query", "load.h5", *question, "--json")
            answer = json.loads(out)
            if answer["total"] != self.settings or not 0 < answer["admissible"] < self.settings:
                raise Wrong(f"query {question}: {answer['admissible']} of {answer['total']}")
            self.table.add("query " + " ".join(f"`{w}`" if " " in w else w for w in question), seconds, memory,
                           f"{answer['admissible']:,} admissible")

    def show(self):
        process = self.begin("serve", "load.h5", "--port", "0", "--memory", 4096)
        try:
            port = int(re.search(r":(\d+)/", process.stdout.readline())[1])
            for path, request in REQUESTS:
                times = [self.post(port, path, request) for _ in range(3)]
                resident = re.search(r"VmRSS:\s*(\d+)", Path(f"/proc/{process.pid}/status").read_text())[1]
                self.table.add(f"page {path}", times[0], int(resident), f"asked again {1000 * times[1]:.0f} and {1000 * times[2]:.0f} ms")
        finally:
            process.terminate()
            process.communicate()

    @staticmethod
    def post(port, path, request):
        begun = time.monotonic()
        connection = http.client.HTTPConnection("127.0.0.1", port, timeout=600)
        connection.request("POST", path, json.dumps(request), {"Content-Type": "application/json"})
        answer = connection.getresponse()
        body = answer.read()
        connection.close()
        if answer.status != 200:
            raise Wrong(f"{path}: {answer.status} {body[:200]!r}")
        return time.monotonic() - begun

    def all(self, kills, compare):
        largest = json.loads(self.run("sweep", "load.toml", "-o", "load.h5", "--dry-run", "--json")[0])["largest_bytes"]
        for number in range(1, kills + 1):
            self.killed(number, 0.8 * largest * number / (kills + 1))
        self.sweep("--resume")
        digests = self.verify()
        if (self.folder / "load.h5.run").exists():
            raise Wrong("the run's folder is still there")
        self.ask()
        self.show()
        (self.folder / "load.h5").unlink()
        if compare:
            self.sweep()
            if self.verify() != digests:
                raise Wrong("killed and resumed it has other digests than without")
            (self.folder / "load.h5").unlink()


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program")
    parser.add_argument("folder", help="with room; made when it is not there")
    parser.add_argument("--points", type=int, default=100, help="values of each of four axes")
    parser.add_argument("--kills", type=int, default=3)
    parser.add_argument("--compare", action="store_true")
    a = parser.parse_args()
    try:
        load = Load(a.program, a.folder, a.points)
        load.all(a.kills, a.compare)
    except Wrong as wrong:
        print(f"load: {wrong}", file=sys.stderr)
        return 1
    print(load.table.text())
    return 0


if __name__ == "__main__":
    sys.exit(main())
