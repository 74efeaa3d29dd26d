# SPDX-License-Identifier: MIT
"""One call of the program lagen."""

import os
import subprocess

from .options import spell_options


class Error(Exception):
    """What lagen said when it gave no result.

    message: its standard error; code: its exit code (1: the mathematics says no, 2: undecided, 3: the model file, 4: the
    command line, 5: the machine).
    """

    def __init__(self, message, code):
        super().__init__(message)
        self.message = message
        self.code = code


def call(command, *arguments, **options):
    """Runs `lagen COMMAND ARGUMENTS --options` and gives what it prints: (standard output, standard error).

    >>> text, messages = lagen.call("derive", "kepler.toml", form="hamilton")

    Raises Error where there is no output and the exit code is not 0, or where there is no such program. An output with an
    exit code of its own, as of a refuted model or a run that ended early, is a result.
    """
    program = os.environ.get("LAGEN") or "lagen"
    words = [program, command, *spell_options(options), *map(os.fspath, arguments)]
    try:
        done = subprocess.run(words, stdin=subprocess.DEVNULL, capture_output=True, encoding="utf-8", check=False)
    except OSError as error:
        raise Error(f"the program lagen could not be started as '{program}': {error.strerror}; "
                    "set LAGEN to its path, or put it on PATH", 5) from error
    if done.returncode != 0 and not done.stdout:
        raise Error(done.stderr.strip() or f"lagen {command} ended with exit code {done.returncode}", done.returncode)
    return done.stdout, done.stderr.strip()
