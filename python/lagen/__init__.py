# SPDX-License-Identifier: MIT
"""The commands of lagen from Python, with results as numpy arrays.

    >>> import lagen
    >>> run = lagen.run("kepler.toml", set={"k": 2}, t_end=10)
    >>> run["x"], run.status, run.invariants["energy"]["max_drift"]

Every function calls the program lagen, which the environment variable LAGEN names, else the first one on PATH. Keyword
arguments are its options, with '_' for '-': `t_end=10` is --t-end 10 (see `spell_options`). What the program refuses is
raised as `Error`, with its message and its exit code.
"""

from .command import Error, call
from .options import spell_options
from .results import Check, Run, Table
from .tasks import chart, check, equations, run, sweep

__all__ = ["Check", "Error", "Run", "Table", "call", "chart", "check", "equations", "run", "spell_options", "sweep"]
