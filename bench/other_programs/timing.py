"""Processor time of a call, and rows of a process as they come."""
import statistics
import subprocess
import tempfile
import time

from .rows import parsed


def timed(call, most_time=0.5, most_runs=5):
    """What a call returns and its processor time [s]: the median of some runs, of one where it is slow."""
    times = []
    while not times or (len(times) < most_runs and sum(times) < most_time):
        start = time.process_time()
        result = call()
        times.append(time.process_time() - start)
    return result, statistics.median(times)


def rows_of_process(words, folder, environment=None):
    """Rows that a process in a folder prints; where it fails the end of what it said is told."""
    with tempfile.TemporaryFile("w+") as errors:
        with subprocess.Popen(words, cwd=folder, env=environment, stdout=subprocess.PIPE, stderr=errors,
                              text=True) as process:
            for line in process.stdout:
                yield from parsed(line)
        if process.returncode:
            errors.seek(0)
            print(f"{words[0]}: status {process.returncode}: {errors.read()[-500:]}", flush=True)
