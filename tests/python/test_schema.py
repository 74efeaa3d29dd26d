# SPDX-License-Identifier: GPL-2.0-or-later
"""The JSON Schema that `lagen schema` prints, against the models of the tree and the mistakes of tests/errors."""

import json
import os
import tomllib
import unittest

import jsonschema

from setting import models, output_of, source

schema = json.loads(output_of(os.environ["LAGEN"], "schema"))
validator = jsonschema.Draft202012Validator(schema)


def errors_of(path):
    return [f"{path.name}: {error.json_path}: {error.message}"
            for error in validator.iter_errors(tomllib.loads(path.read_text(encoding="utf-8")))]


class Schema(unittest.TestCase):
    def test_it_is_a_schema_of_its_draft(self):
        jsonschema.Draft202012Validator.check_schema(schema)
        self.assertEqual(schema["$schema"], "https://json-schema.org/draft/2020-12/schema")

    def test_every_model_of_the_tree_is_valid(self):
        paths = [path for folder in (models, source / "docs" / "cookbook") for path in sorted(folder.rglob("*.toml"))]
        self.assertGreater(len(paths), 70)
        self.assertEqual([error for path in paths for error in errors_of(path)], [])

    def test_unknown_keys_of_blocks_are_invalid_and_unknown_names_are_not(self):
        refused = 0
        for path in sorted((source / "tests" / "errors").glob("*.toml")):
            text = path.with_suffix(".txt").read_text(encoding="utf-8")
            if "error: unknown key" in text or " takes no '" in text and " of kind '" in text:
                self.assertTrue(errors_of(path), path.name)
                refused += 1
            if "error: unknown symbol" in text or "which is no fibre coordinate" in text:
                self.assertEqual(errors_of(path), [], path.name)
        self.assertGreaterEqual(refused, 4)

    def test_a_key_says_what_it_is_and_a_block_what_it_needs(self):
        block = schema["properties"]["hamiltonian"]
        self.assertEqual(block["properties"]["H"]["description"],
                         "a function on the dual of E; may use time, parameters, base coordinates, momenta")
        self.assertEqual(block["allOf"], [{"required": ["H"]}])
        self.assertIn("may use every name of the model", json.dumps(schema["properties"]["observables"]))

    def test_keys_that_exclude_each_other_or_another_kind_are_invalid(self):
        model = {"base": {"coordinates": ["x"]}, "algebroid": {"kind": "tangent"}, "lagrangian": {"L": "v_x^2"}}
        self.assertTrue(validator.is_valid(model))
        self.assertTrue(validator.is_valid(model | {"scene": {"a": {"sample": 0.1, "step": "h"}}}))
        for wrong in ({"scene": {"a": {"sample": 0.1, "samples": 3}}}, {"hamilton_jacobi": {"S": "x", "alpha": {}}},
                      {"discrete": {"step": "h"}}, {"algebroid": {"kind": "tangent", "bracket": {}}},
                      {"algebroid": {"kind": "frame", "of": "a.toml"}}, {"scene": {"a": {"samples": 1}}},
                      {"groupoid": {"group": "SO(3)"}}, {"algebroid": {"kind": "tangents"}}):
            self.assertFalse(validator.is_valid(model | wrong), wrong)


if __name__ == "__main__":
    unittest.main()
