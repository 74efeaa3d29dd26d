# SPDX-License-Identifier: GPL-2.0-or-later
"""The examples of docs/python.md do what is said there."""

import contextlib
import re
import unittest

from setting import all_tests, models, source


class Documentation(unittest.TestCase):
    def setUp(self):
        page = (source / "docs/python.md").read_text(encoding="utf-8")
        self.sympy, self.package = re.findall(r"^```python\n(.*?)^```", page, re.MULTILINE | re.DOTALL)

    def test_the_equations_of_the_double_pendulum(self):
        with contextlib.chdir(models):
            names = {}
            exec(self.sympy, names)
        self.assertEqual({str(symbol) for symbol in names["p"].parameters}, {"g", "l1", "l2", "m1", "m2"})

    @unittest.skipUnless(all_tests, "its chart takes half a minute")
    def test_the_package(self):
        with contextlib.chdir(models):
            names = {}
            exec(self.package, names)
        self.assertEqual(len(names["table"]["w"]), 243)


if __name__ == "__main__":
    unittest.main()
