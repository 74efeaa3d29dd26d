# SPDX-License-Identifier: MIT
"""A function a command."""

import csv
import json
import os
import tempfile

from .command import call
from .results import Check, Run, Table


def run(model, **options):
    """Integrates a scene of the model: `lagen run`, as a Run.

    >>> lagen.run("kepler.toml", scene="default", set={"k": 2}, initial={"x": 0.5}, method="dop853", tolerance=1e-12)

    A run that cannot go on is returned with the rows that it has; its `status` says why, and it is false. A morphism file
    gives {"source": Run, "target": Run, "defect": {..}}. Raises Error: no such model, scene, method, ..
    """
    text, messages = call("run", model, format="json", **options)
    report = json.loads(text)
    if "source" in report:
        return {**report, "source": Run(report["source"], messages), "target": Run(report["target"], messages)}
    return Run(report, messages)


def sweep(model, output=None, **options):
    """Integrates a scene from many starts and with many parameters: `lagen sweep`, a Table with a row a trajectory.

    >>> lagen.sweep("pendulum.toml", set={"g": (9.7, 9.9, 3)}, initial={"w": (0, 8, 81)})

    output: the CSV file that keeps the table; without it there is none. A row that failed says so in `table["status"]`.
    Raises Error as `run`.
    """
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "sweep.csv") if output is None else os.fspath(output)
        call("sweep", model, output=path, **options)
        with open(path, newline="", encoding="utf-8") as file:
            heading, *rows = csv.reader(file)
    texts = {heading.index("status")}
    return Table(heading, [[entry if k in texts else float(entry) if entry else None for k, entry in enumerate(row)]
                           for row in rows])


def chart(model, output=None, **options):
    """Runs a scene by every method: `lagen chart`, as the dictionary of chart.json, its "points" a Table.

    >>> points = lagen.chart("kepler.toml", methods=["dop853", "taylor"])["points"]
    >>> points["error"][points["method"] == "taylor"]

    output: the folder that keeps the pictures and files; without it there are none. With stability=True the dictionary is
    that of stability.json. Raises Error as `run`.
    """
    with tempfile.TemporaryDirectory() as folder:
        text, _ = call("chart", model, format="json", output=folder if output is None else output, **options)
    report = json.loads(text)
    if "points" in report:
        columns = list(dict.fromkeys(name for point in report["points"] for name in point))
        report["points"] = Table(columns, [[point.get(name) for name in columns] for point in report["points"]])
    return report


def check(*models, **options):
    """Decides the claims of the models: `lagen check`, a Check, or for several models a list of them.

    >>> bool(lagen.check("kepler.toml", invariant=["x*v - y*u"]))

    A model that is refuted or undecided is a result. Raises Error: no such file, a mistake in a file.
    """
    text, _ = call("check", *models, format="json", **options)
    report = json.loads(text)
    return [Check(each) for each in report] if isinstance(report, list) else Check(report)


def equations(model, **options):
    """The equations of the model in SymPy, with a right-hand side for numbers: what `lagen derive` derives.

    >>> top = lagen.equations("heavy_top.toml")
    >>> top.rhs(0, [0.6, 0, 0.8, 0.9, -0.4, 1.6], {"mgl": 2})

    Raises Error as `run`, and ImportError where SymPy is not installed.
    """
    from .symbolic import equations_of

    text, _ = call("derive", model, format="json", expand=True, **options)
    return equations_of(json.loads(text))
