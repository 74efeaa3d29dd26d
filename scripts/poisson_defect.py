# SPDX-License-Identifier: GPL-2.0-or-later
"""How far one step of a method is from a Poisson map of E*.

A step Phi: (x, mu) -> (x1, mu1) is a Poisson map where J L(s) J^T = L(Phi(s)) with J = dPhi/ds and the tensor
    L: {mu_a, x^j} = rho^j_a,  {mu_a, mu_b} = C^c_ab mu_c,  {x^i, x^j} = 0                       [Martinez 2001]
on a tangent bundle L is the canonical one, and Phi is symplectic. J is taken by differences of order four of runs of one step, so
that defects below about 1e-10 are those of the differences. rho and C come from what `lagen derive --form exterior` prints.
"""
import json
import math
import subprocess

WIDTH = 2e-3  # of the differences, of states of size 1


class Functions(dict):
    """What expressions may name besides coordinates and parameters."""

    def __init__(self, values):
        super().__init__({name: getattr(math, name) for name in ("sin", "cos", "tan", "exp", "log", "sqrt")})
        self.update(values)


def value_of(text, values):
    return eval(str(text).replace("^", "**"), {"__builtins__": {}}, Functions(values))


def parameters_of(document):
    """The [parameters] of a model, which may use earlier ones."""
    values = {}
    for name, text in document.get("parameters", {}).items():
        values[name] = float(value_of(text, values))
    return values


class PoissonTensor:
    def __init__(self, lagen, model, document, base, fibre, momenta):
        """`momenta`: their names in the order of the fibre coordinates `fibre`."""
        self.base, self.fibre, self.momenta = base, fibre, momenta
        self.parameters = parameters_of(document)
        printed = subprocess.run([lagen, "derive", str(model), "--form", "exterior", "--format", "json"],
                                 capture_output=True, text=True, check=True)
        blocks = json.loads(printed.stdout)["blocks"]
        self.anchor, self.bracket = [], []  # (i, a, rho^i_a), (c, a, b, -C^c_ab) for a < b
        for block in blocks[:2]:
            for equation in block["equations"]:
                of = equation["left"]["symbol"]
                for group in equation["groups"]:
                    places = [fibre.index(name) for name in group["basis"]]
                    if equation["left"]["kind"] == "differential":
                        self.anchor.append((base.index(of), places[0], group["value"]))
                    else:
                        self.bracket.append((fibre.index(of), places[0], places[1], group["value"]))

    def at(self, s):
        """By rows, of the state s = (x, mu)."""
        n = len(self.base)
        values = dict(self.parameters, **dict(zip(self.base, s)))
        tensor = [[0.0] * len(s) for _ in s]

        def add(i, j, entry):
            tensor[i][j] += entry
            tensor[j][i] -= entry

        for i, a, text in self.anchor:
            add(n + a, i, value_of(text, values))
        for c, a, b, text in self.bracket:
            add(n + a, n + b, -value_of(text, values) * s[n + c])
        return tensor


def derivative(step, s):
    """J[i][j] = d step(s)_i / ds_j; nothing where a step fails."""
    columns = []
    for j in range(len(s)):
        width = WIDTH * max(1.0, abs(s[j]))
        ends = []
        for k in (-2, -1, 1, 2):
            moved = list(s)
            moved[j] += k * width
            ends.append(step(moved))
        if any(end is None for end in ends):
            return None
        columns.append([(a - 8 * b + 8 * c - d) / (12 * width) for a, b, c, d in zip(*ends)])
    return [list(row) for row in zip(*columns)]


def product(A, B):
    return [[sum(a * b for a, b in zip(row, column)) for column in zip(*B)] for row in A]


def poisson_defect(tensor, step, s):
    """The largest entry of J L J^T - L(step(s)), over the largest of L; nothing where a step fails."""
    end = step(s)
    J = derivative(step, s) if end is not None else None
    if J is None:
        return None
    moved = product(product(J, tensor.at(s)), [list(column) for column in zip(*J)])
    there = tensor.at(end)
    size = max(abs(entry) for row in there for entry in row)
    return max(abs(a - b) for rows in zip(moved, there) for a, b in zip(*rows)) / size
