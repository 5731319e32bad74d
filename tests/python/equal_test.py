"""Every verb gives what the command line gives, to the last bit: what --json says, and every dataset and
attribute of the result file; wrong input is told alike. What is not the same between two runs of the
program is left out: durations and dates."""

import contextlib
import importlib.util
import json
import unittest

import support
from support import command_line, model, same_bits, whirl

NAMES = sorted(path.stem for path in support.MODELS.glob("*.toml"))
# those that write files for others are in results_test.py
VERBS = {name for name, verb in whirl.verbs.VERBS.items() if not verb.takes_results}

# (verb, options): of every bundled model
ON_ALL = [
    ("check", {}),
    ("static", {}),
    ("modes", {"modes": 5, "speed": "2000 rpm"}),
    ("campbell", {"speeds": "500:3500:1000rpm", "modes": 4}),
    ("critical", {"modes": 3}),
    ("unbalance", {"speeds": "500:3500:1000rpm"}),
    ("frf", {"frequencies": "10:100:30Hz", "speed": "2000rpm"}),
    ("resonances", {"speeds": "500:3500:1000rpm", "modes": 2, "largest": 2}),
    ("lateral", {"maximum_speed": "2000rpm"}),
]
MOTION = {"revolutions": 8, "discard": 2}
STUDY = {"revolutions": 8, "exponents": 8, "discard": 4, "threads": 2}
# and of some
ON_SOME = [
    ("modes", "two_disk_mac", {"over": {"operation.speed": "2000:4000:1000rpm"}, "modes": 3}),
    ("critical", "jeffcott", {"over": {"disk.1.mass": "1:3:1kg"}, "modes": 2}),
    ("unbalance", "jeffcott", {"over": {"disk.1.mass": "1:3:1kg"}, "speeds": "500:3500:1000rpm"}),
    ("sensitivity", "magnetic_bearing", {"frequencies": "10:500:10Hz"}),
    ("simulate", "two_disk_mac", {**MOTION, "speed": "4430rpm"}),
    ("simulate", "two_disk_oil_film", {**MOTION, "method": "dop853"}),
    ("simulate", "blade_seal", {**MOTION, "stations": "all"}),
    ("identify", "two_disk_mac", {**MOTION, "modes": 4, "rotations": True}),
    ("classify", "jeffcott_stator", {"revolutions": 20, "discard": 10, "tolerance": 1e-9}),
    ("orbit", "jeffcott_stator", {"discard": 50, "period": 1}),
    ("orbit", "jeffcott_stator", {"starts": 3, "seed": 2}),
    ("continue", "jeffcott_stator", {"over": {"operation.speed": "130:130.5:0.25rad/s"}, "discard": 50, "most": 4}),
    ("torus", "jeffcott_stator", {"discard": 20, "revolutions": 200, "set": {"contact.ring.friction": 0.15}}),
    ("sweep", "jeffcott_stator", {**STUDY, "over": {"operation.speed": "130:132:1rad/s"}}),
    ("sweep", "jeffcott_stator", {**STUDY, "over": {"operation.speed": "130:132:1rad/s"}, "fresh": True, "spectra": 0}),
    ("map", "jeffcott_stator", {**STUDY, "over": {"operation.speed": "130:132:1rad/s",
                                                   "contact.ring.stiffness": "10:20:10MN/m"}}),
    ("basins", "jeffcott_stator", {**STUDY, "starts": 4}),
    ("bench", "jeffcott_stator", {"methods": "dop853", "tolerances": "1e-6", "revolutions": 2}),
]
# of times and places
TIMED_NUMBERS = {"wall_s", "seconds", "program"}
TIMED_ATTRIBUTES = {"created", "command", "seconds", "host", "process"}
TIMED_ARRAYS = {"/arguments", "/call/option", "/call/set"}


def words_of(options):
    """The same options as words of the command line."""
    for name, value in options.items():
        dashed = "--" + name.replace("_", "-")
        if isinstance(value, dict):
            yield from (f"{dashed}={path}={text}" for path, text in value.items())
        elif value is True:
            yield dashed
        else:
            yield f"{dashed}={value}"


def without_times(record):
    if isinstance(record, dict):
        return {k: without_times(v) for k, v in record.items() if k not in TIMED_NUMBERS}
    return [without_times(v) for v in record] if isinstance(record, list) else record


def exact(record):
    """A text that is the same for the same bits: of -0.0, of integers beside floats."""
    return json.dumps(without_times(record), sort_keys=True)


class Equal(unittest.TestCase):
    def compare(self, verb, name, options):
        self.files = getattr(self, "files", 0) + 1
        out = f"{verb}_{name}_{self.files}.h5"
        timed = verb == "bench"
        status, json_text, errors = command_line(
            verb, support.MODELS / f"{name}.toml", *words_of(options), "--out", out, "--force", "--json", "-", "--quiet")
        method = getattr(model(name), whirl.verbs.python_name(verb))
        try:
            with self.assertWarns(RuntimeWarning) if status == 3 and json_text else contextlib.nullcontext():
                found = method(**options)
        except whirl.ModelError as error:
            self.assertEqual(status, 2, errors)
            for problem in error.problems:
                self.assertIn(problem.message.split("\n")[0][:60], errors)
            return "refused"
        except whirl.NumericalError as error:
            self.assertEqual(status, 3, errors)
            self.assertIn(str(error)[:60], errors)
            return "failed"
        self.assertIn(status, (0, 3), errors)
        if not timed:
            self.assertEqual(exact(found.to_dict()), exact(json.loads(json_text)))
        self.compare_files(found, whirl.open(out), timed)
        return "equal"

    def compare_files(self, found, opened, timed):
        if importlib.util.find_spec("xarray"):
            for name, dataset in opened.to_datasets().items():
                self.assertTrue(set(opened.groups[name]) <= {*dataset.variables, *dataset.dims, *self.axes(opened.groups[name])})
        ours = [p for p in found._store.paths() if p not in TIMED_ARRAYS]
        theirs = [p for p in opened._store.paths() if p not in TIMED_ARRAYS]
        self.assertEqual(sorted(ours), sorted(theirs))
        for path in ours if not timed else []:
            with self.subTest(path=path):
                self.assertEqual(found._store.info(path), opened._store.info(path))
                self.assertTrue(same_bits(found._store.values(path), opened._store.values(path)))
        a, b = ({(o, n): v if isinstance(v, str) else repr(float(v)) for o, n, v in r._store.attributes()
                 if n not in TIMED_ATTRIBUTES} for r in (found, opened))
        self.assertEqual(a, b)

    def axes(self, group):
        """Those that stand along a dimension of another name."""
        return {name for name in group if len(group[name].dims) == 1}

    def test_every_verb_of_a_model_is_tried(self):
        tried = {verb for verb, *_ in ON_ALL} | {verb for verb, *_ in ON_SOME} | {"fit", "balance"}  # of measured motions
        self.assertEqual(tried, VERBS)

    def test_linear_verbs_on_all_bundled_models(self):
        counts = {}
        for name in NAMES:
            for verb, options in ON_ALL:
                with self.subTest(model=name, verb=verb):
                    outcome = self.compare(verb, name, options)
                    counts[outcome] = counts.get(outcome, 0) + 1
        print(counts)
        self.assertGreater(counts["equal"], 6 * len(NAMES))

    def test_motions_and_studies(self):
        for verb, name, options in ON_SOME:
            with self.subTest(model=name, verb=verb):
                self.assertEqual(self.compare(verb, name, options), "equal")

    def test_a_measured_motion(self):
        with open("probes.toml", "w", encoding="utf-8") as file:
            for name, angle in (("x", 0), ("y", 90)):
                file.write(f'[[probe]]\nname = "{name}"\nnode = 4\nangle = "{angle} deg"\n')
            file.write('[keyphasor]\nchannel = "key"\n')
        status, _, errors = command_line(
            "simulate", support.MODELS / "two_disk_mac.toml", *words_of(MOTION | {"revolutions": 40}), "--measure",
            "probes.toml", "--measured-out", "run.csv", "--noise", "1%", "--quiet")
        self.assertEqual(status, 0, errors)
        record = {"measured": "run.csv", "probes": "probes.toml", "modes": 4}
        for more in ({}, {"orders": "1,2"}, {"rate": 1000}):
            with self.subTest(options=more):
                self.assertEqual(self.compare("identify", "two_disk_mac", record | more),
                                 "refused" if "rate" in more else "equal")
        with self.subTest(verb="fit"):
            self.assertEqual(self.compare("fit", "two_disk_mac", {
                "measured": "run.csv", "probes": "probes.toml", "free": "contact.ring.stiffness,contact.ring.friction=0:0.2",
                "revolutions": 6}), "equal")

    def test_balancing(self):
        with open("balance.toml", "w", encoding="utf-8") as file:
            file.write('angles = "with rotation"\n[rotor]\ngrade = "G2.5"\n')
            for name, node in (("left", 4), ("right", 9)):
                file.write(f'[[plane]]\nname = "{name}"\nnode = {node}\nradius = "120 mm"\nholes = {{ count = 12 }}\n'
                           f'[[probe]]\nname = "{name}"\nnode = {node}\nangle = "45 deg"\nuncertainty = "1 um"\n')
        for more in ({}, {"criterion": "min-max"}, {"coefficients": "runs"}):
            with self.subTest(options=more):
                self.assertEqual(self.compare("balance", "two_disk_mac", {"runs": "balance.toml", "speed": "1500rpm"} | more),
                                 "refused" if "coefficients" in more else "equal")

    def test_files_written_by_python_are_those_of_the_command_line(self):
        found = model("jeffcott").unbalance("500:3500:500rpm")
        found.save("saved.h5")
        self.compare_files(found, whirl.open("saved.h5"), False)
        model("jeffcott").unbalance("500:3500:500rpm", out="asked.h5")
        self.compare_files(found, whirl.open("asked.h5"), False)
        status, text, errors = command_line("plot", "saved.h5")
        self.assertEqual(status, 0, errors)
        self.assertIn("bode", text)
        status, _, errors = command_line("rerun", "saved.h5", "--out", "again.h5")
        self.assertEqual(status, 0, errors)
        self.compare_files(found, whirl.open("again.h5"), False)

    def test_a_study_of_a_file_goes_on(self):
        m, options = model("jeffcott_stator"), next(dict(words) for verb, _, words in ON_SOME if verb == "map")
        first = m.map(**options, out="map.h5")
        again = m.map(**options, out="map.h5")
        self.assertEqual(first.resumed, 0)
        self.assertEqual(again.resumed, first["/map/motion"].size)
        self.compare_files(first, again, False)

    def test_matrices_are_those_of_the_export(self):
        try:
            from scipy.io import mmread
        except ImportError:
            self.skipTest("there is no scipy")
        status, _, errors = command_line("export", support.MODELS / "two_disk_mac.toml", "--speed", "3000rpm",
                                         "--format", "mtx", "--out", "rotor")
        self.assertEqual(status, 0, errors)
        found = model("two_disk_mac").matrices(speed="3000 rpm")
        for name in "MCGK":
            self.assertTrue(same_bits(mmread(f"rotor_{name}.mtx").toarray(), getattr(found, name).toarray()))
        self.assertEqual(len(found.dofs), found.M.shape[0])
        self.assertEqual(found.dofs[0], "node 1 x")
        self.assertAlmostEqual(found.speed, 3000 * 3.141592653589793 / 30)


support.main()
