# SPDX-License-Identifier: MIT
"""Keyword arguments as words of the command line."""

import numbers
from collections.abc import Iterable, Mapping

_REPEATED = {"set", "initial", "jacobi-field", "invariant", "curves", "bracket"}


def _spell_value(value):
    """A number in decimals that read back as the same, a fraction exactly, a tuple as the range a:b:n, a text as it is."""
    if isinstance(value, tuple):
        return ":".join(map(_spell_value, value))
    if isinstance(value, numbers.Integral):
        return str(int(value))
    if isinstance(value, numbers.Rational):
        return f"{value.numerator}/{value.denominator}"
    if isinstance(value, numbers.Real):
        return repr(float(value))
    return str(value)


def _entries(name, value, indices=()):
    """name=value, or name[i]=value of each entry of a list or array (name[i,j] of one by rows), counted from 1."""
    if isinstance(value, Iterable) and not isinstance(value, (str, tuple)):
        for k, entry in enumerate(value, 1):
            yield from _entries(name, entry, indices + (k,))
    else:
        place = f"[{','.join(map(str, indices))}]" if indices else ""
        yield f"{name}{place}={_spell_value(value)}"


def _items(value):
    """The words of one option: of a mapping name=value, of a list its entries, else the value."""
    if isinstance(value, Mapping):
        return [item for name, entry in value.items() for item in _entries(name, entry)]
    if isinstance(value, Iterable) and not isinstance(value, (str, tuple)):
        return [_spell_value(entry) for entry in value]
    return [_spell_value(value)]


def spell_options(options):
    """The words of the command line for a mapping from names of options, with '_' for '-', to values.

    True is an option without a value, False and None leave it out. A mapping is name=value for each entry, a list (or an
    array) its entries: both with commas between them, or for --set, --initial, --invariant and their like (which "may be
    repeated") one option each. In a mapping a tuple is a range, {"g": (9.7, 9.9, 3)} is g=9.7:9.9:3, and a list a
    family, {"x": [3, -1]} is x[1]=3 and x[2]=-1.

    >>> spell_options({"set": {"k": 2, "m": 0.5}, "at": [0, 1.5], "t_end": 3, "unchecked": True})
    ['--set', 'k=2', '--set', 'm=0.5', '--at', '0,1.5', '--t-end', '3', '--unchecked']
    """
    words = []
    for keyword, value in options.items():
        name = keyword.replace("_", "-")
        if value is True:
            words.append(f"--{name}")
        elif value is not None and value is not False:
            items = _items(value)
            for item in items if name in _REPEATED else [",".join(items)]:
                words += [f"--{name}={item}"] if item.startswith("-") else [f"--{name}", item]
    return words
