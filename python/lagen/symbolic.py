# SPDX-License-Identifier: MIT
"""What `lagen derive --format json` gives, in SymPy."""

import functools
import keyword
from collections import defaultdict

import numpy
import sympy as sp

from .command import Error
from .expressions import identifiers, names_in, read

_PARTS = "base fibre momenta ambient controls states".split()

_RESERVED = {*keyword.kwlist, *_PARTS} | set(
    "C accelerated accelerations auxiliary bracket constraints coordinates definitions equations explicit force hamiltonian "
    "lagrangian mass parameters poisson rates report resolved rhs rho state symbols t values".split())

_Eq = functools.partial(sp.Eq, evaluate=False)


def _called(name):
    """A name as a symbol of its own, which no attribute holds."""
    return sp.Symbol(identifiers([name], _RESERVED)[0])


def _texts(equation):
    """The expressions of an equation: of its mass matrix, and of its right side."""
    mass = [entry["value"] for entry in equation["left"].get("mass", ())]
    return mass + ([equation["right"]] if "right" in equation else [group["value"] for group in equation["groups"]])


def _names(block):
    return [name for equation in block["equations"] for text in _texts(equation) for name in names_in(text)]


class Equations:
    """The equations of a model as expressions of SymPy; docs/python.md of lagen says what the attributes are.

    report: all of `lagen derive --expand --format json`, as dictionaries and lists.
    """

    def __init__(self, report):
        self.report = report
        self.t = sp.Symbol("t", real=True)
        self._blocks = report["blocks"]
        self._name_symbols(report["system"])
        self._read_system(report["system"])
        self._read_equations()
        self._find_brackets()

    def _moving(self):
        """The names of what has a rate."""
        lefts = [equation["left"] for block in self._blocks for equation in block["equations"]]
        return [name for left in lefts for name in ([entry["symbol"] for entry in left["mass"]] if "mass" in left else
                                                    [left["symbol"]] if left["kind"] == "time_derivative" else [])]

    def _name_symbols(self, system):
        """Symbols of all names, and attributes: first the model's, then those of its equations, then of its definitions."""
        parts = [system.get(part, []) for part in _PARTS]
        declared = list(dict.fromkeys(sum(parts, [entry["symbol"] for entry in system["parameters"]])))
        used = [name for block in self._blocks for name in _names(block)]
        written = [name for name in dict.fromkeys(used) if name != "t" and name not in declared]
        lefts = [equation["left"]["symbol"] for block in self._blocks for equation in block["equations"]
                 if equation["left"]["kind"] == "symbol" and "mass" not in equation["left"]]
        assigned = [name for name in dict.fromkeys(lefts) if name not in {"t", *declared, *written}]
        defined = [entry["symbol"] for entry in system["definitions"]]
        moving = list(dict.fromkeys(self._moving()))
        texts = [entry["value"] for key in ("definitions", "rho", "C") for entry in system[key]]
        inner = [name for text in texts for name in names_in(text)]
        inner = [name for name in dict.fromkeys(inner) if name not in {"t", *declared, *written}]
        spelled = iter(identifiers(declared + written + assigned + defined + [name + "_dot" for name in moving] + inner,
                                   _RESERVED))
        take = lambda names: {name: next(spelled) for name in names}
        symbols = take(declared + written)
        self._assigned, self._defined = take(assigned), take(defined)
        rates = take(moving)
        made = {name: sp.Symbol(variable, real=True) for name, variable in (symbols | take(inner)).items()}
        for name, variable in symbols.items():
            setattr(self, variable, made[name])
        self._symbols = {"t": self.t} | made
        self._rates = {name: sp.Symbol(variable, real=True) for name, variable in rates.items()}
        for name, variable in rates.items():
            setattr(self, variable, self._rates[name])
        self.symbols = {name: made[name] for name in declared}
        for part in _PARTS:
            if part in system:
                setattr(self, part, tuple(made[name] for name in system[part]))

    def _read(self, text):
        return read(text, self._symbols)

    def _read_system(self, system):
        self.parameters = {self._symbols[entry["symbol"]]: self._read(entry["value"]) for entry in system["parameters"]}
        self.definitions = {entry["symbol"]: self._read(entry["value"]) for entry in system["definitions"]}
        for name, value in self.definitions.items():
            setattr(self, self._defined[name], value)
        for name in ("lagrangian", "hamiltonian"):
            if name in system:
                setattr(self, name, self._read(system[name]))
        self.constraints = tuple(map(self._read, system["constraints"]))
        x = {name: i for i, name in enumerate(system["base"])}
        y = {name: a for a, name in enumerate(system.get("ambient", system["fibre"]))}
        rho, C = defaultdict(int), defaultdict(int)
        for entry in system["rho"]:
            i, a = entry["indices"]
            rho[x[i], y[a]] += self._read(entry["value"])
        for entry in system["C"]:
            C[tuple(y[name] for name in entry["indices"])] += self._read(entry["value"])
        given = {(a, b) for c, a, b in C}
        C |= {(c, b, a): -value for (c, a, b), value in C.items() if (b, a) not in given}
        self.rho = sp.ImmutableSparseMatrix(len(x), len(y), dict(rho))
        self.C = sp.ImmutableSparseNDimArray(dict(C), (len(y),) * 3)

    def _left(self, left):
        if "mass" in left:
            return sp.Add(*(self._read(entry["value"]) * self._rates[entry["symbol"]] for entry in left["mass"]))
        if left["kind"] == "zero":
            return sp.Integer(0)
        name = left["symbol"]
        if left["kind"] == "time_derivative":
            return self._rates[name]
        if left["kind"] == "symbol":
            return _called(name) if name in self._assigned else self._symbols[name]
        if left["kind"] == "bracket":
            return sp.Function("bracket")(self._symbols[name], self._symbols[left["other"]])
        if left["kind"] == "component":
            arguments = [self._symbols.get(argument) or _called(argument) for argument in left["arguments"]]
            return sp.Function(_called(name).name)(*arguments)
        sections = [_called("e_" + section) for section in (name, left.get("other")) if section]
        return sp.Function("commutator")(*sections) if left["kind"] == "commutator" else sections[0]

    def _equation(self, equation):
        left = equation["left"]
        if "right" in equation:
            right = self._read(equation["right"])
        else:
            right = sp.Add(*(sp.Mul(self._read(group["value"]), *(_called("e_" + name) for name in group.get("basis", ())))
                             for group in equation["groups"]))
        if left["kind"] == "symbol" and left["symbol"] in self._assigned:
            setattr(self, self._assigned[left["symbol"]], right)
        relation = {"at_least": sp.Ge, "at_most": sp.Le}.get(equation.get("relation"), _Eq)
        return relation(self._left(left), right)

    def _read_equations(self):
        self._read_blocks = [[self._equation(equation) for equation in block["equations"]] for block in self._blocks]
        self.equations = {block["title"]: read for block, read in zip(self._blocks, self._read_blocks) if read}

    def _find_brackets(self):
        for block, read_block in zip(self._blocks, self._read_blocks):
            if not read_block or block["equations"][0]["left"]["kind"] != "bracket":
                continue
            self.coordinates = self.base + self.momenta
            self.poisson = sp.zeros(len(self.coordinates), len(self.coordinates))
            for equation in read_block:
                i, j = map(self.coordinates.index, equation.lhs.args)
                self.poisson[i, j], self.poisson[j, i] = equation.rhs, -equation.rhs
            return

    def bracket(self, F, G):
        """{F, G}, the sum of poisson[i, j] dF/dz^i dG/dz^j over z = coordinates; Fdot = {H, F}."""
        dF, dG = (sp.Matrix([sp.sympify(f).diff(z) for z in self.coordinates]) for f in (F, G))
        return (dF.T * self.poisson * dG)[0]


class Motion(Equations):
    """Equations that say how a state moves. Raises Error where they leave a rate open, or write it in what has no formula."""

    def __init__(self, report):
        self._state = self._find_state(report)
        super().__init__(report)
        system, model = report["system"], report["model"]
        self.state = tuple(self._symbols[name] for name in self._state)
        with_mass = [k for k, block in enumerate(self._blocks) if any("mass" in e["left"] for e in block["equations"])]
        solved = system["fibre"] if with_mass else []
        explicit = set()
        for name in self._state:
            if name not in solved:
                block = self._block_of("time_derivative", name)
                if block is None:
                    raise Error(f"the equations of model '{model}' do not determine the rate of '{name}'", 1)
                explicit.add(block)
        self.rates = tuple(self._rates[name] for name in self._state)
        self.explicit = self._formulas(explicit)
        self.accelerated, self._expressions = (), [self.explicit[rate] for rate in self.rates if rate in self.explicit]
        if with_mass:
            block = self._read_blocks[with_mass[-1]]
            self.accelerated = tuple(self._rates[name] for name in solved)
            self.mass = sp.Matrix([equation.lhs for equation in block]).jacobian(self.accelerated)
            self.force = sp.Matrix([equation.rhs for equation in block])
            self._expressions += [*self.mass, *self.force]
        self.auxiliary = self._formulas(self._find_auxiliary(explicit | set(with_mass[-1:])))

    @staticmethod
    def _find_state(report):
        """Base, then fibre or momenta, then the first-order states that the equations move."""
        system = report["system"]
        moved = {equation["left"]["symbol"] for block in report["blocks"] for equation in block["equations"]
                 if equation["left"]["kind"] == "time_derivative"}
        fibre = system["fibre" if report["form"] == "lagrange" else "momenta"]
        return system["base"] + fibre + [name for name in system.get("states", ()) if name in moved]

    def _moving(self):
        return self._state + super()._moving()

    def _block_of(self, kind, name):
        """The number of the block with an equation `name` = .., or its rate = ..; None where there is none."""
        return next((k for k, block in enumerate(self._blocks) for equation in block["equations"]
                     if equation["left"]["kind"] == kind and equation["left"]["symbol"] == name
                     and "mass" not in equation["left"]), None)

    def _formulas(self, blocks):
        return {equation.lhs: equation.rhs for block in sorted(blocks) for equation in self._read_blocks[block]}

    def _find_auxiliary(self, pending):
        """The blocks that define what these ones are written in besides state, parameters and t."""
        known = {"t", *self._state, *(entry["symbol"] for entry in self.report["system"]["parameters"])}
        pending, found = list(pending), set()
        while pending:
            for name in _names(self._blocks[pending.pop()]):
                block = None if name in known else self._block_of("symbol", name)
                if block is None and name not in known:
                    raise Error(f"the {self.report['form']} equations of model '{self.report['model']}' are written in "
                                f"'{name}', which has no formula\nhint: `lagen generate` writes a header that solves for it", 1)
                if block is not None and block not in found:
                    found.add(block)
                    pending.append(block)
        return found

    def accelerations(self):
        """The rates of the fibre coordinates, mass^-1 force, as expressions; they are long where mass is dense."""
        return self.mass.LUsolve(self.force)

    def resolved(self, expression):
        """The expression in state, parameters and t alone, without the symbols of `auxiliary`."""
        while expression.free_symbols & self.auxiliary.keys():
            expression = expression.xreplace(self.auxiliary)
        return expression

    def values(self, changed=None):
        """The parameters as numbers, in their order: the defaults, but for what `changed` gives by name or symbol.

        A default that uses other parameters follows them. KeyError: `changed` names something else.
        """
        given = {self.symbols.get(name, name): sp.sympify(value) for name, value in (changed or {}).items()}
        if unknown := [str(name) for name in given if name not in self.parameters]:
            raise KeyError("no parameter: " + ", ".join(unknown))
        found = {}
        for symbol, default in self.parameters.items():
            found[symbol] = given.get(symbol, default).subs(found)
        return tuple(float(value) for value in found.values())

    @functools.cached_property
    def _compiled(self):
        return sp.lambdify((self.t, *self.state, *self.parameters), [self.resolved(e) for e in self._expressions],
                           ["numpy", "math"], cse=True)

    def rhs(self, t, state, parameters=None):
        """The rates of `state` at the time t, numbers in its order, as an array.

        parameters: what `values` takes, or what it gave, which saves time. What is not defined is nan. mass * ydot = force
        is solved with numbers; where mass is singular that raises numpy.linalg.LinAlgError.
        """
        if len(state) != len(self.state):
            raise ValueError(f"the state has {len(self.state)} entries, and {len(state)} are given")
        given = (t, *state, *(parameters if isinstance(parameters, tuple) else self.values(parameters)))
        numbers = numpy.array(self._compiled(*numpy.array(given, dtype=float)), dtype=float)
        r = len(self.accelerated)
        n = len(state) - r
        ydot = numpy.linalg.solve(numbers[n:n + r * r].reshape(r, r), numbers[n + r * r:]) if r > 0 else []
        solved, explicit = dict(zip(self.accelerated, ydot)), iter(numbers)
        return numpy.array([solved[rate] if rate in solved else next(explicit) for rate in self.rates])


def equations_of(report):
    """The equations that are reported. Raises Error: a form that speaks of sections, of forms or of arrows."""
    forms = {"lagrange": Motion, "hamilton": Motion, "pontryagin": Motion, "poisson": Equations}
    if report["form"] not in forms:
        raise Error(f"equations in SymPy are those of the forms {', '.join(forms)}, not {report['form']}", 4)
    return forms[report["form"]](report)
