# SPDX-License-Identifier: MIT
"""Texts of lagen's expression language as expressions of SymPy, and names as identifiers."""

import re

import sympy as sp

from .command import Error

_GREEK = ("alpha beta gamma delta epsilon zeta eta theta iota kappa lambda mu nu xi omicron pi rho sigma sigma tau upsilon "
          "phi chi psi omega").split()

_TOKEN = re.compile(r"\s*(?:(?P<number>\d+(?:\.\d+)?(?:e-?\d+)?)|(?P<name>[^\W\d]\w*(?:\[\d+(?:,\d+)*\])?)|"
                    r"(?P<sign><=|>=|==|!=|[-+*/^()\[\],<>]))")

_RELATIONS = {"<": sp.Lt, "<=": sp.Le, ">": sp.Gt, ">=": sp.Ge, "==": sp.Eq, "!=": sp.Ne}

_FUNCTIONS = {name: getattr(sp, name) for name in "sin cos tan asin acos atan atan2 sinh cosh tanh exp log sqrt sign erf".split()}
_FUNCTIONS |= {"abs": sp.Abs, "min": sp.Min, "max": sp.Max,
               "if": lambda condition, yes, no: sp.Piecewise((yes, condition), (no, True))}


class _Inverse:
    """A^-1 as a factor: the product with b solves A x = b."""

    def __init__(self, matrix):
        self.matrix = matrix

    def __mul__(self, right):
        return self.matrix.LUsolve(right)


_FUNCTIONS["inverse"] = _Inverse


def _tokens(text):
    """(kind, text) of each token, and an end."""
    at, tokens = 0, []
    while match := _TOKEN.match(text, at):
        at = match.end()
        tokens.append((match.lastgroup, match[match.lastgroup]))
    if text[at:].strip("\n "):
        raise Error("the expressions of the model are too long to be written out for SymPy" if text.endswith("...") else
                    f"no expression of lagen: '{text[at:]}'", 1)
    return tokens + [("end", "")]


def names_in(text):
    """The names of variables in a text."""
    tokens = _tokens(text)
    return [token for (kind, token), behind in zip(tokens, tokens[1:])
            if kind == "name" and token != "pi" and behind[1] != "("]


class _Reader:
    """One text, by descent through the grammar: comparison, sum, product, sign, power, atom."""

    def __init__(self, text, variables):
        self.tokens, self.at, self.variables = _tokens(text), 0, variables

    def take(self, *signs):
        """The next token where it is one of these signs, else nothing."""
        kind, token = self.tokens[self.at]
        if kind != "sign" or token not in signs:
            return None
        self.at += 1
        return token

    def comparison(self):
        left = self.sum()
        relation = self.take(*_RELATIONS)
        return _RELATIONS[relation](left, self.sum()) if relation else left

    def sum(self):
        terms = [self.product()]
        while sign := self.take("+", "-"):
            terms.append(self.product() if sign == "+" else -self.product())
        return sp.Add(*terms) if len(terms) > 1 else terms[0]

    def product(self):
        value = self.sign()
        while sign := self.take("*", "/"):
            value = value * self.sign() if sign == "*" else value / self.sign()
        return value

    def sign(self):
        return -self.sign() if self.take("-") else self.power()

    def power(self):
        base = self.atom()
        return base ** self.sign() if self.take("^") else base

    def list(self, end):
        entries = [self.comparison()]
        while self.take(","):
            entries.append(self.comparison())
        self.expect(end)
        return entries

    def expect(self, sign):
        if not self.take(sign):
            raise Error(f"'{sign}' is missing in an expression of lagen", 1)

    def atom(self):
        if self.take("("):
            value = self.comparison()
            self.expect(")")
            if self.take("["):
                value = value[int(self.list("]")[0]) - 1]
            return value
        if self.take("["):
            return sp.Matrix([list(row) if isinstance(row, sp.MatrixBase) else row for row in self.list("]")])
        kind, token = self.tokens[self.at]
        self.at += 1
        if kind == "number":
            return sp.Rational(token)
        if self.take("("):
            if token not in _FUNCTIONS:
                raise Error(f"the model uses {token}, which SymPy does not have", 1)
            return _FUNCTIONS[token](*self.list(")"))
        return sp.pi if token == "pi" else self.variables[token]


def read(text, variables):
    """The expression of a text; variables: {name in the model: symbol}. Numbers are exact."""
    return _Reader(text, variables).comparison()


def _spelled(name):
    """ASCII letters, digits and '_': "x[1]" is x_1, Greek letters have their names, other letters are uXXXX."""
    def letter(c):
        if c.isascii():
            return c if c.isalnum() else "_" if c in "_[,^" else ""
        for first, of_case in (("α", str), ("Α", str.capitalize)):
            if 0 <= ord(c) - ord(first) < len(_GREEK):
                return of_case(_GREEK[ord(c) - ord(first)])
        return f"u{ord(c):04X}"

    text = re.sub("__+", "_", "".join(map(letter, name)))
    return text if re.match("[A-Za-z]", text) else "n" + text


def identifiers(names, reserved):
    """Each name as an identifier: a reserved one gains a trailing '_', and so does one that clashes with another; one that
    needs no change keeps its own."""
    plain = {name for name in names if _spelled(name) == name and name not in reserved}
    taken, found = set(), []
    for name in names:
        spelled = _spelled(name)
        if spelled in reserved:
            spelled += "_"
        while spelled in taken or (spelled != name and spelled in plain):
            spelled += "1_" if spelled.endswith("_") else "_"
        taken.add(spelled)
        found.append(spelled)
    return found
