// SPDX-License-Identifier: GPL-2.0-or-later
/// Proofs looked at again at other points, counts of what is zero by structure, and divisions by zero in every block.
#include "verify/algebroid_texts.hpp"
#include "verify/checking.hpp"

#include "graph/core/lower.hpp"

#include <catch2/catch.hpp>

using namespace lagen;

namespace {

const std::string checked_sphere = turning_vector(on_sphere + "casimirs = { a = \"g1^2 + g2^2 + g3^2\" }\n") +
                                   R"([lagrangian]
L = "(w1^2 + w2^2 + 2*w3^2)/2 - g3"
[invariants]
vertical = "p_w1*g1 + p_w2*g2 + p_w3*g3"
)";

Model model_of(const std::string& text)
{
    return read_model_text("test.toml", "name = \"test\"\n" + text);
}

/// The message of the error that `verify` ends with, "" where it does not.
std::string refusal(const std::string& text)
{
    try {
        (void)verify(model_of(text));
    } catch (const ModelError& error) {
        return error.what();
    }
    return "";
}

/// What is said of `divisor`, written in a line that starts with `start`.
std::string zero_divisor(int line, const std::string& start, const std::string& divisor, const std::string& rest)
{
    return "test.toml:" + std::to_string(line) + ":" + std::to_string(start.size() + 1) + ": error: division by " +
           divisor + ", which is zero everywhere\n  " + start + divisor + rest + "\n  " +
           std::string(start.size(), ' ') + "^" + std::string(divisor.size() - 1, '~') +
           "\nhint: a divisor must be nonzero somewhere on the domain";
}

const std::string plane = "[base]\ncoordinates = [\"x\", \"y\"]\n"
                          "[fibre]\ncoordinates = [\"v\", \"w\"]\n"
                          "[algebroid]\nkind = \"tangent\"\n";

} // namespace

TEST_CASE("every structure equation that is proved is zero to 60 digits at five other points")
{
    const System system = elaborate(model_of(checked_sphere));
    REQUIRE(verify(system).structure.verdict == Verdict::valid);
    CHECK(largest_structure_residual(system, 5) < 1e-60);
}

TEST_CASE("the points of another seed are other points")
{
    Graph graph;
    ProofSetting setting;
    setting.variables = {graph.input("x"), graph.input("y")};
    ProofBudget other;
    other.seed = 1;
    const auto first = ZeroDecider(graph, setting).sample_point(),
               second = ZeroDecider(graph, setting, other).sample_point();
    REQUIRE(first);
    REQUIRE(second);
    CHECK(*first != *second);
}

TEST_CASE("of the 638550 Jacobi equations of so(10) all but those with a product are counted, not listed")
{
    std::string coordinates;
    for (int a = 0; a < 45; ++a) coordinates += (a == 0 ? "\"y" : ", \"y") + std::to_string(a) + "\"";
    const ModelReport verified = verified_text("[fibre]\ncoordinates = [" + coordinates +
                                               "]\n[algebroid]\nkind = \"lie_algebra\"\nalgebra = \"so(10)\"\n");
    CHECK(verified.structure.verdict == Verdict::valid);
    CHECK(verified.structure.checks.size() + verified.structure.trivial == 638550);
    // [[e_ij, e_jk], e_kl] and its like: an equation for each of three ways round a path or a star of three edges.
    CHECK(verified.structure.checks.size() < 6000);
    CHECK(verified.structure.checks.size() > 1000);
}

TEST_CASE("a divisor that is zero everywhere is refused in every block, also where it takes algebra to see it")
{
    const std::string one = "sin(x)^2 + cos(x)^2 - 1";
    CHECK(refusal("[base]\ncoordinates = [\"x\", \"y\"]\n[fibre]\ncoordinates = [\"v\", \"w\"]\n[algebroid.anchor]\n"
                  "v = { x = \"1/(" +
                  one + ")\" }\n") == zero_divisor(7, "v = { x = \"1/(", one, ")\" }"));
    CHECK(refusal("[base]\ncoordinates = [\"x\", \"y\"]\n[fibre]\ncoordinates = [\"v\", \"w\"]\n[algebroid.bracket]\n"
                  "\"v,w\" = { v = \"1/(" +
                  one + ")\" }\n") == zero_divisor(7, "\"v,w\" = { v = \"1/(", one, ")\" }"));
    CHECK(refusal(plane + "[lagrangian]\nL = \"v^2/(" + one + ")\"\n") == zero_divisor(9, "L = \"v^2/(", one, ")\""));
    CHECK(refusal(plane + "[definitions]\nunused = \"y/(" + one + ")\"\n") ==
          zero_divisor(9, "unused = \"y/(", one, ")\""));
    CHECK(refusal(plane + "[definitions]\n\"f(u)\" = \"y/((u - 1)*(u + 1) - u^2 + 1)\"\n") ==
          zero_divisor(9, "\"f(u)\" = \"y/(", "(u - 1)*(u + 1) - u^2 + 1", ")\""));
    CHECK(refusal(plane + "[invariants]\nk = \"v/(" + one + ")\"\n") == zero_divisor(9, "k = \"v/(", one, ")\""));
    CHECK(refusal(plane + "[observables]\nk = \"v/(" + one + ")\"\n") == zero_divisor(9, "k = \"v/(", one, ")\""));
    CHECK(refusal(plane + "[lagrangian]\nL = \"v^2*(" + one + ")^(-2)\"\n") ==
          zero_divisor(9, "L = \"v^2*(", one, ")^(-2)\""));
}

TEST_CASE("a divisor that vanishes on the constraints, or for momenta as they are, is refused")
{
    const std::string constrained = "[base]\ncoordinates = [\"x\", \"y\"]\nconstraints = [\"x^2 + y^2 - 1\"]\n"
                                    "[fibre]\ncoordinates = [\"v\"]\n[algebroid.anchor]\n";
    CHECK(refusal(constrained + "v = { x = \"-y\", y = \"x/(1 - x^2 - y^2)\" }\n") ==
          zero_divisor(8, "v = { x = \"-y\", y = \"x/(", "1 - x^2 - y^2", ")\" }"));
    CHECK(refusal(plane + "[lagrangian]\nL = \"(v^2 + w^2)/2\"\n[observables]\nk = \"x/(p_v - v)\"\n") ==
          zero_divisor(11, "k = \"x/(", "p_v - v", ")\""));
    CHECK(refusal(plane + "[lagrangian]\nL = \"(v^2 + w^2)/2\"\n[observables]\nk = \"x/(p_v - 2*v)\"\n").empty());
}

TEST_CASE("the label of a Casimir may be divided by, and a divisor that vanishes at points alone is no mistake")
{
    std::string text = checked_sphere;
    text.replace(text.find("2*w3^2)/2"), 9, "2*w3^2)/a");
    CHECK(verified_text(text).structure.verdict == Verdict::valid);
    CHECK(refusal(plane + "[lagrangian]\nL = \"v^2/x + w^2/sin(y)\"\n").empty());
}

TEST_CASE("a model is defined where its operations are as they are written, also those that fold away")
{
    // [e1, e2] = 2 sqrt(x^2) - 2 x: zero for x >= 0, and for x < 0 the model has no meaning.
    const auto verdict = [](const std::string& entry) {
        return verified_text("[base]\ncoordinates = [\"x\"]\n[fibre]\ncoordinates = [\"e1\", \"e2\"]\n"
                             "[algebroid.anchor]\ne1 = { x = 1 }\ne2 = { x = \"" +
                             entry + "\" }\n[algebroid.bracket]\n\"e1,e2\" = { e1 = \"1 + sqrt(x^2) - x\" }\n")
            .structure.verdict;
    };
    CHECK(verdict("x") == Verdict::invalid);
    CHECK(verdict("sqrt(x)^2") == Verdict::valid);
    CHECK(verdict("sqrt(x)*sqrt(x)") == Verdict::valid);
    CHECK(verdict("exp(log(x))") == Verdict::valid);
    CHECK(verdict("x + 0*log(x)") == Verdict::valid);
}
