// How a search can end. "Proven that there is none" and "gave up" are different answers.
#pragma once

#include <cstdint>
#include <functional>

namespace rightofway {

enum class SearchEnd : std::int32_t { found = 0, proven_none = 1, stopped = 2 };

// Asked now and then by whatever takes long: true once it has to stop, for a deadline or an
// interrupt.
using StopCondition = std::function<bool()>;

}  // namespace rightofway
