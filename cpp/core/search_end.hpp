// How a search can end. "Proven that there is none" and "gave up" are different answers.
#pragma once

#include <cstdint>

namespace rightofway {

enum class SearchEnd : std::int32_t { found = 0, proven_none = 1, stopped = 2 };

}  // namespace rightofway
