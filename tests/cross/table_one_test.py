#!/usr/bin/python3 -B
"""table_one_test.py FLOAT FIXED: the mean ET of ten seeds on each row of Table I is the same in fixed point as in
doubles, within two standard errors of the difference. At the paper's length; IVO_TABLE_ONE_GENERATIONS=40 for a look."""

import os
import subprocess
import sys

generations = os.environ.get("IVO_TABLE_ONE_GENERATIONS", "400")
programs = [subprocess.Popen([path, generations, "10"], stdout=subprocess.PIPE, text=True) for path in sys.argv[1:3]]
tables = []
for program in programs:
    text = program.communicate()[0]
    if program.returncode != 0:
        sys.exit(f"{program.args[0]}: ended with {program.returncode}")
    tables.append([line.split() for line in text.splitlines()])
if len(tables[0]) != 8 or [row[0] for row in tables[0]] != [row[0] for row in tables[1]]:
    sys.exit("expected the same eight rows of both")
wrong = []
for (case, mean, error, _), (_, fixed_mean, fixed_error, _) in zip(*tables):
    allowed = 2 * (float(error) ** 2 + float(fixed_error) ** 2) ** 0.5
    apart = abs(float(mean) - float(fixed_mean))
    print(f"{case:7} doubles {float(mean):8.3f} +- {float(error):.3f} s, fixed point {float(fixed_mean):8.3f} +- {float(fixed_error):.3f} s")
    if apart > allowed:
        wrong.append(f"{case}: {apart:.3f} s apart, expected at most {allowed:.3f}")
print(f"{generations} generations of 10 ants, 10 seeds")
sys.exit("; ".join(wrong) or 0)
