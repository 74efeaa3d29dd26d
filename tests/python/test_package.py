# SPDX-License-Identifier: GPL-2.0-or-later
"""The package lagen beside the program that it calls."""

import doctest
import fractions
import json
import os
import tempfile
import unittest
from unittest import mock

import numpy

import lagen
import lagen.options
from setting import binary, models, written

KEPLER = models / "kepler.toml"


class Options(unittest.TestCase):
    def test_the_example_in_the_documentation_holds(self):
        self.assertEqual(doctest.testmod(lagen.options), doctest.TestResults(failed=0, attempted=1))

    def test_numbers_keep_their_value_and_families_are_given_by_entries(self):
        def spelled(**options):
            return " ".join(lagen.spell_options(options))
        self.assertEqual(spelled(set={"k": 0.1, "m": fractions.Fraction(1, 3), "n": numpy.int64(4)}, t_end=-2),
                         "--set k=0.1 --set m=1/3 --set n=4 --t-end=-2")
        self.assertEqual(spelled(initial={"x": numpy.array([1.5, 2]), "R": [[1, 0], [0, 1]], "y": "2*k"}),
                         "--initial x[1]=1.5 --initial x[2]=2.0 --initial R[1,1]=1 --initial R[1,2]=0 --initial R[2,1]=0 "
                         "--initial R[2,2]=1 --initial y=2*k")
        self.assertEqual(spelled(over={"step": (0.1, 1, 3), "k": (1, 2, 2)}, methods=["rk4", "dop853"], peers=False,
                                 invariant=["x", "y"], scene=None),
                         "--over step=0.1:1:3,k=1:2:2 --methods rk4,dop853 --invariant x --invariant y")


class Results(unittest.TestCase):
    def test_a_run_has_columns_status_invariants_and_events(self):
        run = lagen.run(KEPLER, set={"k": 2}, at=[0, 0.25, 1], tolerance=1e-12)
        self.assertTrue(run)
        self.assertEqual(run.status, "ok")
        self.assertEqual(run.columns, ["t", "x", "y", "u", "v"])
        self.assertEqual(list(run), run.columns)
        numpy.testing.assert_array_equal(run["t"], [0, 0.25, 1])
        energy = (run["u"] ** 2 + run["v"] ** 2) / 2 - 2 / numpy.hypot(run["x"], run["y"])
        numpy.testing.assert_allclose(energy, run.invariants["energy"]["initial"], rtol=1e-10)
        self.assertEqual(run.report["method"], "dop853")
        self.assertEqual(run.state.keys(), {"x", "y", "u", "v"})
        self.assertEqual(run.events, [])
        moved = lagen.run(KEPLER, set={"k": 2}, initial={"x": 0.5}, at=[0, 0.25, 1], tolerance=1e-12)
        self.assertEqual(moved["x"][0], 0.5)

    def test_a_run_that_cannot_go_on_is_false_and_says_why(self):
        run = lagen.run(KEPLER, initial={"u": 0, "v": 0}, at=[0, 0.05, 3], tolerance=1e-12)
        self.assertFalse(run)
        self.assertNotIn(run.status, ("ok", "stopped_by_event"))
        self.assertEqual(run["t"][0], 0)
        self.assertLess(run.report["failed_at"], 3)

    def test_what_is_refused_is_an_error_with_its_text_and_exit_code(self):
        with self.assertRaises(lagen.Error) as caught:
            lagen.run(KEPLER, set={"kk": 2})
        self.assertEqual(caught.exception.code, 3)
        self.assertIn("has no parameter 'kk'", str(caught.exception))
        with self.assertRaisesRegex(lagen.Error, "unknown option '--sett', did you mean '--set'") as caught:
            lagen.run(KEPLER, sett=3)
        self.assertEqual(caught.exception.code, 4)
        with mock.patch.dict(os.environ, LAGEN="no-such-program"):
            with self.assertRaises(lagen.Error) as caught:
                lagen.check(KEPLER)
        self.assertEqual(caught.exception.message, "the program lagen could not be started as 'no-such-program': No such file "
                                                   "or directory; set LAGEN to its path, or put it on PATH")

    def test_a_check_is_true_where_the_model_is_valid(self):
        check = lagen.check(KEPLER)
        self.assertTrue(check)
        self.assertEqual(check.verdict, "valid")
        self.assertIn("angular_momentum", [index for claim in check.checks for index in claim["indices"]])
        refuted, valid = lagen.check(KEPLER, models / "pendulum.toml", invariant=["t"])
        self.assertFalse(refuted)
        self.assertEqual((refuted.verdict, valid.verdict), ("invalid", "invalid"))

    def test_a_sweep_is_a_table_with_a_row_a_trajectory(self):
        ranges = {"initial": {"x": (0.4, 0.6, 3)}, "set": {"k": (1, 2, 2)}, "t_end": 1}
        table = lagen.sweep(KEPLER, **ranges)
        self.assertEqual(table["status"].tolist(), ["ok"] * 6)
        numpy.testing.assert_array_equal(table["index"], range(6))
        numpy.testing.assert_allclose(sorted(set(table["initial.x"])), [0.4, 0.5, 0.6])
        row = [k for k in range(6) if table["set.k"][k] == 2 and table["initial.x"][k] == 0.5][0]
        run = lagen.run(KEPLER, set={"k": 2}, initial={"x": 0.5}, t_end=1)
        self.assertEqual(table["x"][row], run["x"][-1])
        self.assertIn("6 rows", repr(table))
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "kept.csv")
            self.assertEqual(lagen.sweep(KEPLER, output=path, **ranges)["x"].tolist(), table["x"].tolist())
            self.assertTrue(os.path.exists(path))

    def test_a_stability_chart_is_a_dictionary(self):
        chart = lagen.chart(KEPLER, stability=True, methods=["rk4"], over={"step": (0.1, 2, 3)}, t_end=20)
        self.assertEqual(chart["axes"][0]["values"], [0.1, 1.05, 2])
        self.assertEqual(numpy.shape(chart["methods"]["rk4"]["outcome"]), (3, 1))

    def test_the_points_of_a_chart_are_a_table(self):
        report = {"model": "kepler", "points": [{"method": "rk4", "error": 0.5, "invariants": {"energy": 1}},
                                                {"method": "odeint", "peer": "odeint", "error": None, "invariants": {}}]}
        with mock.patch("lagen.tasks.call", return_value=(json.dumps(report), "")) as call:
            points = lagen.chart(KEPLER, methods=["rk4"])["points"]
        self.assertEqual(call.call_args.kwargs["methods"], ["rk4"])
        self.assertEqual(points.columns, ["method", "error", "invariants", "peer"])
        self.assertEqual(points["peer"].tolist(), ["", "odeint"])
        self.assertTrue(numpy.isnan(points["error"][1]))
        self.assertEqual(points["invariants"][0], {"energy": 1})

    def test_equations_are_expressions_of_sympy(self):
        module = lagen.equations(KEPLER, form="hamilton")
        self.assertIn("kinematics", module.equations)
        numpy.testing.assert_allclose(module.rhs(0, [3, 4, 1, 2], {"k": 5}), [1, 2, -0.12, -0.16], rtol=1e-14)

    def test_a_morphism_gives_both_sides(self):
        morphism = written(binary, "python_identity.toml", f"""
[morphism]
source = "{KEPLER}"
target = "{KEPLER}"
base = {{ x = "x", y = "y" }}
fibre = {{ u = "u", v = "v" }}
""")
        both = lagen.run(morphism, at=[0, 0.5])
        numpy.testing.assert_allclose(both["source"]["x"], both["target"]["x"], rtol=1e-12)
        self.assertTrue(both["target"])
        self.assertLess(both["defect"]["max"], 1e-12)


if __name__ == "__main__":
    unittest.main()
