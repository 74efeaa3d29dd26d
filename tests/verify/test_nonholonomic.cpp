// SPDX-License-Identifier: GPL-2.0-or-later
/// What is decided of nonholonomic models.
#include "checking.hpp"

#include <catch2/catch.hpp>

#include <algorithm>

using namespace lagen;

namespace {

ModelReport constrained_report(const std::string& text)
{
    return verified_text(text);
}

const Check& constrained_check(const ModelReport& report, const std::string& name)
{
    const auto found = std::ranges::find(report.structure.checks, name, &Check::name);
    REQUIRE(found != report.structure.checks.end());
    return *found;
}

std::string constrained_plane(const std::string& algebroid, const std::string& more = {})
{
    return "[base]\ncoordinates = [\"x\", \"y\", \"th\"]\n[fibre]\ncoordinates = [\"u\", \"w\"]\n[algebroid]\nkind = "
           "\"nonholonomic\"\n" +
           algebroid + "\nof = { kind = \"tangent\" }\n" + more;
}

const char* const blade = R"toml(sections = { u = { v_x = "cos(th)", v_y = "sin(th)" }, w = { v_th = 1 } })toml";

} // namespace

TEST_CASE("dependent sections are refuted with the combination that vanishes")
{
    const ModelReport report = constrained_report(
        constrained_plane(R"(sections = { u = { v_x = "x", v_y = 1 }, w = { v_x = "2*x", v_y = 2 } })"));
    CHECK(report.structure.verdict == Verdict::invalid);
    const Check& check = constrained_check(report, "independent");
    CHECK(check.indices == std::vector<std::string>{"u", "w"});
    CHECK(check.decision.residual == "-2*u + w"); // of the column v_y, which vanishes nowhere
    CHECK(check.decision.witness);
    CHECK_FALSE(report.mechanics.integrable);
}

TEST_CASE("sections that are dependent at a point alone are refuted there")
{
    const ModelReport report =
        constrained_report(constrained_plane(R"(sections = { u = { v_x = "x", v_y = "y" }, w = { v_th = 1 } })"));
    const Check& check = constrained_check(report, "independent");
    CHECK(check.decision.status == ProofStatus::refuted); // where two variables are zero at once
    CHECK(check.decision.residual == "x^2 + y^2");
    REQUIRE(check.decision.witness);
    const NamedPoint& point = check.decision.witness->point;
    REQUIRE(point.size() == 2);
    CHECK((point[0].first == "x" && to_text(point[0].second) == "0"));
    CHECK((point[1].first == "y" && to_text(point[1].second) == "0"));
    const auto outside = [](const char* domain) {
        return verified_text(std::string("[base]\ncoordinates = [\"x\", \"y\", \"th\"]\ndomain = [\"") + domain +
                             "\"]\n[fibre]\ncoordinates = [\"u\", \"w\"]\n[algebroid]\nkind = \"nonholonomic\"\n"
                             "sections = { u = { v_x = \"x\", v_y = \"y\" }, w = { v_th = 1 } }\nof = { kind = "
                             "\"tangent\" }\n");
    };
    CHECK(constrained_check(outside("x + y > 1"), "independent").decision.status != ProofStatus::refuted);
    CHECK(constrained_check(outside("th > 1"), "independent").decision.status == ProofStatus::refuted);
    const ModelReport line =
        constrained_report(constrained_plane(R"(sections = { u = { v_x = "x" }, w = { v_th = 1 } })"));
    const Check& refuted = constrained_check(line, "independent");
    CHECK(refuted.decision.status == ProofStatus::refuted);
    REQUIRE(refuted.decision.witness);
    CHECK(refuted.decision.witness->point[0].first == "x");
    CHECK(to_text(refuted.decision.witness->point[0].second) == "0");
    CHECK(
        constrained_report(
            "[parameters]\nl = 1\n" +
            constrained_plane(R"toml(sections = { u = { v_x = "sin(th)", v_y = "l*cos(th)" }, w = { v_th = 1 } })toml"))
            .structure.checks[0]
            .where == std::vector<std::string>{"l != 0"});
}

TEST_CASE("constraints that contradict each other are told from those that follow from others")
{
    const auto check_of = [](const char* constraints) {
        const ModelReport report = constrained_report(
            "[base]\ncoordinates = [\"x\", \"y\", \"z\"]\n[fibre]\ncoordinates = [\"v_x\"]\n[algebroid]\nkind = "
            "\"nonholonomic\"\nconstraints = [" +
            std::string(constraints) + "]\nof = { kind = \"tangent\" }\n");
        return constrained_check(report, "independent");
    };
    const Check contradicting = check_of(R"("v_z - 1", "v_z - 2")");
    CHECK(contradicting.decision.status == ProofStatus::refuted);
    CHECK(contradicting.decision.residual == "-(v_z - 1) + (v_z - 2)");
    REQUIRE(contradicting.decision.witness);
    CHECK(contradicting.decision.witness->value == -1);
    CHECK(contradicting.hint == "no velocity satisfies all of them there: leave out those that are not meant");
    const Check dependent = check_of(R"("v_z - y*v_x", "2*v_z - 2*y*v_x")");
    CHECK(dependent.decision.status == ProofStatus::refuted);
    CHECK(dependent.decision.residual == "-2*(v_z - y*v_x) + (2*v_z - 2*y*v_x)");
    REQUIRE(dependent.decision.witness);
    CHECK(dependent.decision.witness->value == 0);
    CHECK(dependent.hint == "leave out the constraints that the others contain");
    const Check moving = check_of(R"("v_z - t", "v_z - y")"); // t is named where it counts
    REQUIRE(moving.decision.witness);
    CHECK(moving.decision.witness->value != 0);
    CHECK(std::ranges::any_of(moving.decision.witness->point, [](const auto& entry) { return entry.first == "t"; }));
}

TEST_CASE("constraints beside sections are compared with them, drift and number too")
{
    const ModelReport right =
        constrained_report(constrained_plane(std::string(blade) + "\nconstraints = [\"v_x*sin(th) - v_y*cos(th)\"]"));
    CHECK(right.structure.verdict == Verdict::valid);
    const ModelReport wrong =
        constrained_report(constrained_plane(std::string(blade) + "\nconstraints = [\"v_x*sin(th) + v_y*cos(th)\"]"));
    const Check& check = constrained_check(wrong, "constraint");
    CHECK(check.decision.status == ProofStatus::refuted);
    CHECK(check.indices == std::vector<std::string>{"u", "v_x*sin(th) + v_y*cos(th)"});
    CHECK(check.decision.residual == "2*sin(th)*cos(th)");
    const ModelReport drifting = constrained_report(
        constrained_plane(std::string(blade) + "\ndrift = { v_x = 1 }\nconstraints = [\"v_x*sin(th) - v_y*cos(th)\"]"));
    CHECK(constrained_check(drifting, "constraint").indices[0] == "drift");
    const std::string one =
        "[base]\ncoordinates = [\"x\", \"y\", \"th\"]\n[fibre]\ncoordinates = [\"u\"]\n[algebroid]\nkind = "
        "\"nonholonomic\"\nof = { kind = \"tangent\" }\nsections = { u = { v_x = 1 } }\n";
    const ModelReport too_few = constrained_report(one + "constraints = [\"v_y\"]\n");
    CHECK(constrained_check(too_few, "constraint").indices == std::vector<std::string>{"number"});
    CHECK(constrained_report(one + "constraints = [\"v_y\", \"v_th\"]\n").structure.verdict == Verdict::valid);
}

TEST_CASE("a bracket that leaves the distribution is shown, with a form and a point")
{
    const ModelReport report = constrained_report(constrained_plane(blade));
    const Integrability& integrable = *report.mechanics.integrable;
    CHECK(integrable.status == ProofStatus::refuted);
    CHECK(integrable.bracket == std::vector<std::string>{"u", "w"});
    CHECK(integrable.components ==
          std::vector<std::pair<std::string, std::string>>{{"v_x", "sin(th)"}, {"v_y", "-cos(th)"}});
    CHECK(integrable.violates == "sin(th)*v_x - cos(th)*v_y");
    CHECK(integrable.witness->value == 1);
    CHECK(integrable.witness->point.empty()); // at every point
    CHECK(constrained_report(constrained_plane(R"(sections = { u = { v_x = "-y", v_y = 1 }, w = { v_th = 1 } })"))
              .mechanics.integrable->status == ProofStatus::proved);
}

TEST_CASE("where the minor that solves the constraints vanishes is listed as singular")
{
    const ModelReport report = constrained_report(
        "[base]\ncoordinates = [\"x\", \"y\", \"th\"]\n[fibre]\ncoordinates = [\"v_x\", \"v_th\"]\n[algebroid]\nkind = "
        "\"nonholonomic\"\nconstraints = [\"v_x*sin(th) - v_y*cos(th)\"]\nof = { kind = \"tangent\" }\n[lagrangian]\nL "
        "= "
        "\"(v_x^2 + v_y^2 + v_th^2)/2\"\n");
    CHECK(report.structure.verdict == Verdict::valid);
    const Regularity& regularity = report.mechanics.regularity;
    CHECK(regularity.kind == Regularity::Kind::generically_regular);
    CHECK(regularity.singular_where == std::vector<std::string>{"cos(th)"});
    REQUIRE(regularity.singular_at.size() == 1);
    const auto th = std::ranges::find(regularity.singular_at[0], "th", &std::pair<std::string, PointValue>::first);
    CHECK(to_text(th->second) == "1.5707963267948966192313");
}

TEST_CASE("a parameter at which the minor that solves the constraints vanishes is listed too")
{
    const ModelReport report = constrained_report(
        "[parameters]\ne = 1\n[base]\ncoordinates = [\"x\", \"y\", \"z\"]\n[fibre]\ncoordinates = [\"v_x\", "
        "\"v_y\"]\n[algebroid]\nkind = \"nonholonomic\"\nconstraints = [\"e*v_z - y*v_x\"]\nof = { kind = "
        "\"tangent\" }\n[lagrangian]\nL = \"(v_x^2 + v_y^2 + v_z^2)/2\"\n");
    const Regularity& regularity = report.mechanics.regularity;
    CHECK(regularity.kind == Regularity::Kind::generically_regular);
    REQUIRE(regularity.singular_at.size() == 1);
    const NamedPoint& point = regularity.singular_at[0];
    REQUIRE(point.size() == 1);
    CHECK((point[0].first == "e" && to_text(point[0].second) == "0"));
}

TEST_CASE("sections that move with time are told from those of a Lie algebroid")
{
    const auto integrable = [](const char* constraint) {
        return *constrained_report("[base]\ncoordinates = [\"x\", \"y\", \"z\"]\n[fibre]\ncoordinates = [\"v_x\", "
                                   "\"v_y\"]\n[algebroid]\nkind = \"nonholonomic\"\nconstraints = [\"" +
                                   std::string(constraint) + "\"]\nof = { kind = \"tangent\" }\n")
                    .mechanics.integrable;
    };
    const Integrability moving = integrable("v_z - x*v_x - t*v_y"), fixed = integrable("v_z - x*v_x - y*v_y");
    CHECK(moving.status == ProofStatus::proved);
    CHECK(moving.moves_with_time);
    CHECK(fixed.status == ProofStatus::proved);
    CHECK_FALSE(fixed.moves_with_time);
}

TEST_CASE("regularity is that of the Hessian on the distribution, which that of L does not tell")
{
    const auto report = [](const std::string& sections, const std::string& L) {
        return constrained_report(
            "[base]\ncoordinates = [\"x\", \"y\"]\n[fibre]\ncoordinates = [\"u\"]\n[algebroid]\nkind = "
            "\"nonholonomic\"\nof = { kind = \"tangent\" }\nsections = { u = " +
            sections + " }\n[lagrangian]\nL = \"" + L + "\"\n");
    };
    CHECK(report("{ v_x = 1 }", "v_x^2/2").mechanics.regularity.kind == Regularity::Kind::regular);
    const Regularity degenerate = report("{ v_x = 1, v_y = 1 }", "v_x^2/2 - v_y^2/2").mechanics.regularity;
    CHECK(degenerate.kind == Regularity::Kind::degenerate);
    CHECK(degenerate.of == Regularity::Matrix::constrained);
}

TEST_CASE("a moving energy is conserved where its section is a symmetry")
{
    const auto conserved = [](const std::string& drift, const std::string& more) {
        return *constrained_report(constrained_plane(std::string(blade) + "\ndrift = " + drift,
                                                     "[lagrangian]\nL = \"(v_x^2 + v_y^2 + v_th^2)/2" + more + "\"\n"))
                    .mechanics.conserved;
    };
    CHECK(conserved("{ v_x = 2 }", "").name == "moving_energy");
    CHECK(conserved("{ v_x = 2 }", "").status == ProofStatus::proved);
    CHECK(conserved("{ v_x = 2 }", " - x").status == ProofStatus::refuted);
    CHECK(conserved("{ v_x = \"sin(t)\" }", "").status == ProofStatus::refuted);
    CHECK(constrained_report(constrained_plane(blade, "[lagrangian]\nL = \"(v_x^2 + v_y^2 + v_th^2)/2 - x*y\"\n"))
              .mechanics.conserved->status == ProofStatus::proved);
}
