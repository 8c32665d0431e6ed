// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QObject>

class pqDataRepresentation;
class pqPVApplicationCore;
class pqPipelineSource;

namespace cactus
{

/// Adds units to the titles of colour bars of this plugin's data: "Depth (µm)". The filter's XML has the unit of each array. A
/// title written by the user stays.
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
