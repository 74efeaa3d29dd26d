// SPDX-License-Identifier: GPL-2.0-or-later
/// The laws of a Lie groupoid and of its invariant fields, for one record and four kinds of data.
#include "elaborate/elaborate.hpp"
#include "geometry/algebroid_of.hpp"
#include "geometry/named_algebra.hpp"
#include "graph/calculus/differentiate.hpp"
#include "model/read_model.hpp"
#include "proof/decide.hpp"

#include <catch2/catch.hpp>

using namespace lagen;

namespace {

const std::string rotations = "[fibre]\ncoordinates = [\"w1\", \"w2\", \"w3\"]\n";
const std::string plane = "[base]\ncoordinates = [\"x\", \"y\"]\n";
const std::string space = "[base]\ncoordinates = [\"G[1..3]\"]\n";

/// A group with a parameter in its generators: rotations of an ellipse and its dilations.
const std::string squeezed = R"toml(
[parameters]
k = 2
[fibre]
coordinates = ["u", "v"]
[groupoid]
kind = "group"
generators = [[[0, "-k"], ["1/k", 0]], [["1", 0], [0, 1]]]
)toml";

const std::vector<std::pair<std::string, std::string>>& models()
{
    static const std::vector<std::pair<std::string, std::string>> texts{
        {"pair", plane + "[groupoid]\nkind = \"pair\"\n"},
        {"rotations", rotations + "[groupoid]\nkind = \"group\"\ngroup = \"SO(3)\"\n"},
        {"moves of the plane", "[fibre]\ncoordinates = [\"w\", \"a\", \"b\"]\n[groupoid]\nkind = \"group\"\ngroup = "
                               "\"SE(2)\"\n"},
        {"a group by generators", squeezed},
        {"an action on space", space + rotations +
                                   "[groupoid]\nkind = \"action\"\ngroup = \"SO(3)\"\naction = { G = "
                                   "\"transpose(W)*G\" }\n"},
        {"affine maps on a line",
         "[base]\ncoordinates = [\"x\"]\n[fibre]\ncoordinates = [\"a\", \"b\"]\n[groupoid]\nkind "
         "= \"action\"\ngroup = \"AFF(1)\"\naction = { x = \"(inverse(W)*[x, 1])[1]/(inverse(W)*[x, 1])[2]\" }\n"},
        {"Atiyah without a connection", plane + "[fibre]\ncoordinates = [\"u\", \"v\", \"w1\", \"w2\", "
                                                "\"w3\"]\n[groupoid]\nkind = \"atiyah\"\ngroup = \"SO(3)\"\n"},
        {"Atiyah with a connection",
         plane +
             "[fibre]\ncoordinates = [\"u\", \"v\", \"w1\", \"w2\", \"w3\"]\n[algebroid]\nkind = \"atiyah\"\nalgebra = "
             "\"so(3)\"\nconnection = { x = { w1 = \"y\", w3 = \"x*y\" }, y = { w2 = \"x^2\" } }\n[groupoid]\nkind = "
             "\"atiyah\"\ngroup = \"SO(3)\"\n"},
    };
    return texts;
}

/// A system with what its laws are proved with.
struct Laws {
    System system;
    Graph& graph = system.graph;
    const Groupoid& groupoid = *system.groupoid;
    std::vector<NodeId> variables = groupoid.coordinates();

    explicit Laws(const std::string& text) : system(elaborate(read_model_text("test.toml", "name = \"test\"\n" + text)))
    {
    }

    /// An arrow of new inputs that starts where `before` ends.
    Arrow arrow_behind(const Arrow& before, const std::string& mark)
    {
        Arrow arrow{target(graph, groupoid, before), {}, {}};
        const auto inputs = [&](const std::vector<NodeId>& like) {
            std::vector<NodeId> out;
            for (const NodeId input : like) out.push_back(graph.input(graph.input_name(input) + mark));
            variables.insert(variables.end(), out.begin(), out.end());
            return out;
        };
        arrow.next = inputs(groupoid.arrow.next);
        arrow.W = inputs(groupoid.arrow.W);
        return arrow;
    }

    [[nodiscard]] bool vanishes(NodeId node) const
    {
        if (graph.is_zero(node)) return true;
        ProofSetting setting;
        setting.variables = variables;
        setting.parameters = system.parameters;
        return ZeroDecider(graph, setting).decide(node).status == ProofStatus::proved;
    }
    [[nodiscard]] bool equal(const std::vector<NodeId>& a, const std::vector<NodeId>& b)
    {
        bool same = a.size() == b.size();
        for (std::size_t k = 0; same && k < a.size(); ++k) same = vanishes(graph.subtract(a[k], b[k]));
        return same;
    }
    [[nodiscard]] bool equal(const Arrow& a, const Arrow& b)
    {
        return equal(a.x, b.x) && equal(a.next, b.next) && equal(a.W, b.W);
    }
    /// X - f_c Y_c = 0
    [[nodiscard]] bool is_combination(VectorField X, const std::vector<VectorField>& Y, const Column& f)
    {
        for (const ColumnEntry& each : f) {
            VectorField term;
            for (const ColumnEntry& entry : Y[each.index])
                term.push_back({entry.index, graph.multiply(each.value, entry.value)});
            X = difference(graph, X, term);
        }
        return std::ranges::all_of(X, [&](const ColumnEntry& entry) { return vanishes(entry.value); });
    }
};

Column negative(Graph& graph, Column column)
{
    for (ColumnEntry& entry : column) entry.value = graph.negate(entry.value);
    return column;
}

} // namespace

TEST_CASE("source, target, product, inverse and identity obey the axioms of a groupoid")
{
    for (const auto& [name, text] : models()) {
        INFO(name);
        Laws laws(text);
        Graph& graph = laws.graph;
        const Groupoid& groupoid = laws.groupoid;
        const Arrow& g = groupoid.arrow;
        const Arrow h = laws.arrow_behind(g, "'"), k = laws.arrow_behind(h, "''");
        const auto times = [&](const Arrow& a, const Arrow& b) { return product(graph, groupoid, a, b); };
        const auto t = [&](const Arrow& a) { return target(graph, groupoid, a); };
        const Arrow gh = times(g, h);
        CHECK(laws.equal(source(gh), source(g)));
        CHECK(laws.equal(t(gh), t(h)));
        CHECK(laws.equal(times(gh, k), times(g, times(h, k))));
        const Arrow left = identity(graph, groupoid, source(g)), right = identity(graph, groupoid, t(g));
        CHECK((laws.equal(times(left, g), g) && laws.equal(times(g, right), g)));
        CHECK((laws.equal(source(left), source(g)) && laws.equal(t(left), source(g))));
        const Arrow back = inverse(graph, groupoid, g);
        CHECK(laws.equal(t(back), source(g)));
        CHECK((laws.equal(times(g, back), left) && laws.equal(times(back, g), right)));
    }
}

TEST_CASE("left invariant fields have the bracket of the algebroid, right ones its negative, and they commute")
{
    for (const auto& [name, text] : models()) {
        INFO(name);
        Laws laws(text);
        Graph& graph = laws.graph;
        const Groupoid& groupoid = laws.groupoid;
        const Algebroid& algebroid = laws.system.algebroid;
        REQUIRE(groupoid.r() == algebroid.r());
        BaseGradient partial(graph, groupoid.coordinates());
        const std::vector<NodeId> t = target(graph, groupoid, groupoid.arrow);
        std::size_t brackets = 0;
        for (std::size_t a = 0; a < groupoid.r(); ++a)
            for (std::size_t b = 0; b < groupoid.r(); ++b) {
                const Column& C = algebroid.C(a, b);
                Column at_target = C;
                for (ColumnEntry& entry : at_target) {
                    std::vector<std::pair<NodeId, NodeId>> moved;
                    for (std::size_t i = 0; i < t.size(); ++i) moved.emplace_back(groupoid.arrow.x[i], t[i]);
                    entry.value = substitute(graph, {&entry.value, 1}, moved)[0];
                }
                brackets += C.size();
                CHECK(laws.is_combination(bracket(partial, groupoid.left[a], groupoid.left[b]), groupoid.left,
                                          at_target));
                CHECK(laws.is_combination(bracket(partial, groupoid.right[a], groupoid.right[b]), groupoid.right,
                                          negative(graph, C)));
                CHECK(laws.is_combination(bracket(partial, groupoid.left[a], groupoid.right[b]), {}, {}));
            }
        CHECK((brackets > 0 || name == "pair" || name == "a group by generators"));
    }
}

TEST_CASE("left fields keep the source and right ones the target, and at the arrows 1 they move the other by rho")
{
    for (const auto& [name, text] : models()) {
        INFO(name);
        Laws laws(text);
        Graph& graph = laws.graph;
        const Groupoid& groupoid = laws.groupoid;
        BaseGradient partial(graph, groupoid.coordinates());
        const Arrow one = identity(graph, groupoid, groupoid.arrow.x);
        const std::vector<NodeId> t = target(graph, groupoid, groupoid.arrow);
        for (std::size_t a = 0; a < groupoid.r(); ++a)
            for (std::size_t i = 0; i < groupoid.n(); ++i) {
                const NodeId rho = Algebroid::entry(graph, laws.system.algebroid.anchor[a], i);
                CHECK(laws.vanishes(partial.along(groupoid.left[a], groupoid.arrow.x[i])));
                CHECK(laws.vanishes(partial.along(groupoid.right[a], t[i])));
                const NodeId moved[] = {partial.along(groupoid.left[a], t[i])};
                CHECK(laws.vanishes(graph.subtract(at(graph, groupoid, moved, one)[0], rho)));
                CHECK(laws.vanishes(graph.add(partial.along(groupoid.right[a], groupoid.arrow.x[i]), rho)));
            }
    }
}

TEST_CASE("a left action written for a right one breaks the law of the target")
{
    Laws laws(space + rotations + "[groupoid]\nkind = \"action\"\ngroup = \"SO(3)\"\naction = { G = \"W*G\" }\n");
    Graph& graph = laws.graph;
    const Groupoid& groupoid = laws.groupoid;
    const Arrow h = laws.arrow_behind(groupoid.arrow, "'");
    CHECK_FALSE(
        laws.equal(target(graph, groupoid, product(graph, groupoid, groupoid.arrow, h)), target(graph, groupoid, h)));
}

TEST_CASE("the algebroid of a groupoid is built where the model gives none")
{
    const auto text_of = [](const std::string& text) {
        const System system = elaborate(read_model_text("test.toml", "name = \"test\"\n" + text));
        std::string out;
        for (const AnchorValue& each : system.written.algebroid.rho)
            out += std::to_string(each.a) + "." + std::to_string(each.i) + " " + to_text(each.value) + "; ";
        out += "| ";
        for (const StructureValue& each : system.written.algebroid.C)
            out += std::to_string(each.a) + std::to_string(each.b) + "." + std::to_string(each.c) + " " +
                   to_text(each.value) + "; ";
        return out;
    };
    CHECK(text_of(models()[0].second) == "0.0 1; 1.1 1; | ");
    CHECK(text_of(models()[1].second) == "| 01.2 1; 02.1 -1; 12.0 1; ");
    CHECK(text_of(models()[4].second) ==
          "0.1 G[3]; 0.2 -G[2]; 1.0 -G[3]; 1.2 G[1]; 2.0 G[2]; 2.1 -G[1]; | 01.2 1; 02.1 -1; 12.0 1; ");
    CHECK(text_of(models()[5].second) == "0.0 -x; 1.0 -1; | 01.1 1; ");
    CHECK(text_of(models()[6].second) == "0.0 1; 1.1 1; | 23.4 1; 24.3 -1; 34.2 1; ");
}

TEST_CASE("generators that depend on each other or do not close are refused by their numbers")
{
    const auto error_of = [](const std::string& generators) -> std::string {
        try {
            (void)elaborate(read_model_text("test.toml", "name = \"test\"\n[parameters]\nk = 2\n[fibre]\ncoordinates = "
                                                         "[\"a\", \"b\"]\n[groupoid]\nkind = \"group\"\ngenerators = " +
                                                             generators + "\n"));
        } catch (const ModelError& error) {
            return error.diagnostic().message;
        }
        return "";
    };
    CHECK(error_of("[[[0, 1], [0, 0]], [[0, 0], [1, 0]]]") ==
          "the commutator of the generators number 1 and 2 is no combination of the generators");
    CHECK(error_of("[[[0, 1], [0, 0]], [[0, \"k\"], [0, 0]]]") ==
          "the generator number 2 is a combination of those before it");
    CHECK(error_of("[[[1, 0], [0, 0]], [[0, \"k\"], [0, 0]]]").empty());
}

TEST_CASE("the Cayley map leads into the groups with a name, and not into SL(3)")
{
    const auto has_cayley_map = [](const std::string& rank, const std::string& group) {
        const std::string text = "name = \"test\"\n[fibre]\ncoordinates = [\"y[1.." + rank +
                                 "]\"]\n[groupoid]\nkind = \"group\"\n" + group + "\n";
        return elaborate(read_model_text("test.toml", text)).groupoid->has_cayley_map;
    };
    const auto generators_of = [](const char* name) {
        const NamedAlgebra algebra = algebra_of_group(name).value();
        std::string text = "generators = [";
        for (const SparseMatrix& matrix : algebra.basis) {
            text += text.back() == '[' ? "[" : ", [";
            const std::vector<Rational> entries = dense(matrix, algebra.size);
            for (std::size_t k = 0; k < entries.size(); ++k)
                text += (k % algebra.size == 0 ? k == 0 ? "[" : "], [" : ", ") + ("\"" + entries[k].get_str() + "\"");
            text += "]]";
        }
        return text + "]";
    };
    for (const auto& [rank, name] : {std::pair{"3", "SO(3)"},
                                     {"3", "SU(2)"},
                                     {"3", "SE(2)"},
                                     {"6", "SE(3)"},
                                     {"3", "SO(2,1)"},
                                     {"3", "SL(2)"},
                                     {"3", "HEIS(3)"},
                                     {"2", "AFF(1)"},
                                     {"6", "SO(4)"},
                                     {"4", "GL(2)"},
                                     {"2", "R^2"}}) {
        INFO(name);
        CHECK(has_cayley_map(rank, generators_of(name)));
    }
    CHECK_FALSE(has_cayley_map("8",
                               "generators = [[[0,1,0],[0,0,0],[0,0,0]], [[0,0,1],[0,0,0],[0,0,0]], "
                               "[[0,0,0],[1,0,0],[0,0,0]], [[0,0,0],[0,0,1],[0,0,0]], [[0,0,0],[0,0,0],[1,0,0]], "
                               "[[0,0,0],[0,0,0],[0,1,0]], [[1,0,0],[0,-1,0],[0,0,0]], [[0,0,0],[0,1,0],[0,0,-1]]]"));
    CHECK_FALSE(has_cayley_map("1", "generators = [[[1, 0], [0, 2]]]"));
}
