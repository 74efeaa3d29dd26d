// SPDX-License-Identifier: GPL-2.0-or-later
/// One walk of a closing. The walk keeps its own stack: chains of definitions are as deep as a user makes them.
#pragma once

#include "expression/combine.hpp"
#include "expression/derivative.hpp"
#include "expression/expansion.hpp"

#include <set>
#include <unordered_map>

namespace lagen {

/// A parameter of a function or the index of a sum, and what it stands for.
struct BoundName {
    const std::string* name;
    Value value;
};

/// The meaning of the names of one body.
struct OpenBody {
    const Definition* definition = nullptr; ///< null: an expression outside of the definitions
    std::vector<BoundName> bound;           ///< the innermost last
    std::shared_ptr<std::map<std::string, Value>> families = std::make_shared<std::map<std::string, Value>>();
    std::unordered_map<const TreeNode*, Value> done; ///< by address; looked up, never iterated
};

/// `enter` gives the value at once where it can, else it leaves a frame; `advance` takes the last frame one step
/// further.
class Expansion::Closing {
  public:
    Closing(Expansion& expansion, const Scope& scope) : expansion_(expansion), scope_(scope) {}

    Value close(const Tree& tree) { return run(enter(tree, std::make_shared<OpenBody>())); }

    Value expand_all(const Definition& definition, std::vector<Value> arguments)
    {
        return run(expand(definition, std::move(arguments), definition.where));
    }

  private:
    using Result = Value; ///< null: a frame was left that will give it

    enum class Step { operation, definition, repetition };

    /// An operation or application whose arguments are being closed, a definition whose body is, or a sum whose bounds
    /// and terms are.
    struct Frame {
        Tree tree = {}; ///< null for a definition
        std::shared_ptr<OpenBody> body = {};
        Step step = Step::operation;
        std::vector<Value> arguments = {};
        Key key = {};                     ///< of a definition
        Repetition* repetition = nullptr; ///< of a sum whose bounds are closed
        long from = 0, to = 0, next = 0;  ///< of a sum; `next` is the index of the term that is being closed
        long before = 0;                  ///< the terms up to here are in a partial sum already
    };

    Value run(Result result);
    Result enter(const Tree& tree, const std::shared_ptr<OpenBody>& body);
    Tree as_printed(const TreeNode& node, const OpenBody& body) const;
    Result enter_name(const Tree& tree, const std::shared_ptr<OpenBody>& body);
    Result advance();
    Result finish_definition();
    Result finish_operation();
    Result expand(const Definition& definition, std::vector<Value> arguments, const SourceRange& use);

    Result advance_repetition();
    void start_repetition(Frame& top);
    Result next_term(Frame& top);
    Result finish_repetition();
    Result open_repetition(Frame& top);
    const std::set<std::string>& names_of(const TreeNode& repetition);
    Value join_terms(const Frame& top, const Maker& make) const;
    std::size_t count_terms(const Frame& top) const;

    Value family(const std::string& name, const Shape& shape, const OpenBody& body) const;
    const Definition& function_of(const TreeNode& node, const OpenBody& body) const;
    /// The operator that an application of diff, grad, jacobian or Dt calls; null for a function of the model and all
    /// else.
    const DerivativeEntry* derivative_of(const TreeNode& node) const;
    [[nodiscard]] bool applies_function(const TreeNode& node) const
    {
        return node.kind == TreeKind::apply && !is_range(node) && derivative_of(node) == nullptr;
    }
    static void require_arity(const TreeNode& node, const DerivativeEntry& entry);
    Value differentiate(const Maker& make, const Tree& tree, std::span<const Value> arguments) const;
    Value rate_of(const Maker& make, const Tree& tree, Closed& X) const;
    void push(Frame frame, const SourceRange& where);
    void refuse_cycle(const Definition& definition, const SourceRange& use) const;
    void refuse_explained(const TreeNode& node) const;
    [[noreturn]] void unknown(const TreeNode& node, const OpenBody& body, bool as_function) const;

    /// Makes nodes for a frame of this body.
    Maker maker(const OpenBody& body, const SourceRange& where)
    {
        return {body.definition ? expansion_.budget_ : budget_, expansion_.signed_identity_, where};
    }

    Expansion& expansion_;
    const Scope& scope_;
    Budget budget_{0, "the expression is longer than {} operations when its sums and arrays are written out",
                   "a family or a sum of this size is beyond what is written out"};
    std::unordered_map<const TreeNode*, std::set<std::string>> names_; ///< looked up, never iterated
    std::vector<Frame> frames_;
    std::vector<const Definition*> active_; ///< of the frames that expand
};

} // namespace lagen
