// SPDX-License-Identifier: GPL-2.0-or-later
/// What every module of SymPy that is printed says in the same words.
#pragma once

#include <string_view>

namespace lagen::sympy_program {

inline constexpr std::string_view imports = R"(

import functools

import sympy as sp

try:
    import numpy
except ImportError:
    numpy = None

Eq = functools.partial(sp.Eq, evaluate=False)
t = sp.Symbol("t", real=True)
)";

inline constexpr std::string_view poisson = R"(

coordinates = base + momenta
poisson = sp.zeros(len(coordinates), len(coordinates))
for _bracket in equations["$"]:
    _i, _j = map(coordinates.index, _bracket.lhs.args)
    poisson[_i, _j], poisson[_j, _i] = _bracket.rhs, -_bracket.rhs


def bracket(F, G):
    """{F, G}, the sum of poisson[i, j] dF/dz^i dG/dz^j over z = coordinates; Fdot = {H, F}."""
    dF, dG = (sp.Matrix([sp.sympify(f).diff(z) for z in coordinates]) for f in (F, G))
    return (dF.T * poisson * dG)[0]
)";

inline constexpr std::string_view accelerations = R"(

accelerated = tuple(rates[state.index(y)] for y in fibre)
mass = sp.Matrix([e.lhs for e in equations["$"]]).jacobian(accelerated)  # shape (r, r)
force = sp.Matrix([e.rhs for e in equations["$"]])  # shape (r, 1)


def accelerations():
    """The rates of the fibre coordinates, mass^-1 force, as expressions; they are long where mass is dense."""
    return mass.LUsolve(force)
)";

inline constexpr std::string_view rates = R"(


def resolved(expression):
    """The expression in state, parameters and t alone, without the symbols of `auxiliary`."""
    while expression.free_symbols & auxiliary.keys():
        expression = expression.xreplace(auxiliary)
    return expression


def values(changed=None):
    """The parameters as numbers, in their order: the defaults, but for what `changed` gives by name or symbol.

    A default that uses other parameters follows them. KeyError: `changed` names something else.
    """
    given = {symbols.get(name, name): sp.sympify(value) for name, value in (changed or {}).items()}
    if unknown := [str(name) for name in given if name not in parameters]:
        raise KeyError("no parameter: " + ", ".join(unknown))
    found = {}
    for symbol, default in parameters.items():
        found[symbol] = given.get(symbol, default).subs(found)
    return tuple(float(value) for value in found.values())


@functools.lru_cache(maxsize=None)
def _compiled():
    return sp.lambdify((t, *state, *parameters), [resolved(e) for e in _expressions],
                       ["numpy", "math"] if numpy else ["math"], cse=True)


def _numbers(t, state, parameters):
    """The entries of `_expressions`."""
    if len(state) != len(rates):
        raise ValueError(f"the state has {len(rates)} entries, and {len(state)} are given")
    given = (t, *state, *(parameters if isinstance(parameters, tuple) else values(parameters)))
    return _compiled()(*(numpy.array(given, dtype=float) if numpy else given))


)";

inline constexpr std::string_view explicit_rhs = R"(
_expressions = [explicit[rate] for rate in rates]


def rhs(t, state, parameters=None):
    """The rates of `state` at the time t, numbers in its order (an array where numpy is installed).

    parameters: what `values` takes, or what it gave, which saves time. What is not defined is nan (without numpy an
    exception).
    """
    found = _numbers(t, state, parameters)
    return numpy.array(found, dtype=float) if numpy else list(map(float, found))
)";

inline constexpr std::string_view implicit_rhs = R"(
_expressions = [*explicit.values(), *mass, *force]


def rhs(t, state, parameters=None):
    """The rates of `state` at the time t, numbers in its order (an array where numpy is installed).

    parameters: what `values` takes, or what it gave, which saves time. What is not defined is nan (without numpy an
    exception). mass * ydot = force is solved with numbers; where mass is singular that raises numpy.linalg.LinAlgError
    (without numpy ZeroDivisionError).
    """
    numbers = _numbers(t, state, parameters)
    n, r = len(explicit), len(accelerated)
    M, f = [numbers[n + r * a:n + r * (a + 1)] for a in range(r)], numbers[n + r * r:]
    if numpy:
        ydot = numpy.linalg.solve(numpy.array(M, dtype=float), numpy.array(f, dtype=float))
    else:
        from mpmath import fp
        ydot = fp.lu_solve(fp.matrix(M), fp.matrix(f))
    found = {**dict(zip(explicit, numbers)), **dict(zip(accelerated, ydot))}
    ordered = [float(found[rate]) for rate in rates]
    return numpy.array(ordered) if numpy else ordered
)";

/// Keywords, and what the module itself is called by.
inline constexpr std::string_view reserved[] = {
    "False",         "None",        "True",       "and",        "as",      "assert",      "async",    "await",
    "break",         "class",       "continue",   "def",        "del",     "elif",        "else",     "except",
    "finally",       "for",         "from",       "global",     "if",      "import",      "in",       "is",
    "lambda",        "nonlocal",    "not",        "or",         "pass",    "raise",       "return",   "try",
    "while",         "with",        "yield",      "C",          "Eq",      "ImportError", "KeyError", "accelerated",
    "accelerations", "ambient",     "auxiliary",  "base",       "bracket", "constraints", "controls", "coordinates",
    "definitions",   "dict",        "equations",  "explicit",   "fibre",   "float",       "force",    "fp",
    "functools",     "hamiltonian", "isinstance", "lagrangian", "len",     "list",        "map",      "mass",
    "momenta",       "numpy",       "parameters", "poisson",    "range",   "rates",       "resolved", "rhs",
    "rho",           "sp",          "state",      "states",     "str",     "symbols",     "t",        "tuple",
    "values",        "zip",
};

} // namespace lagen::sympy_program
