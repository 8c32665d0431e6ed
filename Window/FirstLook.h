// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QObject>

class pqPVApplicationCore;
class pqPipelineSource;

namespace cactus
{

/// Fits the camera to the first data of this plugin that a render view shows. ParaView does so when something is shown for the
/// first time, even where an error has left nothing to be seen; what comes of the next Apply would then be seen from within. And
/// fits it again where what is shown has become larger or smaller, by another Side say, as long as nobody has moved the camera.
class FirstLook : public QObject
{
public:
  /// Lives as long as `core`.
  explicit FirstLook(pqPVApplicationCore* core);

private:
  void fit(pqPipelineSource* source);
};

} // namespace cactus
