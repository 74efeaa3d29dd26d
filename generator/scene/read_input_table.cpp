// SPDX-License-Identifier: GPL-2.0-or-later
#include "scene/read_input_table.hpp"

#include "model/complaints.hpp"
#include "model/families.hpp"
#include "model/model_reader.hpp"
#include "model/plain_names.hpp"
#include "model/read_values.hpp"
#include "scene/csv_fields.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>

namespace lagen {

namespace {

/// Without a mark of UTF-8 at the beginning, and with one kind of line ends.
Excerpt plain_text(const std::string& path)
{
    std::string text = read_file(path);
    if (text.starts_with("\xEF\xBB\xBF")) text.erase(0, 3);
    std::erase(text, '\r');
    return whole_text(path, std::move(text));
}

class InputTableReader {
  public:
    InputTableReader(const Model& model, const Scene& scene)
        : symbols_(symbols_of(model, Role::input)), known_(all_names(model)), scene_(scene)
    {
        const std::string path = input_table_path(model, scene);
        try {
            text_ = plain_text(path);
        } catch (const ModelError&) {
            throw ModelError(fmt::format("the table '{}' of scene '{}' cannot be read", path, scene.name),
                             scene.input_table->where,
                             "a file of at most 16 MiB, whose path begins at the folder of the model file");
        }
    }

    std::vector<std::vector<double>> read(const SceneValues& values)
    {
        std::vector<double> row{0};
        for (const NamedNumber& input : values.inputs) row.push_back(static_cast<double>(input.second));
        std::vector<std::vector<double>> rows;
        for (std::size_t begin = 0; begin < text_.text.size();) {
            const std::size_t end = std::min(text_.text.find('\n', begin), text_.text.size());
            const Excerpt line = trimmed(text_, begin, end);
            begin = end + 1;
            if (line.text.empty()) continue;
            if (places_.empty()) {
                read_heading(line);
                continue;
            }
            read_row(line, row);
            if (rows.empty()) first_ = whole(line);
            if (!rows.empty() && !(row[0] > rows.back()[0]))
                throw ModelError(
                    fmt::format("the time {} stands behind {} in the table of inputs, where times increase", row[0],
                                rows.back()[0]),
                    place_of(line, csv_fields(line.text)[time_column_]));
            rows.push_back(row);
        }
        if (rows.empty())
            throw ModelError(fmt::format("the table '{}' of scene '{}' has no rows", text_.file->name, scene_.name),
                             scene_.input_table->where, "a heading, t,u, then rows of numbers");
        return rows;
    }

    /// Nothing is known before the first row.
    void require_begun(double first, long double from) const
    {
        if (!(from < static_cast<long double>(first))) return;
        throw ModelError(fmt::format("the table of inputs begins at t = {}, where scene '{}' needs them from t = {} on",
                                     first, scene_.name, static_cast<double>(from)),
                         first_, "give a row for its start");
    }

  private:
    static SourceRange whole(const Excerpt& text) { return text.range(0, text.text.size()); }
    static SourceRange place_of(const Excerpt& line, const CsvField& cell) { return line.range(cell.begin, cell.end); }

    [[nodiscard]] std::size_t place_of(const std::string& name) const
    {
        if (name == "t") return 0;
        return 1 + find_plain(names_of(symbols_), name, known_).value_or(symbols_.size());
    }

    void read_heading(const Excerpt& line)
    {
        bool has_time = false;
        for (const CsvField& name : csv_fields(line.text)) {
            const std::size_t place = place_of(name.text);
            if (place > symbols_.size())
                throw ModelError(
                    fmt::format("the column {} of the table of inputs is no input of the model", quote(name.text)),
                    place_of(line, name), hint_for(name.text, names_of(symbols_), "inputs"));
            if (std::ranges::find(places_, place) != places_.end())
                throw ModelError(fmt::format("the table of inputs has two columns '{}'", name.text),
                                 place_of(line, name));
            if (place == 0) has_time = true, time_column_ = places_.size();
            places_.push_back(place);
        }
        if (!has_time)
            throw ModelError("the table of inputs has no column 't'", whole(line), "its heading is t, then inputs");
    }

    void read_row(const Excerpt& line, std::vector<double>& row) const
    {
        const std::vector<CsvField> cells = csv_fields(line.text);
        if (cells.size() != places_.size())
            throw ModelError(fmt::format("a row of the table of inputs has {} cells, and its heading {}", cells.size(),
                                         places_.size()),
                             whole(line));
        for (std::size_t k = 0; k < cells.size(); ++k) {
            const std::string& text = cells[k].text;
            const char* const end = text.data() + text.size();
            double& value = row[places_[k]];
            const auto [rest, error] = std::from_chars(text.data() + (text.starts_with('+') ? 1 : 0), end, value);
            if (error != std::errc() || rest != end || !std::isfinite(value))
                throw ModelError(fmt::format("{} in the table of inputs is no finite number", quote(text)),
                                 text.empty() ? whole(line) : place_of(line, cells[k]));
        }
    }

    std::vector<Symbol> symbols_;
    std::vector<std::string> known_;
    const Scene& scene_;
    Excerpt text_;
    std::vector<std::size_t> places_; ///< of the columns: 0 of t, 1 + k of the input k
    std::size_t time_column_ = 0;
    SourceRange first_; ///< the first row
};

} // namespace

std::string input_table_path(const Model& model, const Scene& scene)
{
    const std::filesystem::path given(scene.input_table->path);
    return (std::filesystem::path(model.file->name).parent_path() / given).string();
}

std::vector<std::vector<double>> read_input_table(const Model& model, const Scene& scene, const SceneValues& values,
                                                  long double end)
{
    InputTableReader reader(model, scene);
    std::vector<std::vector<double>> rows = reader.read(values);
    reader.require_begun(rows.front()[0], std::min(values.start, end));
    return rows;
}

} // namespace lagen
