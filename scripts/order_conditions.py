# SPDX-License-Identifier: GPL-2.0-or-later
"""The order conditions of Runge-Kutta and Nystrom methods, tree by tree, and what they make of coefficients: weights, and
digits behind those that are published. For scripts/tableaus; decimals of 80 digits."""
from decimal import Decimal, getcontext

getcontext().prec = 80
zero, one = Decimal(0), Decimal(1)
tiny = Decimal("1e-30")  # what is smaller is the rounding of the published digits


def trees(order, nystrom):
    """Per tree: its order, its density kappa (order / gamma, so that phi = kappa c^(order - 1) of the exact solution)
    and its branches [(kind, tree)]: "v" a rate, "x" a rate integrated twice, "c" a bare node."""
    found = []

    def grow(rest, most, branches, items):
        if rest == 0:
            kappa = one
            for kind, tree in branches:
                if kind == "v":
                    kappa *= found[tree][1] / found[tree][0]
                elif kind == "x":
                    kappa *= found[tree][1] / (found[tree][0] * (found[tree][0] + 1))
            yield kappa, list(branches)
        for k in range(most, -1, -1):
            kind, tree, cost = items[k]
            if cost <= rest:
                yield from grow(rest - cost, k, branches + [(kind, tree)], items)

    for n in range(1, order + 1):
        items = [("c", None, 1)] if nystrom else []
        items += [("x", k, t[0] + 1) if nystrom else ("v", k, t[0]) for k, t in enumerate(found)]
        found += [(n, kappa, branches) for kappa, branches in grow(n - 1, len(items) - 1, [], items)]
    return found


def elementary(rows, nodes, list_of_trees):
    """Phi_i of every tree at every stage."""
    phi, sums = [], []
    for _, _, branches in list_of_trees:
        here = [one] * len(rows)
        for kind, tree in branches:
            factor = nodes if kind == "c" else sums[tree]
            here = [p * q for p, q in zip(here, factor)]
        phi.append(here)
        sums.append([sum((a * here[j] for j, a in row.items()), zero) for row in rows])
    return phi


def eliminate(rows, unknowns):
    """Gauss-Jordan with full pivoting: {column: right-hand sides}, reduced rows; an error where they contradict."""
    rows, free, answer, r = [row[:] for row in rows], set(range(unknowns)), {}, 0
    while free and r < len(rows):
        size, i, c = max((abs(rows[i][c]), i, c) for i in range(r, len(rows)) for c in free)
        if size < tiny:
            break
        rows[r], rows[i] = rows[i], rows[r]
        rows[r] = [x / rows[r][c] for x in rows[r]]
        for k in range(len(rows)):
            if k != r and rows[k][c]:
                factor = rows[k][c]
                rows[k] = [x - factor * y for x, y in zip(rows[k], rows[r])]
        answer[c] = r
        free.discard(c)
        r += 1
    assert max((abs(x) for row in rows[r:] for x in row), default=zero) < tiny, "order conditions that contradict"
    return {c: rows[k][unknowns:] for c, k in answer.items()}, rows[:r]


def weights(rows, nodes, columns, order, nystrom, theta=None, x=False):
    """The weights on `columns` of this order, at theta or as coefficients of theta^1 .. theta^order; of x, where rates
    are integrated twice, where asked. With fewer conditions than columns: the least ones."""
    conditions = trees(order - 1 if x else order, nystrom)
    phi = elementary(rows, nodes, conditions)
    system = []
    for p, (n, kappa, _) in zip(phi, conditions):
        right = kappa / (n * (n + 1)) if x else kappa / n
        power = n + 1 if x else n
        values = [right if k == power else zero for k in range(1, order + 1)] if theta is None else [right * theta**power]
        system.append([p[j] for j in columns] + values)
    answer, reduced = eliminate(system, len(columns))
    if len(answer) == len(columns):
        return {columns[c]: value for c, value in answer.items()}
    m = len(columns)  # least norm: A^T (A A^T)^-1 b
    gram = [[sum(p * q for p, q in zip(r[:m], s[:m])) for s in reduced] + r[m:] for r in reduced]
    solved, _ = eliminate(gram, len(reduced))
    count = len(reduced[0]) - m
    return {columns[j]: [sum(reduced[i][j] * solved[i][k] for i in solved) for k in range(count)] for j in range(m)}


def polished(guess, conditions):
    """Newton's method with the least changes; conditions that depend on others are left out."""
    step, values = Decimal("1e-30"), guess
    for _ in range(8):
        residuals = conditions(values)
        if max(abs(r) for r in residuals) < Decimal("1e-60"):
            return values
        moved = lambda k, h: conditions([v + h if j == k else v for j, v in enumerate(values)])
        columns = [[(p - q) / (2 * step) for p, q in zip(moved(k, step), moved(k, -step))] for k in range(len(values))]
        chosen, basis = [], []
        for i, row in enumerate(zip(*columns)):
            length = sum(p * p for p in row).sqrt()
            if length < Decimal("1e-10"):
                continue
            rest = [p / length for p in row]
            for other in basis + basis:
                share = sum(p * q for p, q in zip(rest, other))
                rest = [p - share * q for p, q in zip(rest, other)]
            size = sum(p * p for p in rest).sqrt()
            if size > Decimal("1e-10"):
                chosen.append((row, residuals[i]))
                basis.append([p / size for p in rest])
        gram = [[sum(p * q for p, q in zip(r, s)) for s, _ in chosen] + [value] for r, value in chosen]
        solved, _ = eliminate(gram, len(chosen))
        values = [v - sum(solved[i][0] * chosen[i][0][k] for i in solved) for k, v in enumerate(values)]
    raise ValueError("the order conditions are not met")
