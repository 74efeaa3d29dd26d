# SPDX-License-Identifier: GPL-2.0-or-later
"""Equations in SymPy: their right-hand sides beside generated C++, and identities that SymPy proves of them."""

import itertools
import os
import random
import tempfile
import unittest

import numpy
import sympy as sp

import lagen
from lagen.expressions import read
from setting import all_tests, models, output_of, source, written

FORMS = ("lagrange", "hamilton", "pontryagin") + (("poisson",) if all_tests else ())

# The states of a scene, with parameters that are not those of the file: (model, form, {parameter: value}).
MOVED = [("pendulum", "lagrange", {}), ("double_pendulum", "lagrange", {"m1": 1.25}), ("pleiades", "lagrange", {}),
         ("driven_pendulum", "lagrange", {}), ("heavy_top", "lagrange", {"mgl": 2}), ("wong", "lagrange", {}),
         ("snakeboard", "lagrange", {}), ("turntable_ball", "lagrange", {}), ("heavy_top_matrix", "lagrange", {}),
         ("double_pendulum", "hamilton", {"m1": 1.25}), ("heavy_top_euler", "hamilton", {}), ("kirchhoff", "hamilton", {}),
         ("vertical_disk", "hamilton", {}), ("unicycle", "pontryagin", {})]
if all_tests:
    _known = {model for model, form, _ in MOVED if form == "lagrange"}
    _written = {path.stem for path in models.glob("*.toml") if "[lagrangian]" in path.read_text(encoding="utf-8")}
    MOVED += [(model, "lagrange", {}) for model in sorted(_written - _known)]


def rates_in_cpp(folder, points):
    """What the C++ headers of (model, form) give: points {(model, form): (parameters, [(t, state)])} to lists of rates."""
    includes, calls = [], []
    for (model, form), (parameters, states) in points.items():
        header = f"{model}_{form}.hpp"
        lagen.call("generate", models / f"{model}.toml", form=form, only="rhs", output=os.path.join(folder, header))
        includes.append(f'#include "{header}"')
        name = model if form == "lagrange" else f"{model}_{form}"
        set_parameters = " ".join(f"model.parameters.{p} = {v!r};" for p, v in parameters.items())
        for t, state in states:
            entries = ", ".join(repr(entry) for entry in state)
            calls.append(f"{{ lagen::models::{name}<double> model; {set_parameters} print(model, {t!r}, {{{entries}}}); }}")
    program = "\n".join(["#include <algorithm>", "#include <cstdio>", *includes, """
template <class Model>
void print(const Model& model, double t, std::initializer_list<double> entries)
{
    typename Model::State s, ds;
    std::copy(entries.begin(), entries.end(), s.data());
    if (model.rhs(t, s, ds) != lagen::Status::ok) std::printf("failed");
    for (const double rate : ds) std::printf("%.17g ", rate);
    std::printf("\\n");
}
int main()
{
""", *calls, "}"])
    written(folder, "rates.cpp", program)
    binary = os.path.join(folder, "rates")
    output_of("c++", "-std=c++20", "-O0", "-I", folder, "-I", source / "runtime/include", "-I", "/usr/include/eigen3",
              os.path.join(folder, "rates.cpp"), "-o", binary)
    lines = iter(output_of(binary).splitlines())
    return {key: [[float(rate) for rate in next(lines).split()] for _ in states]
            for key, (_, states) in points.items()}


class Equations(unittest.TestCase):
    def test_every_model_has_equations_in_each_of_its_forms(self):
        """Where not all tests run, in one form after the other."""
        count, refused = 0, []
        paths = sorted(models.glob("*.toml"))
        asked = list(itertools.product(paths, FORMS)) if all_tests else list(zip(paths, itertools.cycle(("lagrange", "hamilton"))))
        for path, form in asked:
            with self.subTest(model=path.stem, form=form):
                try:
                    found = lagen.equations(path, form=form)
                except lagen.Error as error:
                    self.assertEqual(error.code, 1)
                    self.assertRegex(error.message, "has no |has neither |is not derived yet|do not make its motion")
                    if "which has no formula" in error.message:
                        refused.append((path.stem, form))
                    continue
                for equation in itertools.chain(*found.equations.values()):
                    self.assertFalse(equation.atoms(sp.Float))
                count += 1
        self.assertGreater(count, 95 if all_tests else 35)
        known = [("chain", "hamilton"), ("relativistic_oscillator", "hamilton")]
        self.assertEqual(refused, [pair for pair in known if (models / f"{pair[0]}.toml", pair[1]) in asked])

    def test_what_sympy_cannot_say_is_refused(self):
        plane = "[base]\ncoordinates = ['x', 'y']\n[algebroid]\nkind = 'tangent'\n"
        refusals = [
            ("L = 'v_x^2/2 + v_y^2/2 + stumpff(1, x)'", {}, 1, "the model uses stumpff, which SymPy does not have"),
            ("L = '(x*v_y - y*v_x)/2 - (x^2 + y^2)/2'", {}, 1, "do not determine the rate of 'v_x'"),
            ("L = 'sqrt(1 + v_x^2 + v_y^2) - x^2/2'", {"form": "hamilton"}, 1, "written in 'v_x', which has no formula"),
            ("L = 'v_x^2/2 + v_y^2/2 - g(g(g(x)))'\n[definitions]\n'f(z)' = '(z + z)/2'\n'g(z)' = 'f(f(f(f(f(f(z))))))'",
             {"form": "poisson"}, 1, "too long to be written out for SymPy"),
            ("L = 'v_x^2/2 + v_y^2/2'", {"form": "cartan"}, 4, "not cartan")]
        for lagrangian, options, code, message in refusals:
            with self.subTest(message=message), tempfile.TemporaryDirectory() as folder:
                path = written(folder, "refused.toml", plane + "[lagrangian]\n" + lagrangian)
                with self.assertRaisesRegex(lagen.Error, message) as refused:
                    lagen.equations(path, **options)
                self.assertEqual(refused.exception.code, code)

    def test_expressions_are_read_as_lagen_reads_them(self):
        x, y = sp.symbols("x y")
        expressions = {"-x^2": -x**2, "x^-y^2": x**(-y**2), "2/3*x - 0.1 + 5e-3*y": sp.Rational(2, 3)*x - sp.Rational(1, 10) + y/200,
                       "--x/y/2": x/y/2, "if(x < y, min(x, 1), abs(y))": sp.Piecewise((sp.Min(x, 1), x < y), (sp.Abs(y), True)),
                       "(inverse([[x, 1], [0, y]])*[3, pi])[2]": sp.pi/y}
        for text, expected in expressions.items():
            self.assertEqual(sp.simplify(read(text, {"x": x, "y": y}) - expected), 0, text)

    def test_right_hand_sides_are_those_of_the_cpp_headers(self):
        draw = random.Random(1)
        modules, points = {}, {}
        for model, form, parameters in MOVED:
            module = lagen.equations(models / f"{model}.toml", form=form)
            states = [(draw.uniform(0, 3), [draw.uniform(0.2, 0.7) for _ in module.state]) for _ in range(3)]
            modules[model, form], points[model, form] = module, (parameters, states)
        with tempfile.TemporaryDirectory() as folder:
            expected = rates_in_cpp(folder, points)
        for (model, form), (parameters, states) in points.items():
            for (t, state), rates in zip(states, expected[model, form]):
                with self.subTest(model=model, form=form):
                    found = modules[model, form].rhs(t, state, parameters)
                    self.assertGreater(numpy.abs(rates).max(), 0.001)
                    numpy.testing.assert_allclose(found, rates, rtol=1e-12, atol=1e-12 * numpy.abs(rates).max())

    def test_a_right_hand_side_is_compiled_once_and_wants_the_whole_state(self):
        module = lagen.equations(models / "pendulum.toml")
        self.assertIs(module._compiled, module._compiled)
        with self.assertRaisesRegex(ValueError, "the state has 2 entries, and 1 are given"):
            module.rhs(0, [1])

    def test_a_right_hand_side_beyond_the_domain_is_not_a_number(self):
        module = lagen.equations(models / "relativistic_oscillator.toml")
        with numpy.errstate(invalid="ignore"):
            self.assertEqual(numpy.isnan(module.rhs(0, [0.5, 0.5, 0.9, 0.9])).tolist(), [False, False, True, True])

    def test_names_are_identifiers_and_numbers_exact(self):
        model = """
[parameters]
lambda = 0.1
"c[1..2]" = [2, "lambda/3"]
state = "2*lambda"
[base]
coordinates = ["x[1..1]", "x_1", "θ"]
[fibre]
coordinates = ["u", "v", "w"]
[algebroid]
kind = "tangent"
[definitions]
T = "(u^2 + v^2)/2 + c[1]*w^2/2"
V = "lambda*cos(θ) + (1/2)*x[1]^2 + 1/3"
[lagrangian]
L = "T - V + c[2]*x_1 - state*x_1^2"
"""
        with tempfile.TemporaryDirectory() as folder:
            path = written(folder, "names.toml", model)
            module = lagen.equations(path)
        self.assertEqual(module.symbols["lambda"], module.lambda_)
        self.assertEqual([str(symbol) for symbol in module.base], ["x_1_", "x_1", "theta"])
        self.assertEqual(module.symbols["x[1]"], module.base[0])
        self.assertEqual(module.parameters[module.lambda_], sp.Rational(1, 10))
        self.assertEqual(module.parameters[module.c_2], module.lambda_ / 3)
        self.assertEqual(module.symbols["state"], module.state_)
        self.assertEqual(module.lagrangian, module.T - module.V + module.c_2 * module.x_1 - module.state_ * module.x_1**2)
        self.assertEqual(module.definitions["T"], module.T)
        self.assertEqual(module.values({"lambda": 3}), (3.0, 2.0, 1.0, 6.0))
        self.assertEqual(module.values({"c[2]": 7}), (0.1, 2.0, 7.0, 0.2))
        with self.assertRaisesRegex(KeyError, "no parameter: u, nothing"):
            module.values({"u": 1, "nothing": 2})


class Identities(unittest.TestCase):
    def test_sympy_proves_that_the_energy_of_the_double_pendulum_is_conserved(self):
        module = lagen.equations(models / "double_pendulum.toml")
        rates = {**module.explicit, **dict(zip(module.accelerated, module.accelerations()))}
        drift = sum(module.E.diff(s) * rates[rate] for s, rate in zip(module.state, module.rates))
        self.assertNotEqual(drift, 0)
        self.assertEqual(sp.simplify(drift), 0)
        self.assertEqual(sp.simplify(module.E - (module.lagrangian.subs({v: -v for v in module.fibre}) +
                                                 2 * module.definitions["potential"])), 0)

    def test_sympy_derives_the_accelerations_from_the_lagrangian(self):
        module = lagen.equations(models / "heavy_top.toml")
        rho, C, L, y = module.rho, module.C, module.lagrangian, module.fibre
        p = [L.diff(v) for v in y]
        for a in range(3):
            right = sum(rho[i, a] * L.diff(x) for i, x in enumerate(module.base))
            right -= sum(p[c] * C[c, a, b] * y[b] for b in range(3) for c in range(3))
            self.assertEqual(sp.expand(right - module.force[a]), 0)
            self.assertEqual(module.mass[a, :], sp.Matrix([[p[a].diff(v) for v in y]]))

    def test_structure_functions_satisfy_the_structure_equations(self):
        for name in ("wong", "heavy_top", "heavy_top_quasivelocities"):
            module = lagen.equations(models / f"{name}.toml")
            rho, C, x = module.rho, module.C, module.base
            r = len(module.fibre)
            along = lambda a, f: sum(rho[i, a] * sp.sympify(f).diff(x[i]) for i in range(len(x)))
            self.assertTrue(any(C[index] != 0 for index in itertools.product(range(r), repeat=3)))
            for a, b in itertools.combinations(range(r), 2):
                for i in range(len(x)):
                    anchor = along(a, rho[i, b]) - along(b, rho[i, a]) - sum(rho[i, c] * C[c, a, b] for c in range(r))
                    self.assertEqual(sp.simplify(anchor), 0)
            for (a, b, c), d in itertools.product(itertools.combinations(range(r), 3), range(r)):
                cyclic = ((a, b, c), (b, c, a), (c, a, b))
                jacobi = sum(along(i, C[d, j, k]) + sum(C[e, j, k] * C[d, i, e] for e in range(r)) for i, j, k in cyclic)
                self.assertEqual(sp.simplify(jacobi), 0)

    def test_brackets_give_the_rates_and_satisfy_jacobis_identity(self):
        module = lagen.equations(models / "heavy_top.toml", form="hamilton")
        z, bracket = module.coordinates, module.bracket
        for s, rate in zip(module.state, module.rates):
            self.assertEqual(sp.simplify(bracket(module.H, s) - module.explicit[rate]), 0)
        self.assertEqual(bracket(z[3], z[4]), z[5])
        for f, g, h in itertools.combinations(z, 3):
            cyclic = ((f, g, h), (g, h, f), (h, f, g))
            self.assertEqual(sp.expand(sum(bracket(i, bracket(j, k)) for i, j, k in cyclic)), 0)

    def test_the_form_poisson_has_brackets_and_the_symplectic_section(self):
        module = lagen.equations(models / "rigid_body.toml", form="poisson")
        self.assertFalse(hasattr(module, "rhs"))
        p = module.momenta
        self.assertEqual(module.bracket(p[0] ** 2 + p[1] ** 2 + p[2] ** 2, p[1]), 0)
        section = module.equations["canonical symplectic section"]
        omega = sp.Function("Omega")
        self.assertIn(sp.Eq(omega(*sp.symbols("X_w1 X_w2")), p[2]), section)
        self.assertIn(sp.Eq(omega(*sp.symbols("X_w1 P_w1")), 1), section)


if __name__ == "__main__":
    unittest.main()
