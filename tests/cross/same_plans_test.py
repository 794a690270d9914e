#!/usr/bin/python3 -B
"""same_plans_test.py HOST_PROGRAM COMMAND...: both must end well and print the same lines, the last one the hash."""

import difflib
import subprocess
import sys

if len(sys.argv) < 3:
    sys.exit("usage: same_plans_test.py HOST_PROGRAM COMMAND...")


PATIENCE_S = 900  # a minute or two where nothing else runs


def said_by(command):
    try:
        done = subprocess.run(command, capture_output=True, text=True, stdin=subprocess.DEVNULL, timeout=PATIENCE_S)
    except subprocess.TimeoutExpired:
        sys.exit(f"{' '.join(command)}: no end after {PATIENCE_S} s")
    if done.returncode != 0:
        sys.exit(f"{' '.join(command)}: ended with {done.returncode}\n{done.stdout}{done.stderr}")
    return done.stdout.splitlines()


here = said_by(sys.argv[1:2])
there = said_by(sys.argv[2:])
if not here or not here[-1].startswith("hash "):
    sys.exit(f"{sys.argv[1]}: printed no hash; expected one in the last line")
if here != there:
    sys.exit("\n".join(difflib.unified_diff(here, there, "this machine", "the other CPU", lineterm="")))
print("\n".join(there))
