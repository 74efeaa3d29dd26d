// SPDX-License-Identifier: GPL-2.0-or-later
/// Each rule of the least model on systems made by hand: what it takes away, and what looks alike and must stay.
#include "least/least_model.hpp"

#include "expression/parse.hpp"
#include "expression/scope.hpp"
#include "graph/core/lower.hpp"

#include <catch2/catch.hpp>

#include <algorithm>

using namespace lagen;

namespace {

using Texts = std::vector<std::string>;

/// x1' = .. with starts, what is watched, and parameters with values.
class Motion {
  public:
    Motion(const Texts& lanes, const Texts& rates, const Texts& start, const Texts& watched,
           const Texts& parameters = {}, const Texts& values = {})
    {
        system_.graph = std::make_shared<Graph>();
        system_.time = graph().input("t");
        for (const std::string& each : parameters) system_.setting.parameters.push_back(graph().input(each));
        for (const std::string& each : lanes) system_.lanes.push_back(graph().input(each));
        for (const std::string& each : rates) system_.rates.push_back(node(each));
        for (const std::string& each : start)
            system_.start.push_back(each.empty() ? std::nullopt : std::optional(node(each)));
        for (const std::string& each : watched) system_.watched.push_back({node(each), each});
        for (std::size_t k = 0; k < values.size(); ++k)
            system_.values.emplace_back(system_.setting.parameters[k], node(values[k]));
        system_.setting.variables = system_.lanes;
        system_.setting.variables.push_back(system_.time);
    }
    Motion& positive(const std::string& function)
    {
        system_.setting.domain.push_back(graph().apply(Op::greater, node(function), graph().constant(0)));
        return *this;
    }
    Motion& constraint(const std::string& function)
    {
        system_.setting.constraints.push_back(node(function));
        return *this;
    }
    Motion& wall(const std::string& function)
    {
        (void)positive(function);
        system_.walls.push_back(system_.setting.domain.back());
        return *this;
    }
    Motion& jump(const Texts& behind)
    {
        std::vector<NodeId> nodes;
        for (const std::string& each : behind) nodes.push_back(node(each));
        system_.jumps.push_back(std::move(nodes));
        return *this;
    }
    Motion& perhaps_conserved(const std::string& function)
    {
        system_.candidates.push_back({node(function), function});
        return *this;
    }
    [[nodiscard]] LeastModel least() const { return least_model(system_); }
    /// The lanes that are left.
    [[nodiscard]] Texts kept() const { return names_in(least()); }
    [[nodiscard]] static Texts names_in(const LeastModel& least)
    {
        Texts names;
        for (const NodeId lane : least.reduction.system.lanes) names.push_back(least.full.graph->input_name(lane));
        return names;
    }

  private:
    Graph& graph() { return *system_.graph; }
    NodeId node(const std::string& text)
    {
        Scope scope;
        for (const NodeId each : graph().inputs()) scope.declare(graph().input_name(each), {});
        return Lowering(graph())(scope.close(parse_expression(whole_text("test", text)), true));
    }

    LaneSystem system_;
};

Texts rules_of(const LeastModel& least)
{
    Texts rules;
    for (const LeastStep& step : least.reduction.steps) rules.push_back(step.rule + " " + step.lane);
    return rules;
}

} // namespace

TEST_CASE("lanes that nothing watched depends on are left out, behind cancellations too")
{
    CHECK(Motion({"x", "y"}, {"-x", "x"}, {"1", "2"}, {"x"}).kept() == Texts{"x"});
    CHECK(Motion({"x", "y"}, {"-x + (y + x)^2 - x^2 - 2*x*y - y^2", "x"}, {"1", "2"}, {"x"}).kept() == Texts{"x"});
    CHECK(Motion({"x", "y"}, {"-x + y/1000000", "x"}, {"1", "2"}, {"x"}).kept() == Texts{"x", "y"});
    CHECK(Motion({"x", "y"}, {"-x", "x"}, {"1", "2"}, {"x*y - x*y"}).kept().empty());
}

TEST_CASE("a derivative that vanishes is not enough where a function has branches, or on constraints alone")
{
    CHECK(Motion({"x", "y"}, {"-x + sign(y)", "-1"}, {"1", "2"}, {"x"}).kept() == Texts{"x", "y"});
    CHECK(Motion({"x", "y"}, {"-x + abs(y)/y", "-1"}, {"1", "2"}, {"x"}).kept() == Texts{"x", "y"});
    CHECK(Motion({"x", "y"}, {"-x + sqrt(y^2)/y", "-1"}, {"1", "2"}, {"x"}).kept() == Texts{"x", "y"});
    CHECK(Motion({"x", "y"}, {"-x + atan(y) + atan(1/y)", "-1"}, {"1", "2"}, {"x"}).kept() == Texts{"x", "y"});
    CHECK(Motion({"x", "y"}, {"-x + sqrt(x^2 + 1 + y - y)", "-1"}, {"1", "2"}, {"x"}).kept() == Texts{"x"});
    // On the circle the slope of (x^2 + y^2 - 1)^2 is 0.
    CHECK(Motion({"x", "y"}, {"-y", "x + (x^2 + y^2 - 1)^2"}, {"1", "0"}, {"x"}).constraint("x^2 + y^2 - 1").kept() ==
          Texts{"x", "y"});
}

TEST_CASE("walls and jumps are watched")
{
    CHECK(Motion({"x", "y"}, {"-x", "-y"}, {"1", "2"}, {"x"}).wall("y").kept() == Texts{"x", "y"});
    CHECK(Motion({"x", "y"}, {"-x", "-y"}, {"1", "2"}, {"x"}).jump({"x + y", "y"}).kept() == Texts{"x", "y"});
    CHECK(Motion({"x", "y"}, {"-x", "-y"}, {"1", "2"}, {"x"}).jump({"x/2", "x"}).kept() == Texts{"x"});
}

TEST_CASE("a lane without a rate is a constant of the start, unless a jump changes it")
{
    Motion motion({"x", "c"}, {"-c*x", "0"}, {"1", "2"}, {"x"});
    const LeastModel least = motion.least();
    CHECK(Motion::names_in(least) == Texts{"x"});
    CHECK(rules_of(least) == Texts{"constant c"});
    REQUIRE(least.reduction.constants.size() == 1);
    CHECK(to_text(*least.full.graph, *least.reduction.constants[0].value) == "2");
    CHECK(motion.jump({"x", "c + 1"}).kept() == Texts{"x", "c"});
}

TEST_CASE("lanes stay on an invariant set that holds their exact start")
{
    // An equilibrium of the last two; then of them with x alone; then a start that misses it by 1e-30.
    const Texts lanes{"x", "z", "w"}, rates{"-x", "w", "-z/x^2"};
    CHECK(Motion(lanes, rates, {"1", "0", "0"}, {"x", "z"}).kept() == Texts{"x"});
    CHECK(Motion(lanes, rates, {"1", "0", "1/10^30"}, {"x", "z"}).kept() == lanes);
    CHECK(Motion({"th", "w"}, {"w", "-sin(th)"}, {"pi", "0"}, {"th"}).kept().empty());
    CHECK(Motion({"th", "w"}, {"w", "-sin(th)"}, {"3.14159265358979", "0"}, {"th"}).kept() == Texts{"th", "w"});
    // Equal and opposite lanes.
    CHECK(Motion({"a", "b", "c"}, {"c*a^2", "c*b^2", "-c*a*b"}, {"1", "1", "2"}, {"a", "b", "c"}).kept() ==
          Texts{"a", "c"});
    CHECK(Motion({"a", "b"}, {"a^3 + 1", "b^3 - 1"}, {"1/2", "-1/2"}, {"b"}).kept() == Texts{"a"});
}

TEST_CASE("a set on which the rates are not Lipschitz holds nobody")
{
    // x = t^2/4 leaves 0 as well as x = 0 stays there.
    CHECK(Motion({"x", "y"}, {"sqrt(x)", "y"}, {"0", "1"}, {"x", "y"}).kept() == Texts{"x", "y"});
    CHECK(Motion({"x", "y"}, {"-sign(x)*y", "y"}, {"0", "1"}, {"x", "y"}).kept() == Texts{"x", "y"});
    CHECK(Motion({"x", "y"}, {"x^2", "y"}, {"0", "1"}, {"x", "y"}).kept() == Texts{"y"});
}

TEST_CASE("what holds for values of parameters is a relation, and no more of them than it takes")
{
    const Texts lanes{"x", "y"}, rates{"-a*x + k*y", "-y"};
    const LeastModel apart = Motion(lanes, rates, {"1", "2"}, {"x"}, {"a", "k"}, {"3", "0"}).least();
    CHECK(Motion::names_in(apart) == Texts{"x"});
    REQUIRE(apart.reduction.prover.bound().size() == 1);
    CHECK(apart.full.graph->input_name(apart.reduction.prover.bound()[0]) == "k");
    const LeastModel joined = Motion(lanes, rates, {"1", "2"}, {"x"}, {"a", "k"}, {"3", "7/10"}).least();
    CHECK(Motion::names_in(joined) == lanes);
    CHECK(joined.reduction.prover.bound().empty());
    // A free parameter has no value that a proof could use.
    CHECK(Motion(lanes, rates, {"1", "2"}, {"x"}, {"a", "k"}).kept() == lanes);
}

TEST_CASE("a conserved function gives the lane of the largest coefficient, which vanishes nowhere")
{
    const Texts lanes{"x", "u", "v"}, rates{"u", "-m2*x", "m1*x"}, start{"1", "2", "3"};
    const auto motion = [&](const char* m1, const char* m2) {
        return Motion(lanes, rates, start, {"x", "v"}, {"m1", "m2"}, {m1, m2})
            .positive("m1")
            .positive("m2")
            .perhaps_conserved("m1*u + m2*v");
    };
    CHECK(rules_of(motion("2", "1/10").least()) == Texts{"momentum u"});
    CHECK(rules_of(motion("1/10^30", "1").least()) == Texts{"momentum v"});
    // m1 may be 0.
    CHECK(Motion(lanes, {"u", "-x", "x"}, start, {"x", "v"}).perhaps_conserved("u*x + v*x").kept() == lanes);
    // A sum of two that change.
    CHECK(Motion(lanes, {"u", "-x", "x"}, start, {"x", "v"})
              .perhaps_conserved("u")
              .perhaps_conserved("v")
              .kept()
              .size() == 2);
    // It is not conserved.
    CHECK(Motion(lanes, {"u", "-x", "2*x"}, start, {"x", "v"}).perhaps_conserved("u + v").kept() == lanes);
}

TEST_CASE("differences move by themselves where their rates depend on differences alone")
{
    const Texts lanes{"x", "y", "u", "v"}, start{"0", "1", "2", "4"};
    CHECK(Motion(lanes, {"u", "v", "(y - x)^3", "-2*(y - x)^3"}, start, {"y - x"}).kept() == Texts{"x - y", "u - v"});
    CHECK(Motion(lanes, {"u", "v", "(y - x)^3 + x/1000", "-2*(y - x)^3"}, start, {"y - x"}).kept() == lanes);
}

TEST_CASE("a watched function may have an equation of its own")
{
    // h = x^2 + y^2 of an isotropic oscillator: h'' = 4 E - 4 k h, E the energy.
    Motion motion({"x", "y", "u", "v"}, {"u", "v", "-k*x", "-k*y"}, {"1", "1/2", "0", "1/3"}, {"x^2 + y^2"}, {"k"},
                  {"2"});
    motion.perhaps_conserved("(u^2 + v^2 + k*(x^2 + y^2))/2");
    const LeastModel least = motion.least();
    CHECK(rules_of(least) == Texts{"own_equation x^2 + y^2"});
    CHECK(least.reduction.prover.bound().empty());
    CHECK(least.reduction.system.lanes.size() == 2);
    CHECK(least.rank.rank == 2);
    // Its second derivative knows nothing of the kinks of max(x, 0).
    const Texts lanes{"x", "y", "z"}, rates{"y*z", "-x*z", "x*y"}, start{"7/10", "-2/5", "9/10"};
    for (const auto& [watched, count] : {std::pair<std::string, std::size_t>{"x", 2}, {"max(x, 0)", 3}}) {
        Motion body(lanes, rates, start, {watched});
        body.perhaps_conserved("x^2 + y^2").perhaps_conserved("z^2 - x^2");
        CHECK(body.kept().size() == count);
    }
}

TEST_CASE("a rank that is certified says that no smooth reduction has fewer states")
{
    const LeastModel least = Motion({"x", "y", "z"}, {"y", "z", "x*y"}, {"1", "2", "3"}, {"x"}).least();
    CHECK(least.reduction.system.lanes.size() == 3);
    CHECK(least.rank.rank == 3);
    CHECK_FALSE(least.rank.point.empty());
}
