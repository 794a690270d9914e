"""Packages of npm for a test: those of a lock file, kept in build/."""

import os
import shutil
import subprocess

from mission_files import SOURCE_DIR


def run(*command, **options):
    done = subprocess.run(command, capture_output=True, text=True, stdin=subprocess.DEVNULL, check=False, **options)
    if done.returncode != 0:
        raise RuntimeError(f"{' '.join(command)}: {done.stdout}{done.stderr}")
    return done.stdout


def install(folder, then=lambda packages: None):
    """The packages of `folder`'s lock file into build/NAME, unless they are there for this version of node; returns where. `then` finishes what
    was installed."""
    packages = os.path.join(SOURCE_DIR, "build", os.path.basename(folder))
    with open(os.path.join(folder, "package-lock.json"), encoding="utf-8") as file:
        wanted = run("node", "--version") + file.read()
    stamp = os.path.join(packages, "installed")
    if os.path.exists(stamp):
        with open(stamp, encoding="utf-8") as file:
            if file.read() == wanted:
                return packages
    shutil.rmtree(packages, ignore_errors=True)
    os.makedirs(packages)
    for name in ("package.json", "package-lock.json", ".npmrc"):
        shutil.copy(os.path.join(folder, name), packages)
    run("npm", "ci", "--ignore-scripts", cwd=packages)
    then(packages)
    with open(stamp, "w", encoding="utf-8") as file:
        file.write(wanted)
    return packages
