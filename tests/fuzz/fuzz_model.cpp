// SPDX-License-Identifier: GPL-2.0-or-later
/// Bytes as a model file: read; where it reads, its scenes are evaluated, it is verified and its equations are derived.
/// A model with many sections or large expressions is read only: deciding it may take its time. So is every model where
/// LAGEN_FUZZ_READS is defined, which needs no more rooms than those that read.
#include "fuzz/harness.hpp"
#include "model/read_model.hpp"
#include "scene/evaluate_scene.hpp"

#ifndef LAGEN_FUZZ_READS
#include "elaborate/make_frame.hpp"
#include "fuzz/small_budget.hpp"
#include "model/scene_form.hpp"
#include "support/model_equations.hpp"
#include "support/stages.hpp"
#endif

using namespace lagen;
using fuzz::accepted;

namespace {

/// Models name other files; those of the machine are none of a fuzzer's business.
bool names_other_files(const std::string& text)
{
    return text.find(".toml") != std::string::npos || text.find('/' + std::string("dev")) != std::string::npos;
}

#ifdef LAGEN_FUZZ_READS

/// Frames of level sets are made by a room that is left out here.
Choosers choosers()
{
    return {{}, [](const auto&, const LevelSetRequest&) -> LevelSetFrame { throw MathematicsError("no frame"); }};
}

void decide(const Model&) {}

#else

using fuzz::small_budget;

constexpr std::size_t largest_rank = 4;
constexpr std::size_t largest_base = 6;
constexpr std::size_t longest_text = 1000;    ///< of all expressions of the model together
constexpr std::size_t longest_mechanics = 60; ///< of what is differentiated and simplified

std::size_t written(const AlgebroidBlock& block)
{
    std::size_t length = block.fibre.size() * block.fibre.size();
    for (const AnchorEntry& entry : block.anchor) length += to_text(entry.value).size();
    for (const BracketEntry& entry : block.bracket) length += to_text(entry.value).size();
    for (const SectionEntry& entry : block.sections) length += to_text(entry.value).size();
    for (const ConnectionEntry& entry : block.connection) length += to_text(entry.value).size();
    for (const AlgebroidBlock& inner : block.of) length += written(inner);
    return length;
}

/// L, H, R, forces, sigma and cost.
std::size_t written_mechanics(const Model& model)
{
    std::vector<Tree> trees = {model.lagrangian, model.hamiltonian, model.dissipation};
    for (const ComponentEntry& entry : model.forces) trees.push_back(entry.value);
    if (model.control) {
        trees.push_back(model.control->cost);
        for (const ComponentEntry& entry : model.control->sigma) trees.push_back(entry.value);
    }
    std::size_t length = 0;
    for (const Tree& tree : trees)
        if (tree) length += to_text(tree).size();
    return length;
}

bool is_small(const Model& model)
{
    std::size_t length = written(model.algebroid) + written_mechanics(model);
    for (const Tree& constraint : model.base.constraints) length += to_text(constraint).size();
    for (const NamedTree& claim : model.invariants) length += to_text(claim.value).size();
    return model.fibre.coordinates.size() <= largest_rank && model.base.coordinates.size() <= largest_base &&
           length <= longest_text;
}

void decide(const Model& model)
{
    if (!is_small(model)) return;
    const ModelReport verified = verify(model, {}, small_budget);
    if (written_mechanics(model) > longest_mechanics) return;
    for (const std::string& form : form_names()) accepted([&] { static_cast<void>(derive(form, model, verified)); });
}

#endif

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    const std::string text(reinterpret_cast<const char*>(data), size);
    if (names_other_files(text)) return 0;
    accepted([&] {
        const Model model = read_model_text("fuzz.toml", text, {}, choosers());
        for (const Scene& scene : model.scenes) accepted([&] { static_cast<void>(evaluate_scene(model, scene)); });
        decide(model);
    });
    return 0;
}
