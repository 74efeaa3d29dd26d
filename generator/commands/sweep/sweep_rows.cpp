// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/sweep/sweep_rows.hpp"

#include "commands/line/scene_options.hpp"
#include "emit/print_literal.hpp"
#include "machine/philox.hpp"
#include "model/families.hpp"
#include "model/plain_names.hpp"
#include "scene/csv_fields.hpp"
#include "text/content_hash.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <fstream>
#include <memory>

namespace lagen {

namespace {

constexpr std::uint64_t most_sweep_rows = 1'000'000'000'000'000;

/// True where the value of a parameter follows from that of another one.
bool follows_from(const Model& model, const Parameter& parameter, const std::string& name)
{
    return std::ranges::any_of(model.parameters, [&](const Parameter& each) {
        return mentions(parameter.value, each.symbol.name) &&
               (each.symbol.name == name || follows_from(model, each, name));
    });
}

/// The name as the model has it.
SweptName swept_name(const SweepRequest::Range& range, const Model& model, const Scene& scene)
{
    for (const Size& size : model.sizes)
        if (range.option == "set" && size.name == range.name)
            range.refuse(fmt::format("'{}' is a size, and each of its values makes another model", range.name));
    for (const Parameter& parameter : model.parameters)
        if (range.option == "set" && parameter.bound && names_entry(range.name, parameter.symbol.name))
            range.refuse(fmt::format("'{}' is bound", parameter.symbol.name));
    return resolved({range.option, range.name}, model, scene, "to sweep",
                    whole_text(fmt::format("<--{}>", range.option), range.text).range(0, range.name.size()));
}

/// Points of a grid, the last axis fastest; the value of an axis is computed where it changes.
SweepRows grid_rows(std::vector<SweptName> names, std::vector<GridAxis> axes)
{
    SweepRows rows{std::move(names), 1, "grid", {}};
    for (const GridAxis& axis : axes) {
        if (axis.count > most_sweep_rows / rows.count) throw UsageError("the grid has more than 1e15 points");
        rows.count *= axis.count;
    }
    std::vector<std::uint64_t> at(axes.size(), most_sweep_rows);
    std::vector<double> values(axes.size());
    rows.values = [axes = std::move(axes), at, values](std::uint64_t index) mutable {
        for (std::size_t k = axes.size(); k-- > 0; index /= axes[k].count) {
            const std::uint64_t place = index % axes[k].count;
            if (at[k] == place) continue;
            at[k] = place;
            values[k] = axes[k].at(place);
        }
        return values;
    };
    return rows;
}

/// Draws that are uniform in each range, first end included.
SweepRows random_rows(std::vector<SweptName> names, const std::vector<GridAxis>& axes, std::uint64_t count,
                      std::uint64_t seed)
{
    SweepRows rows{std::move(names), count, fmt::format("random {}", seed), {}};
    std::vector<std::pair<double, double>> ends;
    for (const GridAxis& axis : axes) ends.emplace_back(nearest_double(axis.first), nearest_double(axis.last));
    rows.values = [ends = std::move(ends), seed](std::uint64_t index) {
        std::vector<double> values;
        for (std::uint32_t k = 0; k < ends.size(); ++k) {
            const double part = uniform_number(seed, index, k);
            values.push_back(std::fma(part, ends[k].second, std::fma(-part, ends[k].first, ends[k].first)));
        }
        return values;
    };
    return rows;
}

// The file of --ensemble: RFC 4180, read line by line, so that it may be larger than the memory.

/// Lines one after the other; their ends, a mark of UTF-8 at the beginning and empty lines are left out.
class EnsembleFile {
  public:
    explicit EnsembleFile(const std::string& path) : path_(path), file_(path, std::ios::binary)
    {
        if (!file_ || file_.peek() == std::ifstream::traits_type::eof())
            throw UsageError(fmt::format("the ensemble '{}' is no file that can be read, or empty", path));
    }

    [[nodiscard]] bool next()
    {
        while (std::getline(file_, line_)) {
            if (++number_ == 1 && line_.starts_with("\xEF\xBB\xBF")) line_.erase(0, 3);
            if (line_.ends_with('\r')) line_.pop_back();
            if (line_.find_first_not_of(' ') != std::string::npos) return true;
        }
        return false;
    }
    [[nodiscard]] const std::string& line() const { return line_; }

    [[noreturn]] void refuse_line(const std::string& message, std::size_t begin, std::size_t end,
                                  const std::string& hint = {}) const
    {
        const std::string before(number_ - 1, '\n');
        const Excerpt text = whole_text(path_, before + line_);
        throw ModelError(message, text.range(before.size() + begin, before.size() + end), hint);
    }

  private:
    std::string path_;
    std::ifstream file_;
    std::string line_;
    std::size_t number_ = 0;
};

/// What a column of the heading names, with the option in front or without; nothing where it names nothing.
SweptName headed_name(const std::string& text, const Model& model, const Scene& scene,
                      const std::vector<std::string>& known)
{
    for (const bool exact : {true, false})
        for (const std::string option : {"set", "initial"}) {
            const std::vector<Symbol> symbols = swept_symbols(option, model, scene);
            const std::string name = text.starts_with(option + ".") ? text.substr(option.size() + 1) : text;
            const std::optional<ResolvedKey> key = exact ? resolve_key(symbols, name) : std::nullopt;
            if (key && key->shape.rank == Rank::scalar) return {option, key->name};
            const auto place = exact ? std::nullopt : find_plain(names_of(symbols), name, known);
            if (place) return {option, symbols[*place].name};
        }
    return {};
}

/// What the heading names.
std::vector<SweptName> headed_names(const EnsembleFile& file, const Model& model, const Scene& scene)
{
    std::vector<SweptName> names;
    std::vector<std::string> known;
    for (const char* option : {"set", "initial"})
        for (const Symbol& symbol : swept_symbols(option, model, scene)) known.push_back(symbol.name);
    const std::vector<std::string> all = all_names(model);
    for (const CsvField& field : csv_fields(file.line())) {
        SweptName found = headed_name(field.text, model, scene, all);
        if (found.name.empty()) {
            const std::string nearest = nearest_name(field.text, known);
            file.refuse_line(fmt::format("the column '{}' is neither a parameter of the model nor an initial value of "
                                         "scene '{}'",
                                         field.text, scene.name),
                             field.begin, field.end, nearest.empty() ? "" : fmt::format("did you mean '{}'?", nearest));
        }
        if (std::ranges::find(names, found) != names.end())
            file.refuse_line(fmt::format("the column '{}' stands there twice", field.text), field.begin, field.end);
        names.push_back(std::move(found));
    }
    return names;
}

/// The numbers of row `row`.
std::vector<double> row_numbers(const EnsembleFile& file, const std::vector<SweptName>& names, std::uint64_t row)
{
    const std::vector<CsvField> fields = csv_fields(file.line());
    if (fields.size() != names.size())
        file.refuse_line(
            fmt::format("row {} has {} fields, where the heading has {}", row, fields.size(), names.size()), 0,
            file.line().size());
    std::vector<double> values;
    for (std::size_t k = 0; k < fields.size(); ++k) {
        const std::string& text = fields[k].text;
        double value = 0;
        const char* end = text.data() + text.size();
        const auto [stop, error] = std::from_chars(text.data(), end, value);
        if (error != std::errc() || stop != end || !std::isfinite(value))
            file.refuse_line(fmt::format("row {} holds '{}' in column '{}', where a finite number is required", row,
                                         text, names[k].name),
                             fields[k].begin, fields[k].end);
        values.push_back(value);
    }
    return values;
}

} // namespace

void require_constants(const Model& model, const SweepRows& rows)
{
    for (const Parameter& parameter : model.parameters)
        for (const SweptName& name : rows.names)
            if (parameter.bound && name.option == "set" && follows_from(model, parameter, name.name))
                throw UsageError(fmt::format("'{}' is bound, and its value follows from '{}', which is swept",
                                             parameter.symbol.name, name.name));
}

SweepRequest::SweepRequest(const Options& options)
{
    const bool random = options.has("random"), ensemble = options.has("ensemble");
    if (random && ensemble) throw UsageError("--random and --ensemble exclude each other");
    if (options.has("seed") && !random) throw UsageError("--seed needs --random");
    for (const auto& [option, text] : options.given()) {
        if (option != "set" && option != "initial") continue;
        Setting setting = read_setting(option, text);
        Range range{range_of(option, setting.value, text), setting.name};
        if (range.parts.size() == 1) {
            (option == "set" ? settings : initial).push_back(std::move(setting));
            continue;
        }
        if (ensemble) range.refuse("the values of an ensemble stand in its file");
        if (range.parts.size() != (random ? 2U : 3U))
            range.refuse(random ? "with --random a range is FIRST:LAST" : "a range is FIRST:LAST:COUNT");
        ranges.push_back(std::move(range));
    }
    options.add_bindings(settings);
    if (ranges.empty() && !ensemble)
        throw UsageError("nothing is swept: give ranges (--set a=0:2:101, --initial x=-1:1:21), with --random N or "
                         "without, or --ensemble FILE.csv");
}

SweepRows sweep_rows(const Options& options, const SweepRequest& request, const Model& model, const Scene& scene)
{
    if (options.has("ensemble")) return ensemble_rows(options.get("ensemble"), model, scene);
    std::vector<SweptName> names;
    std::vector<GridAxis> axes;
    for (const SweepRequest::Range& range : request.ranges) {
        const SweptName name = swept_name(range, model, scene);
        if (std::ranges::find(names, name) != names.end()) range.refuse("it is swept twice");
        names.push_back(name);
        axes.push_back(axis_of(range, model));
    }
    SweepRows rows = options.has("random") ? random_rows(std::move(names), axes, whole_option(options, "random", 1),
                                                         options.has("seed") ? whole_option(options, "seed", 0) : 0)
                                           : grid_rows(std::move(names), std::move(axes));
    for (const SweepRequest::Range& range : request.ranges)
        rows.text += fmt::format("\n{} {}", range.option, range.text);
    rows.text += fmt::format("\n{} rows", rows.count);
    return rows;
}

SweepRows ensemble_rows(const std::string& path, const Model& model, const Scene& scene)
{
    EnsembleFile file(path);
    if (!file.next()) throw UsageError(fmt::format("the ensemble '{}' has no heading", path));
    SweepRows rows{headed_names(file, model, scene), 0, "", {}};
    ContentHash hash;
    hash.add(file.line());
    for (; file.next(); ++rows.count) {
        (void)row_numbers(file, rows.names, rows.count);
        hash.add(file.line());
    }
    if (rows.count == 0) throw UsageError(fmt::format("the ensemble '{}' has no rows", path));
    rows.text = "ensemble " + hash.hex32();
    const auto again = std::make_shared<EnsembleFile>(path);
    (void)again->next();
    rows.values = [again, names = rows.names, at = std::uint64_t{0}](std::uint64_t index) mutable {
        bool more = true;
        for (; at <= index && more; ++at) more = again->next();
        if (!more) again->refuse_line("the ensemble has become shorter meanwhile", 0, 0);
        return row_numbers(*again, names, index);
    };
    return rows;
}

} // namespace lagen
