#!/usr/bin/env python3
"""Runs the commands of a document as a reader would, in an empty folder.

Blocks ```sh are run, blocks ```toml NAME are appended to the file NAME; `<!-- expect: TEXT -->` after a block says what
its output must contain. Blocks ```sh full take minutes: they are run with --full only. Exit status 0 if every command
succeeds and every expectation is met.

usage: run_commands.py DOCUMENT.md PROGRAM [--full]     --full also prints what the commands print
"""
import os
import re
import subprocess
import sys
import tempfile

document, program = sys.argv[1], os.path.abspath(sys.argv[2])
is_full = "--full" in sys.argv[3:]
text = open(document, encoding="utf-8").read()
root = os.path.dirname(os.path.dirname(os.path.abspath(document)))
pieces = re.findall(r"```(\w+)(?: (\S+))?\n(.*?)```|<!-- expect: (.*?) -->", text, flags=re.S)
ran = 0
with tempfile.TemporaryDirectory() as folder:
    os.symlink(os.path.join(root, "models"), os.path.join(folder, "models"))
    path = os.path.dirname(program) + os.pathsep + os.environ["PATH"]
    environment = dict(os.environ, PATH=path, NO_COLOR="1")
    output = ""
    for language, name, body, expected in pieces:
        if expected:
            if output is not None and expected not in output:
                sys.exit(f"{document}: expected \"{expected}\" in:\n{output}")
        elif language == "sh" and name == "full" and not is_full:
            output = None  # and nothing is expected of it
        elif language == "sh":
            run = subprocess.run(["bash", "-e", "-c", body], cwd=folder, env=environment, text=True,
                                 stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
            output = run.stdout
            if is_full:
                print(f"$ {body}{output}", flush=True)
            if run.returncode != 0:
                sys.exit(f"{document}: exit status {run.returncode} of\n{body}\n{output}")
            ran += 1
        elif name:
            with open(os.path.join(folder, name), "a", encoding="utf-8") as file:
                file.write(body + "\n")
if ran == 0:
    sys.exit(f"{document}: no command was found")
print(f"{document}: {ran} blocks of commands ran")
