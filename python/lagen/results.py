# SPDX-License-Identifier: MIT
"""What the commands give, as numpy arrays by name."""

from collections.abc import Mapping

import numpy


def _array(entries):
    """Numbers as an array of doubles (what has no value is nan), texts as an array of str."""
    if any(isinstance(entry, str) for entry in entries):
        return numpy.array(["" if entry is None else entry for entry in entries])
    if any(isinstance(entry, (list, dict)) for entry in entries):
        return numpy.array(entries, dtype=object)
    return numpy.array([numpy.nan if entry is None else entry for entry in entries], dtype=float)


class Table(Mapping):
    """Columns by name, each an array with an entry a row, in the order of the table."""

    def __init__(self, columns, rows):
        entries = zip(*rows) if rows else [()] * len(columns)
        self._columns = {name: _array(column) for name, column in zip(columns, entries)}

    @property
    def columns(self):
        """The names of the columns."""
        return list(self._columns)

    def __getitem__(self, name):
        return self._columns[name]

    def __iter__(self):
        return iter(self._columns)

    def __len__(self):
        return len(self._columns)

    def __repr__(self):
        rows = len(next(iter(self.values()), ()))
        return f"<{type(self).__name__} of {rows} rows: {', '.join(self.columns)}>"


class Run(Table):
    """A run: its rows by column (`run["t"]`, `run["x"]`), and what `lagen run --format json` says besides.

    report: all of it, as dictionaries and lists. messages: what lagen wrote on standard error, as warnings of drift.
    A run is true where it came to its end (or its own event stopped it), as a solution in C++ is.
    """

    def __init__(self, report, messages=""):
        super().__init__(report["columns"], report["rows"])
        self.report = report
        self.messages = messages

    @property
    def status(self):
        """'ok', 'stopped_by_event', or why the run ended early: 'left_domain', 'newton_diverged', .."""
        return self.report["status"]

    @property
    def invariants(self):
        """{name: {"initial", "max_drift", ..}} of what was followed as constant."""
        return self.report["invariants"]

    @property
    def events(self):
        """[{"name", "t", "state"}], in the order of time."""
        return self.report["events"]

    @property
    def state(self):
        """The last good state, {name: value}; its time is `run.report["t"]`."""
        return self.report["state"]

    def __bool__(self):
        return self.status in ("ok", "stopped_by_event")


class Check:
    """What `lagen check` decided of one model; true where it is valid.

    report: all of it, as dictionaries and lists.
    """

    def __init__(self, report):
        self.report = report

    @property
    def verdict(self):
        """'valid', 'invalid' or 'undecided'."""
        return self.report["verdict"]

    @property
    def checks(self):
        """[{"name", "indices", "status", "residual", ..}], an entry a claim."""
        return self.report["checks"]

    def __bool__(self):
        return self.verdict == "valid"

    def __repr__(self):
        return f"<Check of {self.report['model']}: {self.verdict}>"
