"""Studies of whirl-mpi whose processes are killed at random moments go on to the bits of an undisturbed one.

    kill_test.py WHIRL WHIRL-MPI MPIRUN REPOSITORY [--times N] [--seed S] [--ranks N] [--study NAME]

Every way of killing is tried so many times with every study: SIGKILL to a worker or to rank 0, SIGTERM to rank 0, to a
worker or to mpirun. Each time the same line goes on, is killed again or not, and at last all datasets must be those of
`whirl`, undisturbed. Exit status 77 where it cannot run.
"""

import argparse
import os
import pathlib
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time

from result_files import differences, python_with_h5py

SKIPPED = 77
LIMIT = 300.0  # [s], of a run
STUCK = 20.0  # [s], that mpirun may take to end without ranks, or these without it
LONG = 3.0  # [s], that an undisturbed study takes at least, lest every kill be too late
LATEST = 0.9  # of the time that a study takes: when it is killed at the latest
EARLIER = 0.7  # of that, after every kill that was too late
TOO_LATE = 10  # such kills after another
MARK = "WHIRL_KILL_TEST"
DOUBLING = ["--speed", "138.4rad/s", "--set", "contact.ring.stiffness=64e6"]
# (group of the result, coarsest step of the first value, words)
STUDIES = {
    "map": ("map", 0.4, ["map", "jeffcott_stator.toml", "--over", "operation.speed=130:160:{step}rad/s",
                         "--over", "contact.ring.friction=0:0.3:0.03", "--discard", "60", "--revolutions", "30"]),
    "sweep": ("sweep", 0.2, ["sweep", "jeffcott_stator.toml", "--over", "operation.speed=130:160:{step}rad/s",
                             "--discard", "60", "--revolutions", "30"]),
    "continue": ("branch", 0.0002, ["continue", "jeffcott_stator.toml", *DOUBLING, "--over",
                                    "contact.ring.friction=0.08:0.18:{step}", "--at", "0.13", "--switch", "2",
                                    "--over", "contact.ring.stiffness=63.5:64.5:0.5MN/m"]),
}
# who is killed, and how; a rank, "worker" for any but the first, or mpirun itself
KILLS = {
    "SIGKILL to a worker": ("worker", signal.SIGKILL),
    "SIGKILL to rank 0": (0, signal.SIGKILL),
    "SIGTERM to rank 0": (0, signal.SIGTERM),
    "SIGTERM to a worker": ("worker", signal.SIGTERM),
    "SIGTERM to mpirun": (None, signal.SIGTERM),
}


class Failed(Exception):
    pass


def environment():
    """Of all that runs here: as root, with more ranks than processors, without what containers forbid."""
    more = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
            "OMPI_MCA_rmaps_base_oversubscribe": "1", "OMPI_MCA_hwloc_base_binding_policy": "none",
            "OMPI_MCA_btl": "self,vader", "OMPI_MCA_btl_vader_single_copy_mechanism": "none"}
    return os.environ | more | {MARK: str(os.getpid())}


def rank_of(process):
    """The rank of a process of this test; None for others."""
    try:
        if pathlib.Path(f"/proc/{process}/comm").read_text().strip() != "whirl-mpi":
            return None
        words = pathlib.Path(f"/proc/{process}/environ").read_bytes().split(b"\0")
    except OSError:  # it has ended
        return None
    values = dict(word.decode(errors="replace").split("=", 1) for word in words if b"=" in word)
    rank = values.get("OMPI_COMM_WORLD_RANK", values.get("PMI_RANK"))
    return int(rank) if values.get(MARK) == str(os.getpid()) and rank is not None else None


def ranks_now():
    """Processes of this test, by their ranks."""
    found = {}
    for path in pathlib.Path("/proc").iterdir():
        rank = rank_of(path.name) if path.name.isdigit() else None
        if rank is not None:
            found[rank] = int(path.name)
    return found


class Trials:
    """Kills of one study."""

    def __init__(self, name, folder, options):
        self.name, self.folder, self.options = name, folder, options
        self.group, step, words = STUDIES[name]
        self.random = random.Random(f"{options.seed} {name}")
        self.stuck, self.takes = 0, 0.0
        while self.takes < LONG:
            self.words = [word.format(step=step) for word in words] + ["--out"]
            self.undisturbed.unlink(missing_ok=True)
            whole = subprocess.run([options.whirl, *self.words, self.undisturbed.name], cwd=folder, capture_output=True,
                                   text=True)
            if whole.returncode != 0:
                raise Failed(f"whirl {name}: {whole.stderr}")
            self.whole()
            step /= 2

    @property
    def undisturbed(self):
        return self.folder / f"{self.name}.h5"

    @property
    def file(self):
        return self.folder / "killed.h5"

    def start(self):
        line = [self.options.mpirun, "-n", str(self.options.ranks), self.options.whirl_mpi, *self.words, self.file.name,
                "--threads", "1"]
        with open(self.folder / "told", "w") as told:
            return subprocess.Popen(line, cwd=self.folder, env=environment(), stdin=subprocess.DEVNULL,
                                    stdout=told, stderr=told)

    def finish(self, job):
        """Waits until all of its processes are gone; its status.

        Open MPI's mpirun may wait for ever for a rank that was killed while it began: that is counted, and ended.
        """
        begin = last = time.monotonic()
        while job.poll() is None:
            now = time.monotonic()
            if ranks_now():
                last = now
            if now - begin > LIMIT:
                raise Failed(f"{self.name} has not ended in {LIMIT:.0f} s")
            if now - last > STUCK:
                self.stuck += 1
                job.kill()
            time.sleep(0.02)
        end = time.monotonic() + STUCK
        while left := ranks_now():
            if time.monotonic() > end:
                raise Failed(f"processes are left after mpirun has ended: {left}")
            time.sleep(0.02)
        return job.returncode

    def differences(self):
        return differences(self.undisturbed, self.file, self.group)

    def end(self):
        """Lets the same line go on to its end, and looks at what it leaves."""
        if status := self.finish(self.start()):
            raise Failed(f"{self.name} ends with status {status}: " + (self.folder / "told").read_text())
        if different := self.differences():
            raise Failed(f"{self.name}: not as undisturbed: " + ", ".join(different))
        for path in self.folder.glob("killed.h5*"):
            if path != self.file:
                raise Failed(f"left behind: {path.name}")
            path.unlink()

    def whole(self):
        """Takes its time from the beginning to the end, which other work on the machine changes."""
        begin = time.monotonic()
        self.end()
        self.takes = time.monotonic() - begin

    def kill(self, who, how, latest):
        """Begins, or goes on, and kills it at a moment before that part of its time; whether it was not done before."""
        job = self.start()
        time.sleep(self.takes * self.random.uniform(0.1 * latest, latest))
        while job.poll() is None and len(ranks_now()) < self.options.ranks:  # all of them have begun
            time.sleep(0.01)
        ranks = ranks_now()
        rank = self.random.randrange(1, self.options.ranks) if who == "worker" else who
        if job.poll() is None and (rank is None or rank in ranks):
            os.kill(job.pid if rank is None else ranks[rank], how)
        self.finish(job)  # whose status, after SIGTERM, depends on the MPI
        return bool(self.differences())

    def run(self, who, how):
        """Kills it once to three times, and lets it go on to its end; (kills, whether something was saved before)."""
        kills, late, was_saved, wanted = 0, 0, False, self.random.randint(1, 3)
        while kills < wanted:
            if self.kill(who, how, LATEST * EARLIER**late):
                kills += 1
                was_saved |= self.file.exists()
            elif kills > 0:
                break
            else:  # that was too late, as mpirun takes a second to hand on a signal: it begins anew
                late += 1
                if late == TOO_LATE:
                    raise Failed(f"{self.name} is done in {self.takes:.1f} s, before each of {late} kills")
                self.end()
                self.whole()
        self.end()
        return kills, was_saved


def test(folder, options):
    shutil.copy(options.repository / "models/jeffcott_stator.toml", folder)
    for name in options.study or STUDIES:
        trials = Trials(name, folder, options)
        for what, (who, how) in KILLS.items():
            done = [trials.run(who, how) for _ in range(options.times)]
            kills, saved = sum(k for k, _ in done), sum(s for _, s in done)
            print(f"{name}, {what}: {len(done)} of {options.times} go on to the same bits "
                  f"({kills} kills; in {saved} of them something was saved)", flush=True)
        if trials.stuck:
            print(f"{name}: mpirun did not end {trials.stuck} times after its ranks had", flush=True)


def parsed():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    for name in ("whirl", "whirl_mpi", "mpirun", "repository"):
        parser.add_argument(name, type=lambda path: pathlib.Path(path).absolute())
    parser.add_argument("--times", type=int, default=20, help="of each way of killing (default: %(default)s)")
    parser.add_argument("--ranks", type=int, default=3, help="processes (default: %(default)s)")
    parser.add_argument("--seed", type=int, default=1, help="of the moments (default: %(default)s)")
    parser.add_argument("--study", action="append", choices=STUDIES, help="only this one; may be given several times")
    return parser.parse_args()


if __name__ == "__main__":
    arguments = parsed()
    python = python_with_h5py()
    if not python or not arguments.mpirun.exists():
        print("skipped: there is no", "h5py" if not python else arguments.mpirun)
        sys.exit(SKIPPED)
    if python != sys.executable and not os.environ.get(MARK):
        os.environ[MARK] = "again"
        os.execv(python, [python, os.path.abspath(__file__), *sys.argv[1:]])
    with tempfile.TemporaryDirectory(prefix="whirl-kill.") as temporary:
        try:
            test(pathlib.Path(temporary), arguments)
        except Failed as failed:
            print("FAILED:", failed)
            sys.exit(1)
