// SPDX-License-Identifier: GPL-2.0-or-later
/// What equations by vectors and by indices say in numbers.
#pragma once

#include "equations/printed_value.hpp"
#include "support/dice.hpp"

#include <catch2/catch.hpp>

#include <algorithm>

namespace lagen {

/// A scalar, a vector of 3 or a matrix of 9 by rows.
using WrittenValue = std::vector<long double>;
using Letters = std::map<std::string, std::size_t>; ///< the values of indices

/// What written equations say where the names have these values; rates are values of names with a mark.
class WrittenMeaning {
  public:
    explicit WrittenMeaning(const EquationSet& set) : set_(set)
    {
        const auto take = [&](const std::string& name) {
            if (!values_.contains(name))
                values_.emplace(name, static_cast<long double>(dice_.below(9001) + 500) / 10000);
        };
        for (const auto* blocks : {&set.given, &set.blocks})
            for (const EquationBlock& block : *blocks)
                for (const Equation& equation : block.equations) {
                    take("'" + equation.symbol);
                    for (const TermGroup& entry : equation.mass) take("'" + entry.label);
                    for (const auto* list : {&equation.mass, &equation.groups})
                        for (const TermGroup& entry : *list)
                            for (const std::string& name : names_in(entry.value)) take(name);
                }
        for (const WhereEntry& entry : set.where) {
            if (entry.value->kind == TreeKind::number) values_[entry.symbol] = entry.value->number.get_d();
            take(entry.symbol);
            take("'" + entry.symbol);
            for (const std::string& name : names_in(entry.value)) take(name);
        }
    }

    /// The left side minus the right one for all that the equations stand for, one after the other.
    std::vector<long double> values(const std::vector<Equation>& equations)
    {
        std::vector<long double> result;
        for (const Equation& equation : equations) append(equation, {}, result);
        return result;
    }

  private:
    void append(const Equation& equation, const Letters& letters, std::vector<long double>& result)
    {
        if (letters.size() < equation.ranges.size()) {
            const IndexRange& range = equation.ranges[letters.size()];
            for (std::size_t index = range.from; index <= range.to; ++index) {
                Letters next = letters;
                next[range.letter] = index;
                append(equation, next, result);
            }
            return;
        }
        WrittenValue sum = equation.mass.empty() ? named("'" + equation.symbol, letters) : WrittenValue{};
        for (const TermGroup& entry : equation.mass)
            add(sum,
                entry.label.empty() ? value(entry.value, letters)
                                    : product(value(entry.value, letters), named("'" + entry.label, letters)),
                1);
        for (const TermGroup& group : equation.groups) add(sum, value(group.value, letters), -1);
        result.insert(result.end(), sum.begin(), sum.end());
    }

    static void add(WrittenValue& sum, const WrittenValue& term, long double factor)
    {
        if (term.empty()) return; // a sum without terms
        if (sum.empty()) sum.assign(term.size(), 0);
        REQUIRE(sum.size() == term.size());
        for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += factor * term[k];
    }

    static WrittenValue product(const WrittenValue& a, const WrittenValue& b)
    {
        if (a.empty() || b.empty()) return {};
        if (a.size() == 9 && b.size() == 3) {
            WrittenValue result(3, 0);
            for (std::size_t k = 0; k < 9; ++k) result[k / 3] += a[k] * b[k % 3];
            return result;
        }
        REQUIRE((a.size() == 1 || b.size() == 1));
        WrittenValue result = a.size() == 1 ? b : a;
        for (long double& each : result) each *= a.size() == 1 ? a[0] : b[0];
        return result;
    }

    /// The name with indices for letters: a[i+1] at i = 2 is a[3].
    static std::string at(const std::string& name, const Letters& letters)
    {
        std::string result, index;
        bool inside = false;
        for (const char c : name) {
            const bool ends = inside && (c == ',' || c == ']');
            if (ends) {
                const std::size_t sign = index.find_first_of("+-");
                if (const auto letter = letters.find(index.substr(0, sign)); letter != letters.end()) {
                    const long offset = sign == std::string::npos ? 0 : std::stol(index.substr(sign));
                    index = std::to_string(static_cast<long>(letter->second) + offset);
                }
                result += std::exchange(index, {});
            }
            (inside && !ends ? index : result) += c;
            inside = c == '[' || (inside && c != ']');
        }
        return result;
    }

    WrittenValue named(const std::string& written, const Letters& letters)
    {
        const std::string name = at(written, letters);
        if (const auto known = values_.find(name); known != values_.end()) return {known->second};
        const bool rate = name.starts_with('\'');
        const auto vector = std::ranges::find(set_.vectors, name.substr(rate ? 1 : 0), &VectorText::name);
        WrittenValue result;
        if (vector != set_.vectors.end()) {
            for (std::size_t k = 0; k < 3; ++k) {
                const Tree& entry = vector->entries[k];
                const long double value = entry->kind == TreeKind::number ? entry->number.get_d()
                                                                          : values_.at((rate ? "'" : "") + entry->name);
                if (vector->diagonal) result.resize(9, 0);
                vector->diagonal ? void(result[4 * k] = value) : result.push_back(value);
            }
            return result;
        }
        if (name.ends_with("ᵀ")) {
            const WrittenValue matrix = named(name.substr(0, name.find("ᵀ")), letters);
            for (std::size_t k = 0; k < 9; ++k) result.push_back(matrix[k % 3 * 3 + k / 3]);
        } else if (name.ends_with(":]"))
            for (std::size_t k = 1; k <= 3; ++k)
                result.push_back(values_.at(name.substr(0, name.size() - 2) + std::to_string(k) + "]"));
        else if (values_.contains(name + "[1]"))
            for (std::size_t k = 1; k <= 3; ++k) result.push_back(values_.at(name + "[" + std::to_string(k) + "]"));
        else
            for (std::size_t k = 0; k < 9; ++k)
                result.push_back(
                    values_.at(name + "[" + std::to_string(k / 3 + 1) + "," + std::to_string(k % 3 + 1) + "]"));
        return result;
    }

    /// Of a bound of a sum: a number, a letter with an offset, the greater one of two.
    static long bound(const std::string& text, const Letters& letters)
    {
        if (const std::size_t comma = text.find(','); comma != std::string::npos) // max(i,j)
            return std::max(bound(text.substr(4, comma - 4), letters),
                            bound(text.substr(comma + 1, text.size() - comma - 2), letters));
        const std::size_t sign = text.find_first_of("+-");
        const auto letter = letters.find(text.substr(0, sign));
        if (letter == letters.end()) return std::stol(text);
        return static_cast<long>(letter->second) + (sign == std::string::npos ? 0 : std::stol(text.substr(sign)));
    }

    WrittenValue indexed_sum(const Tree& tree, const Letters& letters)
    {
        REQUIRE_FALSE(letters.contains(tree->name));
        const std::vector<Tree>& parts = tree->arguments;
        WrittenValue sum;
        for (long index = bound(parts[0]->name, letters); index <= bound(parts[1]->name, letters); ++index) {
            if (parts.size() > 3 && index == bound(parts[3]->name, letters)) continue;
            Letters inner = letters;
            inner[tree->name] = static_cast<std::size_t>(index);
            add(sum, value(parts[2], inner), 1);
        }
        return sum;
    }

    WrittenValue value(const Tree& tree, const Letters& letters)
    {
        if (tree->kind == TreeKind::sum_over) return indexed_sum(tree, letters);
        std::vector<WrittenValue> arguments;
        for (const Tree& argument : tree->arguments) arguments.push_back(value(argument, letters));
        switch (tree->kind) {
        case TreeKind::name: return named(tree->name, letters);
        case TreeKind::negate: return product({-1}, arguments[0]);
        case TreeKind::add: {
            WrittenValue sum;
            for (const WrittenValue& each : arguments) add(sum, each, 1);
            return sum;
        }
        case TreeKind::multiply: { // from the right: M v is a vector
            WrittenValue result = arguments.back();
            for (std::size_t k = arguments.size() - 1; k-- > 0;) result = product(arguments[k], result);
            return result;
        }
        case TreeKind::apply: {
            const WrittenValue &a = arguments[0], &b = arguments[1];
            REQUIRE((a.size() == 3 && b.size() == 3));
            if (tree->name == "dot") return {a[0] * b[0] + a[1] * b[1] + a[2] * b[2]};
            return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
        }
        case TreeKind::divide: return product({1 / arguments[1].at(0)}, arguments[0]);
        default: break;
        }
        for (WrittenValue& argument : arguments)
            if (argument.empty()) argument = {0};
        TreeNode node = *tree; // a function of scalars
        for (std::size_t k = 0; k < arguments.size(); ++k)
            if (node.arguments[k]->kind != TreeKind::number) node.arguments[k] = name("argument" + std::to_string(k));
        std::map<std::string, long double> scalars;
        for (std::size_t k = 0; k < arguments.size(); ++k) scalars["argument" + std::to_string(k)] = arguments[k].at(0);
        return {
            value_of({LeftSide::symbol, "", {}, {{"", std::make_shared<const TreeNode>(std::move(node))}}}, scalars)};
    }

    const EquationSet& set_;
    testing::Dice dice_{20261126};
    std::map<std::string, long double> values_;
};

} // namespace lagen
