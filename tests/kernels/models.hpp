// SPDX-License-Identifier: GPL-2.0-or-later
/// Models from text and their kernels at points, through the interpreter.
#pragma once

#include "elaborate/make_frame.hpp"
#include "graph/calculus/differentiate.hpp"
#include "graph/core/evaluate.hpp"
#include "graph/unknowns/solve_unknowns.hpp"
#include "model/read_model.hpp"
#include "model/scene_form.hpp"
#include "support/model_kernels.hpp"
#include "support/sanitized.hpp"

#include <catch2/catch.hpp>

#include <filesystem>
#include <map>
#include <random>
#include <set>

namespace lagen::testing {

inline KernelModule kernels_of(const Model& model, const KernelRequest& request = {})
{
    return form_kernels(model, verify(model), request);
}

inline KernelModule kernels_of_text(const std::string& text)
{
    return kernels_of(read_model_text("test.toml", text, {}, choosers()));
}

inline const Kernel& find_kernel(const KernelModule& module, const std::string& name)
{
    for (const Kernel& kernel : module.kernels)
        if (kernel.name == name) return kernel;
    FAIL("no kernel " << name);
    return module.kernels.front();
}

using Values = std::map<std::string, double>;

inline std::vector<double> values_of(const KernelModule& module, const std::string& kernel, const Values& point)
{
    Values inputs = point;
    solve_unknowns(*module.graph, module.implicit, inputs);
    return evaluate<double>(*module.graph, nodes_of(find_kernel(module, kernel)), inputs);
}

/// Every input between 0.5 and 1.5, seeded, with parameters in the domain; smaller lanes where the right-hand side is
/// not finite there.
inline Values random_point(const KernelModule& module, unsigned seed)
{
    std::mt19937 random(seed);
    for (double scale = 1;; scale *= 0.9) {
        REQUIRE(scale > 1e-3);
        Values point;
        for (const NodeId input : module.graph->inputs())
            point[module.graph->input_name(input)] = 0.5 + static_cast<double>(random()) / 4294967295.0;
        for (const Quantity& lane : lanes_of(module)) point[lane.name] *= scale;
        std::vector<NodeId> conditions;
        for (const auto& [text, node] : module.parameter_conditions) conditions.push_back(node);
        const std::vector<double> margins = evaluate<double>(*module.graph, conditions, point);
        if (std::ranges::any_of(margins, [](double margin) { return margin <= 0; })) continue;
        bool finite = true;
        if (has_kernel(module, "rhs"))
            for (const double value : values_of(module, "rhs", point)) finite = finite && std::isfinite(value);
        if (finite) return point;
    }
}

/// The files of models/ without discrete Lagrangians, sorted: kernels of steps have tests of their own.
/// With sanitizers without the largest: many bodies take the same way as two.
inline std::set<std::string> model_files()
{
    const std::set<std::string> largest = {"chain", "outer_solar_system", "pleiades"};
    std::set<std::string> files;
    for (const auto& entry : std::filesystem::directory_iterator(std::string(LAGEN_SOURCE_DIR) + "/models")) {
        const bool left_out = LAGEN_SANITIZED && largest.contains(entry.path().stem().string());
        if (entry.path().extension() == ".toml" && !left_out &&
            !read_model(entry.path().string(), {}, choosers()).discrete)
            files.insert(entry.path().string());
    }
    return files;
}

/// The kernels of every form of a file of models/, derived once for all tests.
inline const std::vector<KernelModule>& kernels_of_file(const std::string& file)
{
    static std::map<std::string, std::vector<KernelModule>> modules;
    const auto found = modules.find(file);
    if (found != modules.end()) return found->second;
    const Model model = read_model(file, {}, choosers());
    const ModelReport verified = verify(model);
    std::vector<KernelModule> all;
    for (const std::string& form : forms_of(model)) {
        KernelRequest request;
        request.form = form;
        all.push_back(form_kernels(model, verified, request));
    }
    return modules.emplace(file, std::move(all)).first->second;
}

} // namespace lagen::testing
