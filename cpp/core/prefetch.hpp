// Asks for memory that is soon needed. Nothing but the time it takes depends on it.
#pragma once

namespace rightofway {

inline void prefetch([[maybe_unused]] const void* address) {
#if defined(__GNUC__) || defined(__clang__)
    __builtin_prefetch(address);
#endif
}

}  // namespace rightofway
