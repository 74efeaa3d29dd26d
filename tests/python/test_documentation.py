# SPDX-License-Identifier: GPL-2.0-or-later
"""The examples of docs/python.md do what is said there."""

import contextlib
import re
import unittest

from setting import all_tests, models, source


class Documentation(unittest.TestCase):
    def setUp(self):
        page = (source / "docs/python.md").read_text(encoding="utf-8")
        self.package, = re.findall(r"^```python\n(.*?)^```", page, re.MULTILINE | re.DOTALL)

    @unittest.skipUnless(all_tests, "its chart takes half a minute")
    def test_the_package(self):
        with contextlib.chdir(models):
            names = {}
            exec(self.package, names)
        self.assertEqual(len(names["table"]["w"]), 243)


if __name__ == "__main__":
    unittest.main()
