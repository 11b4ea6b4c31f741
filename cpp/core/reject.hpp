// Input faults of the core: std::invalid_argument with the text "name[index]: value fault".
// The text locates the entry in its array. The binding turns the exception into ValueError.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
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

// Throws unless the value is in least .. most.
inline void require_range(const std::string& name, std::int64_t value, std::int64_t least,
                          std::int64_t most) {
    if (value < least || value > most) {
        reject(name, value, "is not in " + std::to_string(least) + ".." + std::to_string(most));
    }
}

// Throws unless the id is in 0 .. count - 1.
inline void require_id(const std::string& name, std::int64_t id, std::int64_t count) {
    if (count <= 0) {
        reject(name, id, "does not exist (there are none)");
    }
    require_range(name, id, 0, count - 1);
}

// The same for all entries of an array. Builds a text only for the entry that it refuses.
template <class T>
void require_ranges(const char* name, std::span<const T> values, std::int64_t least,
                    std::int64_t most) {
    for (std::size_t k = 0; k < values.size(); ++k) {
        if (values[k] < least || values[k] > most) {
            require_range(std::string(name) + "[" + std::to_string(k) + "]", values[k], least,
                          most);
        }
    }
}

inline void require_ids(const char* name, std::span<const std::int32_t> ids, std::int64_t count) {
    for (std::size_t k = 0; k < ids.size(); ++k) {
        if (ids[k] < 0 || ids[k] >= count) {
            require_id(std::string(name) + "[" + std::to_string(k) + "]", ids[k], count);
        }
    }
}

inline void require_length(const std::string& name, std::size_t length, std::size_t expected) {
    if (length != expected) {
        throw std::invalid_argument(name + ": its length is " + std::to_string(length) +
                                    ", but must be " + std::to_string(expected));
    }
}

// Throws unless list k can be the entries first[k] .. first[k + 1] - 1 of `n_entries` in all: the
// numbers rise from 0 to `n_entries`, each by at least `least`. `entries` says what they number.
inline void require_lists(const char* name, std::span<const std::int32_t> first,
                          std::size_t n_entries, const char* entries = "entries",
                          std::int32_t least = 0) {
    if (first.empty()) {
        throw std::invalid_argument(std::string(name) +
                                    ": its length is 0, but must be at least 1");
    }
    if (first.front() != 0) {
        reject_entry(name, 0, first.front(), "must be 0");
    }
    for (std::size_t k = 1; k < first.size(); ++k) {
        if (std::int64_t{first[k]} < std::int64_t{first[k - 1]} + least) {
            reject_entry(name, k, first[k],
                         least == 0 ? "is less than the entry before it"
                                    : "is not at least " + std::to_string(least) +
                                          " above the entry before it");
        }
    }
    if (static_cast<std::size_t>(first.back()) != n_entries) {
        reject_entry(
            name, first.size() - 1, first.back(),
            std::string("is not the number of ") + entries + ", " + std::to_string(n_entries));
    }
}

}  // namespace rightofway
