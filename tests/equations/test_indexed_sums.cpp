// SPDX-License-Identifier: GPL-2.0-or-later
/// Sums over indices of families in derived equations: equal to their terms, exact texts; what the model gives.
#include "equations/written/every_size.hpp"
#include "equations/written/index_shape.hpp"
#include "equations/written_blocks.hpp"
#include "support/golden.hpp"

using namespace lagen;

namespace {

/// n bodies with masses and charges.
std::string bodies(int n)
{
    return "[sizes]\nn = " + std::to_string(n) + R"toml(
[parameters]
"m[1..n]" = 1
"e[1..n]" = 1
G = 1
[base]
coordinates = ["x[1..n,1..3]"]
domain = ["m > 0"]
[fibre]
coordinates = ["v[1..n,1..3]"]
[algebroid]
kind = "tangent"
[definitions]
"r(i,j)" = "sqrt(sum(k, 1, 3, (x[i,k] - x[j,k])^2))"
[lagrangian]
L = "sum(i, 1, n, sum(k, 1, 3, m[i]*v[i,k]^2))/2 + sum(i, 1, n, sum(j, i+1, n, (G*m[i]*m[j] - e[i]*e[j])/r(i,j)))"
)toml";
}

/// Rotors that turn one another, and a wheel on all their shafts.
const std::string rotors = R"toml(
[sizes]
n = 5
[parameters]
"I[1..n]" = 1
"K[1..n,1..n]" = 0.3
J = 2
[base]
coordinates = ["q[1..n]"]
domain = ["I > 0", "J > 0"]
[fibre]
coordinates = ["w[1..n]"]
[algebroid]
kind = "tangent"
[lagrangian]
L = "sum(i, 1, n, I[i]*w[i]^2)/2 + sum(i, 1, n, sum(j, 1, n, K[i,j]*cos(q[i] - q[j])))/2 + J*sum(i, 1, n, w[i])^2/2"
[forces]
"w[j]" = "-w[j]/10"
)toml";

/// A chain of masses whose springs are not linear.
const std::string springs = R"toml(
[sizes]
n = 6
[parameters]
"m[1..n]" = 1
"k[1..n]" = 1
alpha = 0.25
[base]
coordinates = ["x[1..n]"]
domain = ["m > 0"]
[fibre]
coordinates = ["v[1..n]"]
[algebroid]
kind = "tangent"
[lagrangian]
L = "sum(i, 1, n, m[i]*v[i]^2)/2 - sum(i, 1, n-1, k[i]*(x[i+1] - x[i])^2/2 + alpha*(x[i+1] - x[i])^3/3)"
)toml";

/// Points that attract by all pairs and triples: where j != i is left out, the equation of i = 1 does not show it.
std::string points(const std::string& potential)
{
    return R"toml(
[sizes]
n = 5
[base]
coordinates = ["x[1..n]"]
[fibre]
coordinates = ["v[1..n]"]
[algebroid]
kind = "tangent"
[lagrangian]
L = "sum(i, 1, n, v[i]^2)/2 - )toml" +
           potential + "\"\n";
}

std::string replaced(std::string text, const std::string& from, const std::string& to)
{
    for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
        text.replace(at, from.size(), to);
    return text;
}

} // namespace

TEST_CASE("sums over indices are equal to their terms")
{
    for (const std::string& text : {bodies(3), bodies(4), bodies(5), rotors, springs})
        CHECK(checked_blocks(of_text(text)) >= 3);
    CHECK(checked_blocks(of_file("models/chain.toml")) == 6);
    for (const int n : {2, 3, 5, 7}) {
        INFO(n);
        const std::vector<Setting> settings{{"n", whole_text("--set", std::to_string(n))}};
        CHECK(checked_blocks(kept_equations(read_model(LAGEN_SOURCE_DIR "/models/chain.toml", settings, choosers()))) >=
              (n > 2 ? 4U : 0U));
    }
}

/// Those of a long chain, from short ones; `asked` has the sizes of these.
std::optional<EquationSet> of_every_size(const std::string& text, std::vector<long>& asked)
{
    return equations_of_every_size(read_model_text("test.toml", text), [&](long size) {
        asked.push_back(size);
        const std::vector<Setting> settings{{"n", whole_text("--set", std::to_string(size))}};
        const Model model = read_model_text("test.toml", text, settings);
        const System system = elaborate(model);
        return with_written_blocks(derive("lagrange", model, system, verify(system)), model);
    });
}

/// models/chain.toml with n links and one part of its file in the place of another.
std::string chain_of(int n, const std::string& part = "", const std::string& instead = "")
{
    std::string text = testing::read_text(LAGEN_SOURCE_DIR "/models/chain.toml");
    text.replace(text.find("n = 4"), 5, "n = " + std::to_string(n));
    if (!part.empty()) text.replace(text.find(part), part.size(), instead);
    return text;
}

TEST_CASE("the equations of a long chain are those of short ones")
{
    std::vector<long> asked;
    const std::optional<EquationSet> six = of_every_size(chain_of(6), asked);
    REQUIRE(six);
    CHECK(asked == std::vector<long>{4, 1, 2, 3});
    const Model model = read_model_text("test.toml", chain_of(6));
    const System system = elaborate(model);
    EquationSet both = derive("lagrange", model, system, verify(system)); // by components, with six links
    for (auto* blocks : {&both.given, &both.blocks})
        for (EquationBlock& block : *blocks) {
            const auto& others = blocks == &both.given ? six->given : six->blocks;
            const auto found = std::ranges::find(others, block.title, &EquationBlock::title);
            REQUIRE(found != others.end());
            CHECK(found->equations.empty());
            block.written = found->written;
        }
    CHECK(checked_blocks(both) == 6);
    const std::optional<EquationSet> long_chain = of_every_size(chain_of(64), asked);
    REQUIRE(long_chain);
    CHECK(block_text(*long_chain, "momenta") ==
          "  p_w[i] = Σ_{j=1..64} l[i] l[j] (Σ_{k=max(i,j)..64} m[k]) w[j] cos(a[i] - a[j])   (i = 1..64)\n");
}

TEST_CASE("a Lagrangian that tells sizes or neighbours apart is derived at its own size")
{
    const std::string potential = "g*sum(i, 1, n, m[i]*y(i))";
    for (const char* other : {"g*sum(i, 1, n, m[i]*y(i))/n", "sum(i, 1, n-1, cos(a[i+1] - a[i]))", "g*m[1]*y(1)",
                              "sin(sum(i, 1, n, a[i]))"}) {
        std::vector<long> asked;
        INFO(other);
        CHECK(!of_every_size(chain_of(6, potential, other), asked));
        CHECK(asked.empty());
    }
}

TEST_CASE("a chain of pendulums is one equation, however long")
{
    const EquationSet chain = of_file("models/chain.toml");
    CHECK(block_text(chain, "momenta") ==
          "  p_w[i] = Σ_{j=1..4} l[i] l[j] (Σ_{k=max(i,j)..4} m[k]) w[j] cos(a[i] - a[j])   (i = 1..4)\n");
    CHECK(block_text(chain, "equations of motion (acceleration form)") ==
          "  Σ_{j=1..4} l[i] l[j] (Σ_{k=max(i,j)..4} m[k]) cos(a[i] - a[j]) ẇ[j]\n"
          "    = -Σ_{j=1..4} l[i] l[j] (Σ_{k=max(i,j)..4} m[k]) w[j]² sin(a[i] - a[j])\n"
          "      - l[i] g (Σ_{j=i..4} m[j]) sin(a[i])   (i = 1..4)\n");
    CHECK(block_text(chain, "energy") ==
          "  E = Σ_{i=1..3} Σ_{j=i+1..4} l[i] l[j] (Σ_{k=j..4} m[k]) w[i] w[j] cos(a[i] - a[j])\n"
          "      + Σ_{i=1..4} l[i]² (Σ_{j=i..4} m[j]) w[i]²/2 - g Σ_{i=1..4} l[i] (Σ_{j=i..4} m[j]) cos(a[i])\n");
    CHECK(print_latex(chain).find("  p_{\\omega_{i}} &= \\sum_{j=1}^{4} l_{i}\\, l_{j}\\, "
                                  "\\left(\\sum_{k=\\max(i,j)}^{4} m_{k}\\right)\\, ") != std::string::npos);
}

TEST_CASE("bodies that attract one another are one equation of vectors with a sum over the others")
{
    CHECK(block_text(of_text(bodies(4)), "equations of motion (acceleration form)") ==
          "  m[i] v̇[i,:] = Σ_{j=1..4, j≠i} (e[i] e[j] - m[i] m[j] G) (x[i,:] - x[j,:])/(Σ_{k=1..3} (x[i,k] - "
          "x[j,k])²)^(3/2)\n"
          "                (i = 1..4)\n");
    const EquationSet planets = of_file("models/outer_solar_system.toml");
    CHECK(print_text(planets).ends_with(
        "where:\n"
        "         potential = -G Σ_{i=1..5} Σ_{j=i+1..6} m[i] m[j]/√(Σ_{k=1..3} (Q[i,k] - Q[j,k])²)\n"
        "  potential_Q[i,j] = G Σ_{k=1..6, k≠i} m[i] m[k] (Q[i,j] - Q[k,j])/(Σ_{l=1..3} (Q[i,l] - Q[k,l])²)^(3/2)\n"
        "                     (i = 1..6, j = 1..3)\n"));
}

TEST_CASE("bodies in the plane are one equation with two indices")
{
    const EquationSet set = of_text(replaced(replaced(bodies(4), "1..3]", "1..2]"), "sum(k, 1, 3", "sum(k, 1, 2"));
    CHECK(checked_blocks(set) == 6);
    CHECK(block_text(set, "momenta") == "  p_v[i,j] = m[i] v[i,j]   (i = 1..4, j = 1..2)\n");
    CHECK(block_text(set, "equations of motion (acceleration form)") ==
          "  m[i] v̇[i,j] = Σ_{k=1..4, k≠i} (e[i] e[k] - m[i] m[k] G) (x[i,j] - x[k,j])/((x[i,1] - x[k,1])²\n"
          "                + (x[i,2] - x[k,2])²)^(3/2)   (i = 1..4, j = 1..2)\n");
}

TEST_CASE("an index that a sum leaves out is found where the first equation does not show it")
{
    const EquationSet pairs = of_text(points("sum(i, 1, n, sum(j, i+1, n, x[i]*x[j]))"));
    CHECK(checked_blocks(pairs) == 6);
    CHECK(block_text(pairs, "equations of motion (acceleration form)") ==
          "  v̇[i] = -Σ_{j=1..5, j≠i} x[j]   (i = 1..5)\n");
    const EquationSet triples = of_text(points("sum(i, 1, n, sum(j, i+1, n, sum(k, j+1, n, x[i]*x[j]*x[k])))"));
    CHECK(checked_blocks(triples) == 6);
    CHECK(block_text(triples, "equations of motion (acceleration form)") ==
          "  v̇[i] = -Σ_{j=1..5, j≠i} Σ_{k=j+1..5, k≠i} x[j] x[k]   (i = 1..5)\n");
}

TEST_CASE("the energy has the form of L, whatever divides it")
{
    const std::string metric =
        "0 - sum(i, 1, n, x[i]^2*v[i]^2/(1 + x[i]^2)) + sum(i, 1, n, v[i])^2/(1 + sum(i, 1, n, x[i]^2))^2 "
        "- sum(i, 1, n, i*v[i]) - sum(i, 1, n, x[i]^4)";
    const EquationSet set = of_text(points(metric));
    CHECK(block_text(set, "energy") ==
          "  E = Σ_{i=1..5} x[i]⁴ - Σ_{i=1..5} x[i]² v[i]²/(x[i]² + 1) + Σ_{i=1..5} v[i]²/2\n"
          "      + (Σ_{i=1..5} v[i])²/(Σ_{i=1..5} x[i]² + 1)²\n");
}

TEST_CASE("discrete equations without a left side have indices too")
{
    std::string text = replaced(springs, "kind = \"tangent\"", "");
    text = replaced(replaced(text, "[algebroid]", "[groupoid]\nkind = \"pair\""), "[lagrangian]",
                    "[discrete]\nstep = \"h\"");
    text = replaced(replaced(text, "m[i]*v[i]^2)/2", "m[i]*(x_next[i] - x[i])^2)/(2*h)"), "- sum(i", "- h*sum(i");
    const EquationSet set = of_text(replaced(text, "alpha = 0.25", "alpha = 0"));
    CHECK(checked_blocks(set) >= 3);
    CHECK(block_text(set, "momenta at the target") == "  p_v_next[i] = m[i] (x_next[i] - x[i])/h   (i = 1..6)\n");
    CHECK(block_text(set, "discrete Euler-Lagrange equations").find("(i = 2..5)\n") != std::string::npos);
}

TEST_CASE("sums stand in comparisons")
{
    const EquationSet set = of_text(points("0") + "[forces]\n\"v[i]\" = \"if(sum(j, 1, n, x[j]) > 0, -v[i], 0)\"\n");
    CHECK(block_text(set, "equations of motion (momentum form)") ==
          "  ṗ_v[i] = if(Σ_{j=1..5} x[j] > 0, -v[i], 0)   (i = 1..5)\n");
}

TEST_CASE("letters of indices are none of the model's names")
{
    std::string text = springs;
    for (const auto& [name, other] : {std::pair("alpha", "i"), std::pair("k[", "j["), std::pair("x[", "k["),
                                      std::pair("v[", "l["), std::pair("\"v\"", "\"l\"")})
        text = replaced(text, name, other);
    const EquationSet set = of_text(text);
    CHECK(checked_blocks(set) >= 4);
    CHECK(block_text(set, "energy").find("p=1") != std::string::npos); // n is its size
}

TEST_CASE("a sum stands by itself in one equation, and its ends where the terms differ")
{
    const EquationSet set = of_text(rotors);
    CHECK(block_text(set, "momenta") == "  p_w[i] = I[i] w[i] + J Σ_{j=1..5} w[j]   (i = 1..5)\n");
    CHECK(block_text(set, "equations of motion (momentum form)") ==
          "  ṗ_w[i] = -Σ_{j=1..5} (K[i,j] + K[j,i]) sin(q[i] - q[j])/2 - w[i]/10   (i = 1..5)\n");
    CHECK(
        block_text(set, "equations of motion (acceleration form)") ==
        "  I[i] ẇ[i] + J Σ_{j=1..5} ẇ[j] = -Σ_{j=1..5} (K[i,j] + K[j,i]) sin(q[i] - q[j])/2 - w[i]/10   (i = 1..5)\n");
    CHECK(block_text(of_text(springs), "energy") ==
          "  E = Σ_{i=1..6} m[i] v[i]²/2 + Σ_{i=1..5} k[i] (x[i] - x[i+1])²/2 - alpha Σ_{i=1..5} (x[i] - "
          "x[i+1])³/3\n");
}

TEST_CASE("what the model gives stands before its equations")
{
    const EquationSet top = of_file("models/heavy_top.toml");
    CHECK(print_text(top).starts_with("Heavy top in body coordinates\n"
                                      "\n"
                                      "Lagrangian:  L(x, y)\n"
                                      "  L = w · I w/2 - mgl e · g\n"
                                      "\n"
                                      "brackets:  [e_a, e_b] = C^c_ab e_c\n"
                                      "  [e_w1, e_w2] = e_w3\n"
                                      "  [e_w1, e_w3] = -e_w2\n"
                                      "  [e_w2, e_w3] = e_w1\n"
                                      "\n"
                                      "constraints:  φ(x) = 0 on M\n"
                                      "  0 = g · g - 1\n"
                                      "\n"
                                      "claimed invariants:  ḟ = 0\n"
                                      "  area = g · p_w\n"
                                      "\n"
                                      "kinematics:"));
    CHECK(print_json(top).find("\"given\"") != std::string::npos);
    const EquationSet control = of_file("models/half_plane_control.toml");
    CHECK(print_text(control).find("claimed invariants:  ḟ = 0\n     shift = mu1\n") != std::string::npos);
    const EquationSet planets = of_file("models/outer_solar_system.toml");
    CHECK(block_text(planets, "claimed invariants") == "          momentum = Σ_{i=1..6} m[i] V[i,:]\n"
                                                       "  angular_momentum = Σ_{i=1..6} m[i] Q[i,:] × V[i,:]\n");
}

TEST_CASE("what is too large to be looked at stays as it is")
{
    std::vector<Tree> terms;
    for (std::size_t k = 1; k <= 2000; ++k) terms.push_back(multiply({number(k), name("x[1]")}));
    const Tree large = add(terms);
    const std::vector<Tree> guesses = lifted(large, "i", 1, 0);
    REQUIRE(guesses.size() == 1);
    CHECK(to_text(guesses[0]) == to_text(large));
    CHECK(lifted_patterns(large, "i").empty());
}
