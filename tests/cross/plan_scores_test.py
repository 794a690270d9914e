#!/usr/bin/python3 -B
"""plan_scores_test.py FLOAT FIXED: the same plans, made with doubles, are worth the same to both builds: ET, ET_c, EST and
unseen mass within 0.01 %. Once as they are, once with waypoints that lie on no grid, as another tool's."""

import random
import subprocess
import sys

ALLOWED = 1e-4
FIGURES = ("ET", "ET_c", "EST", "unseen")


def said_by(*command, given=None):
    done = subprocess.run(command, input=given, stdout=subprocess.PIPE, text=True, check=False)
    if done.returncode != 0:
        sys.exit(f"{' '.join(command)}: ended with {done.returncode}")
    return done.stdout


def nudged(plans):
    """Every waypoint but the first, and so that it stays on the map, by up to 5 cm in a direction of its own."""
    drawn = random.Random(1)
    lines = []
    for line in plans.splitlines():
        words = line.split()
        places = [min(39.9, max(0.1, float(word) + drawn.uniform(-0.05, 0.05))) for word in words[4:]]
        lines.append(" ".join(words[:4] + [repr(place) for place in places]))
    return "\n".join(lines) + "\n"


plans = said_by(sys.argv[1], "make")
wrong = []
for kind, given in (("as planned", plans), ("nudged", nudged(plans))):
    tables = [[line.split() for line in said_by(program, "score", given=given).splitlines()] for program in sys.argv[1:3]]
    if len(tables[0]) != 4 or [row[0] for row in tables[0]] != [row[0] for row in tables[1]]:
        sys.exit("expected the same four cases of both")
    for (case, *doubles), (_, *fixed) in zip(*tables):
        for figure, a, b in zip(FIGURES, map(float, doubles), map(float, fixed)):
            apart = abs(a - b) / abs(a) if a else abs(b)
            print(f"{case:10} {kind:10} {figure:7} doubles {a:.9g}, fixed point {b:.9g}, {apart:.1e} apart")
            if not apart <= ALLOWED:
                wrong.append(f"{case} {kind}: {figure} {apart:.1e} apart, expected at most {ALLOWED}")
sys.exit("; ".join(wrong) or 0)
