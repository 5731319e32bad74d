"""What a call from Python costs beside what the verb itself takes.

    PYTHONPATH=build/release/python python3 bench/python_call.py
"""

import pathlib
import time

import whirl

m = whirl.read(str(pathlib.Path(__file__).resolve().parents[1] / "models" / "jeffcott.toml"))
costs = []
for _ in range(2000):
    begin = time.perf_counter()
    found = m.static()
    costs.append(time.perf_counter() - begin - found._found.seconds)
costs.sort()
print(f"median {1e6 * costs[len(costs) // 2]:.1f} us, the least {1e6 * costs[0]:.1f} us, of {len(costs)} calls")
