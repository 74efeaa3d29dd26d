// SPDX-License-Identifier: GPL-2.0-or-later
/// Models from text and their kernels at points, through the interpreter.
#pragma once

#include "graph/differentiate.hpp"
#include "graph/evaluate.hpp"
#include "kernels/lagrange_kernels.hpp"
#include "model/read_model.hpp"

#include <catch2/catch.hpp>

#include <filesystem>
#include <map>
#include <random>
#include <set>

namespace lagen::testing {

inline KernelModule kernels_of(const Model& model, const KernelRequest& request = {})
{
    return lagrange_kernels(model, verify(model), request);
}

inline KernelModule kernels_of_text(const std::string& text)
{
    return kernels_of(read_model_text("test.toml", text));
}

inline const Kernel& find_kernel(const KernelModule& module, const std::string& name)
{
    for (const Kernel& kernel : module.kernels)
        if (kernel.name == name) return kernel;
    FAIL("no kernel " << name);
    return module.kernels.front();
}

inline std::vector<NodeId> nodes_of(const Kernel& kernel)
{
    std::vector<NodeId> nodes;
    for (const KernelEntry& entry : kernel.output.entries) nodes.push_back(entry.node);
    return nodes;
}

using Values = std::map<std::string, double>;

inline std::vector<double> values_of(const KernelModule& module, const std::string& kernel, const Values& point)
{
    return evaluate<double>(*module.graph, nodes_of(find_kernel(module, kernel)), point);
}

/// Every input between 0.5 and 1.5, seeded.
inline Values random_point(const KernelModule& module, unsigned seed)
{
    std::mt19937 random(seed);
    Values point;
    for (const NodeId input : module.graph->inputs())
        point[module.graph->input_name(input)] = 0.5 + static_cast<double>(random()) / 4294967295.0;
    return point;
}

/// The files of models/, sorted.
inline std::set<std::string> model_files()
{
    std::set<std::string> files;
    for (const auto& entry : std::filesystem::directory_iterator(std::string(LAGEN_SOURCE_DIR) + "/models"))
        if (entry.path().extension() == ".toml") files.insert(entry.path().string());
    return files;
}

/// The kernels of a file of models/, derived once for all tests.
inline const KernelModule& kernels_of_file(const std::string& file)
{
    static std::map<std::string, KernelModule> modules;
    const auto found = modules.find(file);
    return found != modules.end() ? found->second : modules.emplace(file, kernels_of(read_model(file))).first->second;
}

} // namespace lagen::testing
