// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>

namespace cactus
{

/// The two largest fields at a small cube of samples, x fastest.
struct FieldCell
{
  static constexpr int edge = 4; ///< samples along each side
  static constexpr int size = edge * edge * edge;

  int lower[3];        ///< grid index of the cell's first sample
  int begin[3];        ///< the requested part: cell-relative indices [begin, end)
  int end[3];          ///<
  const float* best;   ///< largest field, `size` values
  const float* second; ///< largest field of any other fibre
  const int* rank;     ///< fibre of `best` (rank as in CapsuleField), -1 if no fibre is near

  /// Calls visit(n) for the requested samples: n is the index into `best`, `second` and `rank`.
  template <typename Visit>
  void forEachSample(Visit&& visit) const
  {
    for (int k = this->begin[2]; k < this->end[2]; ++k)
    {
      for (int j = this->begin[1]; j < this->end[1]; ++j)
      {
        const int row = edge * (j + edge * k);
        for (int i = row + this->begin[0]; i < row + this->end[0]; ++i)
        {
          visit(i);
        }
      }
    }
  }
};

/// Receives a cell and the index of the calling thread.
using FieldSink = std::function<void(const FieldCell&, int)>;

} // namespace cactus
