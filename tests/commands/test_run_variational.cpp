// SPDX-License-Identifier: GPL-2.0-or-later
/// `lagen run --method variational4` and its kin on models in continuous time: the groupoid that is made for each kind
/// of algebroid, and the order against Hamilton's equations, whose states are the points and momenta of the steps.
#include "program.hpp"

#include "support/json.hpp"

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <cmath>
#include <map>

using namespace lagen::testing;
namespace json = lagen::json;

namespace {

struct Finished {
    std::map<std::string, double> last; ///< the last row by column
    json::Value report;
};

Finished finished(std::vector<std::string> arguments)
{
    arguments.insert(arguments.begin(), "run");
    arguments.insert(arguments.end(), {"--format", "json"});
    const Outcome outcome = done(arguments);
    Finished out{{}, json::parse(outcome.out)};
    const json::Value &columns = out.report["columns"], &row = out.report["rows"].entries.back();
    for (std::size_t k = 0; k < columns.size(); ++k) out.last[columns[k].text] = std::stod(row[k].text);
    return out;
}

/// The largest distance of points and momenta, as far as both have them.
double distance(const Finished& a, const Finished& b)
{
    double most = 0;
    std::size_t both = 0;
    for (const auto& [name, value] : a.last)
        if (b.last.contains(name) && name != "t") {
            most = std::max(most, std::abs(value - b.last.at(name)));
            ++both;
        }
    REQUIRE(both >= 2);
    return most;
}

double order_of(const std::string& model, const std::string& method, double step, const std::string& end)
{
    const Finished exact =
        finished({model, "--form", "hamilton", "--method", "dop853", "--tolerance", "1e-14", "--at", end});
    const auto error = [&](double h) {
        return distance(finished({model, "--method", method, "--step", fmt::format("{}", h), "--t-end", end}), exact);
    };
    return std::log2(error(step) / error(step / 2));
}

} // namespace

TEST_CASE("a variational method has its order on a pair groupoid and on an action groupoid", "[all]")
{
    CHECK(order_of(models_folder() + "/kepler.toml", "variational4", 0.05, "2") == Approx(4).margin(0.15));
    CHECK(order_of(models_folder() + "/heavy_top.toml", "variational2", 0.02, "2") == Approx(2).margin(0.15));
}

TEST_CASE("variational methods have their orders on models of every kind", "[all]")
{
    for (const char* model :
         {"kepler", "rigid_body", "heavy_top", "kirchhoff", "charged_particle", "elroys_beanie", "planar_body"})
        for (const auto& [method, order, step] :
             {std::tuple{"variational2", 2., 0.05}, {"variational4", 4., 0.05}, {"variational6", 6., 0.2}}) {
            INFO(model << " " << method);
            CHECK(order_of(fmt::format("{}/{}.toml", models_folder(), model), method, step, "2") ==
                  Approx(order).margin(0.3));
        }
}

TEST_CASE("a variational method keeps the vertical momentum of the heavy top, and the sphere", "[run]")
{
    const Finished run =
        finished({models_folder() + "/heavy_top.toml", "--method", "variational4", "--step", "0.05", "--t-end", "50"});
    const json::Value& constraints = run.report["constraints"];
    REQUIRE(constraints.size() == 1);
    CHECK(constraints[0]["max"].number() < 1e-13L);
    CHECK(run.report["invariants"]["energy"]["max_drift"].number() < 1e-3L);
}
