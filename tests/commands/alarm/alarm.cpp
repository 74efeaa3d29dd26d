// SPDX-License-Identifier: GPL-2.0-or-later
/// In this build of lagen one question to the zero decider finds a defect: the linker sends the questions here first
/// (--wrap). LAGEN_ALARM says which one, "decide 3": the third call of `decide`.
#include "proof/decide.hpp"

#include <cstdlib>
#include <string>

namespace {

using lagen::Decision;
using lagen::NodeId;
using lagen::ProofStatus;
using lagen::ZeroDecider;

void count(const char* question)
{
    static const char* wanted = std::getenv("LAGEN_ALARM");
    static int calls = 0;
    const std::string text = wanted == nullptr ? "" : wanted;
    const std::size_t space = text.find(' ');
    if (text.substr(0, space) != question || ++calls != std::atoi(text.c_str() + space)) return;
    throw lagen::InternalError("the alarm of a test");
}

} // namespace

// NOLINTBEGIN: the names that the linker knows
#ifdef __clang__
#pragma clang diagnostic ignored "-Wreturn-type-c-linkage"
#endif
extern "C" {
ProofStatus __real__ZNK5lagen11ZeroDecider6statusEj(const ZeroDecider* decider, NodeId node);
Decision __real__ZNK5lagen11ZeroDecider6decideEj(const ZeroDecider* decider, NodeId node);
bool __real__ZNK5lagen11ZeroDecider14proves_nonzeroEj(const ZeroDecider* decider, NodeId node);
bool __real__ZNK5lagen11ZeroDecider15proves_positiveEj(const ZeroDecider* decider, NodeId node);
bool __real__ZNK5lagen11ZeroDecider18proves_nonnegativeEj(const ZeroDecider* decider, NodeId node);

ProofStatus __wrap__ZNK5lagen11ZeroDecider6statusEj(const ZeroDecider* decider, NodeId node)
{
    count("status");
    return __real__ZNK5lagen11ZeroDecider6statusEj(decider, node);
}
Decision __wrap__ZNK5lagen11ZeroDecider6decideEj(const ZeroDecider* decider, NodeId node)
{
    count("decide");
    return __real__ZNK5lagen11ZeroDecider6decideEj(decider, node);
}
bool __wrap__ZNK5lagen11ZeroDecider14proves_nonzeroEj(const ZeroDecider* decider, NodeId node)
{
    count("nonzero");
    return __real__ZNK5lagen11ZeroDecider14proves_nonzeroEj(decider, node);
}
bool __wrap__ZNK5lagen11ZeroDecider15proves_positiveEj(const ZeroDecider* decider, NodeId node)
{
    count("positive");
    return __real__ZNK5lagen11ZeroDecider15proves_positiveEj(decider, node);
}
bool __wrap__ZNK5lagen11ZeroDecider18proves_nonnegativeEj(const ZeroDecider* decider, NodeId node)
{
    count("nonnegative");
    return __real__ZNK5lagen11ZeroDecider18proves_nonnegativeEj(decider, node);
}
}
// NOLINTEND
