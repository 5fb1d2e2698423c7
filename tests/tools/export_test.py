"""portrait export: CSV and NPY hold, bit for bit, what h5py reads from the portrait and what a query finds."""

import csv
import json

import h5py
import numpy

import program
from program import ProgramTest

GRID = """title = "export"
plant = "dipdt"
n = 1
horizon = 120
precision = "{precision}"
[parameters]
kappa = {{ from = 0.05, to = 0.4, count = 36 }}
delta = {{ from = 0.35, to = 1.05, count = 15 }}
tau_i = [6, 8, 10, 14, 20, inf]
tau_f = [0.05, 0.1, 0.2]
"""
AXES = ("kappa", "delta", "tau_i", "tau_f")


class Export(ProgramTest):
    """9,720 settings in three tiles."""

    def setUp(self):
        super().setUp()
        self.sweep()

    def sweep(self, precision="double"):
        self.write("g.toml", GRID.format(precision=precision))
        self.assertEqual(self.run_program("sweep", "g.toml", "-o", "g.h5", "--quiet", "--force").code, 0)
        self.file = h5py.File(self.folder / "g.h5")
        self.addCleanup(self.file.close)
        self.measures = self.run_program("info", "g.h5", "--json").json["measures"]

    def export(self, name, *options):
        result = self.run_program("export", "g.h5", "-o", name, *options)
        self.assertEqual(result.code, 0, result.err)
        if name.endswith(".npy"):
            return numpy.load(self.folder / name)
        with open(self.folder / name, newline="") as file:
            return list(csv.DictReader(file))

    def about(self, name):
        return json.loads((self.folder / (name + ".json")).read_text())

    def assert_same(self, found, expected, what=""):
        self.assertEqual(found.shape, expected.shape, what)
        self.assertTrue(numpy.array_equal(found, expected, equal_nan=True), what)

    def test_npy_of_everything(self):
        table = self.export("all.npy")
        self.assertEqual(table.shape, (36, 15, 6, 3))
        self.assertEqual(table.dtype.names, (*AXES, "status", *self.measures))
        for name in (*self.measures, "status"):
            self.assert_same(table[name], self.file[name][...], name)
        self.assertGreater(numpy.isnan(table["IAE_w"]).sum(), 100, "unstable settings are there too")
        for k, axis in enumerate(AXES):
            along = self.file[axis][...].reshape([-1 if i == k else 1 for i in range(4)])
            self.assert_same(table[axis], numpy.broadcast_to(along, table.shape), axis)

    def test_npy_and_csv_of_a_slice(self):
        table = self.export("slice.npy", "--slice", "tau_i=inf,tau_f=0.1", "--measures", "Ms,IAE_w")
        self.assertEqual((table.shape, table.dtype.names), ((36, 15), (*AXES, "status", "Ms", "IAE_w")))
        for name in ("Ms", "IAE_w", "status"):
            self.assert_same(table[name], self.file[name][:, :, 5, 1], name)
        rows = self.export("slice.csv", "--slice", "tau_f=0.1,tau_i=inf", "--measures", "Ms,IAE_w")
        self.assertEqual(len(rows), 36 * 15)
        flat = table.ravel()
        for name in ("kappa", "delta", "tau_i", "tau_f", "Ms", "IAE_w"):
            self.assert_same(numpy.array([float(row[name]) for row in rows]), flat[name], name)
        codes = self.about("slice.csv")["status"]
        self.assertEqual([row["status"] for row in rows], [codes[str(code)] for code in flat["status"]])
        about = self.about("slice.npy")
        self.assertEqual((about["shape"], about["slice"], about["fixed"]["b"]), ([36, 15], {"tau_i": "inf", "tau_f": 0.1}, 0))
        self.assertEqual([axis["name"] for axis in about["axes"]], ["kappa", "delta"])
        self.assertEqual([column["name"] for column in about["columns"]], list(table.dtype.names))
        self.assertEqual(about["columns"][-1]["unit"], "normalised, for a step of 1 in the setpoint")
        self.assertIn("integral of |w - y|", about["columns"][-1]["meaning"])

    def test_single_precision(self):
        self.sweep("single")
        table = self.export("all.npy", "--measures", "IAE_w,Ms")
        for name in ("IAE_w", "Ms"):
            self.assert_same(table[name], self.file[name][...].astype(float), name)

    def test_what_a_query_admits(self):
        where = ("--where", "Ms <= 2", "--where", "delta >= 0.5")
        table = self.export("good.npy", *where)
        good = (self.file["status"][...] == 1) & (self.file["Ms"][...] <= 2)
        good &= (self.file["delta"][...] >= 0.5)[None, :, None, None]
        for name in (*self.measures, "status"):
            self.assert_same(table[name], self.file[name][...][good], name)
        query = self.run_program("query", "g.h5", "--minimize", "Ms", *where, "--json").json
        self.assertEqual(len(table), query["admissible"])
        self.assertGreater(len(table), 50)
        self.assertEqual(len(self.export("more.csv", *where, "--include-not-settled")),
                         self.run_program("query", "g.h5", "--minimize", "Ms", *where, "--include-not-settled", "--json").json["admissible"])
        part = self.export("part.npy", *where, "--slice", "tau_f=0.2")
        self.assert_same(part["Ms"], table["Ms"][table["tau_f"] == 0.2])

    def test_the_best_of_a_query_in_real_units(self):
        asked = ("--minimize", "IAE_d + IAE_w", "--where", "Ms <= 1.9", "--top", "25", "--plant", "K=2,Td=0.5", "--step", "w=3,d=2")
        query = self.run_program("query", "g.h5", *asked, "--json").json["top"]
        table = self.export("best.npy", *asked, "--measures", "IAE_d,TV_uw,Ms")
        self.assertEqual(len(table), 25)
        self.assertEqual(table.dtype.names[-1], "objective")
        for row, best in zip(table, query):
            for name in ("IAE_d", "TV_uw", "Ms"):
                self.assertEqual(row[name], best["measures"][name])
            self.assertEqual(row["objective"], best["objective"])
            self.assertEqual(row["kappa"], best["settings"]["kappa"])
            self.assertAlmostEqual(row["Kc"], best["controller"]["standard"]["Kc"], 12)
        units = {column["name"]: column["unit"] for column in self.about("best.npy")["columns"]}
        self.assertIn("unit of y times time", units["IAE_d"])
        everything = self.export("map.csv", "--plant", "K=2,Td=0.5", "--slice", "kappa=0.2,tau_i=6", "--measures", "IAE_d")
        kept = self.file["IAE_d"][15, :, 0, :].ravel()
        # u times K Td^2, time in Td: IAE_d in real units is K Td^3 times the normalised one.
        numpy.testing.assert_allclose([float(row["IAE_d"]) for row in everything], kept * 2 * 0.5**3, rtol=1e-14)

    def test_the_best_of_a_slice(self):
        asked = ("--minimize", "IAE_d", "--where", "Ms <= 2", "--top", "8")
        table = self.export("best.npy", *asked, "--slice", "tau_f=0.2")
        query = self.run_program("query", "g.h5", *asked, "--where", "tau_f == 0.2", "--json").json["top"]
        self.assertEqual(list(table["tau_f"]), [0.2] * 8)
        self.assertEqual(list(table["IAE_d"]), [best["measures"]["IAE_d"] for best in query])
        about = self.about("best.npy")
        self.assertEqual((about["slice"], about["minimize"], about["shape"]), ({"tau_f": 0.2}, "IAE_d", [8]))

    def test_a_plant_takes_the_slice_of_its_lag(self):
        self.write("lag.toml", """plant = "fotd"
n = 0
horizon = 60
[parameters]
tau_1 = [1, 2, 4]
kappa = [0.4, 0.6]
tau_d = [0.1, 0.2, 0.3]
tau_i = 2
""")
        self.assertEqual(self.run_program("sweep", "lag.toml", "-o", "lag.h5", "--quiet").code, 0)
        with h5py.File(self.folder / "lag.h5") as file:
            kept = file["Ms"][...]
        for options, rows in ((("--plant", "K=2,Td=0.5,T1=1"), kept[1].ravel()), ((), kept.ravel())):
            self.assertEqual(self.run_program("export", "lag.h5", "-o", "lag.npy", "--force", "--quiet", *options).code, 0)
            table = numpy.load(self.folder / "lag.npy")
            self.assert_same(table["Ms"].ravel(), rows)
            self.assertEqual([name for name in table.dtype.names if name in ("Kc", "Ti", "TD", "Tf")], ["Kc", "Ti", "TD"] if options else [])
            names = [axis["name"] for axis in self.about("lag.npy")["axes"]]
            self.assertEqual(names, ["kappa", "tau_d"] if options else ["tau_1", "kappa", "tau_d"])
        self.assertEqual(self.run_program("export", "lag.h5", "-o", "lag.npy", "--force", "--quiet", "--minimize", "Ms", "--top", "18").code, 0)
        table = numpy.load(self.folder / "lag.npy")
        self.assertGreater(len(table), 10)
        self.assertEqual(set(table["tau_d"]), {0.1, 0.2, 0.3})
        self.assertEqual(list(table["Ms"]), sorted(table["Ms"]))

    def test_csv_to_stdout(self):
        result = self.run_program("export", "g.h5", "--slice", "kappa=0.2,delta=0.7,tau_i=8", "--measures", "Ms")
        lines = result.out.splitlines()
        self.assertEqual((result.code, result.err, lines[0], len(lines)), (0, "", "kappa,delta,tau_i,tau_f,status,Ms", 4))
        self.assertEqual(lines[1].split(",")[:4], ["0.2", "0.7", "8", "0.05"])

    def test_one_setting(self):
        self.write("one.toml", "plant = \"ipdt\"\nhorizon = 30\n[parameters]\nkappa = 0.5\ntau_i = 6\n")
        self.assertEqual(self.run_program("sweep", "one.toml", "-o", "one.h5", "--quiet").code, 0)
        self.assertEqual(self.run_program("export", "one.h5", "-o", "one.npy", "--quiet").code, 0)
        table = numpy.load(self.folder / "one.npy")
        self.assertEqual(table.shape, ())
        with h5py.File(self.folder / "one.h5") as file:
            self.assertEqual(table["IAE_w"], file["IAE_w"][()])

    def test_what_is_wrong_is_said(self):
        for options, message in (
                (("-o", "a.csv", "--measures", "Ms,IAE_ww"), '--measures: the portrait has no measure "IAE_ww" (did you mean "IAE_w"?)'),
                (("-o", "a.csv", "--measures", "Ms,Ms"), "--measures: Ms stands there twice"),
                (("-o", "a.csv", "--slice", "kapa=0.2"), '--slice: "kapa" is no axis of the portrait (did you mean "kappa"?)'),
                (("-o", "a.csv", "--slice", "kappa=0.2,kappa=0.3"), "--slice: kappa stands there twice"),
                (("-o", "a.csv", "--slice", "delta"), '--slice: "delta" is not AXIS=VALUE, as delta=0.7'),
                (("-o", "a.csv", "--slice", "delta=0.72"), "the axis delta has no value 0.72 (nearest: 0.7 and 0.75)"),
                (("-o", "a.txt"), '-o a.txt: unknown kind of file ".txt" (known: .csv, .npy)'),
                (("-o", "g.toml.npx",), '-o g.toml.npx: unknown kind of file ".npx" (did you mean ".npy"?)'),
                (("--json",), "--json: the table goes to stdout; give -o FILE")):
            self.assert_fails(self.run_program("export", "g.h5", *options), 2, message)
        result = self.run_program("export", "g.h5", "-o", "a.csv", "--where", "Ms <= 0.5")
        self.assert_fails(result, 3, "no admissible setting: nothing is written")
        self.assertEqual(sorted(path.name for path in self.folder.iterdir()), ["g.h5", "g.toml"])
        self.write("a.csv", "mine")
        self.assert_fails(self.run_program("export", "g.h5", "-o", "a.csv"), 2, "a.csv exists already (--force replaces it)")
        self.assertEqual((self.folder / "a.csv").read_text(), "mine")
        self.assertEqual(len(self.export("a.csv", "--force", "--slice", "kappa=0.2,delta=0.7,tau_f=0.1")), 6)

    def test_damage_is_an_error(self):
        data = bytearray((self.folder / "g.h5").read_bytes())
        data[4096 + 99] ^= 4
        (self.folder / "g.h5").write_bytes(data)
        result = self.run_program("export", "g.h5", "-o", "a.npy")
        self.assertEqual(result.code, 4)
        self.assertFalse((self.folder / "a.npy").exists())


if __name__ == "__main__":
    program.main()
