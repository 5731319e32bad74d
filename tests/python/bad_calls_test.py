"""Fifty wrong calls: each gives TypeError, ModelError or another of whirl's errors that says what would be
right, and leaves the model as it was."""

import subprocess
import sys
import unittest

import support
from support import MODELS, model, np, whirl

ME, TE = whirl.ModelError, TypeError
FILE = str(MODELS / "jeffcott_stator.toml")

# what is called with a model, the error, and what it must say
CALLS = [
    # options that do not exist, and values of another type
    (lambda m: m.modes(mode=3), TE, "did you mean modes"),
    (lambda m: m.simulate(revs=3), TE, "has no option revs; "),
    (lambda m: m.modes(modes=[]), TE, "expected a number or a text such as N, found list"),
    (lambda m: m.modes(modes=object()), TE, "found object"),
    (lambda m: m.modes(modes={1: 2}), TE, "found dict"),
    (lambda m: m.modes(modes=True), TE, "found bool"),
    (lambda m: m.sweep(fresh="yes", over={"operation.speed": "1:2:1rad/s"}), TE, "expected True or False"),
    (lambda m: m.sweep(fresh=1, over={"operation.speed": "1:2:1rad/s"}), TE, "expected True or False"),
    (lambda m: m.static(3), TE, "named arguments only"),
    (lambda m: m.campbell("0:100:10rpm", "0:1:1"), TE, "one argument without a name"),
    (lambda m: m.campbell({"operation.speed": "1:2:1"}), TE, "one argument without a name"),
    (lambda m: m.campbell("0:100:10rpm", speeds="0:100:10rpm"), TE, "speeds twice"),
    (lambda m: m.map(over=3), TE, "expected a dict of paths and values"),
    (lambda m: m.map(over={3: "1:2:1"}), TE, "expected a dict of paths and values"),
    (lambda m: m.map(over={"operation.speed": None}), TE, "expected a dict of paths and values"),
    (lambda m: m.campbell(speeds=np.zeros((2, 2))), TE, "found ndarray"),
    (lambda m: m.modes(set="a=b"), TE, "expected a dict of paths and values, found str"),
    (lambda m: m.modes(set={"disk.1.mass": object()}), TE, "disk.1.mass: expected a number"),
    (lambda m: m.modes(speed=object()), TE, "operation.speed: expected a number"),
    # values that mean nothing
    (lambda m: m.modes(modes="many"), ME, "expected"),
    (lambda m: m.modes(modes=2.5), ME, "expected"),
    (lambda m: m.modes(modes=0), ME, "expected"),
    (lambda m: m.modes(modes=-3), ME, "expected"),
    (lambda m: m.modes(modes=10**12), ME, "expected"),
    (lambda m: m.modes(speed="3000 N"), ME, "expected a speed"),
    (lambda m: m.modes(speed="fast"), ME, "expected a speed"),
    (lambda m: m.modes(speed=float("nan")), ME, "operation.speed"),
    (lambda m: m.campbell(speeds="0:100"), ME, "speeds") if False else (lambda m: m.campbell(speeds="0:1 m"), ME, "speeds"),
    (lambda m: m.campbell(speeds="5:1:1rpm"), ME, "speeds"),
    (lambda m: m.simulate(method="euler"), ME, "taylor"),
    (lambda m: m.simulate(tolerance=0.0), ME, "tolerance"),
    (lambda m: m.simulate(tolerance="1 m"), ME, "tolerance"),
    (lambda m: m.simulate(revolutions=-1), ME, "revolutions"),
    (lambda m: m.simulate(revolutions=10**7, samples=10**5), ME, "GB"),
    (lambda m: m.simulate(stations="nowhere"), ME, "nowhere"),
    (lambda m: m.simulate(from_="nothing.h5"), whirl.FileError, "nothing.h5"),
    (lambda m: m.simulate(isa="z80"), ME, "isa"),
    (lambda m: m.orbit(frame="moving"), ME, "stationary or rotating"),
    (lambda m: m.orbit(harmonics=5), ME, "harmonic-balance"),
    (lambda m: m.map({"operation.speed": "1:2:1rad/s"}), ME, "over"),
    (lambda m: m.map({"operation.sped": "1:2:1rad/s", "contact.ring.friction": "0:1:1"}), ME, "speed"),
    (lambda m: m.sweep({"operation.speed": "1:2"}), ME, "step"),
    (lambda m: m.frf(from_="1:sideways"), ME, "from"),
    (lambda m: m.lateral(stages="1:2"), ME, "stages"),
    (lambda m: m.modes(out="no/such/folder/x.h5"), whirl.FileError, "no/such/folder"),
    (lambda m: m.modes(out=FILE), ME, "jeffcott_stator.toml"),
    # paths and values of the model
    (lambda m: m["contact.ring.frictoin"], ME, 'did you mean "friction"'),
    (lambda m: m["contact.rong.friction"], ME, 'did you mean "ring"'),
    (lambda m: m[3], TE, "path of a value"),
    (lambda m: m.__setitem__("contact.ring.friction", -1.0), ME, "contact.ring.friction"),
    (lambda m: m.__setitem__("contact.ring.frictoin", 0.1), ME, "friction"),
    (lambda m: m.__setitem__("contact.ring.stiffness", "4 MN/mm^2"), ME, "expected a stiffness"),
    (lambda m: m.__setitem__(3, 4), TE, "path of a value"),
    (lambda m: m.update({"contact.ring.friction": 0.1, "operation.speed": "1 m"}), ME, "expected a speed"),
    (lambda m: m.update([1, 2]), TE, "expected a dict"),
    (lambda m: m.matrices(speed="1 kg"), ME, "expected a speed"),
    (lambda m: m.state_space(inputs=3), TE, "inputs: expected a text"),
    (lambda m: m.state_space(inputs="nowhere:x"), ME, "inputs"),
    (lambda m: m.state_space(outputs="rotor:sideways"), ME, "outputs"),
    (lambda m: m.state_space("rotor:forward"), ME, "a sense of whirl is no real signal"),
    (lambda m: m.state_space(quantity="jerk"), ME, "displacement, velocity, acceleration"),
    (lambda m: m.state_space(quantity=3), ME, "found 3, expected displacement"),
    (lambda m: m.state_space(modes=0), ME, "expected 1 to"),
    # files and texts
    (lambda m: whirl.read("nothing.toml"), ME, "cannot read the file"),
    (lambda m: whirl.read(3), TE, ""),
    (lambda m: whirl.Model(""), ME, "empty"),
    (lambda m: whirl.Model("format = 1\n[["), ME, ""),
    (lambda m: whirl.Model(b"format = 1"), TE, ""),
    (lambda m: whirl.open("nothing.h5"), whirl.FileError, "nothing.h5"),
    (lambda m: whirl.open(FILE), whirl.FileError, "jeffcott_stator.toml"),
    (lambda m: whirl.Result(), TE, "methods of a model"),
    (lambda m: whirl.report(), TE, "one result or more"),
    (lambda m: whirl.report(3), TE, "one result or more"),
    (lambda m: m.check().svg("bode"), ME, "can be drawn as"),
    (lambda m: m.check().svg("bodee"), ME, 'did you mean "bode"'),
    (lambda m: m.check().nothing, AttributeError, "has no 'nothing'"),
    (lambda m: m.check()["/nothing"], KeyError, "there are"),
    (lambda m: m.check().save("no/such/folder/x.h5"), whirl.FileError, "no/such/folder"),
    # what is made of results
    (lambda m: m.check().identify(), ME, "holds no motion; simulate and identify record one"),
    (lambda m: m.simulate(revolutions=2, discard=0).identify(modes=0), ME, "--modes 0: expected a whole number"),
    (lambda m: m.simulate(revolutions=2, discard=0).identify(speed="3 rpm"), TE, "has no option speed"),
    (lambda m: m.check().to_csv("no/such/folder/x"), whirl.FileError, "no/such/folder"),
    (lambda m: m.check().to_csv(object()), TE, "expected a number or a text such as NAME"),
    (lambda m: m.check().to_csv("x", revolutions=2), ME, "are of motions"),
    (lambda m: m.check().export(outt="x"), TE, "did you mean out"),
    (lambda m: m.check().export(format="nothing"), ME, "there are vtk, xdmf, csv"),
    (lambda m: m.export(format="csv"), ME, "a model holds no tables"),
    (lambda m: m.check().animate(), ME, "expected a video"),
]


class BadCalls(unittest.TestCase):
    def test_say_what_would_be_right(self):
        self.assertGreaterEqual(len(CALLS), 50)
        m = model("jeffcott_stator")
        before = m.to_toml()
        for number, (call, error, says) in enumerate(CALLS):
            with self.subTest(number=number, says=says):
                with self.assertRaises(error) as raised:
                    call(m)
                self.assertIn(says, str(raised.exception))
                self.assertEqual(m.to_toml(), before)

    def test_all_problems_are_told_with_their_places(self):
        text = (MODELS / "jeffcott_stator.toml").read_text()
        text = text.replace("\nfriction", "\nfrictoin").replace("[operation]", "[operatoin]")
        with self.assertRaises(ME) as raised:
            whirl.Model(text, "rotor.toml")
        problems = raised.exception.problems
        self.assertGreaterEqual(len(problems), 2)
        for problem in problems:
            self.assertTrue(problem.message)
        self.assertTrue(any(p.file == "rotor.toml" and p.line > 1 for p in problems))
        self.assertTrue(any("friction" in p.message for p in problems))

    def test_another_python_is_told(self):
        code = "import sys; sys.path.insert(0, sys.argv[1]); sys.modules[sys.argv[2]] = None; import whirl"
        for module in ("numpy", "whirl._whirl"):
            done = subprocess.run([sys.executable, "-c", code, support.PACKAGE, module], capture_output=True, text=True)
            self.assertIn(f"needs numpy and the Python that it was built with, such as /usr/bin/python3; this is "
                          f"{sys.executable}", done.stderr.splitlines()[-1])

    def test_names_of_strangers_do_not_steer_the_terminal(self):
        steers = "\x1b]0;owned\x07\x9b31m\u202e"
        m = (whirl.Model(title=steers).operation(speed="100 rad/s").add("body", name="r" + steers + "\nspoofed", mass=2.0, spins=True)
             .bearing(body="r" + steers + "\nspoofed", stiffness=2e4, damping=4.0))
        run = m.simulate(revolutions=2, discard=0)
        run.save("strange.h5")
        opened = whirl.open("strange.h5")
        texts = [repr(m), run.text, repr(run), repr(opened), repr(run.trajectory), repr(run.x), repr(run.groups)]
        m.contact(name=steers, body="r", stiffness=-1.0)
        for call in (m.check, lambda: whirl.read(steers), lambda: whirl.open(steers)):
            with self.assertRaises((whirl.ModelError, whirl.FileError)) as raised:
                call()
            texts.append(str(raised.exception))
        for text in texts:
            self.assertNotRegex(text, "[\x1b\x07\x9b\u202e]")
        self.assertIn(steers, opened.trajectory.station[0])  # the name itself is what it is

    def test_what_a_call_reads_is_not_written(self):
        with open("probes", "w") as file:
            file.write('[[probe]]\nname = "X"\nnode = 2\nangle = "0 deg"\n')
        with open("probes") as file:
            before = file.read()
        with self.assertRaises(whirl.FileError):
            model("jeffcott").simulate(revolutions=2, discard=0, measure="probes", measured_out="new.csv", out="probes",
                                       force=True)
        with open("probes") as file:
            self.assertEqual(file.read(), before)

    def test_errors_can_be_pickled(self):
        import pickle

        with self.assertRaises(ME) as raised:
            model("jeffcott").modes(modes=0)
        again = pickle.loads(pickle.dumps(raised.exception))
        self.assertEqual(again.problems, raised.exception.problems)


support.main()
