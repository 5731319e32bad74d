"""A study under Slurm meets the time limit of its job, is put back and goes on, and ends as an undisturbed one.

    slurm_test.py WHIRL WHIRL-MPI REPOSITORY     exit status 77 where it cannot run: not root, no slurmd, ...

The job is the first script of docs/cluster.md, whose numbers alone are made smaller. The cluster is this machine alone,
with a munge, a slurmctld and a slurmd of its own, all in one temporary folder and one namespace of processes: the kernel
ends whatever is left in it with the test, however that ends. Nothing outside of the folder is written.
"""

import os
import pathlib
import re
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time
import traceback

from result_files import differences, python_with_h5py

SKIPPED = 77
DAEMONS = ("munged", "slurmctld", "slurmd")
CLIENTS = ("munge", "sbatch", "srun", "scontrol", "mpirun")
PATH = os.environ.get("PATH", "") + ":/usr/sbin:/sbin"

# What the script of the document becomes: (as it is there, here). The study takes two processors some 30 s.
NUMBERS = (
    ("--nodes=4", "--nodes=1"),
    ("--cpus-per-task=32", "--cpus-per-task=1"),
    ("--time=4:00:00", "--time=1"),
    ("rotor.toml", "jeffcott_stator.toml"),
    ("operation.speed=130:165:0.1rad/s", "operation.speed=130:160:0.2rad/s"),
    ("contact.ring.friction=0:0.3:0.001", "contact.ring.friction=0:0.3:0.01"),
)
# slurmctld looks at limits every 30 s only, and then warns of those that are TERM@... and 30 s away: a job of a
# minute is stopped at the first look. It begins so long after a look that its first part is short; later ones take
# some 20 s.
AFTER_A_LOOK = 22.0  # [s]
ENDS = ("COMPLETED", "FAILED", "TIMEOUT", "CANCELLED", "NODE_FAIL", "BOOT_FAIL", "OUT_OF_MEMORY")
LOOK = "Testing job time limits"
LIMIT = 600.0  # [s] for the job with all its returns: some 90 s on a free machine


class Failed(Exception):
    pass


class Skipped(Exception):
    pass


def script_of(document):
    """The first script of the document with the numbers of this test."""
    script = re.search(r"## Slurm, one job\n.*?```sh\n(.*?)```", document, re.DOTALL).group(1)
    for told, here in NUMBERS:
        if script.count(told) != 1:
            raise Failed(f"the first script of docs/cluster.md has no {told}, or several")
        script = script.replace(told, here)
    return script


def free_ports(count):
    sockets = [socket.socket() for _ in range(count)]
    for one in sockets:
        one.bind(("127.0.0.1", 0))
    ports = [one.getsockname()[1] for one in sockets]
    for one in sockets:
        one.close()
    return ports


def configuration(folder):
    """slurm.conf of a cluster of this machine alone."""
    host = socket.gethostname().split(".")[0]
    controller, node = free_ports(2)
    return f"""ClusterName=test
SlurmctldHost={host}(127.0.0.1)
SlurmctldPort={controller}
SlurmdPort={node}
SlurmUser=root
AuthType=auth/munge
CredType=cred/munge
# a job that was put back waits until what its first part was allowed has expired: 120 s if nothing is said
AuthInfo=socket={folder}/munge.socket,cred_expire=5
MpiDefault=pmix
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
# ... and until jobs are looked at again: every minute if nothing is said
SchedulerParameters=sched_interval=2,bf_interval=2
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SlurmdParameters=config_overrides
ReturnToService=2
KillWait=10
SlurmctldDebug=debug2
SlurmctldLogFile={folder}/slurmctld.log
SlurmctldPidFile={folder}/slurmctld.pid
StateSaveLocation={folder}/state
SlurmdLogFile={folder}/slurmd.log
SlurmdPidFile={folder}/slurmd.pid
SlurmdSpoolDir={folder}/spool
NodeName={host} NodeAddr=127.0.0.1 CPUs=2
PartitionName=all Nodes={host} Default=YES MaxTime=INFINITE
"""


def environment(folder, programs):
    """Of all that runs here: no setting of another cluster or of somebody's Open MPI, and no network."""
    kept = {k: v for k, v in os.environ.items() if not k.startswith(("SLURM", "SBATCH", "OMPI", "PMIX"))}
    return kept | {"PATH": f"{programs}:{PATH}", "SLURM_CONF": str(folder / "slurm.conf"), "TMPDIR": str(folder),
                   "OMPI_MCA_btl": "self,vader", "OMPI_MCA_btl_vader_single_copy_mechanism": "none"}


class Cluster:
    """The daemons, which end with the namespace."""

    def __init__(self, folder, programs):
        self.folder = folder
        self.environment = environment(folder, programs)
        (folder / "munge.key").touch(mode=0o600)
        (folder / "munge.key").write_bytes(os.urandom(128))
        (folder / "slurm.conf").write_text(configuration(folder))
        (folder / "mpi.conf").write_text(f"PMIxCliTmpDirBase={folder}\n")
        for name in ("state", "spool"):
            (folder / name).mkdir()
        self.start("munged", "--foreground", "--force", f"--key-file={folder}/munge.key",
                   f"--socket={folder}/munge.socket", f"--pid-file={folder}/munge.pid",
                   f"--log-file={folder}/munge.log", f"--seed-file={folder}/munge.seed")
        self.wait_for("munge", lambda: (folder / "munge.socket").exists())
        self.start("slurmctld", "-D")
        self.start("slurmd", "-D")
        self.wait_for("the node", lambda: "idle" in self.says("sinfo", "--noheader", "--format=%T"), 60)

    def start(self, *words):
        with open(self.folder / f"{words[0]}.out", "w") as out:
            return subprocess.Popen(words, env=self.environment, stdin=subprocess.DEVNULL, stdout=out, stderr=out)

    def says(self, *words):
        return subprocess.run(words, env=self.environment, cwd=self.folder, text=True, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, timeout=60).stdout.strip()

    def wait_for(self, what, is_so, limit=20.0):
        end = time.monotonic() + limit
        while not is_so():
            if time.monotonic() > end:
                raise Failed(f"waited {limit:.0f} s for {what}")
            time.sleep(0.2)

    def looks(self):
        return (self.folder / "slurmctld.log").read_text(errors="replace").count(LOOK)

    def job(self, number):
        """What Slurm tells of a job."""
        return dict(re.findall(r"(\w+)=(\S*)", self.says("scontrol", "--oneliner", "show", "job", number)))

    def run(self, script):
        """Runs a batch script to its end, and gives what Slurm tells of it."""
        (self.folder / "job.sh").write_text(script)
        before = self.looks()
        self.wait_for("slurmctld to look at limits", lambda: self.looks() > before, 90)
        time.sleep(AFTER_A_LOOK)
        number = self.says("sbatch", "--parsable", "job.sh")
        if not number.isdigit():
            raise Failed("sbatch takes no job: " + number)
        begin, last = time.monotonic(), None
        while time.monotonic() - begin < LIMIT:
            job = self.job(number)
            state = {key: job.get(key) for key in ("JobState", "Reason", "Restarts", "ExitCode")}
            if state != last:
                print(f"{time.monotonic() - begin:5.1f} s", *(f"{k}={v}" for k, v in state.items()), flush=True)
                last = state
            if job.get("JobState") in ENDS:
                return job
            time.sleep(0.5)
        raise Failed(f"the job has not ended in {LIMIT:.0f} s")


def undisturbed(script, whirl, cluster):
    """The same study by whirl, alone and in one go."""
    words = re.search(r"whirl-mpi (map .*?--out) atlas\.h5", script.replace("\\\n", " ")).group(1).split()
    begin = time.monotonic()
    outcome = subprocess.run([whirl, *words, "alone.h5", "--threads", "2"], env=cluster.environment,
                             cwd=cluster.folder, text=True, capture_output=True)
    if outcome.returncode != 0:
        raise Failed("whirl map: " + outcome.stderr)
    print(f"undisturbed, two threads: {time.monotonic() - begin:.1f} s", flush=True)


def test(folder, whirl, programs, repository):
    script = script_of((repository / "docs/cluster.md").read_text())
    shutil.copy(repository / "models/jeffcott_stator.toml", folder)
    cluster = Cluster(folder, programs)
    if "pmix" not in cluster.says("srun", "--mpi=list").split():
        raise Skipped("srun knows no pmix")
    undisturbed(script, whirl, cluster)
    job = cluster.run(script)
    if job["JobState"] != "COMPLETED" or job["ExitCode"] != "0:0":
        raise Failed(f"the job is {job['JobState']} with status {job['ExitCode']}")
    if int(job["Restarts"]) < 1:
        raise Failed("the job was done before its time was over: the study of this test must be larger")
    different = differences(folder / "alone.h5", folder / "atlas.h5", "map")
    if different:
        raise Failed("not as undisturbed: " + ", ".join(different))
    log = (folder / f"slurm-{job['JobId']}.out").read_text()
    parts = re.findall(r"stopped with (\d+) of", log)
    print(f"put back {job['Restarts']} times, with {', '.join(parts)} points; all datasets of /map are those of the "
          "undisturbed study")


def tell(folder):
    """The logs, where something failed."""
    for path in sorted(folder.glob("*.out")) + sorted(folder.glob("*.log")):
        lines = path.read_text(errors="replace").splitlines()
        print(f"---- {path.name}", *[line for line in lines if "debug" not in line][-40:], sep="\n")


def first_process(arguments):
    """What the first process of the namespace does: it takes in orphans, and ends all others at the end."""
    folder = pathlib.Path(tempfile.mkdtemp(prefix="whirl-slurm."))
    folder.chmod(0o711)  # munge wants its socket within reach of everybody
    try:
        child = os.fork()
        if child == 0:
            status = 1
            try:
                whirl, whirl_mpi, repository = (pathlib.Path(word).resolve() for word in arguments)
                test(folder, whirl, whirl_mpi.parent, repository)
                status = 0
            except Skipped as skipped:
                print("skipped:", skipped)
                status = SKIPPED
            except Failed as failed:
                tell(folder)
                print("FAILED:", failed)
            except Exception:
                traceback.print_exc(file=sys.stdout)
                tell(folder)
            finally:
                sys.stdout.flush()
                os._exit(status)
        while True:
            process, status = os.wait()
            if process == child:
                return os.waitstatus_to_exitcode(status)
    finally:
        assert os.getpid() == 1  # else the next line would end the session
        os.kill(-1, signal.SIGKILL)
        shutil.rmtree(folder, ignore_errors=True)


def why_not():
    """Why this test cannot run here; empty: it can."""
    missing = [name for name in (*DAEMONS, *CLIENTS, "unshare") if not shutil.which(name, path=PATH)]
    if missing:
        return "there is no " + ", ".join(missing)
    if not python_with_h5py():
        return "Python has no h5py"
    if os.getuid() != 0:
        return "slurmd needs root"
    if subprocess.run([*NAMESPACE, "true"], capture_output=True).returncode != 0:
        return "no namespace of processes may be made here"
    return ""


FIRST = "--first-process"
NAMESPACE = ("unshare", "--pid", "--fork", "--mount-proc", "--kill-child")

if __name__ == "__main__":
    if sys.argv[1] == FIRST:
        sys.exit(first_process(sys.argv[2:]))
    if why := why_not():
        print("skipped:", why)
        sys.exit(SKIPPED)
    sys.stdout.flush()
    os.execvp(NAMESPACE[0], [*NAMESPACE, python_with_h5py(), os.path.abspath(__file__), FIRST, *sys.argv[1:]])
