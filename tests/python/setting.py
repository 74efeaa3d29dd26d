# SPDX-License-Identifier: GPL-2.0-or-later
"""Where the tests of tests/python find things: LAGEN is the program, LAGEN_SOURCE the source tree, LAGEN_BINARY a folder."""

import atexit
import os
import pathlib
import subprocess
import tempfile

import lagen

_cache = tempfile.TemporaryDirectory()
atexit.register(_cache.cleanup)
os.environ.setdefault("LAGEN_CACHE", _cache.name)
os.environ.setdefault("CXXFLAGS", "-O0")

source = pathlib.Path(os.environ["LAGEN_SOURCE"])
binary = pathlib.Path(os.environ["LAGEN_BINARY"])
models = source / "models"
all_tests = os.environ.get("LAGEN_ALL_TESTS") == "ON"


def written(folder, name, text):
    """A file of the folder with this text."""
    path = pathlib.Path(folder) / name
    path.write_text(text, encoding="utf-8")
    return path


def output_of(*words, **options):
    """What a program prints; AssertionError with its standard error where it fails."""
    done = subprocess.run(words, capture_output=True, encoding="utf-8", check=False, **options)
    assert done.returncode == 0, done.stderr
    return done.stdout
