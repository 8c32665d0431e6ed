// SPDX-License-Identifier: BSD-3-Clause
#include "io/FolderFormat.h"

namespace cactus
{

namespace
{

/// For no simulator: PLY files alone.
class SurfacesFormat : public FolderFormat
{
public:
  bool mayBeBinary() const override { return true; }
  bool mayBeOpen() const override { return true; }
  bool mayBeSample() const override { return true; }
};

} // namespace

const FolderFormat& surfacesFormat()
{
  static const SurfacesFormat format;
  return format;
}

} // namespace cactus
