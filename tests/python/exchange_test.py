"""To and from other programs: state spaces for scipy.signal, files of MATLAB, rotors saved by ROSS."""

import csv
import json
import os
import unittest
import warnings

import support
from support import model, needs, np, same_bits, whirl

PROBES = """
[[probe]]
name  = "top"
node  = 7
angle = "45 deg"
[[probe]]
name  = "front x"
at    = "500 mm"
angle = 2.0
"""


def scaled(a, b):
    """The largest difference of arrays, by the largest of the second."""
    return np.abs(a - b).max() / np.abs(b).max()


@needs("scipy")
class Matrices(unittest.TestCase):
    def test_are_those_of_the_export(self):
        import scipy.io

        m = model("two_disk_mac")
        made = m.matrices(speed="3000 rpm")
        m.export(format="mtx", out="rotor", speed="3000 rpm")
        M, C, G, K = made
        for name, matrix in zip("MCGK", (M, C, G, K)):
            self.assertIs(getattr(made, name), matrix)
            self.assertTrue(same_bits(matrix.toarray(), scipy.io.mmread(f"rotor_{name}.mtx").toarray()))
        with open("rotor_dofs.csv") as file:
            self.assertEqual([row[1] for row in list(csv.reader(file))[1:]], made.dofs)
        self.assertEqual(len(made.z), len(made.dofs))
        self.assertIn("of 52 coordinates (node 1 x, ", repr(made))


@needs("scipy")
class StateSpaces(unittest.TestCase):
    def compare(self, m, inputs, outputs, speed, only=None, frequencies="1:200:3.7Hz"):
        quantities = {"displacement": "receptance", "velocity": "mobility", "acceleration": "accelerance"}
        quantities = {q: name for q, name in quantities.items() if q in (only or quantities)}
        found = m.frf(from_=inputs, to=outputs, frequencies=frequencies, speed=speed)
        made = m.state_space(inputs, outputs, quantity=list(quantities), speed=speed)
        H = made.response(found.frf.frequency)
        k = len(made.outputs) // len(quantities)
        self.assertEqual(len(found.frf.to), k * len(made.inputs))
        self.assertEqual(list(found.frf.to)[:k], made.outputs[:k])
        self.assertEqual(list(found.frf["from"])[::k], made.inputs)
        self.assertEqual(made.speed, found.frf.speed)
        worst = 0.0
        for i, name in enumerate(quantities.values()):
            expected = np.asarray(found.frf[name]).reshape(len(made.inputs), k, -1).transpose(1, 0, 2)
            worst = max(worst, scaled(H[i * k:(i + 1) * k], expected))
        return worst

    def test_frequency_responses_are_those_of_the_program(self):
        for name, speed in [("two_disk_mac", "4430 rpm"), ("two_disk_oil_film", None), ("compressor", "5000 rpm"),
                            ("jeffcott", "2000 rpm"), ("overhung_disk", 0.0), ("cross_coupled_bearing", None),
                            ("jeffcott_stator", "1300 rpm")]:
            with self.subTest(model=name):
                worst = self.compare(model(name), None, None, speed)
                print(f"{name}: {worst:.1e}")
                self.assertLess(worst, 1e-10)

    def test_ends_are_stations_tilts_and_probes(self):
        m = model("two_disk_mac")
        m = whirl.Model(m.to_toml() + PROBES, m.path)
        self.assertLess(self.compare(m, "ring:theta_y,3:x,top", "top,front x,left disk:y,7:theta_x", "3000 rpm"), 1e-10)
        made = m.state_space(["ring", "top"], ["front x"], quantity="acceleration", speed="3000 rpm")
        self.assertEqual((made.inputs[1], made.outputs), ("top", ["front x acceleration"]))
        self.assertEqual((made.B.shape[1], made.C.shape[0], made.D.shape), (2, 1, (1, 2)))

    def test_are_taken_by_scipy(self):
        from scipy import signal
        from scipy.linalg import expm

        m = model("two_disk_mac")
        made = m.state_space("4:x", "4:x,7:y", speed="3000 rpm", modes=8)
        self.assertEqual(made.A.shape, (16, 16))
        self.assertEqual(len(made.states), 16)
        self.assertEqual(made.shapes.shape[1], 8)
        eigenvalues = np.linalg.eigvals(m.state_space("4:x", speed="3000 rpm").A)
        for mode in np.asarray(m.modes(modes=4, speed="3000 rpm").modes.eigenvalue):
            self.assertLess(np.abs(eigenvalues - mode).min(), 1e-9 * abs(mode))
        # a force that begins: the rotor after a while, step by step and at once
        times = np.linspace(0.0, 0.2, 201)
        _, y, _ = signal.lsim(made.to_scipy(), np.ones_like(times), times)
        grown = expm(made.A * times[-1]) - np.eye(16)
        self.assertLess(scaled(y[-1], made.C @ grown @ np.linalg.solve(made.A, made.B[:, 0])), 1e-9)

    def test_free_rotors_have_theirs(self):
        shaft = (whirl.Model()
                 .operation(speed="3000 rpm")
                 .material(name="steel", density=7800, youngs_modulus="210 GPa", poisson_ratio=0.3)
                 .shaft(material="steel", length="1 m", outer_diameter="30 mm", elements=20)
                 .disk(name="disk", at=0.3, mass=8.0, polar_inertia=0.1, diametral_inertia=0.05))
        # slower, rounding of the stiffness costs `frf` itself more: 2e-9 of the largest at 1 Hz
        worst = self.compare(shaft, "disk:x,1:theta_y", "disk:x,disk:y,21:x", None, frequencies="50:400:13Hz")
        self.assertLess(worst, 1e-10)
        free = whirl.Model("\n".join(["format = 1", "[[body]]", 'name = "ball"', "mass = 2", "spins = true"]))
        self.assertAlmostEqual(abs(free.state_space("ball:x").response(10.0)[0, 0, 0]), 1 / 200, places=15)

    def test_coordinates_without_mass_follow_the_others(self):
        m = model("blade_seal")  # a shaft without mass, whose damping is that of its stiffness
        self.assertEqual(len(m.state_space().states), 2 * 6 + 6)
        self.assertLess(self.compare(m, "labyrinth disk:x", "labyrinth disk:x,blade disk:y,1:theta_x", None), 1e-10)
        undamped = whirl.Model(m.to_toml().replace("stiffness = 1e-4", "mass = 1.0"))
        self.assertEqual(len(undamped.state_space().states), 2 * 6)
        self.assertLess(self.compare(undamped, "blade disk:x", "labyrinth disk:x,blade disk:y,1:theta_x", None), 1e-10)
        # a moment where nothing has inertia: the tilt has no velocity
        self.assertLess(self.compare(undamped, "1:theta_x", "1:theta_x,blade disk:x", None, ["displacement"]), 1e-10)
        with self.assertRaisesRegex(whirl.NumericalError, "1 left theta_x: without a mass there, .* its velocity"):
            undamped.state_space("1:theta_x", quantity="velocity")

    def test_pedestals_without_mass_may_have_springs_and_dampers(self):
        # in series with the rotor's own: the state of each damper, or none
        for below, between, dampers in [(50.0, 0.0, 2), (0.0, 20.0, 2), (50.0, 20.0, 2), (0.0, 0.0, 0)]:
            with self.subTest(below=below, between=between):
                m = (whirl.Model()
                     .body(name="rotor", mass=2.0, spins=True)
                     .body(name="pedestal", mass=0.0)
                     .bearing(body="pedestal", stiffness=3e4, damping=below)
                     .link(from_="rotor", to="pedestal", stiffness=2e4, damping=between))
                made = m.state_space("rotor:x,pedestal:y", speed="30 rad/s")
                self.assertEqual(len(made.states), 4 + dampers)
                self.assertLess(self.compare(m, "rotor:x,pedestal:y", "rotor:x,pedestal:x,pedestal:y", "30 rad/s",
                                             ["displacement"]), 1e-13)
                self.assertLess(self.compare(m, "rotor:x", "rotor:x,pedestal:x", "30 rad/s"), 1e-13)
        loose = whirl.Model().body(name="rotor", mass=1.0).bearing(body="rotor", stiffness=1e4).body(name="loose", mass=0.0)
        with self.assertRaisesRegex(whirl.NumericalError, "neither mass nor stiffness: loose x, loose y"):
            loose.state_space("rotor:x", speed=0.0)


@needs("scipy")
class Matlab(unittest.TestCase):
    def test_files_hold_every_array_with_its_unit(self):
        import scipy.io

        for found in (model("two_disk_mac").identify(speed="4430 rpm", revolutions=16, discard=2, modes=4),
                      model("two_disk_mac").frf(from_="ring:x", frequencies="0:100:1Hz"),
                      model("jeffcott_stator").continue_({"operation.speed": "130:130.5:0.25rad/s"}, discard=50, most=4)):
            with self.subTest(verb=found.verb):
                found.to_mat("run.mat")
                read = scipy.io.loadmat("run.mat", struct_as_record=False, chars_as_strings=True)
                self.assertEqual((read["verb"][0], read["model"][0]), (found.verb, found.model))
                count = 0
                for name, group in found.groups.items():
                    struct = read[whirl.results._matlab_name(name)][0, 0]
                    units = getattr(read["units"][0, 0], whirl.results._matlab_name(name))[0, 0]
                    for key in group:
                        field = whirl.results._matlab_name(key)
                        self.compare(getattr(struct, field), np.asarray(group[key]))
                        unit = getattr(units, field)
                        self.assertEqual(unit[0] if unit.size else "", group[key].unit)
                        count += 1
                    for key, value in group.attributes.items():
                        self.assertEqual(getattr(struct, key).item() if not isinstance(value, str) else value, value)
                self.assertGreater(count, 4)

    def compare(self, read, array):
        if array.dtype.kind == "U":
            self.assertEqual([str(cell[0]) if cell.size else "" for cell in read.ravel()],
                             [str(text) for text in array.ravel()])
        else:
            self.assertTrue(same_bits(np.ascontiguousarray(read).reshape(array.shape), array))

    def test_names_are_names_there(self):
        for name, made in (("x", "x"), ("a-b/c", "a_b_c"), ("1X", "a_1X"), ("_y", "a__y"), ("end", "end_")):
            self.assertEqual(whirl.results._matlab_name(name), made)


@unittest.skipUnless(hasattr(whirl._whirl, "import_file"), "the module has no import_file")
class Ross(unittest.TestCase):
    FILES = support.REPOSITORY / "tests/data/ross"

    def test_rotors_are_those_of_the_import(self):
        for path in [*sorted(self.FILES.glob("*.toml")), support.MODELS / "layered_ross.json"]:
            with self.subTest(file=path.name), warnings.catch_warnings(record=True) as told:
                warnings.simplefilter("always")
                m = whirl.from_ross(path)
                status, text, errors = support.command_line("import", path, "--out", "rotor.toml", "--force", "--json", "-")
                self.assertEqual(status, 0, errors)
                record = json.loads(text)
                said = [str(w.message) for w in told]
                self.assertEqual(len(said), len(record["left_out"]) + len(record["taken_differently"]))
                expected = whirl.read("rotor.toml").modes(modes=6, speed="1000 rpm")
                self.assertTrue(same_bits(m.modes(modes=6, speed="1000 rpm").eigenvalue, expected.eigenvalue))

    def test_nothing_else_is(self):
        with self.assertRaisesRegex(whirl.FileError, "nothing.json"):
            whirl.from_ross("nothing.json")
        with self.assertRaises(whirl.ModelError):
            whirl.from_ross(support.MODELS / "jeffcott.toml")
        self.assertFalse(os.path.exists("jeffcott.toml"))


support.main()
