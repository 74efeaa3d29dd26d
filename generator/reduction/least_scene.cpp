// SPDX-License-Identifier: GPL-2.0-or-later
#include "reduction/least_scene.hpp"

#include "equations/shared_parts.hpp"
#include "expression/parse.hpp"
#include "expression/rewrite.hpp"
#include "least/least_model.hpp"
#include "model/plain_names.hpp"
#include "model/print_toml.hpp"
#include "model/scene_form.hpp"
#include "reduction/reduced_document.hpp"
#include "text/comma_list.hpp"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <set>

namespace lagen {

namespace {

std::size_t count_of(const OperationCount& count)
{
    return count.additions + count.multiplications + count.divisions + count.functions + count.solves;
}

/// Names of the inputs of a least model as identifiers: lanes and parameters as they are where they are words, "start
/// of p_v" as p_v, a lane of its own by what it is.
class LeastNames {
  public:
    LeastNames(const LeastModel& least, const Model& model) : graph_(*least.full.graph)
    {
        for (const auto& [parameter, value] : least.full.values) add(parameter, graph_.input_name(parameter), "p");
        for (const NodeId lane : least.reduction.system.lanes) add(lane, graph_.input_name(lane), "s");
        for (const auto& [lane, value] : least.reduction.definitions) add(lane, graph_.input_name(lane), "s");
        for (const StartConstant& constant : least.reduction.constants) add(constant.input, constant.name, "c");
        for (const Input& input : model.inputs) taken_.insert(input.symbol.name);
    }

    [[nodiscard]] const std::string& operator[](NodeId input) const { return words_.at(input); }
    [[nodiscard]] bool is_taken(const std::string& word) const { return taken_.contains(word); }
    [[nodiscard]] Tree renamed(const Tree& tree) const { return replace_names(tree, trees_); }

  private:
    void add(NodeId input, const std::string& name_of_it, const char* stem)
    {
        if (words_.contains(input)) return;
        std::string word = is_identifier(name_of_it) ? name_of_it : plain_name(name_of_it);
        if (name_of_it.starts_with("Dt(") && is_identifier(name_of_it.substr(3, name_of_it.size() - 4)))
            word = name_of_it.substr(3, name_of_it.size() - 4) + "_dot";
        const bool is_long = name_of_it.find(' ') != std::string::npos;
        for (std::size_t k = 1; is_long || !is_identifier(word) || taken_.contains(word); ++k) {
            word = fmt::format("{}{}", stem, k);
            if (!taken_.contains(word)) break;
        }
        taken_.insert(word);
        words_.emplace(input, word);
        trees_.emplace(graph_.input_name(input), lagen::name(word));
    }

    const Graph& graph_;
    std::set<std::string> taken_{"t", "pi", "e"};
    std::map<NodeId, std::string> words_;
    std::map<std::string, Tree> trees_;
};

/// "a, b" of the inputs.
std::string list_of_names(const Graph& graph, const std::vector<NodeId>& nodes)
{
    return comma_list(nodes, [&](NodeId node) { return graph.input_name(node); });
}

class LeastWriter {
  public:
    LeastWriter(const CheckedModel& checked, const Scene& scene)
        : model_(checked.model), scene_(scene),
          least_(least_model(lane_system(checked.model, checked.system, checked.report, scene))),
          graph_(*least_.full.graph), reduction_(least_.reduction), names_(least_, checked.model)
    {
    }

    LeastScene write(bool with_document)
    {
        LeastScene out;
        out.full = least_.full.lanes.size();
        out.least = reduction_.system.lanes.size();
        out.obstacle = least_.full.obstacle;
        for (const NodeId parameter : reduction_.prover.bound()) out.relations.push_back(relation(parameter));
        out.not_followed = not_followed();
        out.record = record();
        out.text = text();
        for (const NamedTree& column : columns()) out.columns.push_back(column.name);
        out.unwritten = obstacle_to_writing();
        if (with_document && out.unwritten.empty()) out.document = document(out.text);
        return out;
    }

  private:
    [[nodiscard]] std::string relation(NodeId parameter) const
    {
        const auto value = std::ranges::find(least_.full.values, parameter, &Replacements::value_type::first);
        return fmt::format("{} = {}", graph_.input_name(parameter), lagen::to_text(graph_, value->second));
    }

    /// A function as a person reads it, in the names of the document.
    [[nodiscard]] std::string readable(NodeId node) const
    {
        const std::string text = lagen::to_text(names_.renamed(to_tree(graph_, node)));
        return text.size() <= 160 ? text : text.substr(0, 157) + "...";
    }

    [[nodiscard]] std::vector<NamedTree> columns() const
    {
        if (scene_.observe) return *scene_.observe;
        std::vector<NamedTree> all;
        for (const NodeId lane : least_.full.lanes) all.push_back({graph_.input_name(lane), {}, {}});
        return all;
    }

    [[nodiscard]] Record record_of(const LeastStep& step) const
    {
        Record record = {{"rule", step.rule}, {"lane", step.lane}};
        if (step.value) record["value"] = readable(*step.value);
        if (!step.conserved.empty()) record["conserved"] = step.conserved;
        record["checks"] = Record::array({Record{{"name", step.rule}, {"indices", {step.lane}}, {"status", "proved"}}});
        record["relations"] = list_of(step.relations, [&](NodeId parameter) { return relation(parameter); });
        return record;
    }

    [[nodiscard]] std::vector<std::string> kept() const
    {
        std::vector<std::string> names;
        for (const NodeId lane : reduction_.system.lanes) names.push_back(graph_.input_name(lane));
        return names;
    }

    [[nodiscard]] Record record() const
    {
        return {
            {"model", model_.name},
            {"scene", scene_.name},
            {"states",
             {{"full", least_.full.lanes.size()}, {"least", reduction_.system.lanes.size()}, {"kept", kept()}}},
            {"watched", list_of(least_.full.watched, [](const NamedNode& each) { return each.name; })},
            {"rules", list_of(reduction_.steps, [&](const LeastStep& step) { return record_of(step); })},
            {"left_out", list_of(reduction_.left_out, [&](NodeId lane) { return graph_.input_name(lane); })},
            {"not_followed", not_followed()},
            {"rank",
             {{"value", least_.rank.rank},
              {"point", object_of(least_.rank.point, [](const PointValue& value) { return lagen::to_text(value); })}}},
            {"operations", {{"full", count_of(least_.full_operations)}, {"least", count_of(least_.least_operations)}}}};
    }

    /// Conserved functions that are tracked in a run of the whole model and are no columns here.
    [[nodiscard]] std::vector<std::string> not_followed() const
    {
        std::vector<std::string> names = distinct(reduction_.not_followed);
        std::erase_if(names, [&](const std::string& name) {
            return std::ranges::any_of(model_.fibre.momenta, [&](const Symbol& each) { return each.name == name; });
        });
        return names;
    }

    [[nodiscard]] std::string where_text(const LeastStep& step) const
    {
        return step.relations.empty()
                   ? ""
                   : ", where " + comma_list(step.relations, [&](NodeId parameter) { return relation(parameter); });
    }

    [[nodiscard]] std::string line_of(const LeastStep& step) const
    {
        if (step.rule == "constant") {
            const auto& all = reduction_.constants;
            const auto found = std::ranges::find(all, step.lane, &StartConstant::name);
            const bool known = found != all.end() && found->value;
            return fmt::format("{}{}: its rate is 0{}", step.lane, known ? " = " + readable(*found->value) : "",
                               step.relations.empty() ? ", for all parameters" : where_text(step));
        }
        if (step.rule == "own_equation")
            return fmt::format("{}'' = {}{}", step.lane, readable(*step.value), where_text(step));
        if (step.rule == "momentum")
            return fmt::format("{} by {}: {}{}", step.lane, step.conserved, readable(*step.value), where_text(step));
        if (!step.value) return fmt::format("{} moves by itself{}", step.lane, where_text(step));
        return fmt::format("{} = {}{}", step.lane, readable(*step.value), where_text(step));
    }

    [[nodiscard]] std::string text() const
    {
        const std::size_t full = least_.full.lanes.size(), count = reduction_.system.lanes.size();
        const std::string relations =
            comma_list(reduction_.prover.bound(), [&](NodeId parameter) { return relation(parameter); });
        std::string out = fmt::format("{}, scene {}: ", model_.name, scene_.name);
        out += count == full ? fmt::format("all {} states\n", full) : fmt::format("{} of {} states", count, full);
        if (count != full) out += relations.empty() ? "\n" : fmt::format(", where {}\n", relations);
        if (!relations.empty())
            out += labelled("relation", fmt::format("{} (this scene): for other values less is left out", relations));
        out += labelled("watched", comma_list(least_.full.watched, &NamedNode::name));
        if (!least_.full.obstacle.empty()) out += labelled("kept whole", least_.full.obstacle);
        std::string label;
        for (const LeastStep& step : reduction_.steps) {
            if (step.rule == "watched") continue;
            const std::string name = step.rule == "own_equation" ? "own equation" : step.rule;
            out += labelled(name == label ? "" : name, line_of(step));
            label = name;
        }
        if (!reduction_.left_out.empty()) out += labelled("left out", list_of_names(graph_, reduction_.left_out));
        if (count > 0)
            out += labelled("no fewer", least_.rank.rank == count
                                            ? fmt::format("rank {}: certified at {}", count, point_text())
                                            : fmt::format("rank {} is certified; {} states are not shown to be least",
                                                          least_.rank.rank, count));
        out += labelled("cost", fmt::format("{} -> {} operations", count_of(least_.full_operations),
                                            count_of(least_.least_operations)));
        if (const std::vector<std::string> lost = not_followed(); !lost.empty())
            out += labelled("not followed", comma_list(lost));
        return out;
    }

    [[nodiscard]] std::string point_text() const
    {
        std::string text;
        std::size_t count = 0;
        for (const auto& [name, value] : least_.rank.point) {
            if (count++ == 3) return text + ", ..";
            text += fmt::format("{}{} = {}", text.empty() ? "" : ", ", name, lagen::to_text(value));
        }
        return text;
    }

    /// What a file of first order cannot say.
    [[nodiscard]] std::string obstacle_to_writing() const
    {
        if (!least_.full.obstacle.empty()) return least_.full.obstacle;
        if (scene_.time_scale) return "it has a time scale";
        for (std::size_t i = 0; i < reduction_.system.lanes.size(); ++i)
            if (!reduction_.system.start[i])
                return fmt::format("the start of {} is no closed expression",
                                   graph_.input_name(reduction_.system.lanes[i]));
        for (const StartConstant& constant : reduction_.constants)
            if (!constant.value) return fmt::format("{} at the start is no closed expression", constant.name);
        return "";
    }

    /// Rates and what is watched as trees that share their long parts, which are definitions.
    struct Functions {
        std::vector<Tree> rates, watched, walls;
        std::vector<WhereEntry> definitions;
    };

    [[nodiscard]] Functions functions()
    {
        std::vector<NodeId> rates = simplify(graph_, reduction_.prover.with_relations(reduction_.written));
        std::map<NodeId, std::string> known;
        std::vector<NodeId> roots = rates;
        Replacements definitions = reduction_.definitions;
        std::ranges::reverse(definitions); // each over those before it
        std::vector<NodeId> values;
        for (const auto& [lane, value] : definitions) values.push_back(value);
        values = simplify(graph_, reduction_.prover.with_relations(values));
        roots.insert(roots.begin(), values.begin(), values.end());
        for (const NamedNode& each : reduction_.system.watched) roots.push_back(each.node);
        const SharedParts parts =
            shared_parts(graph_, roots, known, [&](const std::string& word) { return names_.is_taken(word); });
        Functions out;
        std::size_t next = 0;
        std::vector<WhereEntry> given;
        for (const auto& [lane, value] : definitions) given.push_back({names_[lane], parts.values[next++]});
        for (std::size_t k = 0; k < rates.size(); ++k) out.rates.push_back(names_.renamed(parts.values[next++]));
        for (std::size_t k = 0; k < reduction_.system.watched.size(); ++k)
            out.watched.push_back(names_.renamed(parts.values[next++]));
        for (const WhereEntry& each : parts.where) out.definitions.push_back({each.symbol, names_.renamed(each.value)});
        for (const WhereEntry& each : given) out.definitions.push_back({each.symbol, names_.renamed(each.value)});
        for (const NodeId wall : reduction_.system.walls) out.walls.push_back(names_.renamed(to_tree(graph_, wall)));
        return out;
    }

    [[nodiscard]] TomlValue text_of(const Tree& tree) const { return toml_string(lagen::to_text(tree)); }
    [[nodiscard]] TomlValue text_of(NodeId node) const { return text_of(names_.renamed(to_tree(graph_, node))); }
    [[nodiscard]] TomlValue over_parameters(const Tree& tree) const { return text_of(names_.renamed(tree)); }

    [[nodiscard]] std::string document(const std::string& derivation)
    {
        const Functions found = functions();
        TomlValue file;
        file.kind = TomlKind::table;
        put(file, "name", toml_string(model_.name + "_" + plain_name(scene_.name)));
        put(file, "title",
            toml_string(fmt::format("{}, what scene {} watches", model_.title.empty() ? model_.name : model_.title,
                                    scene_.name)));
        TomlValue& parameters = entry_in(file, "parameters");
        const std::vector<NodeId>& bound = reduction_.prover.bound(); // the relations: no parameters any more
        const auto is_bound = [&](NodeId parameter) { return std::ranges::find(bound, parameter) != bound.end(); };
        for (const auto& [parameter, value] : least_.full.values)
            if (!is_bound(parameter)) put(parameters, names_[parameter], text_of(value));
        for (const StartConstant& constant : reduction_.constants)
            put(parameters, names_[constant.input], text_of(*constant.value));
        TomlValue& base = entry_in(file, "base");
        std::vector<std::string> lanes, domain;
        for (const NodeId lane : reduction_.system.lanes) lanes.push_back(names_[lane]);
        const bool is_still = lanes.empty(); // a state that stands still, so that there is one
        if (is_still) lanes.emplace_back("still");
        put(base, "coordinates", toml_list(lanes));
        for (const Tree& condition : model_.base.domain)
            if (is_over_parameters(condition)) domain.push_back(lagen::to_text(names_.renamed(condition)));
        for (const Tree& wall : found.walls) domain.push_back(lagen::to_text(wall));
        if (!domain.empty()) put(base, "domain", toml_list(domain));
        put(entry_in(file, "algebroid"), "kind", toml_string("first_order"));
        for (const auto& [parameter, value] : least_.full.values)
            if (is_bound(parameter)) put(entry_in(file, "definitions"), names_[parameter], text_of(value));
        for (const WhereEntry& each : found.definitions)
            put(entry_in(file, "definitions"), each.symbol, text_of(each.value));
        name_columns(file, found);
        TomlValue& rates = entry_in(file, "rates");
        for (std::size_t k = 0; k < lanes.size(); ++k)
            put(rates, lanes[k], is_still ? toml_string("0") : text_of(found.rates[k]));
        write_scene(entry_in(entry_in(file, "scene"), scene_.name), found);
        std::string head = fmt::format("# What scene {} of {} watches, by its least model:\n#\n", scene_.name,
                                       std::filesystem::path(model_.file->name).filename().string());
        for (std::size_t at = 0; at < derivation.size();) {
            const std::size_t end = derivation.find('\n', at);
            head += "# " + derivation.substr(at, end - at) + "\n";
            at = end + 1;
        }
        return head + "\n" + print_toml(file) + "\n";
    }

    /// A column is written as what it is, and where another one is the same it has a name.
    void name_columns(TomlValue& file, const Functions& found)
    {
        const std::vector<NamedTree> all = columns();
        for (std::size_t k = 0; k < all.size(); ++k) {
            std::string text = lagen::to_text(found.watched[k]);
            if (std::ranges::find(observed_, text) != observed_.end()) {
                const auto is_free = [&](const std::string& word) {
                    return is_identifier(word) && !names_.is_taken(word) &&
                           std::ranges::find(observed_, word) == observed_.end() &&
                           std::ranges::find(found.definitions, word, &WhereEntry::symbol) == found.definitions.end();
                };
                std::string name = plain_name(all[k].name);
                for (std::size_t number = k + 1; !is_free(name); ++number) name = fmt::format("column{}", number);
                put(entry_in(file, "definitions"), name, toml_string(text));
                text = name;
            }
            observed_.push_back(std::move(text));
        }
    }

    void write_scene(TomlValue& table, const Functions& found)
    {
        TomlValue& initial = entry_in(table, "initial");
        for (std::size_t k = 0; k < reduction_.system.lanes.size(); ++k)
            put(initial, names_[reduction_.system.lanes[k]], text_of(*reduction_.system.start[k]));
        if (reduction_.system.lanes.empty()) put(initial, "still", toml_string("0"));
        const std::pair<const char*, const Tree*> numbers[] = {
            {"start", &scene_.start},         {"duration", &scene_.duration}, {"step", &scene_.step},
            {"tolerance", &scene_.tolerance}, {"relative", &scene_.relative}, {"absolute", &scene_.absolute}};
        for (const auto& [key, tree] : numbers)
            if (*tree) put(table, key, over_parameters(*tree));
        if (!scene_.method.empty()) put(table, "method", toml_string(scene_.method));
        const Sampling& sampling = scene_.sampling;
        if (sampling.kind == Sampling::Kind::interval) put(table, "sample", over_parameters(sampling.interval));
        if (sampling.kind == Sampling::Kind::event) put(table, "sample", toml_string(sampling.event));
        if (sampling.kind == Sampling::Kind::count) put(table, "samples", toml_number(sampling.count));
        if (sampling.kind == Sampling::Kind::at) {
            TomlValue times = toml_list({});
            for (const Tree& time : sampling.at) times.items.push_back(over_parameters(time));
            put(table, "at", std::move(times));
        }
        const std::size_t columns_here = columns().size();
        put(table, "observe", toml_list(observed_));
        for (std::size_t k = 0; k < scene_.events.size(); ++k)
            write_event(entry_in(entry_in(table, "events"), scene_.events[k].name), scene_.events[k],
                        found.watched[columns_here + k]);
    }

    void write_event(TomlValue& table, const Event& event, const Tree& when)
    {
        put(table, "when", text_of(when));
        const char* directions[] = {"rising", "falling", "any"};
        put(table, "direction", toml_string(directions[static_cast<std::size_t>(event.direction)]));
        if (event.stop) {
            TomlValue yes;
            yes.kind = TomlKind::boolean;
            yes.boolean = true;
            put(table, "stop", std::move(yes));
        }
        if (event.count != 1) put(table, "count", toml_number(static_cast<std::size_t>(event.count)));
        if (event.jump.empty()) return;
        const auto place = jump_of(event);
        TomlValue& jump = entry_in(table, "jump");
        for (std::size_t i = 0; i < reduction_.system.lanes.size(); ++i)
            if (const NodeId behind = reduction_.system.jumps[place][i]; behind != reduction_.system.lanes[i])
                put(jump, names_[reduction_.system.lanes[i]], text_of(behind));
    }

    /// Jumps stand in the order of the events that have them.
    [[nodiscard]] std::size_t jump_of(const Event& event) const
    {
        std::size_t place = 0;
        for (const Event& each : scene_.events) {
            if (&each == &event) return place;
            if (!each.jump.empty()) ++place;
        }
        return place;
    }

    [[nodiscard]] bool is_over_parameters(const Tree& tree) const
    {
        return std::ranges::all_of(names_in(tree), [&](const std::string& name) {
            return std::ranges::any_of(model_.parameters,
                                       [&](const Parameter& each) { return !each.bound && each.symbol.name == name; });
        });
    }

    static void put(TomlValue& table, const std::string& key, TomlValue value)
    {
        entry_in(table, key) = std::move(value);
    }

    static TomlValue toml_number(std::size_t value)
    {
        TomlValue number;
        number.kind = TomlKind::integer;
        number.text.text = std::to_string(value);
        return number;
    }

    const Model& model_;
    const Scene& scene_;
    LeastModel least_;
    Graph& graph_;
    Reduction& reduction_;
    LeastNames names_;
    std::vector<std::string> observed_; ///< the columns as the document writes them
};

} // namespace

LeastScene least_scene(const CheckedModel& checked, const Scene& scene, bool with_document)
{
    return LeastWriter(checked, scene).write(with_document);
}

LeastRun least_run(const LeastScene& least)
{
    LeastRun run;
    run.model = read_text("<least model>", least.document);
    const Scene& scene = run.model.model.scenes.at(0);
    run.scene = in_form(run.model.model, scene, form_of(run.model.model, scene));
    for (std::size_t k = 0; k < least.columns.size(); ++k) run.scene.observe->at(k).name = least.columns[k];
    return run;
}

} // namespace lagen
