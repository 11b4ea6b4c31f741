// Input faults of the core: std::invalid_argument with the text "name[index]: value fault".
// The text locates the entry in its array. The binding turns the exception into ValueError.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>

namespace rightofway {

[[noreturn]] inline void reject(const std::string& name, std::int64_t value,
                                const std::string& what) {
    throw std::invalid_argument(name + ": " + std::to_string(value) + " " + what);
}

[[noreturn]] inline void reject_entry(const std::string& name, std::size_t index,
                                      std::int64_t value, const std::string& what) {
    reject(name + "[" + std::to_string(index) + "]", value, what);
}

// Throws unless the id is in 0 .. count - 1.
inline void require_id(const std::string& name, std::int64_t id, std::int64_t count) {
    if (id < 0 || id >= count) {
        reject(name, id, "is not in 0.." + std::to_string(count - 1));
    }
}

inline void require_length(const std::string& name, std::size_t length, std::size_t expected) {
    if (length != expected) {
        throw std::invalid_argument(name + ": its length is " + std::to_string(length) +
                                    ", but must be " + std::to_string(expected));
    }
}

}  // namespace rightofway
