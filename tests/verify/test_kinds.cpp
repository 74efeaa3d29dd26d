// SPDX-License-Identifier: GPL-2.0-or-later
/// Kinds of algebroid against hand-written rho and C of the same algebroid (tests/data/continuous): equal as functions,
/// proved; and a sign changed in one entry of C is noticed.
#include "verify/checking.hpp"

#include "elaborate/build_algebroid.hpp"
#include "support/reference_case.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <map>

using namespace lagen;

namespace {

/// Values of rho or C by their indices, on a common graph.
using Entries = std::map<std::vector<std::size_t>, NodeId>;

struct Functions {
    Entries rho, C;
};

Functions functions_of(Graph& graph, const WrittenAlgebroid& algebroid)
{
    Lowering lower(graph);
    const Algebroid lowered = lower_algebroid(graph, lower, algebroid);
    Functions out;
    for (std::size_t a = 0; a < algebroid.r(); ++a) {
        for (const ColumnEntry& entry : lowered.anchor[a]) out.rho[{entry.index, a}] = entry.value;
        for (std::size_t b = 0; b < algebroid.r(); ++b)
            for (const ColumnEntry& entry : lowered.C(a, b)) out.C[{entry.index, a, b}] = entry.value;
    }
    return out;
}

/// The number of entries in which two families of functions certainly differ; -1 where one could not be decided.
int differences(Graph& graph, const ZeroDecider& decider, Entries first, const Entries& second)
{
    for (const auto& [indices, value] : second) first.try_emplace(indices, graph.constant(0));
    int count = 0;
    for (const auto& [indices, value] : first) {
        const auto other = second.find(indices);
        const NodeId right = other == second.end() ? graph.constant(0) : other->second;
        const Decision decision = decider.decide(graph.subtract(value, right));
        if (decision.status == ProofStatus::undecided) return -1;
        count += decision.status == ProofStatus::refuted ? 1 : 0;
    }
    return count;
}

struct Compared {
    int rho, C;
    std::size_t entries; ///< of C, both orders
};

Compared compare_with(const WrittenAlgebroid& kind, const WrittenAlgebroid& general)
{
    Graph graph;
    ProofSetting setting;
    for (const Symbol& symbol : kind.base) setting.variables.push_back(graph.input(symbol.name));
    for (const std::string& name : kind.parameters) setting.parameters.push_back(graph.input(name));
    const Functions first = functions_of(graph, kind);
    const Functions second = functions_of(graph, general);
    const ZeroDecider decider(graph, setting);
    return {differences(graph, decider, first.rho, second.rho), differences(graph, decider, first.C, second.C),
            second.C.size()};
}

ReferenceCase reference_called(const std::string& name)
{
    for (const ReferenceCase& each : read_reference_cases())
        if (each.name == name) return each;
    throw InternalError("there is no reference case " + name);
}

std::string list_of(const std::vector<std::string>& names)
{
    std::string text;
    for (const std::string& name : names) text += (text.empty() ? "\"" : ", \"") + name + "\"";
    return "[" + text + "]";
}

/// The reference's names with another [algebroid] block.
Model model_of(const ReferenceCase& reference, const std::string& algebroid)
{
    std::string text = "[parameters]\n";
    for (const auto& [name, value] : reference.parameters) text += name + " = \"" + value + "\"\n";
    text += "[base]\ncoordinates = " + list_of(reference.base) + "\n";
    text += "[fibre]\ncoordinates = " + list_of(reference.fibre) + "\n[algebroid]\n" + algebroid;
    return read_model_text("kind.toml", "name = \"kind\"\n" + text);
}

ReferenceCase with_opposite_sign(ReferenceCase reference, std::size_t k)
{
    reference.lagrangian.clear();
    reference.initial.clear();
    reference.brackets[k].value = "-(" + reference.brackets[k].value + ")";
    return reference;
}

struct KindCase {
    const char* name;
    bool every_sign_matters; ///< no single sign of C can change in a valid algebroid with this anchor
    const char* algebroid;
};

const KindCase cases[] = {
    {"spherical_pendulum_subbundle_meridian", true,
     "kind = 'subbundle'\nspanned_by = { a = { x = '-y', y = 'x' }, b = { x = 'x*z', y = 'y*z', z = '-x^2-y^2' } }\n"},
    {"spherical_pendulum_subbundle_zframe", true,
     "kind = 'subbundle'\nspanned_by = { a = { x = 'z', z = '-x' }, b = { y = 'z', z = '-y' } }\n"},
    {"leaf_alpha_plus_1", true,
     "kind = 'subbundle'\nspanned_by = { a = { x = '-y', y = 'x' }, b = { x = 'x*z', y = 'y*z', z = 'x^2+y^2' } }\n"},
    {"leaf_alpha_minus_1", true,
     "kind = 'subbundle'\nspanned_by = { a = { x = 'z', z = 'x' }, b = { y = 'z', z = 'y' } }\n"},
    {"leaf_graph", true, "kind = 'subbundle'\nspanned_by = { a = { x = 1, z = 'y' }, b = { y = 1, z = 'x' } }\n"},
    {"elroys_beanie_bodyframe", false, "kind = 'atiyah'\nalgebra = 'se(2)'\n"},
    {"elroys_beanie_se2", true, "kind = 'atiyah'\nalgebra = 'se(2)'\nconnection = { ps = { W = 'I2/(I1+I2)' } }\n"},
    {"wong_su2_plane", true,
     "kind = 'atiyah'\nalgebra = 'su(2)'\n[algebroid.connection]\nx = { q1 = 'a*y', q3 = 'b' }\n"
     "y = { q1 = 'c*x*y', q2 = '-b*x', q3 = 'a*x^2' }\n"},
    {"charged_particle_reduced", false,
     "kind = 'atiyah'\nbracket = {}\nconnection = { y = { q = 'b0*x + b1*x^2/2 + b2*x*y^2' } }\n"},
    {"heavy_top_euler_quasivelocities", true,
     "kind = 'frame'\n[algebroid.of]\nkind = 'tangent'\n[algebroid.sections]\n"
     "w1 = { v_ph = 'sin(ps)/sin(th)', v_th = 'cos(ps)', v_ps = '-cos(th)*sin(ps)/sin(th)' }\n"
     "w2 = { v_ph = 'cos(ps)/sin(th)', v_th = '-sin(ps)', v_ps = '-cos(th)*cos(ps)/sin(th)' }\n"
     "w3 = { v_ps = 1 }\n"},
    {"heavy_top_quaternion", true,
     "kind = 'action'\nalgebra = 'so(3)'\nrepresentation = [\n"
     "[[0,'1/2',0,0],['-1/2',0,0,0],[0,0,0,'-1/2'],[0,0,'1/2',0]],\n"
     "[[0,0,'1/2',0],[0,0,0,'1/2'],['-1/2',0,0,0],[0,'-1/2',0,0]],\n"
     "'[[0,0,0,1/2],[0,0,-1/2,0],[0,1/2,0,0],[-1/2,0,0,0]]']\n"},
    {"planar_body_se2", false, "kind = 'lie_algebra'\nalgebra = 'se(2)'\n"},
    {"kirchhoff_se3", false, "kind = 'lie_algebra'\nalgebra = 'se(3)'\n"},
    {"geodesic_torus_orthonormal", true,
     "kind = 'frame'\nsections = { a = { v_th = '1/r' }, b = { v_ph = '1/(R+r*cos(th))' } }\n"
     "of = { kind = 'tangent' }\n"},
    {"geodesic_half_plane_orthonormal", true,
     "kind = 'frame'\nsections = { a = { v_x = 'y' }, b = { v_y = 'y' } }\nof = { kind = 'tangent' }\n"},
};

} // namespace

TEST_CASE("every kind has the anchor and the brackets of the same algebroid written out by hand")
{
    for (const KindCase& each : cases) {
        INFO(each.name);
        const ReferenceCase reference = reference_called(each.name);
        const Model model = model_of(reference, each.algebroid);
        const WrittenAlgebroid general = build_algebroid(read_model_text("general.toml", model_text(reference)));
        const Compared compared = compare_with(build_algebroid(model), general);
        CHECK(compared.rho == 0);
        CHECK(compared.C == 0);
        CHECK(compared.entries == 2 * reference.brackets.size());
        CHECK(verify(model).structure.verdict == Verdict::valid);
    }
}

TEST_CASE("a sign changed in one bracket is another algebroid, and mostly none at all")
{
    for (const KindCase& each : cases) {
        const ReferenceCase reference = reference_called(each.name);
        const WrittenAlgebroid kind = build_algebroid(model_of(reference, each.algebroid));
        for (std::size_t k = 0; k < reference.brackets.size(); ++k) {
            INFO(each.name << ", bracket " << k);
            const Model mutant = read_model_text("mutant.toml", model_text(with_opposite_sign(reference, k)));
            CHECK(compare_with(kind, build_algebroid(mutant)).C == 2);
            if (each.every_sign_matters) CHECK(verify(mutant).structure.verdict == Verdict::invalid);
        }
    }
}

TEST_CASE("solved brackets are as short as by hand")
{
    const auto bracket = [](const char* name) {
        const auto found =
            std::ranges::find_if(cases, [&](const KindCase& each) { return name == std::string(each.name); });
        const WrittenAlgebroid algebroid = build_algebroid(model_of(reference_called(name), found->algebroid));
        std::vector<std::string> lines;
        for (const StructureValue& entry : algebroid.C)
            lines.push_back(algebroid.fibre[entry.a].name + "," + algebroid.fibre[entry.b].name + ":" +
                            algebroid.fibre[entry.c].name + " " + to_text(entry.value));
        return lines;
    };
    CHECK(bracket("leaf_alpha_minus_1") == std::vector<std::string>{"a,b:a -y/z", "a,b:b x/z"});
    CHECK(bracket("heavy_top_euler_quasivelocities") ==
          std::vector<std::string>{"w1,w2:w3 1", "w1,w3:w2 -1", "w2,w3:w1 1"});
    CHECK(bracket("geodesic_torus_orthonormal") == std::vector<std::string>{"a,b:b sin(th)/(R + r*cos(th))"});
    CHECK(bracket("leaf_alpha_plus_1").empty());
}

TEST_CASE("a distribution that is not involutive is refuted with the bracket that leaves it")
{
    const ModelReport verified =
        verified_text("[base]\ncoordinates = ['x', 'y', 'z']\n[fibre]\ncoordinates = ['a', 'b']\n[algebroid]\n"
                      "kind = 'subbundle'\nspanned_by = { a = { x = 1 }, b = { y = 1, z = 'x' } }\n");
    CHECK(verified.structure.verdict == Verdict::invalid);
    const Check& last = verified.structure.checks.back();
    CHECK(line_of(last) == "involutive(a, b) refuted");
    CHECK(last.decision.residual == "1");
    REQUIRE(last.decision.witness);
    CHECK(last.decision.witness->value == 1);
    CHECK(last.hint ==
          "[a, b] leaves the distribution along z: a subbundle needs [rho(a), rho(b)] in the span of its sections");
}

TEST_CASE("matrices that do not represent the algebra are refuted by the anchor")
{
    const std::string text = "[base]\ncoordinates = ['x', 'y', 'z']\n[fibre]\ncoordinates = ['a', 'b', 'c']\n"
                             "[algebroid]\nkind = 'action'\nalgebra = 'so(3)'\nrepresentation = ['hat([1,0,0])', "
                             "'hat([0,1,0])', ";
    CHECK(verified_text(text + "'hat([0,0,1])']\n").structure.verdict == Verdict::valid);
    const ModelReport wrong = verified_text(text + "'hat([0,0,-1])']\n");
    CHECK(wrong.structure.verdict == Verdict::invalid);
    CHECK(line_of(wrong.structure.checks.front()) == "anchor(a, b, x) refuted");
}

TEST_CASE("sections that are dependent everywhere are refused where they are given")
{
    const std::string start =
        "[base]\ncoordinates = [\"x\", \"y\"]\n[fibre]\ncoordinates = [\"a\", \"b\"]\n[algebroid]\n";
    CHECK_THROWS_WITH(
        verified_text(start + "kind = \"subbundle\"\nspanned_by = { a = { x = \"y\" }, b = { x = 1 } }\n"),
        "test.toml:8:26: error: the sections of the subbundle are linearly dependent everywhere: their number is "
        "2, and the rank of the distribution is smaller\n  spanned_by = { a = { x = \"y\" }, b = { x = 1 } }\n"
        "                           ^~~\nhint: give as many sections as the distribution has dimensions");
    CHECK_THROWS_WITH(
        verified_text(start + "kind = \"frame\"\nof = { kind = \"tangent\" }\n"
                              "sections = { a = { v_x = \"sin(x)^2 + cos(x)^2\" }, b = { v_x = 1 } }\n"),
        Catch::StartsWith("test.toml:9:26: error: the sections of the frame are linearly dependent everywhere: the "
                          "determinant of 'sections' is zero\n") &&
            Catch::EndsWith("hint: a frame has as many independent sections as the algebroid that it frames"));
}

TEST_CASE("the matrix of a family of sections maps the new coordinates to the old ones, w = M u")
{
    const auto model = [](const std::string& sections) {
        return "[base]\ncoordinates = [\"x\", \"y\"]\n[fibre]\ncoordinates = [\"u[1..2]\"]\n[algebroid]\nkind = "
               "\"frame\"\n"
               "[algebroid.of]\nkind = \"tangent\"\nfibre = [\"w[1..2]\"]\n[algebroid.sections]\n" +
               sections;
    };
    const ModelReport whole = verified_text(model("u = { w = \"[[1, x], [0, 1]]\" }\n"));
    const ModelReport entries =
        verified_text(model("\"u[1]\" = { \"w[1]\" = \"1\" }\n\"u[2]\" = { \"w[1]\" = \"x\", \"w[2]\" = \"1\" }\n"));
    REQUIRE(whole.algebroid.rho.size() == entries.algebroid.rho.size());
    for (std::size_t k = 0; k < whole.algebroid.rho.size(); ++k) {
        CHECK(whole.algebroid.rho[k].a == entries.algebroid.rho[k].a);
        CHECK(whole.algebroid.rho[k].i == entries.algebroid.rho[k].i);
        CHECK(to_text(whole.algebroid.rho[k].value) == to_text(entries.algebroid.rho[k].value));
    }
    REQUIRE(whole.algebroid.C.size() == 1);
    CHECK(to_text(whole.algebroid.C[0].value) == "1"); // [d/dx, x d/dx + d/dy] = d/dx
}

TEST_CASE("a size stands for the number of a named Lie algebra")
{
    const auto model = [](const char* size, const char* algebra) {
        return std::string("[sizes]\nn = ") + size + "\n[fibre]\ncoordinates = [\"w[1..n*(n - 1)/2]\"]\n" +
               "[algebroid]\nkind = \"lie_algebra\"\nalgebra = \"" + algebra + "\"\n";
    };
    CHECK(verified_text(model("5", "so(n)")).algebroid.C.size() ==
          verified_text(model("5", "so(5)")).algebroid.C.size());
    CHECK(verified_text(model("4", "so(n)")).structure.verdict == Verdict::valid);
}
