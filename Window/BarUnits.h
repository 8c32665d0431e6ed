// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QObject>

class pqDataRepresentation;
class pqPVApplicationCore;
class pqPipelineSource;

namespace cactus
{

/// Puts the unit of what colours data of this plugin, as its filter's XML tells of each array, behind the name in the title of
/// the colour bar: "Depth (µm)". A title that somebody has written stays.
class BarUnits : public QObject
{
  Q_OBJECT

public:
  /// Lives as long as `core`.
  explicit BarUnits(pqPVApplicationCore* core);

private:
  void watch(pqPipelineSource* source);
  void afterColouring();
  static void addUnit(pqDataRepresentation* shown);
};

} // namespace cactus
