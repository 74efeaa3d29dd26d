// SPDX-License-Identifier: GPL-2.0-or-later
/// The [sizes] block by exact arithmetic; parameter values, settings from the command line, and the base's constraints,
/// Casimirs and domain.
#include "expression/find_part.hpp"
#include "expression/parse.hpp"
#include "model/complaints.hpp"
#include "model/families.hpp"
#include "model/model_reader.hpp"
#include "model/read_values.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <functional>
#include <numeric>
#include <unordered_map>

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
        case TreeKind::add: return std::accumulate(args.begin(), args.end(), Rational(0));
        case TreeKind::multiply: return std::accumulate(args.begin(), args.end(), Rational(1), std::multiplies<>());
        case TreeKind::divide:
            if (args[1] == 0) refuse(size_, "divides by zero", node.where);
            return value / args[1];
        case TreeKind::power: return raised(value, args[1], node);
        default: break;
        }
        refuse(size_, fmt::format("uses {}", quote(source_text(node.where))), node.where);
    }

    [[nodiscard]] Rational value_of(const TreeNode& node) const
    {
        const auto place = values_.find(node.name);
        if (place != values_.end()) return place->second;
        std::vector<std::string> known;
        for (const NamedTree& size : sizes_) known.push_back(size.name);
        throw complain::names_no(fmt::format("the size '{}'", size_.name), node.name, "size", node.where,
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

std::string input_hint(const std::string& name)
{
    return fmt::format("a scene says what an input is: inputs = {{ {} = \"..\" }}", name);
}

void apply(ModelReader& reader, const std::vector<Symbol>& symbols, const Setting& setting)
{
    if (const std::optional<ResolvedKey> key = resolve_key(symbols, key_of(reader, setting))) {
        const std::string what = fmt::format("the value set for parameter '{}'", key->name);
        std::vector<Tree> values;
        if (setting.gives_value())
            values = fit_values(reader.close(parse_expression(setting.value), Role::parameter, what), key->shape, what,
                                place_of(setting.value));
        for (std::size_t k = 0; k < key->indices.size(); ++k) {
            Parameter& parameter = reader.model.parameters[key->indices[k]];
            if (!values.empty()) parameter.value = values[k];
            parameter.bound |= setting.binds;
        }
        return;
    }
    const Names::Entry* entry = reader.names.find(setting.name);
    std::vector<std::string> known = reader.names.of(Role::parameter);
    const std::vector<std::string> sizes = reader.names.of(Role::size);
    known.insert(known.end(), sizes.begin(), sizes.end());
    if (entry != nullptr && entry->role == Role::size) return; // read_sizes has seen it
    const std::string what =
        entry != nullptr ? fmt::format("'{}' is {}, not a parameter", setting.name, role_text(entry->role))
                         : fmt::format("the model has no parameter{} '{}' to {}", sizes.empty() ? "" : " or size",
                                       setting.name, setting.binds ? "bind" : "set");
    const std::string size = nearest_name(setting.name, sizes);
    const bool starts = entry != nullptr && setting.gives_value() && !setting.binds &&
                        (entry->role == Role::base || entry->role == Role::fibre || entry->role == Role::momentum ||
                         entry->role == Role::state);
    const std::string hint =
        entry != nullptr && entry->role == Role::input ? input_hint(setting.name)
        : starts ? fmt::format("where a scene starts is set by --initial {}={}, of `run` and `sweep`", setting.name,
                               setting.value.text)
        : !size.empty() && nearest_name(setting.name, known) == size ? fmt::format("did you mean the size '{}'?", size)
        : resolve_key(symbols, family_name(setting.name))
            ? hint_for_key(symbols, setting.name, "parameters")
            : hint_for(setting.name, known, sizes.empty() ? "parameters" : "parameters and sizes");
    const std::string given = setting.gives_value() ? setting.name + "=" + setting.value.text : setting.name;
    throw ModelError(what, whole_text(option_of(setting), given).range(0, setting.name.size()), hint);
}

/// A constraint without base coordinates holds everywhere or nowhere.
void require_coordinate(const ModelReader& reader, const Tree& closed, const Excerpt& text)
{
    for (const std::string& name : names_in(closed)) {
        const Names::Entry* entry = reader.names.find(name);
        if (entry != nullptr && entry->role == Role::base) return;
    }
    throw ModelError(fmt::format("the constraint '{}' contains no base coordinate", text.text), place_of(text),
                     "a constraint is an expression of base coordinates that is zero");
}

/// A constraint that moves with t leaves the base: its rate is a constraint on velocities, with a drift.
void refuse_moving(const ModelReader& reader, const std::vector<Tree>& closed, const Excerpt& text)
{
    constexpr std::size_t longest = 60; ///< characters of the constraint in the hint
    const Tree time =
        find_name(closed, [&](const std::string& name) { return name == "t" && reader.names.find(name) == nullptr; });
    if (time == nullptr) return;
    throw complain::may_not_depend(
        "a constraint", "the time ('t')", time->where.file ? time->where : place_of(text),
        fmt::format("constraints of which one moves with t are constraints on velocities, with a drift: "
                    "kind = \"nonholonomic\" with constraints = [\"Dt({})\"], each of them in Dt, and "
                    "[algebroid.of] kind = \"tangent\"",
                    text.text.size() <= longest ? text.text : ".."));
}

bool is_strict(Comparison comparison)
{
    return comparison == Comparison::less || comparison == Comparison::greater || comparison == Comparison::not_equal;
}

/// One strict inequality an entry: a vector is compared with a scalar, or with a vector of its shape.
std::vector<Tree> read_inequalities(const ModelReader& reader, const Excerpt& text)
{
    const Tree parsed = parse_comparison(text);
    if (parsed->kind != TreeKind::compare || !is_strict(parsed->comparison))
        throw ModelError(fmt::format("the domain condition '{}' is not a strict inequality", text.text), place_of(text),
                         "use <, > or !=");
    const auto close = [&](std::size_t side) {
        return reader.close(parsed->arguments[side], Role::parameter | Role::base, "the domain");
    };
    const ArrayValue left = close(0);
    const ArrayValue right = close(1);
    const bool scalars = left.shape.rank == Rank::scalar && right.shape.rank == Rank::scalar;
    const bool alike = left.shape == right.shape || left.shape.rank == Rank::scalar || right.shape.rank == Rank::scalar;
    if (scalars || !alike) return {reader.scalar(parsed, Role::parameter | Role::base, "the domain")};
    std::vector<Tree> inequalities;
    for (std::size_t k = 0; k < std::max(left.shape.size(), right.shape.size()); ++k)
        inequalities.push_back(compare(parsed->comparison, left.entries[left.entries.size() == 1 ? 0 : k],
                                       right.entries[right.entries.size() == 1 ? 0 : k]));
    return inequalities;
}

// Depth-first search with its own stack: a chain of parameters is as long as a user makes it.

struct Visit {
    std::size_t value;
    std::vector<std::string> uses;
    std::size_t next;
};

[[noreturn]] void refuse_cycle(const std::vector<NamedTree>& values, const std::vector<Visit>& path, std::size_t first,
                               const char* noun)
{
    constexpr std::size_t most = 8;
    const auto start = std::find_if(path.begin(), path.end(), [&](const Visit& v) { return v.value == first; });
    std::string cycle;
    for (auto each = start; each != path.end(); ++each) {
        if (static_cast<std::size_t>(each - start) == most) {
            cycle += "... -> ";
            break;
        }
        cycle += values[each->value].name + " -> ";
    }
    throw ModelError(fmt::format("the {} depend on each other in a cycle: {}{}", noun, cycle, values[first].name),
                     values[first].where, "give one of them a value of its own");
}

} // namespace

void read_sizes(ModelReader& reader)
{
    std::vector<NamedTree> sizes;
    for (const Item& item : reader.at("sizes").items()) {
        reader.names.declare(item.name(), Role::size, item.where());
        Tree value = read_expression(item.value(), item.title());
        for (const Setting& setting : *reader.settings)
            if (setting.name == item.name() && setting.gives_value()) value = parse_expression(setting.value);
        sizes.push_back(NamedTree{item.name(), std::move(value), item.where()});
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

void read_parameters(ModelReader& reader)
{
    std::vector<Parameter>& parameters = reader.model.parameters;
    const std::vector<Symbol> symbols = symbols_of(reader.model, Role::parameter);
    reader.read_declared(reader.at("parameters"),
                         [&](std::size_t k, const Tree& value) { parameters[k].value = value; });
    for (const Setting& setting : *reader.settings)
        if (!setting.sizes_alone) apply(reader, symbols, setting);
    std::vector<NamedTree> values;
    for (const Parameter& each : parameters) values.push_back({each.symbol.name, each.value, each.symbol.where});
    (void)dependency_order(values, "parameters");
}

void read_base(ModelReader& reader)
{
    Base& base = reader.model.base;
    const Item block = reader.at("base");
    constexpr Roles point = Role::parameter | Role::base;
    for (const Excerpt& text : block.at("constraints").texts()) {
        refuse_equation(text, "the constraint");
        ArrayValue closed = reader.close(parse_expression(text), point | Role::time, "a constraint");
        refuse_moving(reader, closed.entries, text);
        for (Tree& entry : closed.entries) {
            require_coordinate(reader, entry, text);
            base.constraints.push_back(std::move(entry));
            base.constraint_texts.push_back(place_of(text));
        }
    }
    if (reader.own_constraints) { // of a level set, without repetitions
        base.constraints = entries_at(base.constraints, *reader.own_constraints);
        base.constraint_texts = entries_at(base.constraint_texts, *reader.own_constraints);
    }
    for (const NamedTree& each : reader.casimirs)
        append_entries(base.casimirs, each,
                       reader.close(each.value, point, fmt::format("the Casimir '{}'", each.name)));
    for (const Excerpt& text : block.at("domain").texts())
        for (Tree& inequality : read_inequalities(reader, text)) base.domain.push_back(std::move(inequality));
}

std::vector<std::size_t> dependency_order(const std::vector<NamedTree>& values, const char* noun)
{
    std::unordered_map<std::string, std::size_t> index; // looked up, never iterated
    for (std::size_t k = 0; k < values.size(); ++k) index.emplace(values[k].name, k);
    enum class State { fresh, open, done };
    std::vector<State> state(values.size(), State::fresh);
    std::vector<std::size_t> order;
    std::vector<Visit> path;
    const auto enter = [&](std::size_t k) {
        state[k] = State::open;
        path.push_back(Visit{k, names_in(values[k].value), 0});
    };
    for (std::size_t first = 0; first < values.size(); ++first) {
        if (state[first] == State::fresh) enter(first);
        while (!path.empty()) {
            Visit& top = path.back();
            if (top.next == top.uses.size()) {
                state[top.value] = State::done;
                order.push_back(top.value);
                path.pop_back();
                continue;
            }
            const auto place = index.find(top.uses[top.next++]);
            if (place == index.end() || state[place->second] == State::done) continue;
            if (state[place->second] == State::open) refuse_cycle(values, path, place->second, noun);
            enter(place->second);
        }
    }
    return order;
}

} // namespace lagen
