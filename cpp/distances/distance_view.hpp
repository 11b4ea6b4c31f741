// How far it is from everywhere to one vertex, read from a table that belongs to somebody else.
//
// Where all edges are equally long, one table of edge counts serves robots of any speed.
#pragma once

#include <cstdint>

#include "core/types.hpp"

namespace rightofway {

class DistanceView {
  public:
    static constexpr std::uint16_t no_way = UINT16_MAX;

    DistanceView() = default;
    // `no_way` marks where no way leads on.
    DistanceView(const std::uint16_t* counts, Tick ticks) : narrow_(counts), scale_(ticks) {}
    // -1 marks where no way leads on.
    DistanceView(const std::int32_t* counts, Tick ticks) : wide_(counts), scale_(ticks) {}

    // Ticks to the target, -1 where no way leads there.
    Tick from(VertexId vertex) const {
        if (narrow_ != nullptr) {
            const std::uint16_t count = narrow_[vertex];
            return count == no_way ? -1 : scale_ * count;
        }
        const std::int32_t count = wide_[vertex];
        return count < 0 ? -1 : scale_ * count;
    }

  private:
    const std::uint16_t* narrow_ = nullptr;
    const std::int32_t* wide_ = nullptr;
    Tick scale_ = 1;
};

}  // namespace rightofway
