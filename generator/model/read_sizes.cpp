// SPDX-License-Identifier: GPL-2.0-or-later
/// The [sizes] block: integers by exact arithmetic, from the file or from the command line.
#include "model/model_reader.hpp"

#include "expression/parse.hpp"
#include "model/dependency_order.hpp"
#include "model/read_values.hpp"
#include "model/table_reader.hpp"

#include <fmt/format.h>

namespace lagen {

namespace {

constexpr long largest_size = 4096;
constexpr std::size_t most_bits = 256; // of what stands between

[[noreturn]] void refuse(const NamedTree& size, const std::string& found, const SourceRange& where,
                         const char* hint = "sizes are made of integers and other sizes by + - * / ^")
{
    throw ModelError(
        fmt::format("the size '{}' {}, where an integer from 0 to {} is required", size.name, found, largest_size),
        where.file ? where : size.where, hint);
}

/// Values of expressions over sizes. Parsed trees are at most 1024 levels deep, so plain recursion is safe.
class SizeArithmetic {
  public:
    SizeArithmetic(const std::map<std::string, Rational>& values, const std::vector<NamedTree>& sizes, std::size_t k)
        : values_(values), sizes_(sizes), size_(sizes[k])
    {
    }

    Rational operator()(const TreeNode& node) const
    {
        std::vector<Rational> args;
        for (const Tree& argument : node.arguments) args.push_back((*this)(*argument));
        Rational value = combine(node, args);
        const std::size_t bits = bits_of(value);
        if (bits > most_bits) refuse(size_, fmt::format("passes through a number of {} bits", bits), node.where);
        return value;
    }

  private:
    [[nodiscard]] Rational combine(const TreeNode& node, const std::vector<Rational>& args) const
    {
        Rational value = args.empty() ? Rational(0) : args[0];
        switch (node.kind) {
        case TreeKind::number: return node.number;
        case TreeKind::name: return value_of(node);
        case TreeKind::negate: return -value;
        case TreeKind::add: return sum(args);
        case TreeKind::multiply:
            for (std::size_t k = 1; k < args.size(); ++k) value *= args[k];
            return value;
        case TreeKind::divide:
            if (args[1] == 0) refuse(size_, "divides by zero", node.where);
            return value / args[1];
        case TreeKind::power: return raised(value, args[1], node);
        default: break;
        }
        refuse(size_, fmt::format("uses {}", quote(source_text(node.where))), node.where);
    }

    static Rational sum(const std::vector<Rational>& terms)
    {
        Rational value = 0;
        for (const Rational& term : terms) value += term;
        return value;
    }

    [[nodiscard]] Rational value_of(const TreeNode& node) const
    {
        const auto place = values_.find(node.name);
        if (place != values_.end()) return place->second;
        std::vector<std::string> known;
        for (const NamedTree& size : sizes_) known.push_back(size.name);
        throw ModelError(fmt::format("the size '{}' uses '{}', which is no size", size_.name, node.name), node.where,
                         hint_for(node.name, known, "sizes"));
    }

    [[nodiscard]] Rational raised(const Rational& base, const Rational& exponent, const TreeNode& node) const
    {
        constexpr long largest_exponent = 64;
        if (exponent.get_den() != 1 || exponent < 0 || exponent > largest_exponent)
            refuse(size_, fmt::format("has the exponent {}", exponent.get_str()), node.where);
        Rational value = 1;
        for (long k = exponent.get_num().get_si(); k > 0; --k) value *= base;
        return value;
    }

    const std::map<std::string, Rational>& values_; ///< of all sizes that it may use
    const std::vector<NamedTree>& sizes_;
    const NamedTree& size_; ///< whose value is made
};

} // namespace

void read_sizes(ModelReader& reader, const TomlEntry* block, const std::vector<Setting>& settings)
{
    if (block == nullptr) return;
    const TableReader table(block->value, "[sizes]");
    std::vector<NamedTree> sizes;
    for (const TomlEntry& entry : block->value.entries) {
        reader.names.declare(entry.name(), Role::size, entry.where());
        Tree value = read_expression(entry.value, fmt::format("the size '{}'", entry.name()));
        for (const Setting& setting : settings)
            if (setting.name == entry.name() && setting.gives_value()) value = parse_expression(setting.value);
        sizes.push_back(NamedTree{entry.name(), std::move(value), entry.where()});
    }
    std::map<std::string, Rational> values;
    for (const std::size_t k : dependency_order(sizes, "sizes")) {
        const NamedTree& size = sizes[k];
        const Rational value = SizeArithmetic(values, sizes, k)(*size.value);
        if (value.get_den() != 1 || value < 0 || value > largest_size)
            refuse(size, fmt::format("is {}", value.get_str()), size.value->where, "");
        values.emplace(size.name, value);
    }
    for (const NamedTree& size : sizes) {
        const long value = values.at(size.name).get_num().get_si();
        reader.model.sizes.push_back(Size{size.name, value, size.where});
        reader.model.scope.declare_size(size.name, value, size.where);
    }
}

} // namespace lagen
