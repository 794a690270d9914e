"""A small tree with one planted file, and what a lint says of it."""

import os
import subprocess
import tempfile

SOURCE_DIR = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..")


def run(lint, files):
    """(exit status, output) of toolchain/lint/`lint` over a tree of `files`, path to text."""
    with tempfile.TemporaryDirectory() as tree:
        for path, text in files.items():
            full = os.path.join(tree, path)
            os.makedirs(os.path.dirname(full), exist_ok=True)
            with open(full, "w", encoding="utf-8") as file:
                file.write(text)
        done = subprocess.run(
            [os.path.join(SOURCE_DIR, "toolchain/lint", lint), tree], capture_output=True, text=True, stdin=subprocess.DEVNULL
        )
        return done.returncode, done.stdout + done.stderr
