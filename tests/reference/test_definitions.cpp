// SPDX-License-Identifier: GPL-2.0-or-later
/// The algebroids of the reference definitions: verdicts, and what is said of those that are wrong.
#include "support/reference_case.hpp"
#include "verify/checking.hpp"

#include <catch2/catch.hpp>

#include <map>

using namespace lagen;
using Hints = std::vector<std::string>;

TEST_CASE("the reference definitions that are wrong have these hints")
{
    const std::map<std::string, Hints> expected = {
        {"not_a_lie_algebra", {}},
        {"half_plane_frame_wrong_sign",
         {"all equations of the algebroid hold with the opposite sign of component e1 of [e1, e2], or with the "
          "opposite sign of component y of the anchor of e2"}},
        {"zero_bracket_bad_anchor",
         {"[e1, e2] needs component e2 = 1/x, given is none; with it all equations of the algebroid hold"}},
        {"polar_pair_missing_C",
         {"[e1, e2] needs component e1 = -2, given is none; with it all equations of the algebroid hold"}},
        {"antisymmetry_broken",
         {"all equations of the algebroid hold with the opposite sign of component e2 of [e1, e2], or with the "
          "opposite sign of component e2 of [e2, e1]"}},
    };
    std::size_t wrong = 0;
    for (const ReferenceDefinition& definition : read_reference_definitions()) {
        INFO(definition.algebroid.name);
        const ModelReport verified = verify(read_model_text("test.toml", model_text(definition.algebroid)));
        CHECK(verified.structure.verdict == (definition.valid ? Verdict::valid : Verdict::invalid));
        if (definition.valid) {
            CHECK(hints_of(verified).empty());
            continue;
        }
        ++wrong;
        CHECK(hints_of(verified) == expected.at(definition.algebroid.name));
    }
    CHECK(wrong == expected.size());
}

TEST_CASE("the algebroids between which the reference morphisms are given are valid")
{
    const std::vector<ReferenceCase> algebroids = read_morphism_algebroids();
    CHECK(algebroids.size() == 8);
    for (const ReferenceCase& algebroid : algebroids) {
        INFO(algebroid.name);
        CHECK(verify(read_model_text("test.toml", model_text(algebroid))).structure.verdict == Verdict::valid);
    }
}
