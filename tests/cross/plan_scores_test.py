#!/usr/bin/python3 -B
"""plan_scores_test.py FLOAT FIXED: the same plans, made with doubles, are worth the same to both builds: ET, ET_c, EST and
unseen mass within 0.01 %, on maps of 40 m and of nearly a million cells. Once as they are, once with waypoints that lie on no
grid, as another tool's."""

import random
import subprocess
import sys

ALLOWED = 1e-4
FIGURES = ("ET", "ET_c", "EST", "unseen")
CASES = 11


def said_by(*command, given=None):
    done = subprocess.run(command, input=given, stdout=subprocess.PIPE, text=True, check=False)
    if done.returncode != 0:
        sys.exit(f"{' '.join(command)}: ended with {done.returncode}")
    return done.stdout


def nudged(line, drawn):
    """Every waypoint but the first, and so that it stays where the plan is, by up to 5 cm in a direction of its own."""
    words = line.split()
    places = [float(word) for word in words[2:]]
    low, high = min(places), max(places)
    moved = [min(high, max(low, place + drawn.uniform(-0.05, 0.05))) for place in places[2:]]
    return " ".join(words[:4] + [repr(place) for place in moved])


plans = said_by(sys.argv[1], "make").splitlines()
seeded = random.Random(1)
given = [f"as-planned {line}" for line in plans] + [f"nudged {nudged(line, seeded)}" for line in plans]
tables = [
    [line.split() for line in said_by(program, "score", given="\n".join(given) + "\n").splitlines()]
    for program in sys.argv[1:3]
]
if len(tables[0]) != 2 * CASES or [row[:2] for row in tables[0]] != [row[:2] for row in tables[1]]:
    sys.exit(f"expected the same {CASES} cases of both, twice")
wrong = []
for (kind, case, *doubles), (_, _, *fixed) in zip(*tables):
    for figure, a, b in zip(FIGURES, map(float, doubles), map(float, fixed)):
        apart = abs(a - b) / abs(a) if a else abs(b)
        print(f"{case:16} {kind:10} {figure:7} doubles {a:.9g}, fixed point {b:.9g}, {apart:.1e} apart")
        if not apart <= ALLOWED:
            wrong.append(f"{case} {kind}: {figure} {apart:.1e} apart, expected at most {ALLOWED}")
sys.exit("; ".join(wrong) or 0)
