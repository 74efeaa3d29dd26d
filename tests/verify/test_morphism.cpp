// SPDX-License-Identifier: GPL-2.0-or-later
/// Morphisms of algebroids and of groupoids, true and false ones of every sort: which claims hold, which are refuted
/// and where, and what follows.
#include "elaborate/elaborate_morphism.hpp"
#include "model/read_values.hpp"
#include "verify/checking.hpp"
#include "verify/verify_morphism.hpp"

#include <catch2/catch.hpp>

#include <map>

namespace lagen {

namespace {

struct Verified {
    SystemMorphism morphism;
    MorphismReport report;
};

MorphismFile read_case(const std::string& name)
{
    const std::string folder = name == "heavy_top_reduction" ? "/models/morphisms/" : "/tests/data/morphisms/";
    const std::string path = LAGEN_SOURCE_DIR + folder + name + ".toml";
    return read_morphism(std::make_shared<const SourceFile>(SourceFile{path, read_file(path)}));
}

Verified verified(const std::string& name)
{
    Verified out;
    out.morphism = elaborate_whole(read_case(name));
    out.report = verify(out.morphism);
    return out;
}

/// "admissible 2, morphism 4" of the checks that are refuted.
std::string refuted(const MorphismReport& report)
{
    std::map<std::string, int> counts;
    for (const Check& check : report.structure.checks)
        if (check.decision.status == ProofStatus::refuted) ++counts[check.name];
    std::string text;
    for (const auto& [name, count] : counts) text += (text.empty() ? "" : ", ") + name + " " + std::to_string(count);
    return text;
}

struct Case {
    const char* name;
    const char* refuted; ///< "": all is proved
    std::size_t rank;
    bool surjective, injective;
};

constexpr Case cases[] = {
    {"heavy_top_reduction", "", 3, true, true},
    {"wrong_row", "admissible 2, invariance 1, morphism 4", 3, true, true},
    {"one_form", "", 1, true, false},
    {"not_closed", "morphism 1", 1, true, false},
    {"polar_to_cartesian", "", 2, true, true},
    {"bad_polar", "admissible 1, morphism 1", 2, true, true},
    {"polar_one_form", "", 1, true, false},
    {"folded_line", "", 1, true, true},
    {"se2_reduction", "", 3, true, true},
    {"se2_wrong_side", "invariance 1, product 2", 3, true, true},
    {"top_reduction", "", 3, true, true},
    {"top_of_any_vertical", "", 3, true, true},
    {"forget_gravity", "invariance 1", 3, true, true},
    {"turned", "", 3, true, true},
    {"inverse_map", "morphism 3, product 9", 3, true, true},
    {"circle_reduction", "", 3, true, true},
    {"wrong_fibre", "fibre 1", 3, true, true},
    {"shape", "", 2, true, false},
    {"circle_and_shape", "", 2, true, false},
    {"no_element_of_the_group", "element 1, product 1, unit 1", 1, false, true},
};

} // namespace

TEST_CASE("morphisms of algebroids and groupoids, true and false ones of every sort")
{
    for (const Case& each : cases) {
        INFO(each.name);
        const MorphismReport report = verified(each.name).report;
        CHECK(refuted(report) == each.refuted);
        CHECK(report.structure.verdict == (*each.refuted == '\0' ? Verdict::valid : Verdict::invalid));
        REQUIRE(report.rank.rank);
        CHECK(*report.rank.rank == each.rank);
        CHECK(report.rank.surjective == each.surjective);
        CHECK(report.rank.injective == each.injective);
        for (const Check& check : report.structure.checks)
            CHECK((check.decision.status != ProofStatus::refuted || check.decision.witness.has_value()));
    }
}

TEST_CASE("what a morphism allows is said where everything is proved, and not where it is not surjective")
{
    const MorphismTheorems top = verified("heavy_top_reduction").report.theorems;
    CHECK((top.reduction && top.reconstruction && !top.discrete));
    const MorphismTheorems discrete = verified("top_reduction").report.theorems;
    CHECK((!discrete.reduction && discrete.discrete));
    const MorphismTheorems wrong = verified("wrong_row").report.theorems;
    CHECK((!wrong.reduction && !wrong.reconstruction && !wrong.discrete));
}

TEST_CASE("where a fibre map may fall in rank nothing follows for the motions, whatever holds elsewhere")
{
    const MorphismReport folded = verified("folded_line").report;
    CHECK(folded.structure.verdict == Verdict::valid);
    CHECK(folded.rank.where == std::vector<std::string>{"x != 0"});
    CHECK((!folded.theorems.reduction && !folded.theorems.reconstruction));
}

TEST_CASE("the rank of a morphism names where it may fall")
{
    const GenericRank rank = verified("one_form").report.rank;
    CHECK(rank.where == std::vector<std::string>{"2*x*y != 0"});
    CHECK(verified("heavy_top_reduction").report.rank.where.empty()); // sin(th) > 0 is in the domain
}

TEST_CASE("the fibre map of a morphism of groupoids is that of its arrows: its equations hold by themselves")
{
    Verified reduction = verified("top_reduction");
    Graph graph = reduction.morphism.source.graph;
    const DerivedFibre derived = derived_fibre(graph, reduction.morphism);
    const ResidualList residuals = morphism_equations(graph, reduction.morphism, derived.matrix);
    CHECK(residuals.residuals.size() > 10);
    // The same by Euler's kinematic equations, which the other is given with.
    const SystemMorphism given = elaborate_whole(read_case("heavy_top_reduction"));
    Graph other = given.source.graph;
    const std::vector<NodeId> wanted = fibre_matrix(other, given);
    REQUIRE(wanted.size() == derived.matrix.size());
    ProofSetting setting;
    setting.variables = reduction.morphism.source.algebroid.x;
    Graph& both = graph;
    const std::vector<NodeId> moved = [&] {
        std::vector<NodeId> out;
        Lowering lower(both);
        for (const NodeId node : wanted) out.push_back(lower(to_tree(other, node)));
        return out;
    }();
    for (std::size_t k = 0; k < moved.size(); ++k)
        CHECK(ZeroDecider(both, setting).status(both.subtract(moved[k], derived.matrix[k])) == ProofStatus::proved);
}

} // namespace lagen
