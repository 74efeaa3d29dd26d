// SPDX-License-Identifier: GPL-2.0-or-later
/// [forms]: claims decided by components, closedness outside the verdict.
#include "verify/checking.hpp"

#include <catch2/catch.hpp>

#include <chrono>

using namespace lagen;

namespace {

using Lines = std::vector<std::string>;

/// The sphere with the action of so(3), and these forms.
ModelReport with_forms(const std::string& forms)
{
    return verified_text("[parameters]\nk = 2\n[base]\ncoordinates = ['g1', 'g2', 'g3']\n[fibre]\ncoordinates = ['w1', "
                         "'w2', 'w3']\n[algebroid]\nkind = 'action'\nalgebra = 'so(3)'\n[algebroid.anchor]\n"
                         "w1 = { g2 = 'g3', g3 = '-g2' }\nw2 = { g1 = '-g3', g3 = 'g1' }\n"
                         "w3 = { g1 = 'g2', g2 = '-g1' }\n[forms]\n" +
                         forms);
}

Lines claims_of(const ModelReport& report)
{
    Lines lines;
    for (const Check& check : report.structure.checks)
        if (check.name == "closed" || check.name == "equals") lines.push_back(line_of(check));
    return lines;
}

} // namespace

TEST_CASE("d of a function has the components rho_a(f), and is closed")
{
    const ModelReport report =
        with_forms("V = { degree = 0, value = 'k*g3' }\n"
                   "A = { degree = 1, w1 = '-k*g2', w2 = 'k*g1', closed = true, equals = 'd(V)' }\n");
    CHECK(report.structure.verdict == Verdict::valid);
    CHECK(claims_of(report) == Lines{"closed(A, w1, w3) proved", "closed(A, w2, w3) proved", "equals(A, w1) proved",
                                     "equals(A, w2) proved"});
    REQUIRE(report.structure.forms.size() == 2);
    CHECK(report.structure.forms[0].closed == ProofStatus::refuted);
    CHECK(report.structure.forms[1].closed == ProofStatus::proved);
}

TEST_CASE("a wrong sign in a claim is refuted, and a form that claims nothing is not part of the verdict")
{
    const ModelReport wrong = with_forms("V = { degree = 0, value = 'k*g3' }\n"
                                         "A = { degree = 1, w1 = 'k*g2', w2 = 'k*g1', equals = 'd(V)' }\n");
    CHECK(wrong.structure.verdict == Verdict::invalid);
    CHECK(claims_of(wrong) == Lines{"equals(A, w1) refuted", "equals(A, w2) proved"});
    const ModelReport silent = with_forms("A = { degree = 1, w1 = 'k*g2', w2 = 'k*g1' }\n");
    CHECK(silent.structure.verdict == Verdict::valid);
    CHECK(silent.structure.forms.at(0).closed == ProofStatus::refuted);
}

TEST_CASE("components in another order of their indices have the sign of the order")
{
    const ModelReport report = with_forms("F = { degree = 2, 'w2,w1' = 'g3' }\n"
                                          "G = { degree = 2, 'w1,w2' = '-g3', equals = 'F' }\n");
    CHECK(claims_of(report) == Lines{"equals(G, w1, w2) proved"});
}

TEST_CASE("claims may use d, wedge, contraction with a section, sums and products with functions")
{
    const std::string forms = "A = { degree = 1, w1 = 'g1', w2 = '3' }\nB = { degree = 1, w2 = 'g2', w3 = 'k' }\n";
    const auto holds = [&](const std::string& degree, const std::string& rest) {
        return with_forms(forms + "C = { degree = " + degree + ", " + rest + " }\n").structure.verdict ==
               Verdict::valid;
    };
    CHECK(holds("2", "'w1,w2' = 'g1*g2', 'w1,w3' = 'k*g1', 'w2,w3' = '3*k', equals = 'wedge(A, B)'"));
    CHECK(holds("2", "'w1,w2' = '-g1*g2', 'w1,w3' = '-k*g1', 'w2,w3' = '-3*k', equals = 'wedge(B, A)'"));
    CHECK(holds("1", "w2 = 'g1*g2', w3 = 'k*g1', equals = 'i(w1, wedge(A, B))'"));
    CHECK(holds("1", "w1 = '2*g1*g3/k', w2 = '(6 + g2)*g3/k', w3 = 'g3', equals = 'g3*(2*A + B)/k'"));
    CHECK(holds("0", "value = 'g1^2 + 3*g2', equals = 'i([g1, g2, g3], A)'"));
    CHECK(holds("3", "equals = 'd(d(A))'"));
    CHECK_FALSE(holds("3", "'w1,w2,w3' = '1/10^15', equals = 'd(d(A))'"));
}

TEST_CASE("a claim of forms holds where both sides are defined as they are written")
{
    const auto verdict_of = [](const std::string& forms) {
        return verified_text("[base]\ncoordinates = ['x', 'y']\n[algebroid]\nkind = 'tangent'\n[forms]\n" + forms +
                             "\n")
            .structure.verdict;
    };
    for (const char* nowhere :
         {"H = { degree = 0, value = '0*log(-1 - x^2)', closed = true }",
          "H = { degree = 0, value = '0*log(-1 - x^2)', equals = '0' }",
          "H = { degree = 0, value = '0', equals = '0*log(-1 - x^2)' }",
          "H = { degree = 1, v_x = 'y', v_y = 'x', equals = 'd(x*y) + 0*d(log(-1 - x^2))' }",
          "H = { degree = 1, v_x = 'y', v_y = 'x', equals = 'd(x*y)*(log(-1 - x^2)/log(-1 - x^2))' }",
          "H = { degree = 1, v_x = 'x', equals = 'd(x)*(sqrt(-1 - x^2)^2)*0 + x*d(x)' }",
          "H = { degree = 0, value = 'x', equals = 'i([log(-1 - x^2), 1], x*d(y))' }",
          "H = { degree = 1, v_x = 'y', equals = 'B' }\nB = { degree = 1, v_x = 'y + 0*log(-1 - x^2)' }",
          "H = { degree = 1, equals = 'd(G)' }\nG = { degree = 0, value = '0*log(-1 - x^2)' }"}) {
        INFO(nowhere);
        CHECK(verdict_of(nowhere) == Verdict::undecided);
    }
    CHECK(verdict_of("B = { degree = 1, v_x = '1/x', equals = 'd(log(-x))' }") == Verdict::valid);
    CHECK(verdict_of("Z = { degree = 2, equals = 'd(d(x*y))', closed = true }") == Verdict::valid);
}

TEST_CASE("a closed function is constant where a Casimir is")
{
    const auto where_of = [](const std::string& f) {
        const ModelReport report =
            verified_text("[base]\ncoordinates = ['x', 'y', 'phi']\n[fibre]\ncoordinates = ['w']\n[algebroid.anchor]\n"
                          "w = { x = '-y', y = 'x', phi = '1' }\n[forms]\nQ = { degree = 0, closed = true, value = '" +
                          f + "' }\n");
        Lines lines;
        for (const Check& check : report.structure.checks)
            if (check.name == "closed") lines.insert(lines.end(), check.where.begin(), check.where.end());
        CHECK(report.structure.verdict == Verdict::valid);
        return lines;
    };
    CHECK(where_of("phi - atan2(y, x)") == Lines{"y != 0"});
    CHECK(where_of("abs(y)/y - abs(y)/y") == Lines{"y != 0"});
    CHECK(where_of("x^2 + y^2").empty());
}

TEST_CASE("whether a form is closed that does not claim it is decided within a small budget")
{
    const auto begin = std::chrono::steady_clock::now();
    const auto tangent = [](std::size_t n, const std::string& form) {
        return verified_text("[base]\ncoordinates = ['x[1.." + std::to_string(n) +
                             "]']\n[algebroid]\nkind = 'tangent'\n[forms]\nA = { " + form + " }\n")
            .structure.forms.at(0)
            .closed;
    };
    const auto slopes = [](std::size_t n, const std::string& of) { // the k-th is written with x[k]
        std::string form = "degree = 1";
        for (std::size_t k = 1; k <= n; ++k) {
            const std::string x = "x[" + std::to_string(k) + "]";
            form += ", 'v_" + x + "' = '" + x + "*" + of + "'";
        }
        return form;
    };
    const std::string twice = "sqrt(2 + sin(sum(k, 1, 40, x[k])))/sqrt(2 + sin(sum(k, 1, 40, x[k]*1)))";
    CHECK(tangent(40, slopes(40, "(" + twice + "*exp(sum(k, 1, 40, x[k]^2)) + x[1]^2)")) == ProofStatus::refuted);
    CHECK(tangent(20, slopes(20, "sum(k, 1, 20, x[k]^2)")) == ProofStatus::proved);
    CHECK(tangent(90, "degree = 2, 'v_x[1],v_x[2]' = 'sin(x[3])*x[4]'") == ProofStatus::undecided);
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
    CHECK(seconds.count() < 10);
}

TEST_CASE("a definition called d is meant where the model has one")
{
    const std::string model =
        "[base]\ncoordinates = ['x']\n[algebroid]\nkind = 'tangent'\n[definitions]\n'd(q)' = 'q^3'\n"
        "[forms]\nf = { degree = 0, value = 'x^3', equals = 'd(x)' }\n";
    CHECK(verified_text(model).structure.verdict == Verdict::valid);
}
