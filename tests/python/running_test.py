"""Running: other threads of Python go on, models run beside each other, Ctrl-C and exceptions stop a verb
with what it has, and memory stays as it is."""

import os
import signal
import subprocess
import sys
import threading
import time
import unittest

import support
from support import model, same_bits, whirl

LONG = {"revolutions": 200_000, "discard": 0, "samples": 4}


def resident():
    """Memory in use [bytes]."""
    with open("/proc/self/statm") as file:
        return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")


class Running(unittest.TestCase):
    def test_python_goes_on_meanwhile(self):
        counted, done = [0], threading.Event()

        def count():
            while not done.is_set():
                counted[0] += 1
                time.sleep(1e-3)

        thread = threading.Thread(target=count)
        thread.start()
        begin = time.monotonic()
        model("jeffcott_stator").simulate(revolutions=3000, discard=0, samples=4)
        elapsed = time.monotonic() - begin
        done.set()
        thread.join()
        self.assertGreater(counted[0], 100 * elapsed)  # of 1000 in a second, on a busy machine

    def test_two_models_run_at_once(self):
        names = ["jeffcott_stator", "two_disk_mac"]
        options = {"speed": "4000 rpm", "revolutions": 40, "discard": 5}
        alone = [model(name).simulate(**options) for name in names]
        found, m = {}, [model(name) for name in names]

        def work(i):
            for _ in range(3):
                found[i] = m[i % 2].simulate(**options, out=f"thread_{i}.h5")

        threads = [threading.Thread(target=work, args=(i,)) for i in range(4)]
        for t in threads:
            t.start()
        for t in threads:
            t.join()
        for i in range(4):
            self.assertTrue(same_bits(found[i].x, alone[i % 2].x))
            self.assertTrue(same_bits(whirl.open(f"thread_{i}.h5").x, alone[i % 2].x))

    def test_one_model_on_films_is_used_by_several_threads(self):
        m = model("two_disk_oil_film")  # its equilibria are found once, whoever asks
        found = []

        def work(i):
            for k in range(20):
                speed = f"{1000 + 10 * k} rpm"
                found.append(m.matrices(speed=speed).K.sum() if i % 2 else m.modes(modes=1, speed=speed).speed_rpm)
                found.append(m.matrices().K.sum() if i % 2 else m.static().speed_rpm)

        threads = [threading.Thread(target=work, args=(i,)) for i in range(4)]
        for t in threads:
            t.start()
        for t in threads:
            t.join(60.0)
        self.assertEqual(len(found), 4 * 40)

    def test_one_model_runs_in_several_threads(self):
        m = model("two_disk_mac")
        alone = m.campbell("0:5000:500rpm").to_dict()
        found = []
        threads = [threading.Thread(target=lambda: found.append(m.campbell("0:5000:500rpm").to_dict())) for _ in range(4)]
        for t in threads:
            t.start()
        for t in threads:
            t.join()
        self.assertEqual(found, [alone] * 4)

    def test_ctrl_c_stops_with_what_there_is(self):
        threading.Timer(0.5, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
        with self.assertRaises(KeyboardInterrupt) as raised:
            model("jeffcott_stator").simulate(**LONG)
        result = raised.exception.result
        self.assertFalse(result.is_whole)
        self.assertGreater(len(result.time), 0)
        self.assertLess(result.revolutions, LONG["revolutions"])

    def test_a_study_is_stopped_and_goes_on(self):
        options = {"over": {"operation.speed": "130:140:0.05rad/s", "contact.ring.stiffness": "10:20:0.1MN/m"},
                   "revolutions": 50, "exponents": 50, "discard": 50, "out": "stopped.h5"}
        has_begun = threading.Event()

        def stop():
            has_begun.wait()
            os.kill(os.getpid(), signal.SIGINT)

        threading.Thread(target=stop).start()
        with self.assertRaises(KeyboardInterrupt) as raised:
            model("jeffcott_stator").map(**options, progress=lambda what, done, total: done and has_begun.set())
        done = raised.exception.result.done
        self.assertGreater(done.sum(), 0)
        self.assertLess(done.sum(), done.size)
        self.assertTrue(same_bits(whirl.open("stopped.h5").done, done))

    def test_linear_verbs_are_left_between_their_steps(self):
        speeds = "100:12000:0.5rpm"  # minutes
        for name, verb, options in [("compressor", "campbell", {"speeds": speeds}),
                                    ("compressor", "unbalance", {"speeds": speeds}),
                                    ("compressor", "modes", {"over": {"operation.speed": speeds}}),
                                    ("compressor", "frf", {"from_": "1:x", "frequencies": "1:900:0.01Hz", "speed": "1 rpm"}),
                                    ("two_disk_oil_film", "campbell", {"speeds": speeds})]:
            with self.subTest(model=name, verb=verb):
                m = model(name)
                before = m.modes(modes=2, speed="4000 rpm").to_dict()["modes"]
                threading.Timer(0.2, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
                begin = time.monotonic()
                with self.assertRaises(KeyboardInterrupt) as raised:
                    getattr(m, verb)(**options)
                self.assertLess(time.monotonic() - begin, 5.0)
                self.assertFalse(hasattr(raised.exception, "result"))
                self.assertEqual(m.modes(modes=2, speed="4000 rpm").to_dict()["modes"], before)  # films, too

    def test_an_exception_of_progress_leaves(self):
        def fail(what, done, total):
            raise RuntimeError(f"enough of {what}")

        with self.assertRaisesRegex(RuntimeError, "enough of simulating"):
            model("jeffcott_stator").simulate(**LONG, progress=fail)

    def test_progress_is_told(self):
        told = []
        model("jeffcott_stator").simulate(revolutions=3000, discard=0, samples=4,
                                          progress=lambda *facts: told.append(facts))
        self.assertEqual({(what, total) for what, _, total in told}, {("simulating", 3000)})
        self.assertEqual([done for _, done, _ in told], sorted(done for _, done, _ in told))

    def test_the_interrupt_handler_of_python_stays(self):
        before = signal.getsignal(signal.SIGINT)
        model("jeffcott_stator").simulate(revolutions=10, discard=0)
        self.assertIs(signal.getsignal(signal.SIGINT), before)
        with self.assertRaises(KeyboardInterrupt):
            os.kill(os.getpid(), signal.SIGINT)
            time.sleep(1.0)

    def test_motions_that_fail_are_told(self):
        m = (whirl.Model()  # dry friction that pushes forward: it grows beyond all bounds
             .operation(speed="300 rad/s")
             .body(name="rotor", mass=1.0, spins=True)
             .bearing(body="rotor", stiffness=1e4, damping=1.0)
             .add("unbalance", body="rotor", offset="1 mm")
             .contact(name="ring", body="rotor", clearance="0.1 mm", stiffness=1e5, friction=2.0, slip="forward"))
        with self.assertWarnsRegex(RuntimeWarning, "ring"):
            found = m.simulate(revolutions=2000, discard=0)
        self.assertIn("ring", found.failure)
        self.assertFalse(found.is_whole)
        self.assertGreater(len(found.time), 0)

    def test_the_interpreter_ends_cleanly(self):
        code = ("import sys; sys.path.insert(0, sys.argv[1]); import whirl, threading\n"
                "m = whirl.read(sys.argv[2])\n"
                "a = m.campbell('0:1000:100rpm').campbell\n"
                "t = threading.Thread(target=lambda: m.simulate(revolutions=100, discard=0)); t.start(); t.join()\n"
                "print(whirl.__version__)")
        done = subprocess.run([sys.executable, "-c", code, support.PACKAGE, str(support.MODELS / "jeffcott_stator.toml")],
                              capture_output=True, text=True)
        self.assertEqual((done.returncode, done.stderr), (0, ""))


class Memory(unittest.TestCase):
    def test_ten_thousand_calls_leave_no_memory_behind(self):
        m = model("jeffcott")

        def use(n):
            for i in range(n):
                found = m.static()
                found.to_dict()
                if i % 10 == 0:
                    m["operation.speed"] = f"{1000 + i % 7} rpm"
                    for group in found.groups.values():
                        [group[name] for name in group]
                    try:
                        m.modes(modes=0)
                    except whirl.ModelError:
                        pass

        use(1000)
        before = resident()
        use(10_000)
        grown = resident() - before
        print(f"{grown / 1024:.0f} kB more after 10 000 calls")
        self.assertLess(grown, 2**18)  # 26 bytes of a call; measured: 0


support.main()
