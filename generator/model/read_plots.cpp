// SPDX-License-Identifier: GPL-2.0-or-later
/// The [scene.NAME.plot] blocks, once all scenes are read: a picture may be like that of a scene further below.
#include "model/read_curve.hpp"
#include "model/read_values.hpp"
#include "model/scene_form.hpp"
#include "model/scene_reader.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace lagen {

namespace {

/// Pictures are copied along `like`: each is made once.
class Plots {
  public:
    Plots(const ModelReader& reader, const std::vector<TomlEntry>& blocks)
        : reader_(reader), blocks_(blocks), states_(blocks.size(), State::unread), plots_(blocks.size())
    {
        for (const TomlEntry& block : blocks) names_.push_back(block.name());
    }

    /// That of scene k; nothing where it has none.
    const std::optional<Plot>& of(std::size_t k)
    {
        if (states_[k] == State::read) return plots_[k];
        if (states_[k] == State::open)
            throw ModelError(fmt::format("the plot of scene '{}' is like itself, through 'like'", names_[k]),
                             blocks_[k].where());
        states_[k] = State::open;
        const TomlEntry* block = entry(blocks_[k].value, "plot");
        plots_[k] = block != nullptr ? read(k, *block) : liked_by_scene(k);
        states_[k] = State::read;
        return plots_[k];
    }

  private:
    enum class State { unread, open, read };

    static const TomlEntry* entry(const TomlValue& table, const std::string& key)
    {
        const auto found =
            std::ranges::find_if(table.entries, [&](const TomlEntry& each) { return each.name() == key; });
        return found == table.entries.end() ? nullptr : &*found;
    }

    std::size_t index(const std::string& name) const
    {
        return static_cast<std::size_t>(std::ranges::find(names_, name) - names_.begin());
    }

    /// A scene without a picture of its own has that of the scene which it is like.
    std::optional<Plot> liked_by_scene(std::size_t k)
    {
        const TomlEntry* like = entry(blocks_[k].value, "like");
        return like == nullptr ? std::nullopt : of(index(like->value.text.text));
    }

    Plot liked(std::size_t k, const TomlEntry& like)
    {
        const std::string target = read_text(like.value, fmt::format("'like' of [scene.{}.plot]", names_[k]));
        const std::size_t found = index(target);
        if (found == names_.size())
            throw ModelError(
                fmt::format("the plot of scene '{}' is like that of '{}', which is no scene", names_[k], target),
                like.value.where, hint_for(target, names_, "scenes"));
        const std::optional<Plot>& plot = of(found);
        if (!plot)
            throw ModelError(
                fmt::format("the plot of scene '{}' is like that of '{}', which has none", names_[k], target),
                like.value.where, fmt::format("add [scene.{}.plot] with curves", target));
        return *plot;
    }

    std::vector<PlotCurve> curves_in(const std::vector<Excerpt>& texts) const
    {
        std::vector<PlotCurve> curves;
        for (const Excerpt& text : texts)
            for (PlotCurve& curve : read_curve(reader_.model, reader_.arrows, text)) curves.push_back(std::move(curve));
        return curves;
    }

    /// A string is a panel, and so is a list of strings.
    void read_panels(Plot& plot, const TomlEntry& given, const std::string& what) const
    {
        plot.panels.clear();
        if (given.value.kind != TomlKind::array) (void)read_list(given.value, what);
        for (const TomlValue& item : given.value.items) {
            TomlValue list;
            list.kind = TomlKind::array;
            list.where = given.value.where;
            list.items = {item};
            const bool inner = item.kind == TomlKind::array;
            std::vector<PlotCurve> curves = curves_in(read_list(inner ? item : list, what));
            if (curves.empty()) throw ModelError(fmt::format("a panel in {} has no curves", what), item.where);
            add_panel(plot, std::move(curves));
        }
    }

    Plot read(std::size_t k, const TomlEntry& block)
    {
        const std::string title = fmt::format("[scene.{}.plot]", names_[k]);
        TableReader table(block.value, title, "curves = [\"t:x\", \"x:y\"]");
        const auto what = [&](const char* key) { return fmt::format("'{}' of {}", key, title); };
        Plot plot;
        if (const TomlEntry* like = table.take("like")) plot = liked(k, *like);
        if (const TomlEntry* given = table.take("curves")) read_panels(plot, *given, what("curves"));
        if (const TomlEntry* given = table.take("equal")) plot.equal = read_flag(given->value, what("equal"));
        if (const TomlEntry* given = table.take("points")) plot.points = read_flag(given->value, what("points"));
        const TomlEntry* sphere = table.take("sphere");
        if (sphere != nullptr) plot.sphere = read_flag(sphere->value, what("sphere"));
        table.finish();
        if (plot.panels.empty())
            throw ModelError(fmt::format("{} has no curves", title), block.where(), "curves = [\"t:x\", \"x:y\"]");
        if (sphere != nullptr && std::ranges::none_of(plot.panels, is_in_space))
            throw ModelError(fmt::format("{} asks for a sphere, and has no curve in space", title), sphere->where(),
                             "a curve in space has three coordinates: \"x:y:z\"");
        return plot;
    }

    const ModelReader& reader_;
    const std::vector<TomlEntry>& blocks_;
    std::vector<std::string> names_;
    std::vector<State> states_;
    std::vector<std::optional<Plot>> plots_;
};

} // namespace

void read_plots(ModelReader& reader, const std::vector<TomlEntry>& blocks)
{
    Plots plots(reader, blocks);
    for (std::size_t k = 0; k < blocks.size(); ++k) {
        Scene& scene = reader.model.scenes[k];
        saying_which(scene.name, [&] { scene.plot = plots.of(k); });
        if (scene.plot && !forms_of(reader.model).empty())
            require_values_in(reader.model, scene, form_of(reader.model, scene));
    }
}

} // namespace lagen
