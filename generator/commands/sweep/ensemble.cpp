// SPDX-License-Identifier: GPL-2.0-or-later
/// The file of --ensemble: RFC 4180, read line by line, so that it may be larger than the memory.
#include "commands/sweep/sweep_rows.hpp"
#include "model/families.hpp"
#include "model/plain_names.hpp"
#include "text/content_hash.hpp"

#include <fmt/core.h>

#include <charconv>
#include <cmath>
#include <cstring>
#include <fstream>
#include <memory>

namespace lagen {

namespace {

/// A field with the place of its text in its line.
struct CsvField {
    std::string text;
    std::size_t begin = 0, end = 0;
};

/// The fields of a line, blanks and quotes around them taken away.
std::vector<CsvField> csv_fields(const std::string& line)
{
    std::vector<CsvField> list;
    for (std::size_t at = 0; at <= line.size(); ++at) {
        CsvField field;
        while (at < line.size() && line[at] == ' ') ++at;
        field.begin = at;
        if (at < line.size() && line[at] == '"') {
            for (++at; at < line.size(); ++at) {
                if (line[at] == '"' && (at + 1 == line.size() || line[++at] != '"')) break;
                field.text += line[at];
            }
            at = std::min(line.find(',', at), line.size());
            field.end = at;
        } else {
            at = std::min(line.find(',', at), line.size());
            field.end = at;
            while (field.end > field.begin && line[field.end - 1] == ' ') --field.end;
            field.text = line.substr(field.begin, field.end - field.begin);
        }
        list.push_back(std::move(field));
    }
    return list;
}

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
        for (const SweptName& before : names)
            if (before.option == found.option && before.name == found.name)
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
