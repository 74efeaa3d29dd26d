// SPDX-License-Identifier: GPL-2.0-or-later
#include "emit/print_function.hpp"
#include "emit/print_kernel.hpp"
#include "emit/spell.hpp"
#include "text/comma_list.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace lagen {

namespace {

/// solve_NAME() of one block.
class ImplicitPrinter {
  public:
    ImplicitPrinter(TextBlock& out, const KernelModule& module, const ModuleNames& names, const ImplicitBlock& block)
        : out_(out), module_(module), names_(names), block_(block), size_(block.unknowns.size()),
          inputs_(point_inputs(module))
    {
        std::vector<NodeId> start = block.guess;
        if (block.bracket)
            for (const auto* ends : {&block.bracket->lower, &block.bracket->upper})
                for (const std::optional<NodeId>& end : *ends)
                    if (end) start.push_back(*end);
        std::vector<NodeId> inner;
        if (block.angles) {
            inner = block.angles->b;
            inner.insert(inner.end(), block.angles->c.begin(), block.angles->c.end());
        } else {
            inner = block.residuals;
            for (std::size_t k = 0; k < block.jacobian.size(); ++k)
                if (!block.bracket || k % (size_ + 1) == 0) inner.push_back(block.jacobian[k]);
            inner.insert(inner.end(), block.sizes.begin(), block.sizes.end());
            if (!block.bracket) inner.insert(inner.end(), block.inside.begin(), block.inside.end());
        }
        start_ = body_of(start);
        iteration_ = body_of(inner);
        inputs_.push_back(unknowns_of(block, "unknowns"));
    }

    void print()
    {
        out_.blank();
        out_.comment(block_.documentation);
        out_.comment(block_.angles
                         ? "In closed form; answers singular_control, and NaN in z, where one has no direction."
                     : block_.bracket
                         ? "By Newton's method and bisection; answers newton_diverged, and NaN in z, where a value is "
                           "not finite."
                         : "By Newton's method; answers newton_diverged, and NaN in z, where it finds no solution to "
                           "round-off.");
        std::vector<std::string> arguments;
        for (const KernelInput& input : std::span(inputs_).first(2))
            arguments.push_back(maybe_unused(reads(start_, input) || reads(iteration_, input)) + type_of(input) + " " +
                                input.name);
        open_block(out_, fmt::format("[[nodiscard]] status_t<S> solve_{}({}, std::array<S, {}>& z) const noexcept",
                                     block_.name, comma_list(arguments), size_));
        block_.bracket ? print_bounds() : print_guess();
        block_.angles ? print_angles() : print_iteration();
        close_block(out_);
    }

    /// Of the functions that the search calls.
    [[nodiscard]] Includes includes() const
    {
        Includes all = includes_of(start_);
        all.merge(includes_of(iteration_));
        return all;
    }

  private:
    [[nodiscard]] Body body_of(const std::vector<NodeId>& outputs) const
    {
        return write_body({*module_.graph, names_.locals, outputs, {}, names_.moving, Checking::none, {}, 0});
    }

    /// Before the search, in braces of its own.
    void print_scope(const Body& body, std::function<std::string(std::size_t, const std::string&)> store)
    {
        open_block(out_, "");
        print_lines(out_, body, request(std::move(store)));
        close_block(out_);
    }

    [[nodiscard]] FunctionRequest request(std::function<std::string(std::size_t, const std::string&)> store) const
    {
        return {module_, names_, "solve_" + block_.name, false, inputs_, {}, std::move(store)};
    }

    void print_guess()
    {
        print_scope(start_, [this](std::size_t k, const std::string& value) {
            if (!block_.follows) return fmt::format("z[{}] = {};", k, value);
            return fmt::format("z[{}] = number_or<S>(guess.{}, {});", k, names_.guess.at(block_.unknowns[k]), value);
        });
    }

    void print_angles()
    {
        out_.line(fmt::format("std::array<S, {}> b, c;", size_));
        print_scope(iteration_, [this](std::size_t k, const std::string& value) {
            return fmt::format("{}[{}] = {};", k < size_ ? "b" : "c", k % size_, value);
        });
        out_.line("return nearest_angles(b, c, z);");
    }

    void print_bounds()
    {
        std::vector<std::string> places; // of the ends that are there
        out_.line(fmt::format("std::array<S, {}> lower, upper;", size_));
        for (const bool is_lower : {true, false}) {
            const auto& ends = is_lower ? block_.bracket->lower : block_.bracket->upper;
            for (std::size_t k = 0; k < size_; ++k) {
                const std::string place = fmt::format("{}[{}]", is_lower ? "lower" : "upper", k);
                if (ends[k])
                    places.push_back(place);
                else
                    out_.line(fmt::format("{} = S({}std::numeric_limits<real_t<S>>::infinity());", place,
                                          is_lower ? "-" : ""));
            }
        }
        print_scope(start_, [&places](std::size_t k, const std::string& value) {
            return fmt::format("{} = {};", places[k], value);
        });
    }

    void print_iteration()
    {
        const std::size_t derivatives = block_.bracket ? size_ : size_ * size_;
        out_.line(fmt::format("return {0}(z, {1}[&](const std::array<S, {2}>& unknowns, std::array<S, {2}>& residual, "
                              "std::array<S, {3}>& derivative, std::array<S, {2}>& size) noexcept {{",
                              block_.bracket ? "bracket" : "newton", block_.bracket ? "lower, upper, " : "", size_,
                              derivatives));
        out_.indent(1);
        const std::size_t conditions = block_.bracket ? 0 : block_.inside.size();
        if (conditions > 0) out_.line(fmt::format("std::array<S, {}> inside;", conditions));
        const std::pair<const char*, std::size_t> arrays[] = {
            {"residual", size_}, {"derivative", derivatives}, {"size", size_}, {"inside", conditions}};
        print_lines(out_, iteration_, request([&arrays](std::size_t k, const std::string& value) {
                        const auto* array = arrays;
                        for (; k >= array->second; ++array) k -= array->second;
                        return fmt::format("{}[{}] = {};", array->first, k, value);
                    }));
        if (conditions > 0) out_.line("require_positive(inside, residual);");
        out_.indent(-1);
        out_.line("});");
    }

    TextBlock& out_;
    const KernelModule& module_;
    const ModuleNames& names_;
    const ImplicitBlock& block_;
    std::size_t size_;
    std::vector<KernelInput> inputs_; ///< t, s, unknowns
    Body start_;                      ///< the guess, or the ends of the bracket
    Body iteration_; ///< residuals, then the Jacobian, sizes and conditions; of a bracket the Jacobian's diagonal, no
                     ///< conditions; of angles b, then c
};

/// The part of follow() that is about one block.
void follow_block(TextBlock& out, const KernelModule& module, const ModuleNames& names, const ImplicitBlock& block)
{
    const std::size_t size = block.unknowns.size();
    const std::string solved = "solved_" + block.name;
    std::vector<std::string> members;
    for (const NodeId id : block.unknowns) members.push_back("guess." + names.guess.at(id));
    std::string kept = "guess.{0} = number_or<S>({1}[{2}], guess.{0});";
    if (!block.angles) {
        const Body body =
            write_body({*module.graph, names.locals, block.jacobian, {}, names.moving, Checking::none, {}, 0});
        out.line(fmt::format("const std::array<S, {}> from = {{{}}};", size, comma_list(members)));
        out.line(fmt::format("const auto curvature = [&]([[maybe_unused]] const std::array<S, {}>& unknowns, "
                             "std::array<S, {}>& matrix) noexcept {{",
                             size, size * size));
        out.indent(1);
        std::vector<KernelInput> inputs = point_inputs(module);
        inputs.push_back(unknowns_of(block, "unknowns"));
        print_lines(out, body,
                    {module, names, "follow", false, inputs, {}, [](std::size_t k, const std::string& value) {
                         return fmt::format("matrix[{}] = {};", k, value);
                     }});
        out.indent(-1);
        out.line("};");
        out.line(fmt::format("const auto same = is_same_maximum(from, {}, curvature);", solved));
        out.line("StatusOf<S>::fail(status, !same, Status::not_a_maximum);");
        kept = "guess.{0} = select(same, {1}[{2}], guess.{0});";
    }
    for (std::size_t k = 0; k < size; ++k)
        out.line(fmt::format(fmt::runtime(kept), names.guess.at(block.unknowns[k]), solved, k));
}

} // namespace

void print_guess(TextBlock& out, const KernelModule& module, const ModuleNames& names)
{
    std::vector<std::string> members;
    for (const ImplicitBlock& block : module.implicit)
        if (block.follows)
            for (const NodeId unknown : block.unknowns) members.push_back(names.guess.at(unknown));
    if (members.empty()) return;
    out.blank();
    out.comment("Where the next search for the controls begins; NaN: where the model says. follow() keeps it.");
    out.line("struct Guess {");
    out.indent(1);
    for (const std::string& member : members)
        out.line(fmt::format("S {} = S(std::numeric_limits<real_t<S>>::quiet_NaN());", member));
    out.indent(-1);
    out.line("} guess;");
}

void print_follow(TextBlock& out, const KernelModule& module, const ModuleNames& names)
{
    std::vector<const ImplicitBlock*> followed;
    bool watches = false;
    for (const ImplicitBlock& block : module.implicit) {
        if (block.follows) followed.push_back(&block);
        watches = watches || (block.follows && !block.angles);
    }
    if (followed.empty()) return;
    out.blank();
    out.comment("The controls at (t, s) become the guess of the next search: called at the start of a run and after "
                "each of its");
    out.comment("steps, it follows their branch; integrate() does so. A control that is not found leaves its guess as "
                "it is.");
    if (watches)
        out.comment(
            "not_a_maximum unless d2H/du2 is negative definite at them, and on the way to them from the guess.");
    open_block(out, "[[nodiscard]] status_t<S> follow(S t, const State& s) noexcept");
    for (const ImplicitBlock* block : followed) {
        out.line(fmt::format("std::array<S, {}> solved_{};", block->unknowns.size(), block->name));
        const std::string call = fmt::format("solve_{0}(t, s, solved_{0})", block->name);
        out.line(block == followed.front() ? fmt::format("auto status = {};", call)
                                           : fmt::format("status = StatusOf<S>::first(status, {});", call));
    }
    for (const ImplicitBlock* block : followed) follow_block(out, module, names, *block);
    out.line("return status;");
    close_block(out);
}

void print_implicit(TextBlock& out, const KernelModule& module, const ModuleNames& names, const ImplicitBlock& block,
                    Includes& includes)
{
    if (block.follows) includes.insert("lagen/controls.hpp");
    if (block.bracket) includes.insert("lagen/bracket.hpp");
    if (!block.bracket && !block.angles) includes.merge(Includes{"lagen/linear.hpp", "lagen/newton.hpp"});
    ImplicitPrinter printer(out, module, names, block);
    printer.print();
    includes.merge(printer.includes());
}

} // namespace lagen
