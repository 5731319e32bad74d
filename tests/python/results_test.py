"""Results: arrays look at the library's memory and keep it alive, know their units and axes, and go to
xarray, pandas and matplotlib where these are; figures are the library's own."""

import gc
import inspect
import json
import os
import re
import subprocess
import sys
import unittest

import support
from support import command_line, model, needs, np, same_bits, whirl


class Arrays(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.run_ = model("two_disk_mac").simulate(speed="4430 rpm", revolutions=4, discard=2, stations="all")

    def test_know_what_they_are(self):
        x = self.run_.x
        self.assertEqual((x.unit, x.dims, x.meaning), ("m", ("station", "time"), "displacement x"))
        self.assertEqual(x.shape, (len(self.run_.station), len(self.run_.time)))
        self.assertIs(x.coords["time"], self.run_.time)
        self.assertEqual(self.run_.time.dims, ("time",))
        self.assertEqual(self.run_.trajectory.x[0, 0], x[0, 0])
        self.assertEqual(self.run_["/trajectory/x"].shape, x.shape)
        self.assertEqual(self.run_.normal_force.dims, ("contact", "time"))

    def test_cannot_be_changed_and_are_not_copied(self):
        x = self.run_.x
        self.assertFalse(x.flags.writeable)
        with self.assertRaises(ValueError):
            np.asarray(x)[0, 0] = 1.0
        with self.assertRaises(ValueError):
            x.flags.writeable = True  # the memory is the library's
        self.assertFalse(x.flags.owndata)
        again = self.run_._store.values("/trajectory/x")
        self.assertTrue(np.shares_memory(x, again))
        self.assertTrue(np.shares_memory(x, x.sel(station=str(self.run_.station[0]))))

    def test_live_longer_than_their_result(self):
        found = model("jeffcott").campbell("0:3000:100rpm")
        name = next(iter(found.campbell))
        array = found.campbell[name]
        before = np.array(array)
        del found
        gc.collect()
        junk = [np.full(array.shape, 7.0) for _ in range(100)]
        self.assertTrue(same_bits(array, before))
        del junk

    def test_a_million_samples_come_without_a_copy(self):
        run = model("jeffcott").simulate(revolutions=15700, samples=64, discard=0, method="taylor")
        self.assertGreater(len(run.time), 1_000_000)
        views = [run._store.values("/trajectory/x") for _ in range(50)]  # 400 MB if they were copies
        self.assertTrue(all(np.shares_memory(views[0], v) for v in views))

    def test_are_plain_arrays_in_computations(self):
        x = self.run_.x
        for made in (2.0 * x, x[0], np.sin(x), x.T[:3]):
            self.assertIs(type(np.asarray(made)), np.ndarray)
        self.assertIs(type(2.0 * x), np.ndarray)
        self.assertIs(type(x[0]), np.ndarray)
        self.assertIsInstance(float(x.max()), float)
        self.assertAlmostEqual(float(np.hypot(x, self.run_.y).max()), max(s["max_radius_m"] for s in
                               self.run_.to_dict()["stations"]), places=12)

    def test_parts_are_chosen_by_what_stands_along(self):
        x = self.run_.x
        ring = next(str(s) for s in self.run_.station if "ring" in str(s))
        self.assertTrue(same_bits(x.sel(station="ring"), np.asarray(x)[list(self.run_.station).index(ring)]))
        t = float(self.run_.time[17])
        self.assertTrue(same_bits(x.sel(time=t * (1 + 1e-12)), np.asarray(x)[:, 17]))
        self.assertEqual(x.sel(station="ring", time=t).shape, ())
        for wrong in ({"place": 1}, {"station": "nowhere"}):
            with self.assertRaises(KeyError):
                x.sel(wrong)
        with self.assertRaises(TypeError):
            x.sel(time="ring")

    def test_groups_and_numbers_are_attributes(self):
        self.assertIn("trajectory", self.run_.groups)
        self.assertEqual(self.run_.trajectory.period, self.run_.period)
        self.assertEqual(self.run_.revolutions, 4)
        self.assertIn("x", dir(self.run_))
        self.assertIn("x [m] (station, time)", repr(self.run_.trajectory))
        self.assertEqual(model("jeffcott").check().to_dict()["speed_rpm"], model("jeffcott").check().speed_rpm)

    def test_of_opened_files_are_the_same(self):
        self.run_.save("run.h5")
        opened = whirl.open("run.h5")
        self.assertEqual(opened.verb, "simulate")
        self.assertEqual(list(opened.groups), sorted(self.run_.groups))
        for name in self.run_.trajectory:
            self.assertTrue(same_bits(opened.trajectory[name], self.run_.trajectory[name]))
            self.assertEqual(opened.trajectory[name].dims, self.run_.trajectory[name].dims)
        self.assertEqual(opened.attributes["whirl_version"], whirl.__version__)
        with self.assertRaises(whirl.FileError):  # somebody else's file
            with open("mine.txt", "w") as file:
                file.write("mine")
            self.run_.save("mine.txt")
        self.run_.save("mine.txt", force=True)

    def test_motions_go_on_from_results(self):
        m = model("two_disk_mac")
        self.run_.save("first.h5")
        by_file = m.simulate(speed="4430 rpm", revolutions=2, discard=0, from_="first.h5")
        by_result = m.simulate(speed="4430 rpm", revolutions=2, discard=0, from_=self.run_)
        self.assertTrue(same_bits(by_file.x, by_result.x))

    @needs("xarray")
    def test_become_datasets(self):
        x = self.run_.x.to_xarray()
        self.assertEqual(x.attrs["units"], "m")
        self.assertTrue(np.shares_memory(x.values, np.asarray(self.run_.x)))
        self.assertTrue(same_bits(x.sel(station=str(self.run_.station[1])).values, np.asarray(self.run_.x)[1]))
        for name, dataset in self.run_.to_datasets().items():
            for key in self.run_.groups[name]:
                self.assertIn(key if key in dataset else self.run_.groups[name][key].dims[0], dataset.variables)
        self.assertEqual(self.run_.to_dataset().x.dims, ("station", "time"))
        plane = model("jeffcott_stator").map(
            {"operation.speed": "130:132:1rad/s", "contact.ring.stiffness": "10:20:10MN/m"}, revolutions=8, exponents=8,
            discard=4)
        self.assertEqual(plane.to_dataset().motion.dims, ("operation.speed", "contact.ring.stiffness"))
        self.assertEqual(plane.to_dataset().motion.shape, (3, 2))

    @needs("pandas")
    def test_become_tables(self):
        table = self.run_.to_dataframe(of="x")
        self.assertEqual(len(table), self.run_.x.size)
        self.assertTrue(same_bits(table["x [m]"].to_numpy().reshape(self.run_.x.shape), self.run_.x))
        self.assertEqual(list(table.index.names), ["station", "time"])
        self.assertGreater(len(self.run_.to_dataframe("contacts")), 0)


class OfResults(unittest.TestCase):
    """What is made of a result that is there."""

    OPTIONS = {"speed": "4430 rpm", "revolutions": 16, "discard": 2, "stations": "ring,1"}

    def same(self, found, expected):
        self.assertEqual(found._store.paths(), expected._store.paths())
        for path in expected._store.paths():
            self.assertEqual(found._store.info(path), expected._store.info(path))
            self.assertTrue(same_bits(found._store.values(path), expected._store.values(path)), path)
        a, b = ({(o, n): v for o, n, v in r._store.attributes() if n != "created"} for r in (found, expected))
        self.assertEqual(a, b)
        a, b = ({**r.to_dict(), "cost": {**r.cost, "wall_s": 0}} for r in (found, expected))
        self.assertEqual(a, b)

    def test_modes_of_a_motion_are_those_of_one_call(self):
        m = model("two_disk_mac")
        expected = m.identify(**self.OPTIONS, modes=5, rotations=True)
        run = m.simulate(**self.OPTIONS)
        self.same(run.identify(modes=5, rotations=True), expected)
        run.save("motion.h5", force=True)
        self.same(whirl.open("motion.h5").identify(modes=5, rotations=True), expected)
        self.same(m.identify(**self.OPTIONS).identify(modes=5, rotations=True), expected)
        shown = run.identify(modes=5)._repr_html_()
        self.assertIn("Modal assurance criterion", shown)
        self.assertIn("MAC of deflection shapes", shown)

    def test_only_motions_are_identified(self):
        m = model("jeffcott")
        with self.assertRaisesRegex(whirl.ModelError, "holds no motion"):
            m.modes(modes=2).identify()
        with self.assertRaisesRegex(TypeError, "has no option revolutions"):
            m.simulate(revolutions=4).identify(revolutions=8)

    def test_tables_and_meshes_are_those_of_the_program(self):
        run = model("two_disk_mac").simulate(**self.OPTIONS)
        run.save("motion.h5", force=True)
        for name, options, words in [("whole", {}, []), ("end", {"revolutions": 2}, ["--revolutions", "2"])]:
            status, _, errors = command_line("export", "motion.h5", "--format", "csv", "--out", f"theirs_{name}", *words)
            self.assertEqual(status, 0, errors)
            files = run.to_csv(f"ours_{name}", **options)
            self.assertIn(f"ours_{name}_trajectory_time.csv", files)
            for file in files:
                with open(file) as ours, open(file.replace("ours", "theirs")) as theirs:
                    self.assertEqual(ours.read(), theirs.read())
        self.assertEqual(run.export(format="csv", force=True).files[0].split("_")[0], "simulate")
        files = model("jeffcott").export(format="mtx", out="rotor").files
        self.assertTrue(all(os.path.exists(file) for file in files))
        self.assertIn("rotor_M.mtx", files)

    def test_lines_of_tables_are_kept_whole(self):
        self.assertIn('<pre style="white-space:pre;', model("jeffcott").modes(modes=2)._repr_html_())


class Models(unittest.TestCase):
    def test_values_are_read_as_written_and_set_by_paths(self):
        m = model("jeffcott_stator")
        m["contact.ring.friction"] = 0.25
        self.assertEqual(m["contact.ring.friction"], 0.25)
        m["operation.speed"] = "1200 rpm"
        self.assertEqual(m["operation.speed"], "1200 rpm")
        self.assertIsInstance(m["contact"], list)
        self.assertEqual(m.sets, ["contact.ring.friction=0.25", "operation.speed=1200 rpm"])
        m["contact.ring.friction"] = np.float64(0.1)
        self.assertEqual(m.sets, ["operation.speed=1200 rpm", "contact.ring.friction=0.1"])
        self.assertAlmostEqual(m.check().speed_rpm, 1200.0)
        self.assertAlmostEqual(m.check(speed="600 rpm").speed_rpm, 600.0)
        self.assertAlmostEqual(m.check(set={"operation.speed": "700 rpm"}).speed_rpm, 700.0)
        self.assertAlmostEqual(m.check().speed_rpm, 1200.0)

    def test_several_values_hold_together(self):
        m = model("jeffcott_stator")
        before = m.to_toml()
        with self.assertRaises(whirl.ModelError):
            m.update({"contact.ring.friction": 0.3, "contact.ring.stiffness": "-1 N/m"})
        self.assertEqual(m.to_toml(), before)
        other = m.copy()
        other["contact.ring.friction"] = 0.3
        self.assertEqual(m.to_toml(), before)
        self.assertNotEqual(other.to_toml(), before)

    def test_texts_of_models_are_the_same_models(self):
        for path in sorted(support.MODELS.glob("*.toml")):
            with self.subTest(model=path.stem):
                m = whirl.read(path)
                again = whirl.Model(m.to_toml(), path)
                self.assertEqual(again.to_toml(), m.to_toml())
                self.assertEqual(again.check().to_dict(), m.check().to_dict())

    def test_are_built_in_code(self):
        built = (whirl.Model(title="Overhung disk")
                 .operation(speed="3000 rpm")
                 .material(name="steel", density="7800 kg/m^3", youngs_modulus="210 GPa", poisson_ratio=0.3)
                 .shaft(material="steel", length="400 mm", outer_diameter="25 mm", elements=8)
                 .disk(name="disk", at="400 mm", mass="8 kg", polar_inertia="0.1 kg.m^2", diametral_inertia=0.05)
                 .add("unbalance", at="400 mm", moment="100 g.mm")
                 .bearing(at=0.0, stiffness=50e6, damping="500 N.s/m")
                 .bearing(at=0.2, stiffness="50 MN/m", damping=500))
        read = model("overhung_disk")
        for verb in ("modes", "critical", "unbalance"):
            found, expected = (getattr(m, verb)().to_dict() for m in (built, read))
            del found["model"], expected["model"]
            self.assertEqual(found, expected)
        again = whirl.Model(built.to_toml())
        self.assertEqual(again.to_toml(), built.to_toml())
        again.disk(name="second", at="200 mm", mass=1.0, polar_inertia=0.01, diametral_inertia=0.005)
        self.assertEqual(len(again["disk"]), 2)
        with self.assertRaises(whirl.ModelError) as raised:
            whirl.Model().shaft(length="1 m", material="steel").disk(at="3 m").check()
        self.assertGreater(len(raised.exception.problems), 1)
        with self.assertRaises(TypeError):
            whirl.Model().disk(mass=object())

    def test_tables_are_those_of_model_files(self):
        properties = json.loads(whirl._whirl.model_schema())["properties"]
        kinds = {"array": "several", "object": "one"}
        tables = {name: kinds[p["type"]] for name, p in properties.items() if p.get("type") in kinds}
        self.assertEqual(whirl.methods.TABLES, {**tables, "material": "named"})

    def test_stubs_are_those_of_the_methods(self):
        done = subprocess.run([sys.executable, support.REPOSITORY / "tools/python-stubs", support.PACKAGE, "--check"])
        self.assertEqual(done.returncode, 0)

    @needs("mypy")
    def test_stubs_fit_the_module(self):
        place = support.REPOSITORY / "tests/python"
        done = subprocess.run([sys.executable, "-m", "mypy.stubtest", "whirl", "--allowlist", place / "stubtest_allowed.txt",
                               "--mypy-config-file", place / "mypy.ini"], capture_output=True, text=True,
                              env={**os.environ, "MYPYPATH": support.PACKAGE, "PYTHONPATH": support.PACKAGE})
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def test_help_reads_well(self):
        doc = inspect.getdoc(whirl.Model.simulate)
        self.assertTrue(doc.startswith("Integrates in time"))
        for text in ("Parameters", "revolutions : N", "from_ : FILE.h5", "Raises", "progress : "):
            self.assertIn(text, doc)
        self.assertIn("revolutions=None", str(inspect.signature(whirl.Model.simulate)))
        self.assertEqual(list(inspect.signature(whirl.Model.campbell).parameters)[1], "speeds")
        for verb in whirl.verbs.VERBS.values():
            self.assertTrue(getattr(whirl.Model, whirl.verbs.python_name(verb.name)).__doc__)


class Figures(unittest.TestCase):
    def test_are_those_of_the_program(self):
        found = model("two_disk_mac").campbell("0:6000:1000rpm")
        found.save("campbell.h5")
        status, _, errors = command_line("plot", "campbell.h5", "campbell", "--out", "campbell.svg")
        self.assertEqual(status, 0, errors)
        with open("campbell.svg", encoding="utf-8") as file:
            self.assertEqual(found.svg("campbell"), file.read())
        shown = re.sub(r'whirl-\w{12}-| style="max-width:100%;height:auto"', "", found._repr_svg_())
        self.assertTrue(shown.startswith("<svg ") and found.svg("campbell").endswith(shown))
        self.assertIn("<svg", found._repr_html_())
        self.assertIn("campbell", found.figures())

    def test_stand_beside_each_other_on_a_page(self):
        m = model("two_disk_mac")
        names = [re.findall(r'id="([^"]+)"', m.campbell(f"0:6000:{step}rpm")._repr_html_()) for step in (1000, 2000)]
        self.assertTrue(names[0])
        self.assertFalse(set(names[0]) & set(names[1]))
        shown = m.modes(modes=2)._repr_html_()
        self.assertEqual(set(re.findall(r"url\(#([^)]+)\)", shown)), set(re.findall(r'id="([^"]+)"', shown)))

    def test_identify_shows_its_mac(self):
        found = model("two_disk_mac").identify(speed="4430 rpm", revolutions=16, discard=2, modes=4)
        self.assertEqual(found.svg(), found.svg("mac"))
        self.assertIn("MAC of deflection shapes", found._repr_html_())

    def test_pages_are_reports(self):
        page = model("jeffcott").modes(modes=2).report()
        self.assertIn("<html", page.html)
        self.assertIn("<iframe", page._repr_html_())
        page.save("page.html")

    @needs("matplotlib")
    def test_can_be_drawn_with_matplotlib(self):
        import matplotlib

        matplotlib.use("Agg")
        import matplotlib.pyplot as plt

        found = model("two_disk_mac").campbell("0:6000:1000rpm")
        axes = found.plot()
        self.assertRegex(axes.get_xlabel(), re.compile("speed"))
        run = model("two_disk_mac").identify(speed="4430 rpm", revolutions=16, discard=2, modes=4)
        for kind, variants in run.figures().items():
            with self.subTest(kind=kind):
                self.assertIsNotNone(run.plot(kind))
                plt.close("all")
        self.assertEqual(run.x.sel(station="ring").plot().get_ylabel(), "x [m]")
        plt.close("all")


support.main()
