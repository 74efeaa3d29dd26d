// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/chart/contestants.hpp"

#include "commands/line/options.hpp"
#include "commands/scene/preparation.hpp"
#include "emit/print_header.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <map>

namespace lagen {

namespace {

enum class Kinship { explicit_steps, pair, nystrom, series, implicit, splitting, group };

Kinship kinship_of(const MethodEntry& method)
{
    switch (method.kind) {
    case MethodKind::splitting: return Kinship::splitting;
    case MethodKind::series: return Kinship::series;
    case MethodKind::implicit_stages: return Kinship::implicit;
    case MethodKind::group:
    case MethodKind::poisson: return Kinship::group;
    case MethodKind::explicit_stages: break;
    case MethodKind::discrete: throw InternalError("a discrete motion has no chart");
    }
    if (method.system != SecondOrder::Kind::no) return Kinship::nystrom;
    return method.adaptive ? Kinship::pair : Kinship::explicit_steps;
}

/// A library that takes part where it is installed, by runtime/program/lagen_chart/NAME.hpp.
struct PeerEntry {
    const char* name;
    const char* header;
    const char* package;
    const char* libraries;
    std::array<const char*, 3> methods; ///< nullptr where there are fewer
};

constexpr std::array peers{
    PeerEntry{"odeint", "boost/numeric/odeint.hpp", "libboost-dev", "", {"dopri5", "fehlberg78", "bulirsch_stoer"}},
    PeerEntry{"gsl", "gsl/gsl_odeiv2.h", "libgsl-dev", "-lgsl,-lgslcblas", {"rk8pd", "rkf45", nullptr}},
    PeerEntry{"sundials",
              "cvode/cvode.h",
              "libsundials-dev",
              "-lsundials_cvode,-lsundials_nvecserial,-lsundials_sunnonlinsolfixedpoint",
              {"cvode_adams", nullptr, nullptr}},
};

std::string main_with(const std::string& header, const std::string& call)
{
    return fmt::format("#include \"model.hpp\"\n#include \"lagen_chart/{}.hpp\"\nint main(int argc, char** "
                       "argv)\n{{\n    return lagen::{};\n}}\n",
                       header, call);
}

} // namespace

std::string obstacle_to(const MethodEntry& method, const ChartProblem& problem)
{
    if (method.kind == MethodKind::series) return problem.no_series;
    const std::optional<Obstacle> obstacle = obstacle_of(method, problem.module);
    return obstacle ? obstacle->text : "";
}

std::vector<MethodFamily> method_families(const ChartProblem& problem, const std::vector<const MethodEntry*>& wanted,
                                          std::vector<LeftOutMethod>& left_out)
{
    std::map<Kinship, std::vector<const MethodEntry*>> families;
    for (const MethodEntry& method : method_table()) {
        if (wanted.empty() ? *method.scheme != '\0' : std::ranges::find(wanted, &method) == wanted.end()) continue;
        const std::string obstacle = obstacle_to(method, problem);
        if (!obstacle.empty() && !wanted.empty()) throw UsageError(obstacle);
        if (obstacle.empty())
            families[kinship_of(method)].push_back(&method);
        else
            left_out.push_back({method.name, obstacle});
    }
    std::vector<MethodFamily> list;
    for (const auto& [kinship, methods] : families) {
        MethodFamily family;
        std::string types, names;
        for (const MethodEntry* method : methods) {
            family.methods.push_back({method->name, method->adaptive});
            types += fmt::format(", lagen::{}", method->type);
            names += fmt::format("{}\"{}\"", names.empty() ? "" : ", ", method->name);
        }
        family.text = {problem.header,
                       main_with("points", fmt::format("chart_points<lagen::models::{}<double>{}>({{{}}}, argc, "
                                                       "argv)",
                                                       class_name(problem.module.name), types, names))};
        list.push_back(std::move(family));
    }
    return list;
}

std::vector<MethodFamily> peer_families(const ChartProblem& problem, std::vector<LeftOutMethod>& left_out)
{
    std::vector<MethodFamily> list;
    for (const PeerEntry& peer : peers) {
        if (!finds_header(peer.header)) {
            left_out.push_back({peer.name, fmt::format("the compiler does not find {} (Debian package {})", peer.header,
                                                       peer.package)});
            continue;
        }
        MethodFamily family;
        family.peer = peer.name;
        for (const char* method : peer.methods)
            if (method != nullptr) family.methods.push_back({method, true});
        family.text = {problem.header,
                       main_with(peer.name, fmt::format("chart_peer<lagen::models::{}<double>>(argc, argv)",
                                                        class_name(problem.module.name))),
                       split_list(peer.libraries)};
        list.push_back(std::move(family));
    }
    return list;
}

} // namespace lagen
