// The outcomes of a search. "No plan exists" (proven) and "gave up" are different answers.
#pragma once

#include <cstdint>
#include <functional>

namespace rightofway {

enum class SearchEnd : std::int32_t { found = 0, proven_none = 1, stopped = 2 };

// Long computations call the stop condition at intervals. True: stop, because of a deadline or an
// interrupt.
using StopCondition = std::function<bool()>;

}  // namespace rightofway
