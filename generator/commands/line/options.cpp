// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/line/options.hpp"

#include "emit/print_literal.hpp"
#include "expression/parse.hpp"
#include "machine/write_file.hpp"
#include "model/families.hpp"
#include "scene/read_input_table.hpp"
#include "text/comma_list.hpp"

#include <boost/program_options.hpp>
#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>

namespace lagen {

namespace {

namespace po = boost::program_options;

std::string long_name(const OptionEntry& entry)
{
    const std::string name = entry.name;
    return name.substr(0, name.find(','));
}

po::options_description describe(const CommandSyntax& syntax)
{
    po::options_description description("options", 110);
    for (const OptionEntry& entry : syntax.options) {
        std::string help = entry.help;
        if (entry.standard != nullptr) help += fmt::format(" [{}]", entry.standard);
        if (entry.value == nullptr) {
            description.add_options()(entry.name, help.c_str());
        } else {
            description.add_options()(
                entry.name, po::value<std::vector<std::string>>()->value_name(entry.value)->composing(), help.c_str());
        }
    }
    description.add_options()("help,h", "print this text");
    return description;
}

void print_help(const CommandSyntax& syntax, const po::options_description& description)
{
    std::ostringstream text;
    text << description;
    const std::string arguments = *syntax.positional == '\0' ? "" : std::string(" ") + syntax.positional;
    write_standard_output(
        fmt::format("usage: lagen {}{} [options]\n\n{}\n\n{}", syntax.command, arguments, syntax.purpose, text.str()));
}

void check_positional(const CommandSyntax& syntax, const std::vector<std::string>& positional)
{
    const std::string shape = syntax.positional;
    const bool several = shape.ends_with("...");
    const std::size_t least = shape.empty() ? 0 : 1;
    if (positional.size() < least)
        throw UsageError(fmt::format("{} is missing (see lagen {} --help)", shape, syntax.command));
    if (positional.size() > least && !several) {
        throw UsageError(
            fmt::format("unexpected argument '{}' (see lagen {} --help)", positional[least], syntax.command));
    }
}

/// UsageError where one of the files `read` is to be written.
void require_other_files(const Options& options, const std::vector<std::string>& read)
{
    std::error_code ignored; // a file that is not there is no other one
    for (const char* written : {"output", "plot", "depfile"})
        for (const std::string& file : read)
            if (options.has(written) && std::filesystem::equivalent(options.get(written), file, ignored))
                throw UsageError(
                    fmt::format("'{}' is read, and cannot be --{} as well", options.get(written), written));
}

void require_parameters(const Model& model, const std::string& name, const Excerpt& text,
                        const std::vector<Tree>& trees)
{
    for (const Tree& tree : trees)
        for (const std::string& used : names_in(tree))
            if (std::ranges::none_of(model.parameters, [&](const Parameter& each) { return each.symbol.name == used; }))
                throw ModelError(fmt::format("--{} depends on '{}', which is no parameter", name, used),
                                 text.range(0, text.text.size()), "give numbers, or expressions of parameters");
}

/// "on", or "to 9".
std::string up_to(std::uint64_t most)
{
    return most == UINT64_MAX ? "on" : fmt::format("to {}", most);
}

Rational end_of_range(const Model& model, const std::string& option, const Excerpt& text)
{
    const Tree tree = option_tree(model, option, text);
    const SourceRange where = text.range(0, text.text.size());
    if (!names_in(tree).empty())
        throw ModelError(fmt::format("a range of --{} ends at an expression of '{}', where a number is required",
                                     option, names_in(tree).front()),
                         where);
    const std::optional<Rational> exact = exact_value(tree);
    const double value = exact ? nearest_double(*exact) : static_cast<double>(TreeValues()(tree, {}));
    if (!std::isfinite(value))
        throw ModelError(fmt::format("a range of --{} ends at {}, where a finite number is required", option, value),
                         where);
    return exact.value_or(Rational(value));
}

} // namespace

Options::Options(const CommandSyntax& syntax, std::span<const std::string> arguments) : command_(syntax.command)
{
    const po::options_description description = describe(syntax);
    po::options_description everything;
    everything.add(description).add_options()("positional", po::value<std::vector<std::string>>()->composing());
    po::positional_options_description order;
    order.add("positional", -1);
    po::variables_map map;
    try {
        const int style = po::command_line_style::unix_style & ~po::command_line_style::allow_guessing;
        const std::vector<std::string> words(arguments.begin(), arguments.end());
        const po::parsed_options parsed =
            po::command_line_parser(words).options(everything).positional(order).style(style).run();
        for (const po::option& option : parsed.options)
            if (option.position_key < 0)
                given_.emplace_back(option.string_key, option.value.empty() ? "" : option.value[0]);
        po::store(parsed, map);
    } catch (const po::unknown_option& error) {
        std::vector<std::string> known;
        for (const OptionEntry& entry : syntax.options) known.push_back("--" + long_name(entry));
        const std::string nearest = nearest_name(error.get_option_name(), known);
        throw UsageError(fmt::format("unknown option '{}'{} (see lagen {} --help)", error.get_option_name(),
                                     nearest.empty() ? "" : fmt::format(", did you mean '{}'?", nearest), command_));
    } catch (const po::error& error) {
        throw UsageError(fmt::format("{} (see lagen {} --help)", error.what(), command_));
    }
    if (map.count("help") > 0) {
        print_help(syntax, description);
        help_ = true;
        return;
    }
    for (const OptionEntry& entry : syntax.options) {
        const std::string name = long_name(entry);
        if (entry.standard != nullptr) standards_[name] = entry.standard;
        if (map.count(name) == 0) continue;
        values_[name] = entry.value == nullptr ? std::vector<std::string>{} : map[name].as<std::vector<std::string>>();
    }
    if (map.count("positional") > 0) positional_ = map["positional"].as<std::vector<std::string>>();
    check_positional(syntax, positional_);
}

std::string Options::get(const std::string& name) const
{
    const auto found = values_.find(name);
    if (found != values_.end() && !found->second.empty()) return found->second.back();
    const auto standard = standards_.find(name);
    return standard == standards_.end() ? std::string() : standard->second;
}

std::vector<std::string> Options::all(const std::string& name) const
{
    const auto found = values_.find(name);
    return found == values_.end() ? std::vector<std::string>{} : found->second;
}

std::string Options::choice(const std::string& name, const std::vector<std::string>& allowed) const
{
    const std::string value = get(name);
    if (std::find(allowed.begin(), allowed.end(), value) != allowed.end()) return value;
    const std::string nearest = nearest_name(value, allowed);
    throw UsageError(fmt::format("--{} is '{}', it must be one of {}{}", name, value, comma_list(allowed),
                                 nearest.empty() ? "" : fmt::format("; did you mean '{}'?", nearest)));
}

/// "I1=2" or "m".
Setting Options::binding_of(const std::string& entry) const
{
    const std::size_t equals = entry.find('=');
    std::string name = entry.substr(0, equals);
    name.erase(name.find_last_not_of(' ') + 1);
    if (name.empty() || equals + 1 == entry.size())
        throw UsageError(fmt::format("--bind needs names or name=value, found '{}'", entry));
    if (equals == std::string::npos) return {name, {}, true};
    return {name, whole_text("<--bind " + name + ">", entry.substr(equals + 1)), true};
}

void Options::add_bindings(std::vector<Setting>& settings) const
{
    std::vector<Setting> bindings;
    for (const std::string& text : all("bind"))
        for (const std::string& entry : split_list(text)) bindings.push_back(binding_of(entry));
    for (const Setting& set : settings)
        for (const Setting& bound : bindings)
            if (bound.gives_value() && (names_entry(bound.name, set.name) || names_entry(set.name, bound.name)))
                throw UsageError(fmt::format("--set gives '{}' the value {} and --bind gives '{}' the value {}",
                                             set.name, set.value.text, bound.name, bound.value.text),
                                 fmt::format("--bind {} takes the value of --set", bound.name));
    settings.insert(settings.end(), bindings.begin(), bindings.end());
}

std::vector<Setting> Options::settings() const
{
    std::vector<Setting> settings = named("set");
    add_bindings(settings);
    return settings;
}

std::vector<Setting> Options::named(const std::string& option) const
{
    std::vector<Setting> settings;
    for (const std::string& text : all(option)) settings.push_back(read_setting(option, text));
    return settings;
}

Setting read_setting(const std::string& option, const std::string& text)
{
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos || equals == 0)
        throw UsageError(fmt::format("--{} needs name=value, found '{}'", option, text));
    const std::string name = text.substr(0, text.find_last_not_of(' ', equals - 1) + 1);
    const std::size_t value = std::min(text.find_first_not_of(' ', equals + 1), text.size());
    return {name, whole_text(fmt::format("<--{} {}>", option, name), text.substr(value))};
}

std::vector<std::string> split_list(const std::string& text)
{
    std::vector<std::string> entries(1);
    int depth = 0;
    for (const char c : text) {
        depth += c == '(' || c == '[' ? 1 : c == ')' || c == ']' ? -1 : 0;
        if (c == ',' && depth == 0) {
            entries.emplace_back();
        } else if (c != ' ' || !entries.back().empty()) {
            entries.back() += c;
        }
    }
    for (std::string& entry : entries) entry.erase(entry.find_last_not_of(' ') + 1);
    if (entries.size() == 1 && entries[0].empty()) entries.clear();
    return entries;
}

void require_apart(const Options& options, const Model& model, std::initializer_list<const char*> also)
{
    std::vector<std::string> read{model.file->name};
    for (const auto& file : model.included) read.push_back(file->name);
    for (const Scene& scene : model.scenes)
        if (scene.input_table) read.push_back(input_table_path(model, scene));
    for (const char* name : also)
        if (options.has(name)) read.push_back(options.get(name));
    require_other_files(options, read);
}

void require_apart(const Options& options, const MorphismFile& morphism)
{
    require_other_files(options, {morphism.file->name});
    for (const MorphismFile& stage : morphism.stages) require_apart(options, stage);
    if (!morphism.stages.empty()) return;
    require_apart(options, morphism.source);
    require_apart(options, morphism.target);
}

ArrayValue option_array(const Model& model, const std::string& name, const Excerpt& text)
{
    ArrayValue value = model.scope.close_array(parse_expression(text));
    require_parameters(model, name, text, value.entries);
    return value;
}

Tree option_tree(const Model& model, const std::string& name, const Excerpt& text)
{
    const Tree tree = model.scope.close(parse_expression(text));
    require_parameters(model, name, text, {tree});
    return tree;
}

double GridAxis::at(std::uint64_t place) const
{
    Rational part(place, std::max<std::uint64_t>(count - 1, 1));
    part.canonicalize();
    return nearest_double(first + (last - first) * part);
}

void RangeText::refuse(const std::string& what) const
{
    throw UsageError(fmt::format("--{} {}: {}", option, text, what));
}

RangeText range_of(const std::string& option, const Excerpt& range, const std::string& text)
{
    RangeText out{option, text, {}};
    for (std::size_t begin = 0, end = 0; end != std::string::npos; begin = end + 1) {
        end = range.text.find(':', begin);
        out.parts.push_back(trimmed(range, begin, std::min(end, range.text.size())));
    }
    return out;
}

GridAxis axis_of(const RangeText& range, const Model& model, std::uint64_t most)
{
    GridAxis axis{end_of_range(model, range.option, range.parts[0]), end_of_range(model, range.option, range.parts[1]),
                  0};
    if (range.parts.size() < 3) return axis;
    const std::string& text = range.parts[2].text;
    const std::optional<std::uint64_t> count = read_whole(text);
    if (!count || *count == 0 || *count > most)
        range.refuse(
            fmt::format("the number of points is '{}', where a whole number from 1 {} is required", text, up_to(most)));
    axis.count = *count;
    return axis;
}

std::optional<std::uint64_t> read_whole(const std::string& text)
{
    constexpr std::size_t most_digits = 18;
    std::uint64_t value = 0;
    const char* end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, value);
    if (error != std::errc() || stop != end || text.size() > most_digits) return std::nullopt;
    return value;
}

std::uint64_t whole_option(const Options& options, const std::string& name, std::uint64_t least, std::uint64_t most)
{
    const std::optional<std::uint64_t> value = read_whole(options.get(name));
    if (value && *value >= least && *value <= most) return *value;
    throw UsageError(fmt::format("--{} is '{}', where a whole number from {} {} is required", name, options.get(name),
                                 least, up_to(most)));
}

} // namespace lagen
