// SPDX-License-Identifier: GPL-2.0-or-later
/// Equations by vectors and by indices say what their components say: in numbers on every model, and some as exact
/// texts.
#include "elaborate/make_frame.hpp"
#include "emit/print_equations.hpp"
#include "emit/print_equations_terms.hpp"
#include "equations/printed_value.hpp"
#include "model/read_model.hpp"
#include "model/scene_form.hpp"
#include "support/dice.hpp"
#include "support/model_equations.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>

using namespace lagen;
using lagen::testing::Dice;

namespace {

EquationSet kept_equations(Model model, std::string form = {})
{
    if (form.empty()) form = default_form(model);
    const System system = elaborate(model);
    return derive(form, model, system, verify(system), {}, Definitions::kept);
}

EquationSet of_file(const std::string& path)
{
    return kept_equations(read_model(LAGEN_SOURCE_DIR "/" + path, {}, choosers()));
}

EquationSet of_text(const std::string& text)
{
    return kept_equations(read_model_text("test.toml", text));
}

/// A scalar, a vector of 3 or a matrix of 9 by rows.
using Value = std::vector<long double>;
using Letters = std::map<std::string, std::size_t>; ///< the values of indices

/// What written equations say where the names have these values; rates are values of names with a mark.
class Meaning {
  public:
    explicit Meaning(const EquationSet& set) : set_(set)
    {
        const auto take = [&](const std::string& name) {
            if (!values_.contains(name))
                values_.emplace(name, static_cast<long double>(dice_.below(9001) + 500) / 10000);
        };
        for (const EquationBlock& block : set.blocks)
            for (const Equation& equation : block.equations) {
                take("'" + equation.symbol);
                for (const TermGroup& entry : equation.mass) take("'" + entry.label);
                for (const auto* list : {&equation.mass, &equation.groups})
                    for (const TermGroup& entry : *list)
                        for (const std::string& name : names_in(entry.value)) take(name);
            }
    }

    /// The left side minus the right one for all that the equations stand for, one after the other.
    std::vector<long double> values(const std::vector<Equation>& equations)
    {
        std::vector<long double> result;
        for (const Equation& equation : equations) append(equation, {}, result);
        return result;
    }

  private:
    void append(const Equation& equation, const Letters& letters, std::vector<long double>& result)
    {
        if (letters.size() < equation.ranges.size()) {
            const IndexRange& range = equation.ranges[letters.size()];
            for (std::size_t index = range.from; index <= range.to; ++index) {
                Letters next = letters;
                next[range.letter] = index;
                append(equation, next, result);
            }
            return;
        }
        Value sum = equation.mass.empty() ? named("'" + equation.symbol, letters) : Value{};
        for (const TermGroup& entry : equation.mass)
            add(sum, product(value(entry.value, letters), named("'" + entry.label, letters)), 1);
        for (const TermGroup& group : equation.groups) add(sum, value(group.value, letters), -1);
        result.insert(result.end(), sum.begin(), sum.end());
    }

    static void add(Value& sum, const Value& term, long double factor)
    {
        if (sum.empty()) sum.assign(term.size(), 0);
        REQUIRE(sum.size() == term.size());
        for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += factor * term[k];
    }

    static Value product(const Value& a, const Value& b)
    {
        if (a.size() == 9 && b.size() == 3) {
            Value result(3, 0);
            for (std::size_t k = 0; k < 9; ++k) result[k / 3] += a[k] * b[k % 3];
            return result;
        }
        REQUIRE((a.size() == 1 || b.size() == 1));
        Value result = a.size() == 1 ? b : a;
        for (long double& each : result) each *= a.size() == 1 ? a[0] : b[0];
        return result;
    }

    /// The name with indices for letters: a[i+1] at i = 2 is a[3].
    static std::string at(const std::string& name, const Letters& letters)
    {
        std::string result = name.substr(0, name.find('['));
        if (result.size() == name.size()) return name;
        std::string index;
        result += '[';
        for (std::size_t k = result.size(); k < name.size(); ++k) {
            if (name[k] != ',' && name[k] != ']') {
                index += name[k];
                continue;
            }
            const auto letter = letters.find(index.substr(0, index.find_first_of("+-")));
            if (letter != letters.end()) {
                const std::size_t sign = index.find_first_of("+-");
                const long offset = sign == std::string::npos ? 0 : std::stol(index.substr(sign));
                index = std::to_string(static_cast<long>(letter->second) + offset);
            }
            result += index + name[k];
            index.clear();
        }
        return result;
    }

    Value named(const std::string& written, const Letters& letters)
    {
        const std::string name = at(written, letters);
        if (const auto known = values_.find(name); known != values_.end()) return {known->second};
        const bool rate = name.starts_with('\'');
        const auto vector = std::ranges::find(set_.vectors, name.substr(rate ? 1 : 0), &VectorText::name);
        Value result;
        if (vector != set_.vectors.end()) {
            for (std::size_t k = 0; k < 3; ++k) {
                const Tree& entry = vector->entries[k];
                const long double value = entry->kind == TreeKind::number ? entry->number.get_d()
                                                                          : values_.at((rate ? "'" : "") + entry->name);
                if (vector->diagonal) result.resize(9, 0);
                vector->diagonal ? void(result[4 * k] = value) : result.push_back(value);
            }
            return result;
        }
        if (name.ends_with("ᵀ")) {
            const Value matrix = named(name.substr(0, name.find("ᵀ")), letters);
            for (std::size_t k = 0; k < 9; ++k) result.push_back(matrix[k % 3 * 3 + k / 3]);
        } else if (name.ends_with(":]"))
            for (std::size_t k = 1; k <= 3; ++k)
                result.push_back(values_.at(name.substr(0, name.size() - 2) + std::to_string(k) + "]"));
        else if (values_.contains(name + "[1]"))
            for (std::size_t k = 1; k <= 3; ++k) result.push_back(values_.at(name + "[" + std::to_string(k) + "]"));
        else
            for (std::size_t k = 0; k < 9; ++k)
                result.push_back(
                    values_.at(name + "[" + std::to_string(k / 3 + 1) + "," + std::to_string(k % 3 + 1) + "]"));
        return result;
    }

    Value value(const Tree& tree, const Letters& letters)
    {
        std::vector<Value> arguments;
        for (const Tree& argument : tree->arguments) arguments.push_back(value(argument, letters));
        switch (tree->kind) {
        case TreeKind::name: return named(tree->name, letters);
        case TreeKind::negate: return product({-1}, arguments[0]);
        case TreeKind::add: {
            Value sum;
            for (const Value& each : arguments) add(sum, each, 1);
            return sum;
        }
        case TreeKind::multiply: { // from the right: M v is a vector
            Value result = arguments.back();
            for (std::size_t k = arguments.size() - 1; k-- > 0;) result = product(arguments[k], result);
            return result;
        }
        case TreeKind::apply: {
            const Value &a = arguments[0], &b = arguments[1];
            REQUIRE((a.size() == 3 && b.size() == 3));
            if (tree->name == "dot") return {a[0] * b[0] + a[1] * b[1] + a[2] * b[2]};
            return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
        }
        case TreeKind::divide: return product({1 / arguments[1].at(0)}, arguments[0]);
        default: break;
        }
        TreeNode node = *tree; // a function of scalars
        for (std::size_t k = 0; k < arguments.size(); ++k)
            if (node.arguments[k]->kind != TreeKind::number) node.arguments[k] = name("argument" + std::to_string(k));
        std::map<std::string, long double> scalars;
        for (std::size_t k = 0; k < arguments.size(); ++k) scalars["argument" + std::to_string(k)] = arguments[k].at(0);
        return {
            value_of({LeftSide::symbol, "", {}, {{"", std::make_shared<const TreeNode>(std::move(node))}}}, scalars)};
    }

    const EquationSet& set_;
    Dice dice_{20261126};
    std::map<std::string, long double> values_;
};

/// Blocks that are written otherwise than by components; each says the same.
std::size_t checked_blocks(const EquationSet& set)
{
    std::size_t blocks = 0;
    for (const EquationBlock& block : set.blocks) {
        if (block.written.empty()) continue;
        ++blocks;
        INFO(set.model << ", " << block.title);
        CHECK(block.written.size() <= block.equations.size());
        const std::vector<long double> expected = Meaning(set).values(block.equations);
        const std::vector<long double> found = Meaning(set).values(block.written);
        REQUIRE(found.size() == expected.size());
        for (std::size_t k = 0; k < found.size(); ++k)
            CHECK((std::abs(found[k] - expected[k]) <= 1e-13L * (1 + std::abs(expected[k])) ||
                   (std::isnan(found[k]) && std::isnan(expected[k]))));
    }
    return blocks;
}

std::string block_text(const EquationSet& set, const std::string& title)
{
    const std::string text = print_text(set) + "\n";
    const std::size_t begin = text.find("\n" + title + ":");
    REQUIRE(begin != std::string::npos);
    const std::size_t line = text.find('\n', begin + 1) + 1;
    return text.substr(line, text.find("\n\n", line) + 1 - line);
}

/// A body in R^3 with a full matrix of inertia, and vectors that are multiplied twice.
const std::string body = R"toml(
[parameters]
"J[1..3,1..3]" = [[2, "1/10", 0], ["1/10", 3, "1/5"], [0, "1/5", 4]]
m = 1.5
k = 0.3
[base]
coordinates = ["x[1..3]"]
[fibre]
coordinates = ["w[1..3]", "v[1..3]"]
[algebroid]
kind = "general"
[algebroid.anchor]
"v[1]" = { "x[1]" = 1 }
"v[2]" = { "x[2]" = 1 }
"v[3]" = { "x[3]" = 1 }
[algebroid.bracket]
"w[1],w[2]" = { "w[3]" = 1 }
"w[2],w[3]" = { "w[1]" = 1 }
"w[3],w[1]" = { "w[2]" = 1 }
[lagrangian]
L = "dot(w, J*w)/2 + m*dot(v, v)/2 + k/sqrt(dot(x, x))"
)toml";

} // namespace

TEST_CASE("equations by vectors and indices are equal to their components")
{
    for (const char* name : {"heavy_top", "kirchhoff", "lagrange_top", "heavy_top_matrix", "attitude", "gyrostat"}) {
        INFO(name);
        CHECK(checked_blocks(of_file(std::string("models/") + name + ".toml")) >= 2);
    }
}

TEST_CASE("equations by vectors and indices are equal to their components in every model", "[all]")
{
    std::size_t blocks = 0;
    for (const auto& entry : std::filesystem::directory_iterator(LAGEN_SOURCE_DIR "/models")) {
        if (entry.path().extension() != ".toml") continue;
        INFO(entry.path().filename());
        const Model model = read_model(entry.path().string(), {}, choosers());
        const System system = elaborate(model);
        const Report report = verify(system);
        for (const char* form : {"lagrange", "hamilton", "pontryagin", "discrete"}) {
            INFO(form);
            try {
                blocks += checked_blocks(derive(form, model, system, report, {}, Definitions::kept));
            } catch (const MathematicsError&) { // the model has no such form
            }
        }
    }
    CHECK(blocks > 80);
}

TEST_CASE("the heavy top and Kirchhoff's body are written as in a book")
{
    const EquationSet top = of_file("models/heavy_top.toml");
    CHECK(block_text(top, "kinematics") == "  ġ = g × w\n");
    CHECK(block_text(top, "momenta") == "  p_w = I w\n");
    CHECK(block_text(top, "equations of motion (momentum form)") == "  ṗ_w = p_w × w + mgl g × e\n");
    CHECK(block_text(top, "equations of motion (acceleration form)") == "  I ẇ = I w × w + mgl g × e\n");
    CHECK(block_text(top, "energy") == "  E = w · I w/2 + mgl e · g\n");
    CHECK(print_text(top).ends_with("where:\n"
                                    "    I = diag(I1, I2, I3)\n"
                                    "    e = [e1, e2, e3]\n"
                                    "    g = [g1, g2, g3]\n"
                                    "    w = [w1, w2, w3]\n"
                                    "  p_w = [p_w1, p_w2, p_w3]\n"));
    CHECK(print_latex(top).find("  I\\, \\dot{\\omega} &= I\\, \\omega \\times \\omega + mgl\\, \\gamma \\times e\n") !=
          std::string::npos);
    const EquationSet fluid = of_file("models/kirchhoff.toml");
    CHECK(block_text(fluid, "equations of motion (momentum form)") == "  ṗ_w = p_w × w + p_v × v\n  ṗ_v = p_v × w\n");
}

TEST_CASE("rows of a matrix are vectors, and a basis vector stands for an axis")
{
    const EquationSet matrix = of_file("models/heavy_top_matrix.toml");
    CHECK(block_text(matrix, "kinematics") == "  Ṙ[i,:] = R[i,:] × w   (i = 1..3)\n");
    CHECK(block_text(matrix, "equations of motion (momentum form)") == "  ṗ_w = p_w × w + mgl R[3,:] × e\n");
    const EquationSet top = of_file("models/lagrange_top.toml");
    CHECK(block_text(top, "equations of motion (momentum form)") == "  ṗ_w = p_w × w + mgl g × e_3\n");
    CHECK(print_text(top).find("\n  e_3 = [0, 0, 1]\n") != std::string::npos);
}

TEST_CASE("families are written once, in LaTeX too")
{
    const EquationSet set = of_file("models/outer_solar_system.toml");
    CHECK(block_text(set, "equations of motion (acceleration form)") ==
          "  m[i] V̇[i,:] = -potential_Q[i,:]   (i = 1..6)\n");
    CHECK(print_latex(set).find("p_{V,i:} &= m_{i}\\, V_{i:} \\qquad (i = 1, \\dots, 6)") != std::string::npos);
    const EquationSet chain = of_text(R"toml(
[sizes]
n = 6
[parameters]
"k[1..n]" = 1
[base]
coordinates = ["x[1..n]"]
[fibre]
coordinates = ["v[1..n]"]
[algebroid]
kind = "tangent"
[lagrangian]
L = "sum(i, 1, n, v[i]^2)/2 - sum(i, 1, n-1, k[i]*(x[i+1] - x[i])^2)/2"
)toml");
    CHECK(checked_blocks(chain) == 4);
    CHECK(block_text(chain, "kinematics") == "  ẋ[i] = v[i]   (i = 1..6)\n");
    CHECK(block_text(chain, "equations of motion (acceleration form)") ==
          "  v̇[1] = k[1] (x[2] - x[1])\n"
          "  v̇[i] = k[i-1] (x[i-1] - x[i]) + k[i] (x[i+1] - x[i])   (i = 2..5)\n"
          "  v̇[6] = k[5] (x[5] - x[6])\n");
}

TEST_CASE("full matrices stand beside their transposes")
{
    const EquationSet set = of_text(body);
    CHECK(checked_blocks(set) == 5);
    CHECK(block_text(set, "kinematics") == "  ẋ = v\n");
    CHECK(block_text(set, "momenta") == "  p_w = J w/2 + Jᵀ w/2\n  p_v = m v\n");
    CHECK(block_text(set, "equations of motion (momentum form)") ==
          "  ṗ_w = p_w × w\n  ṗ_v = -k x/(x[1]² + x[2]² + x[3]²)^(3/2)\n");
    CHECK(block_text(set, "equations of motion (acceleration form)") ==
          "  (J/2) ẇ + (Jᵀ/2) ẇ = J w × w/2 + Jᵀ w × w/2\n"
          "                 m v̇ = -k x/(x[1]² + x[2]² + x[3]²)^(3/2)\n");
    CHECK(print_latex(set).find("\\frac{J^{\\mathsf{T}}\\, w}{2}") != std::string::npos);
}

TEST_CASE("joint angles are no vector of space, and a declared name keeps its meaning")
{
    const EquationSet arm = of_text(R"toml(
[parameters]
g = 9.81
"tau[1..3]" = 0
[base]
coordinates = ["q[1..3]"]
[fibre]
coordinates = ["v[1..3]"]
[algebroid]
kind = "tangent"
[lagrangian]
L = "dot(v, v)/2 + g*cos(q[1]) + q[1]*q[2]*q[3]"
)toml");
    CHECK(block_text(arm, "equations of motion (acceleration form)") ==
          "  v̇[1] = q[2] q[3] - g sin(q[1])\n  v̇[2] = q[1] q[3]\n  v̇[3] = q[1] q[2]\n");
    const EquationSet taken = of_text(R"toml(
[parameters]
g = 9.81
I1 = 1
I2 = 2
I3 = 3
[base]
coordinates = ["g1", "g2", "g3"]
casimirs = { n = "g1^2 + g2^2 + g3^2" }
[fibre]
coordinates = ["w1", "w2", "w3"]
[algebroid]
kind = "action"
algebra = "so(3)"
[algebroid.anchor]
w1 = { g2 = "g3", g3 = "-g2" }
w2 = { g1 = "-g3", g3 = "g1" }
w3 = { g1 = "g2", g2 = "-g1" }
[lagrangian]
L = "(I1*w1^2 + I2*w2^2 + I3*w3^2)/2 - g*g3"
)toml");
    CHECK(block_text(taken, "kinematics") == "  ġ1 = g2 w3 - g3 w2\n  ġ2 = g3 w1 - g1 w3\n  ġ3 = g1 w2 - g2 w1\n");
}

TEST_CASE("no vector is called like the time, the energy or another symbol")
{
    const EquationSet set = of_text(R"toml(
[base]
coordinates = ["t1", "t2", "t3", "E1", "E2", "E3"]
[fibre]
coordinates = ["u1", "u2", "u3", "v1", "v2", "v3"]
[algebroid]
kind = "tangent"
[lagrangian]
L = "(u1^2 + u2^2 + u3^2 + v1^2 + v2^2 + v3^2)/2 - (t1*E1 + t2*E2 + t3*E3)"
)toml");
    CHECK(block_text(set, "kinematics") == "  ṫ1 = u1\n  ṫ2 = u2\n  ṫ3 = u3\n  Ė1 = v1\n  Ė2 = v2\n  Ė3 = v3\n");
    CHECK(block_text(set, "energy") == "  E = u · u/2 + v · v/2 + t1 E1 + t2 E2 + t3 E3\n");
}
